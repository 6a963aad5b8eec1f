// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/cohesive.hpp"
#include <gtest/gtest.h>

namespace piola::contact {
namespace {

CohesiveLaw law(double shear_weight = 1) { return cohesive_law(1e12, 2e6, 100, shear_weight); }
Vec<3> const up{{0, 0.6, 0.8}}, along{{1, 0, 0}}, across{{0, 0.8, -0.6}};

TEST(CohesiveLaw, BeginsElasticThenSoftensThenHoldsNothing) {
  EXPECT_DOUBLE_EQ(law().first(), 2e-6);
  EXPECT_DOUBLE_EQ(law().last, 1e-4);
  EXPECT_DOUBLE_EQ(envelope(law(), 1e-6), 1e6);
  EXPECT_DOUBLE_EQ(envelope(law(), 2e-6), 2e6);
  EXPECT_NEAR(envelope(law(), 0.5 * (2e-6 + 1e-4)), 1e6, 1e-6);
  EXPECT_EQ(envelope(law(), 1e-4), 0);
  EXPECT_EQ(envelope(law(), 1), 0);
}

TEST(CohesiveLaw, TakesItsToughness) {
  constexpr int steps = 100000;
  double area = 0;
  for (int k = 0; k < steps; ++k) area += 1.1e-4 / steps * envelope(law(), (k + 0.5) * 1.1e-4 / steps);
  EXPECT_NEAR(area, 100, 1e-5);
  EXPECT_NEAR(lost_energy(law(), 1e-4), 100, 1e-12);
  EXPECT_NEAR(lost_energy(law(), 1), 100, 1e-12) << "once failed, no more";
  EXPECT_EQ(lost_energy(law(), 1e-6), 0) << "elastic";
}

TEST(CohesiveLaw, LosesWhatItDoesNotGiveBack) {
  for (double const d : {3e-6, 2e-5, 9e-5}) {
    constexpr int steps = 20000;
    double work = 0;
    for (int k = 0; k < steps; ++k) work += d / steps * envelope(law(), (k + 0.5) * d / steps);
    EXPECT_NEAR(lost_energy(law(), d), work - 0.5 * secant(law(), d) * d * d, 1e-5);
  }
}

TEST(CohesiveLaw, WithoutAStrengthItNeverFails) {
  CohesiveLaw const never = cohesive_law(5, 0, 0, 1);
  EXPECT_EQ(secant(never, 1e9), 5);
  EXPECT_EQ(lost_energy(never, 1e9), 0);
  EXPECT_EQ(elastic_bond(5, {{1, 2, 3}}).energy, 0.5 * 5 * 14);
}

TEST(CohesiveLaw, CompressionDoesNotOpen) {
  Separation const pressed = separation(1e-5 * up, up), opened = separation(-1e-5 * up, up);
  EXPECT_DOUBLE_EQ(pressed.open, -1e-5);
  EXPECT_EQ(effective_opening(law(), pressed), 0);
  EXPECT_DOUBLE_EQ(effective_opening(law(), opened), 1e-5);
  // After half of the damage it is as stiff under pressure as before, and softer in tension.
  double const d = 5e-5;
  EXPECT_DOUBLE_EQ(cohesive_bond(law(), 1e-5 * up, up, d).energy, 0.5 * 1e12 * 1e-10);
  EXPECT_DOUBLE_EQ(cohesive_bond(law(), -1e-5 * up, up, d).energy, 0.5 * secant(law(), d) * 1e-10);
}

TEST(CohesiveLaw, SlidingCountsByItsWeight) {
  Vec<3> const jump = -3e-6 * up + 4e-6 * along;
  EXPECT_DOUBLE_EQ(effective_opening(law(), separation(jump, up)), 5e-6);
  EXPECT_DOUBLE_EQ(effective_opening(law(0.5), separation(jump, up)), std::sqrt(9 + 4) * 1e-6);
  // Alone it takes the same energy, with beta times the traction.
  double const last = law(0.5).last / 0.5;
  EXPECT_DOUBLE_EQ(effective_opening(law(0.5), separation(last * across, up)), law().last);
  Vec<3> const t = cohesive_bond(law(0.5), (law().first() / 0.5) * across, up, law().first()).by_jump;
  EXPECT_NEAR(dot(t, across), 0.5 * 2e6, 1e-6);
}

TEST(CohesiveLaw, TractionIsTheSlopeOfTheEnergy) {
  for (double const weight : {1.0, 0.4})
    for (double const sign : {1.0, -1.0}) {
      Vec<3> jump = (sign * 3e-6) * up + 2e-6 * along - 1e-6 * across, n = up;
      Bond const bond = cohesive_bond(law(weight), jump, n, 1e-5);
      auto const slope = [&](double& coordinate, double h) {
        double const kept = coordinate;
        coordinate = kept + h;
        double const high = cohesive_bond(law(weight), jump, n, 1e-5).energy;
        coordinate = kept - h;
        double const low = cohesive_bond(law(weight), jump, n, 1e-5).energy;
        coordinate = kept;
        return (high - low) / (2 * h);
      };
      Vec<3> by_normal;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(bond.by_jump[c], slope(jump[c], 1e-9), 1e-3);
        by_normal[c] = slope(n[c], 1e-4) - bond.by_normal[c];
      }
      // Normals stay of unit length: what would make them longer does not count.
      by_normal = by_normal - dot(by_normal, n) * n;
      EXPECT_LT(std::sqrt(dot(by_normal, by_normal)), 1e-6);
    }
}

}  // namespace
}  // namespace piola::contact
