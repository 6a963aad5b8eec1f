// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/rigid_picture.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/projection.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

using Point = std::array<double, 3>;
using Kind = RigidShape::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The part of a ray inside a shape; `normal` is that of the surface where it leaves, towards the viewer.
struct Part {
  double from = -infinity, to = infinity;
  Point normal{};
  void cut(double low, double high, Point const& normal_at_high) {
    from = std::max(from, low);
    if (high >= to) return;
    to = high;
    normal = normal_at_high;
  }
  bool empty() const { return !(from <= to); }
};

/// |(p + s w - centre) . axis| <= half
void cut_slab(Part& part, Point const& r, Point const& w, Point const& axis, double half) {
  constexpr double parallel = 1e-12;  // of unit vectors
  double const a = dot(r, axis), g = dot(w, axis);
  if (std::abs(g) < parallel) {
    if (std::abs(a) > half) part.to = -infinity;
    return;
  }
  double const sign = g > 0 ? 1 : -1;
  part.cut((-sign * half - a) / g, (sign * half - a) / g, {sign * axis[0], sign * axis[1], sign * axis[2]});
}

/// Distance from the axis at most radius; a zero axis: from the centre.
void cut_round(Part& part, Point const& r, Point const& w, Point const& axis, double radius) {
  Point const r_across = plus(r, -dot(r, axis), axis), w_across = plus(w, -dot(w, axis), axis);
  double const a = dot(w_across, w_across), b = dot(r_across, w_across), c = dot(r_across, r_across) - radius * radius;
  if (a < 1e-24) {
    if (c > 0) part.to = -infinity;
    return;
  }
  double const root = b * b - a * c;
  if (root < 0) {
    part.to = -infinity;
    return;
  }
  double const high = (-b + std::sqrt(root)) / a;
  Point normal = plus(r_across, high, w_across);
  for (double& n : normal) n /= radius;
  part.cut((-b - std::sqrt(root)) / a, high, normal);
}

/// A shape as boxes and rounds see it: a plane has become a plate.
struct Solid {
  Kind kind = Kind::box;
  Point centre{};
  std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point half{};
  double radius = 0;
  bool marked = false;  ///< whether it shows how it has turned

  Part seen(Point const& from, Point const& w) const {
    Point const r = minus(from, centre);
    Part part;
    if (kind == Kind::sphere) cut_round(part, r, w, {}, radius);
    if (kind == Kind::cylinder) {
      cut_round(part, r, w, axes[0], radius);
      cut_slab(part, r, w, axes[0], half[0]);
    }
    if (kind == Kind::box)
      for (std::size_t k = 0; k < 3; ++k) cut_slab(part, r, w, axes[k], half[k]);
    return part;
  }
  double reach() const { return kind == Kind::sphere ? radius : std::sqrt(dot(half, half) + radius * radius); }
};

/// Two directions across a unit vector; in a plane the first one lies in it.
std::array<Point, 2> across(Point const& n) {
  Point const other = std::abs(n[2]) < 0.9 ? Point{0, 0, 1} : Point{1, 0, 0};
  Point a{other[1] * n[2] - other[2] * n[1], other[2] * n[0] - other[0] * n[2], other[0] * n[1] - other[1] * n[0]};
  double const length = std::sqrt(dot(a, a));
  for (double& c : a) c /= length;
  return {a, Point{n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]}};
}

/// Every other eighth of a ball, or quarter of a disc, is darker.
bool is_dark(RigidShape const& shape, Point const& at, int dimension) {
  Point const r = minus(at, shape.centre);
  bool dark = false;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) dark = dark != (dot(r, shape.edges[c]) < 0);
  return dark;
}

Solid solid_of(RigidShape const& shape, Stage const& stage) {
  Solid solid{shape.kind, shape.centre};
  solid.half = shape.half_lengths;
  solid.radius = shape.radius;
  solid.marked = shape.kind == Kind::sphere && shape.turns();
  if (shape.kind == Kind::cylinder) solid.axes[0] = shape.axis;
  if (shape.kind == Kind::box) solid.axes = shape.edges;
  if (shape.kind != Kind::plane) return solid;
  double const thick = 0.02 * stage.size(), wide = 0.7 * stage.size();
  Point const middle = stage.middle();
  solid.kind = Kind::box;
  solid.centre = plus(middle, -dot(minus(middle, shape.centre), shape.axis) - thick / 2, shape.axis);
  auto const side = across(shape.axis);
  solid.axes = {shape.axis, side[0], side[1]};
  solid.half = {thick / 2, wide, wide};
  return solid;
}

/// Draws the first intersection of a ray through a sample with one shape.
struct RigidSample {
  RigidCanvas const& canvas;
  SurfaceBuffers& buffers;
  RigidShape const& shape;
  Solid const& solid;

  void draw(int x, int y) const {
    Projection const& project = canvas.project;
    double const fine = canvas.fine;
    ViewRay const line = project.sight((x + 0.5) / fine, (y + 0.5) / fine);
    Part const part = solid.seen(line.from, line.towards);
    if (part.empty() || !std::isfinite(part.to)) return;
    bool const flat = canvas.dimension < 3;
    constexpr float behind_all = -1e30F;
    // Not a number at the eye and behind it, which no comparison lets pass.
    float const depth = flat ? behind_all : static_cast<float>(project.depth(line, part.to) * project.scale * fine);
    std::size_t const at = buffers.at(x, y);
    if (!(depth > buffers.depth[at])) return;
    bool const dark = solid.marked && is_dark(shape, plus(line.from, part.to, line.towards), canvas.dimension);
    Point const& n = part.normal;
    buffers.put(at, depth,
                flat ? SurfaceBuffers::Normal{} : SurfaceBuffers::packed(dot(n, project.right), -dot(n, project.up)), 0,
                dark ? RigidCanvas::dark : RigidCanvas::bright);
  }
};

}  // namespace

Stage Stage::around(std::span<Point const> points) {
  Stage stage{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (Point const& p : points)
    for (std::size_t c = 0; c < 3; ++c) {
      stage.low[c] = std::min(stage.low[c], p[c]);
      stage.high[c] = std::max(stage.high[c], p[c]);
    }
  return points.empty() ? Stage{} : stage;
}

Point Stage::middle() const { return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}; }

double Stage::size() const {
  Point const edges = minus(high, low);
  return std::sqrt(dot(edges, edges));
}

void RigidCanvas::draw(SurfaceBuffers& buffers, std::span<RigidShape const> shapes) const {
  PIOLA_EXPECTS(fine >= 1);
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  for (RigidShape const& shape : shapes) {
    Solid const solid = solid_of(shape, stage);
    auto const centre = project(project.eye.seen(solid.centre));
    // The image of a shape that reaches the eye is unbounded.
    Point const front = plus(solid.centre, solid.reach(), project.towards);
    double const larger = project.eye.magnification(front);
    double const reach = std::isnan(larger)
                             ? buffers.width + buffers.height
                             : (solid.reach() * larger + project.eye.shift(solid.centre, larger)) * project.scale;
    if (!std::isfinite(centre[0]) || !std::isfinite(centre[1]) || !std::isfinite(reach)) continue;
    auto const bound = [&](double value, int low, int high) {
      return static_cast<int>(std::clamp(value * fine, static_cast<double>(low), static_cast<double>(high)));
    };
    int const x0 = bound(centre[0] - reach - 1, 0, width), x1 = bound(centre[0] + reach + 1, 0, width);
    int const y0 = bound(centre[1] - reach - 1, top, buffers.height),
              y1 = bound(centre[1] + reach + 1, 0, buffers.height);
    RigidSample const one{*this, buffers, shape, solid};
    exec_host::parallel_for_chunks(std::max(y1 - y0, 0), std::max(x1 - x0, 0) * std::max(y1 - y0, 0), [&](Index k) {
      for (int x = x0; x < x1; ++x) one.draw(x, y0 + k);
    });
  }
}

void show_shapes(Window& window, View const& view, std::span<RigidShape const> shapes, Stage const& stage) {
  for (RigidShape const& shape : shapes) {
    if (shape.kind == Kind::plane) continue;
    Solid const solid = solid_of(shape, stage);
    if (solid.reach() > 2 * stage.size()) continue;
    std::vector<Point> corners;
    for (int k = 0; k < 8; ++k) {
      Point corner = solid.centre;
      for (std::size_t c = 0; c < 3; ++c)
        corner = plus(corner, (k >> c & 1 ? 1 : -1) * (shape.kind == Kind::sphere ? 0 : solid.half[c]), solid.axes[c]);
      corners.push_back(corner);
    }
    window.include(view, corners, solid.radius);
  }
}

}  // namespace piola
