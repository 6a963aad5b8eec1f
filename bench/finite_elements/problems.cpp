// SPDX-License-Identifier: Apache-2.0
#include "problems.hpp"
#include <algorithm>
#include <limits>
#include <numbers>

namespace bricks {
namespace {

using Point = std::array<double, 3>;
using Count = std::array<std::ptrdiff_t, 3>;

constexpr double degree = std::numbers::pi / 180;
Material const rubber{1100, 17e6, 0.45};

/// Node of a mesh that stands at X in the undeformed box.
std::size_t node_at(Mesh const& mesh, Point const& X) {
  std::array<std::ptrdiff_t, 3> at{};
  for (std::size_t c = 0; c < 3; ++c) at[c] = std::lround((X[c] - mesh.low[c]) / mesh.spacing[c]);
  return static_cast<std::size_t>(at[0] + at[1] * mesh.row + at[2] * mesh.layer);
}

/// Angle about y that turns the top best onto where it is, right-handed:
/// atan2(sum m X x x, sum m X . x) about the axis, unwrapped by the caller.
double top_twist(Mesh const& mesh) {
  double cross = 0, dot = 0;
  mesh.for_each_node([&](std::size_t n, Count const& at) {
    if (at[1] != mesh.cells[1]) return;
    double const Z = mesh.place(at[2], 2), X = mesh.place(at[0], 0);
    cross += mesh.mass[n] * (Z * mesh.x[0][n] - X * mesh.x[2][n]);
    dot += mesh.mass[n] * (Z * mesh.x[2][n] + X * mesh.x[0][n]);
  });
  return std::atan2(cross, dot);
}

/// Mean displacement of the top across.
double top_sway(Mesh const& mesh) {
  double sum = 0, mass = 0;
  mesh.for_each_node([&](std::size_t n, Count const& at) {
    if (at[1] != mesh.cells[1]) return;
    sum += mesh.mass[n] * (mesh.x[0][n] - mesh.place(at[0], 0));
    mass += mesh.mass[n];
  });
  return sum / mass;
}

double height(Mesh const& mesh) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  mesh.for_each_node([&](std::size_t n, Count const& at) {
    if (at[1] == 0) low = std::min(low, mesh.x[1][n]);
    if (at[1] == mesh.cells[1]) high = std::max(high, mesh.x[1][n]);
  });
  return high - low;
}

unsigned foot(Point const& X) { return X[1] <= 0 ? 7U : 0U; }

Problem column(std::string name, std::string about) {
  Problem p;
  p.name = std::move(name);
  p.about = std::move(about);
  p.box = {{-0.5, 0, -0.5}, {0.5, 6, 0.5}};
  p.material = rubber;
  p.cells = [](std::ptrdiff_t n) { return Count{n, 6 * n, n}; };
  p.held = foot;
  return p;
}

Problem twist() {
  Problem p = column("twist", "twisting column, Lee et al. 2016, Section 8.9");
  p.end = 0.11;
  p.sample = 0.5e-3;
  p.velocity = [](Point const& X) {
    double const w = 105 * std::sin(std::numbers::pi * X[1] / 12);
    return Point{w * X[2], 0, -w * X[0]};
  };
  p.trace = [](Mesh const& mesh) { return std::vector{top_twist(mesh)}; };
  p.angle = true;
  p.readings = {{"first_peak_twist", "degree", 0, Statistic::first_peak, 0, degree},
                {"time_of_first_peak", "s", 0, Statistic::time_of_first_peak, 0, 1}};
  return p;
}

Problem twist_long() {
  Problem p = twist();
  p.name = "twist_long";
  p.about = "twisting column at the times of the figures";
  p.end = 0.25;
  p.readings = {{"twist_at_100_ms", "degree", 0, Statistic::at_time, 0.1, degree},
                {"twist_at_250_ms", "degree", 0, Statistic::at_time, 0.25, degree}};
  return p;
}

Problem bend() {
  Problem p = column("bend", "bending column, Lee et al. 2016, Section 8.8");
  p.end = 0.55;
  p.sample = 5e-3;
  p.velocity = [](Point const& X) { return Point{10 * X[1] / 6, 0, 0}; };
  p.trace = [](Mesh const& mesh) { return std::vector{top_sway(mesh)}; };
  p.readings = {{"tip_maximum", "m", 0, Statistic::first_peak, 0, 1},
                {"time_of_tip_maximum", "s", 0, Statistic::time_of_first_peak, 0, 1}};
  return p;
}

Problem bend_long() {
  Problem p = bend();
  p.name = "bend_long";
  p.about = "bending column at the time of the figure";
  p.end = 1.5;
  p.readings = {{"tip_at_1500_ms", "m", 0, Statistic::at_time, 1.5, 1}};
  return p;
}

Problem tensile() {
  Problem p;
  p.name = "tensile";
  p.about = "tensile cube, Lee et al. 2016, Section 8.4";
  p.box = {{0, 0, 0}, {1, 1, 1}};
  p.material = {7000, 21e9, 0.3};
  p.end = 1.2e-3;
  p.sample = 0.01e-3;
  p.cells = [](std::ptrdiff_t n) { return Count{n, n, n}; };
  p.velocity = [](Point const& X) { return Point{0, 800 * X[1], 0}; };
  p.held = foot;
  p.trace = [](Mesh const& mesh) { return std::vector{height(mesh), mesh.x[1][node_at(mesh, {0.5, 1, 0.5})] - 1}; };
  p.readings = {{"largest_height", "m", 0, Statistic::largest, 0, 1},
                {"time_of_largest_height", "ms", 0, Statistic::time_of_largest, 0, 1e-3},
                {"rise_of_the_top_at_0.71_ms", "m", 1, Statistic::at_time, 0.71e-3, 1}};
  return p;
}

/// Rollers on the faces of a box that is open at its top (bits as in Problem::held).
unsigned open_box(Point const& X, Box const& box) {
  constexpr double near = 1e-9;
  unsigned held = X[1] <= box.low[1] + near ? 2U : 0U;
  if (X[0] <= box.low[0] + near || X[0] >= box.high[0] - near) held |= 1U;
  if (X[2] <= box.low[2] + near || X[2] >= box.high[2] - near) held |= 4U;
  return held;
}

Problem punch() {
  Problem p;
  p.name = "punch";
  p.about = "nearly incompressible punch, Lee et al. 2016, Section 8.6";
  p.box = {{0, 0, 0}, {1, 0.5, 0.1}};
  p.material = {1000, 1e6, 0.499};
  p.end = 0.012;
  p.sample = 0.1e-3;
  p.cells = [](std::ptrdiff_t n) { return Count{n, n / 2, 1}; };
  auto const stamp = [](Point const& X) { return X[1] >= 0.5 - 1e-9 && std::abs(X[0] - 0.5) <= 1.0 / 6 + 1e-6; };
  p.velocity = [stamp](Point const& X) { return Point{0, stamp(X) ? -10.0 : 0.0, 0}; };
  p.held = [stamp, box = p.box](Point const& X) { return stamp(X) ? 7U : open_box(X, box); };
  p.trace = [](Mesh const& mesh) { return std::vector{mesh.x[1][node_at(mesh, {1, 0.5, 0})]}; };
  p.readings = {{"corner_height_at_12_ms", "m", 0, Statistic::at_time, 0.012, 1}};
  return p;
}

Problem coining() {
  Problem p;
  p.name = "coining";
  p.about = "symmetric coining, Lee et al. 2016, Section 8.5";
  p.box = {{0, 0, 0}, {0.03, 0.01, 0.005}};
  p.material = {1000, 1e6, 0.495};
  p.end = 0.54e-3;
  p.sample = 0.005e-3;
  p.cells = [](std::ptrdiff_t n) { return Count{6 * n, 2 * n, n}; };
  auto const stamp = [](Point const& X) { return X[1] >= 0.01 - 1e-9 && X[0] <= 0.01 + 1e-9; };
  p.velocity = [stamp](Point const& X) { return Point{0, stamp(X) ? -10.0 : 0.0, 0}; };
  p.held = [stamp](Point const& X) {
    return stamp(X) ? 7U : (X[0] <= 0 ? 1U : 0U) | (X[1] <= 0 ? 2U : 0U) | (X[2] <= 0 ? 4U : 0U);
  };
  p.trace = [](Mesh const& mesh) { return std::vector{mesh.x[0][node_at(mesh, {0.03, 0.01, 0.005})] - 0.03}; };
  p.readings = {{"corner_displacement", "mm", 0, Statistic::at_time, 0.54e-3, 1e-3}};
  return p;
}

Problem spin() {
  Problem p;
  p.name = "spin";
  p.about = "spinning cube, Lee et al. 2016, Section 8.3";
  p.box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  p.material = {1100, 17e6, 0.3};
  p.end = 0.4;
  p.sample = 0.5e-3;
  p.cells = [](std::ptrdiff_t n) { return Count{n, n, n}; };
  p.velocity = [](Point const& X) { return Point{-105 * X[1], 105 * X[0], 0}; };
  p.held = [](Point const&) { return 0U; };
  p.trace = [](Mesh const& mesh) {
    double cross = 0, dot = 0;
    mesh.for_each_node([&](std::size_t n, Count const& at) {
      double const X = mesh.place(at[0], 0), Y = mesh.place(at[1], 1);
      cross += mesh.mass[n] * (X * mesh.x[1][n] - Y * mesh.x[0][n]);
      dot += mesh.mass[n] * (X * mesh.x[0][n] + Y * mesh.x[1][n]);
    });
    return std::vector{std::atan2(cross, dot)};
  };
  p.angle = true;
  p.readings = {{"turns", "turn", 0, Statistic::at_time, 0.4, 2 * std::numbers::pi}};
  return p;
}

/// A mode of linear elasticity, so small that a neo-Hookean solid follows it: the exact answer is cos(omega t) with
/// omega = sqrt(3)/2 pi sqrt((lambda + 2 mu)/rho). Lee et al. 2016, Section 8.2.
Problem swing() {
  constexpr double amplitude = 1e-6, quarter = std::numbers::pi / 2;
  Problem p;
  p.name = "swing";
  p.about = "swinging cube, Lee et al. 2016, Section 8.2: has an exact solution, 0.70750 at 2 ms";
  p.box = {{0, 0, 0}, {1, 1, 1}};
  p.material = {1100, 17e6, 0.3};
  p.end = 2e-3;
  p.sample = 2e-5;
  p.cells = [](std::ptrdiff_t n) { return Count{n, n, n}; };
  p.velocity = [](Point const&) { return Point{}; };
  p.displacement = [](Point const& X) {
    Point s, c;
    for (std::size_t k = 0; k < 3; ++k) {
      s[k] = std::sin(quarter * X[k]);
      c[k] = std::cos(quarter * X[k]);
    }
    return Point{amplitude * s[0] * c[1] * c[2], amplitude * c[0] * s[1] * c[2], amplitude * c[0] * c[1] * s[2]};
  };
  p.held = [](Point const& X) {
    unsigned held = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (X[k] <= 0) held |= 1U << k;
      if (X[k] >= 1) held |= 7U & ~(1U << k);
    }
    return held;
  };
  p.trace = [](Mesh const& mesh) { return std::vector{(mesh.x[0][node_at(mesh, {1, 0, 0})] - 1) / amplitude}; };
  p.readings = {{"displacement_of_the_corner", "1", 0, Statistic::at_time, 2e-3, 1}};
  return p;
}

}  // namespace

std::vector<Problem> problems() {
  return {twist(), twist_long(), bend(), bend_long(), tensile(), coining(), punch(), spin(), swing()};
}

}  // namespace bricks
