// SPDX-License-Identifier: Apache-2.0
#include "piola/math/quaternion.hpp"
#include "piola/mechanics/contact/ties.hpp"
#include "mechanics/contact/blocks.hpp"
#include <gtest/gtest.h>

/// Ties of a body to a rigid shape.
namespace piola::contact {
namespace {

using testing::Blocks;
using testing::distort;

RigidSurface plate(int dimension) {
  RigidSurface box;
  box.kind = RigidSurface::Kind::box;
  box.dimension = dimension;
  box.half_lengths = {{2, dimension == 3 ? 2.0 : 0.5, 0.5}};
  box.centre = {{2, dimension == 3 ? 2.0 : -0.5, dimension == 3 ? -0.5 : 0}};
  return box;
}

/// A block of 5 particles a side that stands on a plate of 4.
struct OnPlate {
  Blocks blocks;
  int dimension;
  HostParticles hosts;
  std::vector<Vec<3>> x;
  std::vector<RigidSurface> rigids;
  Ties ties;

  OnPlate(int D, double strength, double below = 0)
      : blocks(D, 0), dimension(D), hosts(blocks.set, blocks.surfaces), rigids{plate(D)} {
    rigids[0].centre[D - 1] -= below;
    for (auto const id : hosts.ids()) {
      auto const& X = blocks.set.X[static_cast<std::size_t>(id)];
      x.push_back({{X[0], X[1], X[2]}});
    }
    TieRule rule;
    rule.rigid = 0;
    rule.strength = strength;
    rule.toughness = 0.2 * strength;  // fails at 0.4 m
    rule.shear_weight = 0.7;
    ties = Ties({rule}, blocks.set, blocks.surfaces, hosts, x, rigids);
  }
  void move_plate() {
    RigidSurface& box = rigids[0];
    box.centre = box.centre + Vec<3>{{0.02, dimension == 3 ? -0.03 : -0.05, dimension == 3 ? -0.06 : 0}};
    Vec<3> const axis = dimension == 3 ? Vec<3>{{0.6, 0, 0.8}} : Vec<3>{{0, 0, 1}};
    box.turn = matrix_of(turn_about(axis, 0.04)) * box.turn;
  }
  /// What it stores and what has become heat.
  double energy(std::vector<Vec<3>> const& at, std::vector<RigidSurface> const& shapes) const {
    Ties copy = ties;
    copy.evaluate(hosts, at, shapes);
    return copy.totals().energy + copy.totals().heat;
  }
};

class RigidTiesIn : public ::testing::TestWithParam<int> {};

TEST_P(RigidTiesIn, HoldTheFaceThatLiesOnTheShape) {
  int const D = GetParam();
  OnPlate const held(D, 0);
  // Particles at 0.5, 1.5, 2.5, 3.5 of a plate that ends at 4; those at 4.5 look beyond its rim.
  EXPECT_EQ(held.ties.found()[0].points[0], D == 3 ? 16 : 4);
  EXPECT_NEAR(held.ties.found()[0].area, D == 3 ? 16 : 4, 1e-12);
  EXPECT_DOUBLE_EQ(held.ties.found()[0].stiffness, 2 * 2e6) << "C_s M / dp";
  EXPECT_GT(OnPlate(D, 0, 0.4).ties.count(), 0U);
  EXPECT_EQ(OnPlate(D, 0, 0.6).ties.count(), 0U);
  EXPECT_NEAR(OnPlate(D, 0, 0.6).ties.found()[0].nearest, 0.6, 1e-12);
}

TEST_P(RigidTiesIn, RigidMotionOfBothCostsNothing) {
  OnPlate held(GetParam(), 0, 0.2);
  Mat<3> const R = matrix_of(turn_about({{0, 0, 1}}, 0.7));
  Vec<3> const shift{{1, -2, 0}};
  for (Vec<3>& y : held.x) y = R * y + shift;
  held.rigids[0].centre = R * held.rigids[0].centre + shift;
  held.rigids[0].turn = R;
  EXPECT_LT(held.energy(held.x, held.rigids), 1e-27 * 4e6 * 100);
}

TEST_P(RigidTiesIn, ForcesAreTheSlopesOfTheEnergy) {
  int const D = GetParam();
  for (double const strength : {0.0, 1e5}) {
    OnPlate held(D, strength);
    distort(held.x, D, 0.1);
    held.move_plate();
    held.ties.evaluate(held.hosts, held.x, held.rigids);
    constexpr double h = 1e-6;
    double largest = 0;
    for (Vec<3> const& f : held.ties.forces()) largest = std::max(largest, std::sqrt(dot(f, f)));
    ASSERT_GT(largest, 0);
    auto const slope = [&](auto const& move) {
      auto const at = [&](double way) {
        auto x = held.x;
        auto shapes = held.rigids;
        move(x, shapes, way);
        return held.energy(x, shapes);
      };
      return (at(h) - at(-h)) / (2 * h);
    };
    for (std::size_t n = 0; n < held.ties.loaded_indices().size(); n += 3)
      for (int c = 0; c < D; ++c) {
        auto const i = static_cast<std::size_t>(held.ties.loaded_indices()[n]);
        double const by_place = slope([&](auto& x, auto&, double way) { x[i][c] += way; });
        EXPECT_NEAR(held.ties.forces()[i][c], -by_place, 1e-5 * largest);
      }
    auto const& on = held.ties.resultant_on_rigid(0);
    for (int c = 0; c < D; ++c)
      EXPECT_NEAR(on.force[c], -slope([&](auto&, auto& s, double way) { s[0].centre[c] += way; }),
                  1e-5 * (largest + std::fabs(on.force[c])));
    for (int c = D == 3 ? 0 : 2; c < 3; ++c) {
      Vec<3> axis;
      axis[c] = 1;
      auto const turn = [&](auto&, auto& s, double way) { s[0].turn = matrix_of(turn_about(axis, way)) * s[0].turn; };
      EXPECT_NEAR(on.moment[c], -slope(turn), 1e-4 * largest);
    }
  }
}

TEST_P(RigidTiesIn, MomentaAreKept) {
  int const D = GetParam();
  for (double const strength : {0.0, 1e5}) {
    OnPlate held(D, strength, 0.2);
    distort(held.x, D, 0.1);
    held.move_plate();
    held.ties.evaluate(held.hosts, held.x, held.rigids);
    auto const& on = held.ties.resultant_on_rigid(0);
    Vec<3> force = on.force, moment = on.moment + cross(held.rigids[0].centre, on.force);
    double size = std::sqrt(dot(force, force));
    for (std::size_t k = 0; k < held.x.size(); ++k) {
      force = force + held.ties.forces()[k];
      moment = moment + cross(held.x[k], held.ties.forces()[k]);
      size += std::sqrt(dot(held.ties.forces()[k], held.ties.forces()[k]));
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(force[c], 0, 1e-15 * size);
      EXPECT_NEAR(moment[c], 0, 5e-15 * size) << "arms of 5 m";
      EXPECT_NEAR(held.ties.resultant_on_first(0).force[c], -on.force[c], 1e-15 * size);
    }
  }
}

TEST_P(RigidTiesIn, FrequencyIsABoundOfBodyAndShape) {
  int const D = GetParam();
  OnPlate held(D, 0);
  RigidSurface& box = held.rigids[0];
  for (double const mass : {1.0, 1e3}) {
    box.inverse_mass = 1 / mass;
    for (int c = 0; c < 3; ++c) box.inverse_inertia(c, c) = D == 3 || c == 2 ? 1 / mass : 0;
    std::vector<double> const inverse(held.x.size(), 1.0);
    double const bound = held.ties.frequency2(inverse) + held.ties.springs_of_shape(0, held.rigids);
    // Power iteration with displacements that are small.
    std::vector<Vec<3>> u(held.x.size(), {{1, 0.3, D == 3 ? 0.2 : 0}});
    Vec<3> way{{-1, 0.2, D == 3 ? 0.5 : 0}}, angle{{D == 3 ? 0.1 : 0, 0, 0.2}};
    double growth = 0;
    for (int round = 0; round < 200; ++round) {
      constexpr double h = 1e-6;
      auto x = held.x;
      auto shapes = held.rigids;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = x[k] + h * u[k];
      shapes[0].centre = shapes[0].centre + h * way;
      shapes[0].turn = matrix_of(turn_by(h * angle)) * shapes[0].turn;
      held.ties.evaluate(held.hosts, x, shapes);
      auto const& on = held.ties.resultant_on_rigid(0);
      double const before = mass * (dot(way, way) + dot(angle, angle));
      double sum = before, product = dot(way, on.force) + dot(angle, on.moment);
      for (std::size_t k = 0; k < u.size(); ++k) {
        sum += dot(u[k], u[k]);
        product += dot(u[k], held.ties.forces()[k]);
      }
      growth = -product / h / sum;
      double const scale = 1 / (h * bound);
      for (std::size_t k = 0; k < u.size(); ++k) u[k] = (-scale) * held.ties.forces()[k];
      way = (-scale / mass) * on.force;
      angle = (-scale / mass) * on.moment;
      if (D == 2) angle = {{0, 0, angle[2]}};
    }
    EXPECT_GT(bound, growth * (1 - 1e-9)) << mass;
    EXPECT_LT(bound, 8 * growth) << mass << ": every spring counts with the largest give of the shape";
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, RigidTiesIn, ::testing::Values(2, 3));

}  // namespace
}  // namespace piola::contact
