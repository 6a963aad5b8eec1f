// SPDX-License-Identifier: Apache-2.0
// What the guards of the step and of small strain report, and the limits that a case gives them.
#include "formulations/small_bodies.hpp"
#include "support/key_words.hpp"
#include "support/scripted_run.hpp"

namespace piola {
namespace {

using test::expect_words;
using testing::Outcome;
using testing::run;
using testing::Script;
using testing::simulation;
using testing::TemporaryFolder;
using testing::turned;

TEST(StepGuard, WarnsOfAStepThatFallsAThousandfold) {
  auto const with = [](double least) {
    Script s;
    s.step = [=](double t) { return t < 0.5 ? 1e-3 : least; };
    s.jacobian = [](std::size_t i, double t) { return i == 7 && t > 0.5 ? 0.4 : 1; };
    Simulation of = simulation(s);
    of.spec.run.end = 0.501;
    of.spec.output.history_every = 1e-3;
    TemporaryFolder const folder;
    return run(of, folder / "r");
  };
  Outcome const o = with(0.9e-6);
  expect_words(o.all(),
               {"the step fell to 900 ns at t = 0.5", "0.0009 of the 1 ms that waves at rest allow (limit 0.001)",
                "particle 7 of body 'plate'", "has det F = 0.4"});
  EXPECT_NEAR(o.guards["step"]["share"].get<double>(), 0.9e-3, 1e-12);
  ASSERT_FALSE(o.shown.empty());
  expect_words(o.shown[0], {"so far, at t = 0.5"});
  EXPECT_TRUE(with(1.1e-6).of.summary.warnings.empty());
}

TEST(StepGuard, LetsTheCaseBoundItsSteps) {
  Script s;
  Simulation of = simulation(s);
  of.spec.bodies[0].material = testing::rubber();  // waves allow far more than what the script takes
  of.spec.run.max_step = 1e-7;
  of.spec.run.end = 1e-4;
  TemporaryFolder const folder;
  EXPECT_TRUE(run(of, folder / "bounded").of.summary.warnings.empty());
}

// A first step that is far below what waves allow.
TEST(StepGuard, KnowsTheSpeedOfWaves) {
  Script s;
  s.step = [](double) { return 1e-7; };
  Simulation of = simulation(s);
  of.spec.bodies[0].material = testing::rubber();  // 144 m/s, 1 m: 2 ms
  of.spec.run.end = 1e-4;
  of.spec.output.history_every = 1e-5;
  TemporaryFolder const folder;
  expect_words(run(of, folder / "r").all(),
               {"the step fell to 100 ns", "of the 2.08 ms that waves at rest allow", "the formulation itself"});
}

TEST(SmallStrainGuard, WarnsOfStrainAndRotationOfTheLinearLaw) {
  auto const with = [](std::function<std::array<double, 9>(std::size_t, double)> gradient, std::string const& law) {
    Script s;
    s.gradient = std::move(gradient);
    Simulation of = simulation(s);
    of.spec.bodies[0].law = law;
    of.spec.bodies[0].formulation.name = "nodal";
    TemporaryFolder const folder;
    return run(of, folder / "r");
  };
  auto const turns = [](double most) { return [=](std::size_t i, double t) { return turned(i == 5 ? most * t : 0); }; };
  auto const stretches = [](double most) {
    return [=](std::size_t i, double t) {
      return std::array<double, 9>{1 + (i == 3 ? most * t : 0), 0, 0, 0, 1, 0, 0, 0, 1};
    };
  };
  Outcome const o = with(turns(0.06), "linear_elastic");
  expect_words(o.all(),
               {"linear_elastic is for small strain and rotation", "the rotation reached 0.06 rad (limit 0.05)",
                "particle 5 of body 'plate'", "wrong by about 6 %", "a strain of 0.0018", "saint_venant_kirchhoff"});
  EXPECT_NEAR(o.guards["small_strain"]["rotation"].get<double>(), 0.06, 1e-12);
  EXPECT_NEAR(o.guards["small_strain"]["strain"].get<double>(), 0, 1e-12) << "a rotation is no strain";
  EXPECT_TRUE(with(turns(0.049), "linear_elastic").of.summary.warnings.empty());
  expect_words(with(turns(3.1), "linear_elastic").all(), {"rotation reached 3.1 rad"});
  expect_words(with(stretches(0.03), "linear_elastic").all(), {"the strain reached 0.0304 (limit 0.02)", "particle 3"});
  expect_words(with(stretches(-0.03), "linear_elastic").all(), {"the strain reached 0.0296"});
  EXPECT_TRUE(with(stretches(0.019), "linear_elastic").of.summary.warnings.empty());
  EXPECT_TRUE(with(turns(3), "neo_hookean").of.summary.warnings.empty());
}

GuardLimits limits_of(std::initializer_list<std::pair<double GuardLimits::*, double>> changes) {
  GuardLimits limits;
  for (auto const& [limit, value] : changes) limits.*limit = value;
  return limits;
}

/// Steps of 1 ms up to 0.1 s, 10 us after; particle 7 is compressed to det F = 0.4 then.
Outcome with_falling_step(GuardLimits const& limits) {
  Script s;
  s.step = [](double t) { return t < 0.1 ? 1e-3 : 1e-5; };
  s.jacobian = [](std::size_t i, double t) { return i == 7 && t > 0.1 ? 0.4 : 1; };
  Simulation of = simulation(s);
  of.spec.run.end = 0.102;
  of.spec.run.guards = limits;
  of.spec.output.history_every = 1e-4;
  TemporaryFolder const folder;
  return run(of, folder / "r");
}

TEST(StepGuard, TakesItsLimitsFromTheCase) {
  EXPECT_TRUE(with_falling_step({}).of.summary.warnings.empty()) << "a hundredth is above the default limit";
  Outcome const warned = with_falling_step(limits_of({{&GuardLimits::step_warn, 0.02}}));
  EXPECT_EQ(warned.of.ending, RunStatus::completed);
  expect_words(warned.all(), {"the step fell to 10 us", "(limit 0.02)", "particle 7"});
}

TEST(StepGuard, EndsTheRunBelowTheLimitOfTheCase) {
  Outcome const ended = with_falling_step(limits_of({{&GuardLimits::step_stop, 0.02}}));
  EXPECT_EQ(ended.of.ending, RunStatus::failed);
  EXPECT_LT(ended.of.summary.end_time, 0.1013);
  expect_words(ended.of.failure, {"particle 7 (body 'plate'", "where the time step fell", "= 0.01", "det F = 0.4",
                                  "run.guards.step_stop is 0.02"});
  EXPECT_EQ(with_falling_step(limits_of({{&GuardLimits::step_stop, 0.005}})).of.ending, RunStatus::completed);
}

TEST(StepGuard, IsSilentWithoutLimit) {
  Script s;
  s.step = [](double t) { return t < 0.1 ? 1e-3 : 1e-7; };
  Simulation of = simulation(s);
  of.spec.run.end = 0.10001;
  of.spec.run.guards = limits_of({{&GuardLimits::step_warn, 0}});
  of.spec.output.history_every = 1e-6;
  TemporaryFolder const folder;
  EXPECT_TRUE(run(of, folder / "r").of.summary.warnings.empty());
}

/// Particle 5 of linear_elastic turns by 0.1 rad within a second, particle 3 is stretched by a tenth.
Outcome with_large_strain(GuardLimits const& limits) {
  Script s;
  s.gradient = [](std::size_t i, double t) {
    auto F = turned(i == 5 ? 0.1 * t : 0);
    if (i == 3) F[0] = 1 + 0.1 * t;
    return F;
  };
  Simulation of = simulation(s);
  of.spec.bodies[0].law = "linear_elastic";
  of.spec.bodies[0].formulation.name = "nodal";
  of.spec.run.guards = limits;
  TemporaryFolder const folder;
  return run(of, folder / "r");
}

TEST(SmallStrainGuard, TakesItsLimitsFromTheCase) {
  using G = GuardLimits;
  Outcome const spared = with_large_strain(limits_of({{&G::small_strain_warn, 0.2}, {&G::small_rotation_warn, 0.2}}));
  EXPECT_TRUE(spared.of.summary.warnings.empty()) << spared.all();
  Outcome const turned_far = with_large_strain(limits_of({{&G::small_strain_warn, G::never}}));
  expect_words(turned_far.all(), {"the rotation reached 0.1 rad (limit 0.05)"});
  EXPECT_EQ(turned_far.all().find("the strain reached"), std::string::npos);
}

TEST(SmallStrainGuard, EndsTheRunAboveTheLimitsOfTheCase) {
  using G = GuardLimits;
  Outcome const strained = with_large_strain(limits_of({{&G::small_strain_stop, 0.06}}));
  EXPECT_EQ(strained.of.ending, RunStatus::failed);
  EXPECT_NEAR(strained.of.summary.end_time, 0.59, 0.02);
  expect_words(strained.of.failure, {"particle 3 (body 'plate'", "has a strain that linear_elastic is not for",
                                     "run.guards.small_strain_stop is 0.06"});
  Outcome const turned_far = with_large_strain(limits_of({{&G::small_rotation_stop, 0.08}}));
  EXPECT_EQ(turned_far.of.ending, RunStatus::failed);
  EXPECT_NEAR(turned_far.of.summary.end_time, 0.81, 0.02);
  expect_words(turned_far.of.failure, {"particle 5 (body 'plate'", "has a rotation", "small_rotation_stop is 0.08"});
  EXPECT_EQ(with_large_strain(limits_of({{&G::small_strain_stop, 0.2}, {&G::small_rotation_stop, 0.2}})).of.ending,
            RunStatus::completed);
}

}  // namespace
}  // namespace piola
