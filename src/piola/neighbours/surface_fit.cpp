// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/surface_fit.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace piola {
namespace {

double height_over(PatchFoot const& foot, BlockGrid::Point const& X) {
  double height = 0;
  for (std::size_t c = 0; c < 3; ++c) height += (X[c] - foot.X[c]) * foot.normal[c];
  return height;
}

double distance_between(BlockGrid::Point const& X, BlockGrid::Point const& Y) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) square += (X[c] - Y[c]) * (X[c] - Y[c]);
  return std::sqrt(square);
}

}  // namespace

bool SurfaceFit::OuterSide::operator<(OuterSide const& other) const {
  auto const key = [](OuterSide const& s) { return std::tuple(s.place[2], s.place[1], s.place[0], s.axis, s.upper); };
  return key(*this) < key(other);
}

SurfaceFit::SurfaceFit(BlockGrid const& grid, Outline const& outline, double spacing)
    : grid_(grid), outline_(outline), h_(spacing) {
  PIOLA_EXPECTS(spacing > 0);
  if (!outline.patches) return;
  grid_.each_inside([&](Place const& place) {
    for (std::size_t axis = 0; axis < grid_.dimension(); ++axis)
      for (bool const upper : {false, true})
        if (!grid_.is_inside(BlockGrid::beside(place, axis, upper))) outer_.push_back({place, axis, upper});
  });
  exec_host::parallel_for(static_cast<Index>(outer_.size()),
                          [&](Index k) { label(outer_[static_cast<std::size_t>(k)]); });
  collect_corners();
  std::vector<double> moved(corners_.size());
  exec_host::parallel_for(static_cast<Index>(corners_.size()), [&](Index k) {
    moved[static_cast<std::size_t>(k)] = move(corners_[static_cast<std::size_t>(k)]);
  });
  for (double const distance : moved) {
    farthest_ = std::max(farthest_, distance);
    if (distance < 0) ++unmoved_;
  }
  std::sort(outer_.begin(), outer_.end());
}

void SurfaceFit::collect_corners() {
  corner_number_.assign(grid_.corners(), -1);
  for (OuterSide const& side : outer_) {
    if (side.patch < 0) continue;
    auto const all = grid_.corners_of(side.place, side.axis, side.upper);
    for (std::size_t k = 0; k < BlockSide::corners(grid_.dimension()); ++k) {
      auto& number = corner_number_[grid_.corner_index(all[k])];
      if (number < 0) {
        number = static_cast<std::int32_t>(corners_.size());
        corners_.push_back({{}, grid_.corner_at(all[k])});
      }
      auto& patches = corners_[static_cast<std::size_t>(number)].patches;
      if (std::find(patches.begin(), patches.end(), side.patch) == patches.end()) patches.push_back(side.patch);
    }
  }
}

BlockSide SurfaceFit::side(Place const& place, std::size_t axis, bool upper) const {
  BlockSide side{axis, {}, true};
  auto const corners = grid_.corners_of(place, axis, upper);
  for (std::size_t k = 0; k < BlockSide::corners(grid_.dimension()); ++k) {
    std::int32_t const moved = corner_number_.empty() ? -1 : corner_number_[grid_.corner_index(corners[k])];
    side.flat = side.flat && moved < 0;
    side.corner[k] = moved < 0 ? grid_.corner_at(corners[k]) : corners_[static_cast<std::size_t>(moved)].X;
  }
  return side;
}

int SurfaceFit::patch(Place const& place, std::size_t axis, bool upper) const {
  OuterSide const key{place, axis, upper};
  auto const found = std::lower_bound(outer_.begin(), outer_.end(), key);
  return found == outer_.end() || key < *found ? -1 : found->patch;
}

/// The patch with the least distance from the middle of the side, among those that do not face away.
void SurfaceFit::label(OuterSide& side) const {
  Point const X = this->side(side.place, side.axis, side.upper).middle(grid_.dimension());
  double least = std::numeric_limits<double>::infinity();
  for (PatchFoot const& foot : outline_.patches(X, 0.5 * h_)) {
    double const height = height_over(foot, X), distance = distance_between(X, foot.X);
    double const beside = std::sqrt(std::max(0.0, distance * distance - height * height)) - foot.radius;
    bool const away = (side.upper ? 1 : -1) * foot.normal[side.axis] <= 1e-9;
    double const cost = std::abs(height) + std::max(0.0, beside) + (away ? h_ : 0);
    if (cost < least) side.patch = foot.patch;
    least = std::min(least, cost);
  }
}

/// Returns the distance [spacings], or -1 for a corner that would move too far and stays.
double SurfaceFit::move(Corner& corner) const {
  constexpr int steps = 4;
  constexpr double longest = 0.35;
  Point X = corner.X;
  for (int k = 0; k < steps; ++k) step(corner, X);
  double const distance = distance_between(X, corner.X) / h_;
  if (!(distance < longest)) return -1;
  corner.X = X;
  return distance;
}

/// Newton's step of least norm onto the planes of all patches of a corner.
void SurfaceFit::step(Corner const& corner, Point& X) const {
  constexpr double negligible = 1e-3;  // square of the sine between two patches
  SymMat<3> A;                         // sum of n n^T
  Vec<3> b;                            // sum of heights n
  for (PatchFoot const& foot : outline_.patches(X, 0.5 * h_)) {
    if (std::find(corner.patches.begin(), corner.patches.end(), foot.patch) == corner.patches.end()) continue;
    double height = height_over(foot, X);
    if (corner.patches.size() == 1) height = exact_height(X, height);
    for (int i = 0; i < 3; ++i) {
      double const n = foot.normal[static_cast<std::size_t>(i)];
      b[i] += height * n;
      for (int j = i; j < 3; ++j) A(i, j) += n * foot.normal[static_cast<std::size_t>(j)];
    }
  }
  Eigen<3> const e = symmetric_eigen<3, double>(A);
  for (int k = 0; k < 3; ++k) {
    if (e.value[k] < negligible) continue;
    double const by = dot(e.vector[k], b) / e.value[k];
    for (std::size_t c = 0; c < grid_.dimension(); ++c) X[c] -= by * e.vector[k][static_cast<int>(c)];
  }
}

/// Height over a curved patch: the distance from the body, unless another patch is nearer.
double SurfaceFit::exact_height(Point const& X, double height) const {
  if (!outline_.distance) return height;
  double const distance = outline_.distance(X);
  return std::abs(distance - height) < 0.02 * h_ ? distance : height;
}

}  // namespace piola
