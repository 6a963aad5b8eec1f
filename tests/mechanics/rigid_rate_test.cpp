// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/rigid_rate.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>
#include <vector>

namespace piola {
namespace {

using testing::Random;

struct Cloud {
  std::vector<double> V;
  std::vector<Vec<3>> x, f;
};

/// Random points far from the origin (arms are then long compared with the body), rates of the dimension.
Cloud cloud(int dimension, std::uint32_t seed) {
  Random random(seed);
  Cloud r;
  for (int k = 0; k < 40; ++k) {
    Vec<3> x = random.vector(1), f = random.vector(5);
    for (int c = 0; c < 3; ++c) {
      x[c] = c < dimension ? x[c] + 3 : 0;
      f[c] = c < dimension ? f[c] + 1 : 0;
    }
    r.V.push_back(random.in(0.1, 1));
    r.x.push_back(x);
    r.f.push_back(f);
  }
  return r;
}

RateSums sums(Cloud const& cloud, std::vector<Vec<3>> const& f) {
  RateSums s;
  for (std::size_t k = 0; k < f.size(); ++k) {
    double const V = cloud.V[k];
    Vec<3> const& x = cloud.x[k];
    Vec<3> const moment = cross(x, f[k]);
    s.volume += V;
    for (int c = 0; c < 3; ++c) {
      s.x[c] += V * x[c];
      s.xx[c] += V * x[c] * x[c];
      s.f[c] += V * f[k][c];
      s.moment[c] += V * moment[c];
    }
    s.xx[3] += V * x[0] * x[1];
    s.xx[4] += V * x[1] * x[2];
    s.xx[5] += V * x[0] * x[2];
  }
  return s;
}

Vec<3> at(RigidRate const& g, Vec<3> const& x) {
  Vec<3> const spin{{g.spin[0], g.spin[1], g.spin[2]}}, push{{g.push[0], g.push[1], g.push[2]}},
      centre{{g.centre[0], g.centre[1], g.centre[2]}};
  return cross(spin, x - centre) + push;
}

class RigidRateOf : public ::testing::TestWithParam<int> {};

TEST_P(RigidRateOf, RemovesResultantAndMoment) {
  Cloud const c = cloud(GetParam(), 1);
  RateSums const before = sums(c, c.f);
  RigidRate const g = balancing_rate(before, GetParam());
  auto balanced = c.f;
  for (std::size_t k = 0; k < balanced.size(); ++k) balanced[k] = balanced[k] + at(g, c.x[k]);
  RateSums const after = sums(c, balanced);
  double const scale = 40 * 6 * 4;  // points, rates, arms: what sums of absolute values come to at most
  ASSERT_GT(std::fabs(before.f[0]), 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::fabs(after.f[i]), 1e-12 * scale);
    EXPECT_LT(std::fabs(after.moment[i]), 1e-12 * scale);
  }
}

TEST_P(RigidRateOf, ChangesNothingThatIsBalancedAlready) {
  Cloud const c = cloud(GetParam(), 2);
  RigidRate const g = balancing_rate(sums(c, c.f), GetParam());
  auto balanced = c.f;
  for (std::size_t k = 0; k < balanced.size(); ++k) balanced[k] = balanced[k] + at(g, c.x[k]);
  RigidRate const again = balancing_rate(sums(c, balanced), GetParam());
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::fabs(again.push[i]), 1e-13 * 100);
    EXPECT_LT(std::fabs(again.spin[i]), 1e-13 * 100);
  }
}

TEST_P(RigidRateOf, HasThePowerOfADirectSum) {
  Cloud const c = cloud(GetParam(), 3), motion = cloud(GetParam(), 4);
  RigidRate const g = balancing_rate(sums(c, c.f), GetParam());
  double direct = 0, size = 0;
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    double const power = c.V[k] * dot(motion.f[k], at(g, c.x[k]));
    direct += power;
    size += std::fabs(power);
  }
  ASSERT_GT(std::fabs(direct), 0.1);
  EXPECT_NEAR(power_of(g, sums(c, motion.f)), direct, 1e-12 * size);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, RigidRateOf, ::testing::Values(1, 2, 3));

TEST(RigidRate, OfABodyWithoutInertiaAboutAnAxisStaysFinite) {
  Cloud rod;  // all points on the x axis: no inertia about x
  for (int k = 0; k < 5; ++k) {
    rod.V.push_back(1);
    rod.x.push_back({{static_cast<double>(k), 0, 0}});
    rod.f.push_back({{0, static_cast<double>(k), 1}});
  }
  RigidRate const g = balancing_rate(sums(rod, rod.f), 3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(g.spin[i]) && std::isfinite(g.push[i]));
}

}  // namespace
}  // namespace piola
