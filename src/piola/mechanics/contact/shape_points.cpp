// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/shape_points.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola::contact {
namespace {

using Kind = RigidSurface::Kind;

constexpr double number_pi = std::numbers::pi;
constexpr double strip = 1;  // spacings from an edge
constexpr int least_around = 24, least_on_sphere = 48;

/// Points at equal distances on a line, both ends among them.
struct EvenRow {
  std::int64_t intervals = 0;
  double length = 0;
  EvenRow(double l, double step)
      : intervals(std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(l / step - 1e-9)))), length(l) {}
  double at(std::int64_t k) const { return length * (static_cast<double>(k) / static_cast<double>(intervals) - 0.5); }
  double share(std::int64_t k) const {
    return (k == 0 || k == intervals ? 0.5 : 1.0) * length / static_cast<double>(intervals);
  }
  double from_end(std::int64_t k) const { return 0.5 * length - std::fabs(at(k)); }
  /// The last point within a distance of the first one.
  std::int64_t within(double distance) const {
    return static_cast<std::int64_t>(distance / length * static_cast<double>(intervals));
  }
  /// The first and the last point between two places.
  std::array<std::int64_t, 2> between(double low, double high) const {
    double const unit = length / static_cast<double>(intervals), n = static_cast<double>(intervals);
    return {static_cast<std::int64_t>(std::clamp(std::floor((low + 0.5 * length) / unit), 0.0, n)),
            static_cast<std::int64_t>(std::clamp(std::ceil((high + 0.5 * length) / unit), 0.0, n))};
  }
};

Vec<3> face_normal(int axis, double side) {
  Vec<3> n;
  n[axis] = side;
  return n;
}

/// Two unit vectors across an axis.
std::array<Vec<3>, 2> axes_across(Vec<3> const& axis) {
  Vec<3> const other = std::fabs(axis[0]) < 0.9 ? Vec<3>{{1, 0, 0}} : Vec<3>{{0, 1, 0}};
  Vec<3> u = other - dot(other, axis) * axis;
  u = (1 / std::sqrt(dot(u, u))) * u;
  return {u, cross(axis, u)};
}

}  // namespace

bool ShapeRange::holds(Vec<3> const& arm) const {
  for (int c = 0; c < 3; ++c)
    if (!(arm[c] >= low[c] && arm[c] <= high[c])) return false;
  return true;
}

ShapePoints::ShapePoints(RigidSurface const& shape, double spacing)
    : shape_(shape),
      spacing_(spacing),
      step_(spacing / (shape.dimension == 3 ? 3 : 4)),
      thin_round_((shape.kind == Kind::sphere || shape.kind == Kind::cylinder) &&
                  2 * shape.radius < thin_below * spacing) {
  PIOLA_EXPECTS(spacing > 0);
}

bool ShapePoints::any() const {
  return shape_.kind == Kind::box || shape_.kind == Kind::cylinder || (shape_.kind == Kind::sphere && thin_round_);
}

std::int64_t ShapePoints::points_of_face(int across_axis) const {
  std::int64_t n = 1;
  for (int c = 0; c < shape_.dimension; ++c)
    if (c != across_axis) n *= EvenRow(2 * shape_.half_lengths[c], step_).intervals + 1;
  return n;
}

/// One face of a box: the points nearer to an edge than a strip.
void ShapePoints::face(int across_axis, double side, std::int64_t first, ShapeRange const& range,
                       std::vector<ShapePoint>& all) const {
  double const place = side * shape_.half_lengths[across_axis];
  if (!(place >= range.low[across_axis] && place <= range.high[across_axis])) return;
  bool const flat = shape_.dimension == 2;
  int const i = across_axis == 0 ? 1 : 0, j = flat ? 2 : 3 - i - across_axis;
  EvenRow const u(2 * shape_.half_lengths[i], step_), v(flat ? 0 : 2 * shape_.half_lengths[j], step_);
  double const width = strip * spacing_ * (1 + 1e-9);
  auto const [u_first, u_last] = u.between(range.low[i], range.high[i]);
  auto const [v_first, v_last] = flat ? std::array<std::int64_t, 2>{0, 0} : v.between(range.low[j], range.high[j]);
  auto const rim = flat ? -1 : v.within(width);
  double const widened = widening(u.length) * (flat ? 1 : widening(v.length));
  for (auto k = u_first; k <= u_last; ++k) {
    bool const whole = u.from_end(k) <= width;
    for (auto m = v_first; m <= v_last; ++m) {
      if (!whole && m > rim && m < v.intervals - rim) m = v.intervals - rim;  // points far from edges are omitted
      if (m > v_last) break;
      ShapePoint p{first + k * (flat ? 1 : v.intervals + 1) + m,
                   {},
                   face_normal(across_axis, side),
                   widened * u.share(k) * (flat ? 1 : v.share(m))};
      p.arm[across_axis] = place;
      p.arm[i] = u.at(k);
      if (!flat) p.arm[j] = v.at(m);
      if (range.holds(p.arm)) all.push_back(p);
    }
  }
}

double ShapePoints::widening(double width) const { return std::max(1.0, spacing_ / width); }

void ShapePoints::add_ring(Ring ring, std::vector<Ring>& all) const {
  ring.first = all.empty() ? 0 : all.back().first + all.back().count;
  ring.count = ring.radius > 0
                   ? std::max<std::int64_t>(least_around, std::llround(std::ceil(2 * number_pi * ring.radius / step_)))
                   : 1;
  all.push_back(ring);
}

/// Circles on a cylinder: near its rims, or, if it is thin, everywhere.
std::vector<ShapePoints::Ring> ShapePoints::rings() const {
  std::vector<Ring> all;
  double const R = shape_.radius, width = strip * spacing_ * (1 + 1e-9), wide = widening(2 * R);
  Vec<3> const& axis = shape_.axis;
  EvenRow const side(2 * shape_.half_lengths[0], step_);
  for (std::int64_t k = 0; k <= side.intervals; ++k)
    if (thin_round_ || side.from_end(k) <= width)
      add_ring({side.at(k) * axis, R, wide * widening(side.length) * 2 * number_pi * R * side.share(k), {}, 1, 0, 0},
               all);
  auto const spokes = std::max<std::int64_t>(1, std::llround(std::ceil(R / step_)));
  double const gap = R / static_cast<double>(spokes);
  for (std::int64_t k = 0; k <= spokes; ++k) {
    double const r = gap * static_cast<double>(k), inner = std::max(r - 0.5 * gap, 0.0),
                 outer = std::min(r + 0.5 * gap, R);
    if (!thin_round_ && R - r > width) continue;
    for (double const end : {-1.0, 1.0})
      add_ring({(end * shape_.half_lengths[0]) * axis, r, wide * wide * number_pi * (outer * outer - inner * inner),
                end * axis, 0, 0, 0},
               all);
  }
  return all;
}

/// Spread evenly along a spiral; in 2D around a circle.
void ShapePoints::sphere(ShapeRange const& range, std::vector<ShapePoint>& all) const {
  double const R = shape_.radius;
  bool const flat = shape_.dimension == 2;
  double const size = flat ? 2 * number_pi * R : 4 * number_pi * R * R, wide = widening(2 * R);
  auto const n = std::max<std::int64_t>(flat ? least_around : least_on_sphere,
                                        std::llround(std::ceil(size / (flat ? step_ : step_ * step_))));
  double const golden = number_pi * (3 - std::sqrt(5.0)), count = static_cast<double>(n);
  for (std::int64_t k = 0; k < n; ++k) {
    double const z = flat ? 0 : 1 - (2 * static_cast<double>(k) + 1) / count, r = std::sqrt(1 - z * z);
    double const turn = static_cast<double>(k) * (flat ? 2 * number_pi / count : golden);
    Vec<3> const n_k{{r * std::cos(turn), r * std::sin(turn), z}};
    if (range.holds(R * n_k)) all.push_back({k, R * n_k, n_k, (flat ? wide : wide * wide) * size / count});
  }
}

std::vector<ShapePoint> ShapePoints::within(ShapeRange const& range) const {
  std::vector<ShapePoint> all;
  if (shape_.kind == Kind::sphere) sphere(range, all);
  if (shape_.kind == Kind::box) {
    std::int64_t first = 0;
    for (int c = 0; c < shape_.dimension; ++c)
      for (double const side : {-1.0, 1.0}) {
        face(c, side, first, range, all);
        first += points_of_face(c);
      }
  }
  if (shape_.kind != Kind::cylinder) return all;
  auto const [u, v] = axes_across(shape_.axis);
  for (Ring const& ring : rings())
    for (std::int64_t k = 0; k < ring.count; ++k) {
      double const turn = 2 * number_pi * static_cast<double>(k) / static_cast<double>(ring.count);
      Vec<3> const out = std::cos(turn) * u + std::sin(turn) * v;
      Vec<3> const arm = ring.middle + ring.radius * out;
      if (range.holds(arm))
        all.push_back(
            {ring.first + k, arm, ring.normal + ring.outward * out, ring.area / static_cast<double>(ring.count)});
    }
  return all;
}

}  // namespace piola::contact
