// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/transformed_solid.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace piola::geometry {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

class TransformedSolid final : public Solid {
 public:
  TransformedSolid(SolidPtr solid, RigidTransform const& placing)
      : solid_(std::move(solid)), to_(placing), back_(transpose(placing.rotation)) {}
  int dimension() const override { return solid_->dimension(); }
  bool distance_is_bound() const override { return solid_->distance_is_bound(); }
  Foot at(Vec<3> const& X) const override {
    Foot const own = solid_->at((1 / to_.scale) * (back_ * (X - to_.move)));
    return {to_.scale * own.distance, to_.rotation * own.normal};
  }
  Bounds bounds() const override {
    Bounds const own = solid_->bounds();
    Bounds all{{{inf, inf, inf}}, {{-inf, -inf, -inf}}};
    for (int corner = 0; corner < 8; ++corner) {
      Vec<3> X;
      for (int c = 0; c < 3; ++c) X[c] = (corner >> c & 1) != 0 ? own.max[c] : own.min[c];
      X = place(X);
      for (int c = 0; c < 3; ++c) {
        if (!std::isfinite(X[c])) return {{{-inf, -inf, -inf}}, {{inf, inf, inf}}};
        all.min[c] = std::min(all.min[c], X[c]);
        all.max[c] = std::max(all.max[c], X[c]);
      }
    }
    return all;
  }
  std::optional<double> exact_volume() const override {
    auto volume = solid_->exact_volume();
    if (volume) *volume *= std::pow(to_.scale, dimension());
    return volume;
  }
  std::vector<Patch> patches() const override { return solid_->patches(); }
  void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const override {
    PIOLA_EXPECTS(edge > 0);
    std::size_t const first = pieces.size();
    solid_->cut_surface(edge / to_.scale, pieces);
    double const larger = std::pow(to_.scale, dimension() - 1);
    for (std::size_t i = first; i < pieces.size(); ++i) {
      pieces[i].X = place(pieces[i].X);
      pieces[i].area = larger * (to_.rotation * pieces[i].area);
    }
  }

 private:
  Vec<3> place(Vec<3> const& X) const { return to_.scale * (to_.rotation * X) + to_.move; }
  SolidPtr solid_;
  RigidTransform to_;
  Mat<3> back_;
};

// Two unit vectors across a unit vector.
std::array<Vec<3>, 2> across(Vec<3> const& n) {
  int least = 0;
  for (int c = 1; c < 3; ++c)
    if (std::abs(n[c]) < std::abs(n[least])) least = c;
  Vec<3> other;
  other[least] = 1;
  Vec<3> const a = cross(n, other), first = (1 / std::sqrt(dot(a, a))) * a;
  return {first, cross(n, first)};
}

}  // namespace

Mat<3> rotation_about(Vec<3> const& axis, double angle) {
  double const c = std::cos(angle), s = std::sin(angle);
  Mat<3> R = c * identity<3>() + (1 - c) * outer(axis, axis);
  for (int i = 0; i < 3; ++i) {
    int const j = (i + 1) % 3, k = (i + 2) % 3;
    R(j, k) -= s * axis[i];
    R(k, j) += s * axis[i];
  }
  return R;
}

Mat<3> rotation_from_z(Vec<3> const& axis) {
  Vec<3> const z{{0, 0, 1}}, turn = cross(z, axis);
  double const sine = std::sqrt(dot(turn, turn));
  if (sine == 0) return axis[2] > 0 ? identity<3>() : rotation_about({{1, 0, 0}}, std::acos(-1.0));
  return rotation_about((1 / sine) * turn, std::atan2(sine, axis[2]));
}

SolidPtr placed(SolidPtr solid, RigidTransform const& placing) {
  PIOLA_EXPECTS(solid != nullptr);
  PIOLA_EXPECTS(placing.scale > 0);
  if (auto const* half = dynamic_cast<HalfSpace const*>(solid.get()))
    return std::make_shared<HalfSpace>(placing.scale * (placing.rotation * half->point()) + placing.move,
                                       placing.rotation * half->normal(), half->dimension());
  return std::make_shared<TransformedSolid>(std::move(solid), placing);
}

Bounds HalfSpace::bounds() const { return {{{-inf, -inf, -inf}}, {{inf, inf, inf}}}; }

void HalfSpace::cut_surface_around(Bounds const& box, double edge, std::vector<SurfacePiece>& pieces) const {
  PIOLA_EXPECTS(edge > 0);
  Vec<3> const middle = 0.5 * (box.min + box.max), half = 0.5 * (box.max - box.min);
  double const reach = std::sqrt(dot(half, half)), away = at(middle).distance;
  if (std::abs(away) > reach) return;
  Vec<3> const foot = middle - away * normal_;
  int const n = std::max(1, static_cast<int>(std::ceil(2 * reach / edge)));
  double const step = 2 * reach / n;
  auto const axes =
      dimension_ == 3 ? across(normal_) : std::array<Vec<3>, 2>{{{{-normal_[1], normal_[0], 0}}, {{0, 0, 0}}}};
  for (int j = 0; j < (dimension_ == 3 ? n : 1); ++j)
    for (int i = 0; i < n; ++i) {
      double const a = (i + 0.5) * step - reach, b = (j + 0.5) * step - reach;
      Vec<3> const X = foot + a * axes[0] + b * axes[1];
      pieces.push_back({X, (dimension_ == 3 ? step * step : step) * normal_, 0});
    }
}

}  // namespace piola::geometry
