// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/setup/contact_surface.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

/// Blocks with surfaces, and checks of contact forces.
namespace piola::contact::testing {

inline ShapeSpec box(int dimension, std::array<double, 3> min, std::array<int, 3> particles, double spacing) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.min = min;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.max[c] = min[c] + spacing * particles[c];
    shape.particles[c] = particles[c];
  }
  shape.placement = ShapeSpec::Placement::cell_centred;
  return shape;
}

/// Two stacked blocks. The upper one has another spacing and overlaps the lower one by `depth` [m].
struct Blocks {
  ParticleSet set;
  std::vector<Surface> surfaces;

  explicit Blocks(int dimension, double depth, double spacing = 0.7, double shift = 0.3) {
    std::size_t const up = dimension == 3 ? 2 : 1;
    std::array<double, 3> above{shift, dimension == 3 ? shift : 0, 0};
    above[up] = 3 - depth;
    add(box(dimension, {0, 0, 0}, {5, dimension == 3 ? 5 : 3, 3}, 1));
    add(box(dimension, above, {4, dimension == 3 ? 4 : 3, 3}, spacing));
  }
  void add(ShapeSpec const& shape) {
    fill(shape, "block " + std::to_string(set.bodies.size()), set);
    surfaces.push_back(contact_surface(shape, set, set.bodies.back()));
    surfaces.back().modulus = set.bodies.size() == 1 ? 2e6 : 5e6;
  }
  PairSettings setting(std::size_t rigids, FrictionLaw const& friction = {}) const {
    std::size_t const n = surfaces.size();
    PairSettings s(n, std::vector<PairSetting>(n + rigids, {true, 0.5, friction}));
    for (std::size_t b = 0; b < n; ++b) s[b][b].is_active = false;
    return s;
  }
  SurfaceContactSystem system(std::vector<RigidSurface> rigids = {}, FrictionLaw const& friction = {}) const {
    auto const s = setting(rigids.size(), friction);
    return {set, surfaces, std::move(rigids), s};
  }
};

inline std::vector<Vec<3>> places(SurfaceContactSystem const& system, ParticleSet const& set) {
  std::vector<Vec<3>> x;
  for (auto const id : system.ids()) {
    auto const& X = set.X[static_cast<std::size_t>(id)];
    x.push_back({{X[0], X[1], X[2]}});
  }
  return x;
}

/// Bends, shears and perturbs the positions, so that no face remains flat.
inline void distort(std::vector<Vec<3>>& x, int dimension, double amount) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> some(-1, 1);
  for (Vec<3>& y : x) {
    Vec<3> const X = y;
    y[0] += amount * (0.3 * X[1] + 0.05 * X[0] * X[0]);
    y[1] += amount * (-0.2 * X[0]);
    for (int c = 0; c < dimension; ++c) y[c] += 0.1 * amount * some(random);
  }
}

/// Interleaves the points of a surface at random. The points with x < `middle` keep their relative order, and so do the
/// remaining points.
inline void deal_out(Surface& surface, ParticleSet const& set, double middle, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<SurfacePoint> side[2];
  for (SurfacePoint const& point : surface.points)
    side[set.X[static_cast<std::size_t>(point.particle)][0] < middle ? 0 : 1].push_back(point);
  std::size_t next[2]{};
  for (SurfacePoint& point : surface.points) {
    bool const any[2]{next[0] < side[0].size(), next[1] < side[1].size()};
    std::size_t const from = any[0] && any[1] ? random() % 2 : any[0] ? 0 : 1;
    point = side[from][next[from]++];
  }
}

/// Expects non-zero contact forces whose resultant and moment vanish.
inline void expect_balance(SurfaceContactSystem const& system, std::vector<Vec<3>> const& x) {
  Vec<3> force, moment;
  double size = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    Vec<3> const& f = system.forces()[k];
    force = force + f;
    moment = moment + cross(x[k], f);
    size += std::sqrt(dot(f, f));
  }
  ASSERT_GT(size, 0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(force[c], 0, 1e-12 * size);
    EXPECT_NEAR(moment[c], 0, 1e-11 * size);
  }
}

/// Expects forces to be minus the gradient of the energy at x, by central differences for every third loaded point.
inline void expect_slopes(SurfaceContactSystem& system, std::vector<Vec<3>> const& x, int dimension) {
  system.evaluate(x, 1e-3);
  auto const forces = system.forces();
  auto const pushed = system.loaded_indices();
  ASSERT_GT(pushed.size(), 5U);
  double largest = 0;
  for (Vec<3> const& f : forces) largest = std::max(largest, std::sqrt(dot(f, f)));
  for (std::size_t n = 0; n < pushed.size(); n += 3)
    for (int c = 0; c < dimension; ++c) {
      constexpr double h = 1e-6;
      auto const i = static_cast<std::size_t>(pushed[n]);
      auto moved = x;
      moved[i][c] += h;
      system.evaluate(moved, 1e-3);
      double const up = system.totals().energy;
      moved[i][c] -= 2 * h;
      system.evaluate(moved, 1e-3);
      EXPECT_NEAR(forces[i][c], -(up - system.totals().energy) / (2 * h), 1e-5 * largest);
    }
}

}  // namespace piola::contact::testing
