// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

/// Velocities after `end` seconds in n steps.
Values velocities(Assembly const& a, double end, int n) {
  auto const f = make_formulation(a);
  advance(*f, end / n, n);
  EXPECT_FALSE(f->failure().has_value());
  return sample(*f, "Velocity", a.particles.X.size());
}

/// |v_n - v_2n| / |v_2n - v_4n|, which tends to 2^order.
double quotient(Assembly const& a, double end, int n) {
  Values const once = velocities(a, end, n), twice = velocities(a, end, 2 * n), four = velocities(a, end, 4 * n);
  return largest_difference(once, twice) / largest_difference(twice, four);
}

class TimeOrder : public ::testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(TimeOrder, IsTwoAtLargeStrain) {
  auto const& [variables, dimension] = GetParam();
  Assembly a = tumbling_box(dimension, 5);
  choose(a, "variables", variables);
  choose(a, "eps4_momentum", 0.0);
  EXPECT_NEAR(quotient(a, 4e-3, 40), 4, 0.5);  // next order: a few times dt / end
}

/// Stabilised, at strains so small that the wave speed in D, which a step takes from its start, does not vary.
TEST_P(TimeOrder, IsTwoForStabilisedWaves) {
  auto const& [variables, dimension] = GetParam();
  Assembly a = tumbling_box(dimension, 5);
  for (auto& v : a.initial_velocity)
    for (double& c : v) c *= 1e-6;
  choose(a, "variables", variables);
  EXPECT_NEAR(quotient(a, 4e-3, 40), 4, 0.5);
}

INSTANTIATE_TEST_SUITE_P(All, TimeOrder,
                         ::testing::Combine(::testing::Values("pF", "displacement"), ::testing::Values(1, 2, 3)));

/// Without stabilisation, momentum and deformation variables are displacement variables: F stays the gradient of x,
/// because both are advanced with the same velocities and the gradient is linear.
TEST(DisplacementVariables, AreMomentumAndDeformationVariablesWithoutStabilisation) {
  for (double const jitter : {0.0, 0.2}) {
    Assembly a = tumbling_box(3, 5, jitter);
    choose(a, "eps4_momentum", 0.0);
    choose(a, "angular_momentum_projection", "off");
    support(a, {true, true, true}, [](Point const& X) { return X[1] < 1e-9; });
    Values const mixed = velocities(a, 4e-3, 40);
    choose(a, "variables", "displacement");
    Values const classical = velocities(a, 4e-3, 40);
    EXPECT_LT(largest_difference(mixed, classical), 1e-10 * largest(mixed));
  }
}

TEST(DisplacementVariables, KeepTheirTimeStep) {
  Assembly a = tumbling_box(3, 5);  // 125 particles do not fill their groups of lanes
  choose(a, "variables", "displacement");
  auto const f = make_formulation(a);
  double const before = f->stable_time_step();
  advance(*f, before, 3);
  EXPECT_GT(f->stable_time_step(), 0.5 * before);
}

}  // namespace
}  // namespace piola
