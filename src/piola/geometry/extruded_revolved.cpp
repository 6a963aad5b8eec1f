// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/extruded_revolved.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola::geometry {
namespace {

std::vector<Patch> patches_named(std::vector<std::string> const& names) {
  std::vector<Patch> patches;
  patches.reserve(names.size());
  for (std::string const& name : names) patches.push_back({name});
  return patches;
}

int parts_over(double length, double edge) { return std::max(1, static_cast<int>(std::ceil(length / edge - 1e-9))); }

/// Cuts an edge of a profile; f(middle, exact vector length).
template <class F>
void cut_edge(ProfileEdge const& e, double edge, F const& f) {
  constexpr double full = 2 * std::numbers::pi;
  bool const circle = e.arc && std::abs(e.sweep) > full - 1e-12;
  int const n = std::max(parts_over(e.length(), edge), e.arc ? 4 : 1);
  double const part = e.length() / n;
  // The chord of an arc's piece, whose vectors sum to that of the arc; pieces of a circle cancel at full length.
  double const size = e.arc && !circle ? 2 * e.radius * std::sin(0.5 * std::abs(e.sweep) / n) : part;
  for (int i = 0; i < n; ++i) {
    auto const [x, normal] = e.point((i + 0.5) / n);
    f(x, size * normal);
  }
}

}  // namespace

Foot Flat::at(Vec<3> const& X) const {
  ProfileFoot const foot = profile_.at({{X[0], X[1]}});
  return {foot.distance, {{foot.normal[0], foot.normal[1], 0}}};
}

Bounds Flat::bounds() const {
  auto const [min, max] = profile_.bounds();
  return {{{min[0], min[1], 0}}, {{max[0], max[1], 0}}};
}

std::vector<Patch> Flat::patches() const { return patches_named(profile_.names()); }

void Flat::cut_surface(double edge, std::vector<SurfacePiece>& pieces) const {
  PIOLA_EXPECTS(edge > 0);
  for (ProfileEdge const& e : profile_.edges())
    cut_edge(e, edge, [&](Vec<2> const& x, Vec<2> const& area) {
      pieces.push_back({{{x[0], x[1], 0}}, {{area[0], area[1], 0}}, e.patch});
    });
}

Foot Extruded::at(Vec<3> const& X) const {
  ProfileFoot const side = profile_.at({{X[0], X[1]}});
  bool const upper = X[2] - to_ > from_ - X[2];
  double const end = upper ? X[2] - to_ : from_ - X[2], sense = upper ? 1 : -1;
  Foot const by_side{side.distance, {{side.normal[0], side.normal[1], 0}}}, by_end{end, {{0, 0, sense}}};
  if (side.distance <= 0 || end <= 0) return side.distance > end ? by_side : by_end;
  double const distance = std::hypot(side.distance, end);
  return {distance, (side.distance / distance) * by_side.normal + (end / distance) * by_end.normal};
}

Bounds Extruded::bounds() const {
  auto const [min, max] = profile_.bounds();
  return {{{min[0], min[1], from_}}, {{max[0], max[1], to_}}};
}

std::vector<Patch> Extruded::patches() const {
  auto patches = patches_named(profile_.names());
  patches.push_back({"-z"});
  patches.push_back({"+z"});
  return patches;
}

void Extruded::cut_surface(double edge, std::vector<SurfacePiece>& pieces) const {
  PIOLA_EXPECTS(edge > 0);
  int const layers = parts_over(to_ - from_, edge);
  double const height = (to_ - from_) / layers;
  for (ProfileEdge const& e : profile_.edges())
    cut_edge(e, edge, [&](Vec<2> const& x, Vec<2> const& length) {
      for (int k = 0; k < layers; ++k)
        pieces.push_back(
            {{{x[0], x[1], from_ + (k + 0.5) * height}}, {{height * length[0], height * length[1], 0}}, e.patch});
    });
  cut_ends(edge, pieces);
}

// Squares of a grid. A square that the outline cuts counts with its inner fraction; all are scaled to the exact area.
void Extruded::cut_ends(double edge, std::vector<SurfacePiece>& pieces) const {
  auto const [min, max] = profile_.bounds();
  int const nx = parts_over(max[0] - min[0], edge), ny = parts_over(max[1] - min[1], edge);
  double const dx = (max[0] - min[0]) / nx, dy = (max[1] - min[1]) / ny;
  std::vector<std::pair<Vec<2>, double>> squares;
  double sum = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      Vec<2> const x{{min[0] + (i + 0.5) * dx, min[1] + (j + 0.5) * dy}};
      ProfileFoot const foot = profile_.at(x);
      double const width = dx * std::abs(foot.normal[0]) + dy * std::abs(foot.normal[1]);
      double const share = std::clamp(0.5 - foot.distance / width, 0.0, 1.0);
      if (share <= 0) continue;
      // The middle of what is inside lies further in.
      squares.emplace_back(x - (0.5 * (1 - share) * width) * foot.normal, share);
      sum += share;
    }
  double const area = profile_.area() / sum;
  int const patch = static_cast<int>(profile_.names().size());
  for (bool const upper : {false, true})
    for (auto const& [x, share] : squares)
      pieces.push_back(
          {{{x[0], x[1], upper ? to_ : from_}}, {{0, 0, (upper ? 1 : -1) * share * area}}, patch + (upper ? 1 : 0)});
}

Foot Revolved::at(Vec<3> const& X) const {
  double const r = std::hypot(X[0], X[1]);
  ProfileFoot const foot = profile_.at({{r, X[2]}});
  double const c = r > 0 ? X[0] / r : 1, s = r > 0 ? X[1] / r : 0;
  return {foot.distance, {{foot.normal[0] * c, foot.normal[0] * s, foot.normal[1]}}};
}

Bounds Revolved::bounds() const {
  auto const [min, max] = profile_.bounds();
  return {{{-max[0], -max[0], min[1]}}, {{max[0], max[0], max[1]}}};
}

std::vector<Patch> Revolved::patches() const { return patches_named(profile_.names()); }

void Revolved::cut_surface(double edge, std::vector<SurfacePiece>& pieces) const {
  PIOLA_EXPECTS(edge > 0);
  for (ProfileEdge const& e : profile_.edges()) {
    int const n = std::max(parts_over(e.length(), edge), e.arc ? 4 : 1);
    for (int i = 0; i < n; ++i) {
      double const low = static_cast<double>(i) / n, high = (i + 1.0) / n;
      Vec<2> const a = e.point(low).first, b = e.point(high).first;
      auto const [middle, normal] = e.point(0.5 * (low + high));
      // Per angle: the exact area of the band, int r ds, and its exact part along the axis, int r dr.
      double const chord = std::sqrt(dot(b - a, b - a));
      double area = 0.5 * (a[0] + b[0]) * chord;
      if (e.arc)
        area = std::abs(e.centre[0] * e.radius * e.sweep / n +
                        e.radius * e.radius * (std::sin(e.start + high * e.sweep) - std::sin(e.start + low * e.sweep)));
      if (!(area > 0)) continue;
      double const axial = 0.5 * (a[0] - b[0]) * (a[0] + b[0]);
      double const radial = std::copysign(std::sqrt(std::max(0.0, area * area - axial * axial)), normal[0]);
      double const r = e.arc ? middle[0] : (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / (1.5 * (a[0] + b[0]));
      int const around = std::max(8, parts_over(2 * std::numbers::pi * std::max(a[0], b[0]), edge));
      double const step = 2 * std::numbers::pi / around;
      for (int k = 0; k < around; ++k) {
        // Bands are staggered, so that pieces are not aligned.
        double const angle = (k + 0.5 * (i % 2)) * step, c = std::cos(angle), s = std::sin(angle);
        pieces.push_back(
            {{{r * c, r * s, middle[1]}}, {{step * radial * c, step * radial * s, step * axial}}, e.patch});
      }
    }
  }
}

}  // namespace piola::geometry
