// SPDX-License-Identifier: Apache-2.0
// Laws and functions on packs of lanes against the same on one double. This file is a machine of its own.
#undef PIOLA_BACKEND
#undef PIOLA_BACKEND_IS_HOST
#define PIOLA_BACKEND test_packs
#define PIOLA_BACKEND_IS_NATIVE 1
#include "piola/materials/laws.hpp"
#include "materials/law_types.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace piola::inline PIOLA_BACKEND {
namespace {

/// Every lane another F, J between 0.3 and 3.
struct Sample {
  Mat<3, Lanes> F;
  Mat<3> lane_F[lane_count];

  Sample(std::mt19937& bits, double size) {
    std::uniform_real_distribution<double> change(-size, size);
    for (int l = 0; l < lane_count; ++l) {
      do {
        lane_F[l] = identity<3>();
        for (double& c : lane_F[l].c) c += change(bits);
      } while (!(determinant(lane_F[l]) > 0.3 && determinant(lane_F[l]) < 3));
      for (int c = 0; c < 9; ++c) F.c[c][l] = lane_F[l].c[c];
    }
  }
};

template <class Law>
class LawOnLanes : public ::testing::Test {};
TYPED_TEST_SUITE(LawOnLanes, TypesOf<Laws>::type, LawNames);

TYPED_TEST(LawOnLanes, GivesEachLaneItsOwnStressAndEnergy) {
  double const values[] = {1100, 17e6, 0.3, 0.4};
  TypeParam const law(values);
  double const near = 1e-13 * law.rho0 * law.p_wave_speed() * law.p_wave_speed();
  std::mt19937 bits(1);
  for (int k = 0; k < 100; ++k) {
    Sample const s(bits, TypeParam::small_strain ? 0.01 : 0.4);
    Mat<3, Lanes> const H = cofactor(s.F), P = law.first_piola(s.F);
    Lanes const J = determinant(s.F), W = law.energy(s.F), p = law.pressure(s.F);
    Mat<3, Lanes> const P_of_all = law.stress(s.F, H, J);
    Lanes const W_of_all = law.energy(s.F, H, J), modulus = law.largest_modulus(J, Lanes(0.7), Lanes(1.2));
    for (int l = 0; l < lane_count; ++l) {
      Mat<3> const& F = s.lane_F[l];
      Mat<3> const one = law.first_piola(F), one_of_all = law.stress(F, cofactor(F), determinant(F));
      for (int c = 0; c < 9; ++c) {
        EXPECT_NEAR(lane(P.c[c], l), one.c[c], near);
        EXPECT_NEAR(lane(P_of_all.c[c], l), one_of_all.c[c], near);
      }
      EXPECT_NEAR(lane(W, l), law.energy(F), near);
      EXPECT_NEAR(lane(W_of_all, l), law.energy(F, cofactor(F), determinant(F)), near);
      EXPECT_NEAR(lane(p, l), law.pressure(F), near);
      EXPECT_NEAR(lane(modulus, l), law.largest_modulus(determinant(F), 0.7, 1.2), near);
    }
  }
}

/// The same bits of f(a) in every lane, whatever the other lanes hold, and the value of one double.
template <class F>
void expect_the_same_in_every_lane(F const& f) {
  for (double const a : {0.01, 0.2499, 0.25, 0.5, 0.7, 0.99, 1.0, 1.01, 1.42, 2.0, 3.9, 4.0, 4.01, 1e5})
    for (double const other : {1.0, 0.3, 1e-4, 1e6})
      for (int l = 0; l < lane_count; ++l) {
        Lanes x(other);
        x[l] = a;
        EXPECT_EQ(lane(f(x), l), lane(f(Lanes(a)), 0)) << a << " beside " << other;
        EXPECT_NEAR(lane(f(x), l), f(a), 4e-16 * std::fabs(f(a))) << a;
      }
}

TEST(LogarithmOnLanes, DoesNotDependOnTheOtherLanes) {
  expect_the_same_in_every_lane([](auto const& a) { return logarithm(a); });
}
TEST(PowerMinusThirdOnLanes, DoesNotDependOnTheOtherLanes) {
  expect_the_same_in_every_lane([](auto const& a) { return power_minus_third(a); });
}

}  // namespace
}  // namespace piola::inline PIOLA_BACKEND
