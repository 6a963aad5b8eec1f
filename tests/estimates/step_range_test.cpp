// SPDX-License-Identifier: Apache-2.0
// The range of the number of steps that `piola check` gives, and the trial steps that it starts from.
#include "piola/estimates/step_range.hpp"
#include "piola/estimates/trial.hpp"
#include "piola/model/read_case.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include "support/scripted_run.hpp"

namespace piola {
namespace {

using test::mentions;

/// Two squares of a formulation, a body length apart.
CaseSpec two_squares(std::string const& formulation, std::string const& more = "") {
  auto const square = [&](char const* name, char const* from, char const* to) {
    return std::string("[[body]]\nname = \"") + name + "\"\nshape = { box = { min = [" + from + ", 0], max = [" + to +
           ", 1] }, particles = [6, 6] }\nmaterial = { law = \"elastic\", density = 1000, youngs_modulus = 1e7, "
           "poissons_ratio = 0.3 }\nformulation = { name = \"" +
           formulation + "\" }\n";
  };
  return read_case_text(
      "title = \"Two\"\n[run]\nend = 1\n" + square("left", "0", "1") + square("right", "2", "3") + more, "case.toml");
}

TEST(StepRange, IsOneNumberWithoutContactAndWithSteadySteps) {
  CaseSpec const alone = read_case_text(test::sample_case(), "case.toml");
  for (double const change : {0.0, 0.019, -0.019, 0.02}) {
    EXPECT_EQ(step_excess(alone, change).factor, 1) << change;
    EXPECT_EQ(step_excess(alone, change).why, "") << change;
  }
}

TEST(StepRange, IsWiderWhereTheLastTrialStepsChanged) {
  CaseSpec const alone = read_case_text(test::sample_case(), "case.toml");
  for (double const change : {0.021, -0.021, 0.5}) {
    StepExcess const excess = step_excess(alone, change);
    EXPECT_EQ(excess.factor, 1.5) << change;
    EXPECT_EQ(
        excess.why,
        "steps are known as a range: their length was still changing when the trial ended (up to 1.5 times as many "
        "in cases known)");
  }
}

TEST(StepRange, IsThatOfContactWhateverTheTrialFound) {
  for (double const change : {0.0, 0.5}) {
    EXPECT_EQ(step_excess(two_squares("adaptle"), change).factor, 6) << "contact of the formulation";
    EXPECT_EQ(step_excess(two_squares("nodal"), change).factor, 2.5) << "contact of surfaces";
    EXPECT_EQ(step_excess(two_squares("nodal", "[contact]\nlaw = \"none\"\n"), change).factor, change == 0 ? 1 : 1.5);
  }
  std::string const why = step_excess(two_squares("nodal"), 0).why;
  EXPECT_TRUE(mentions(why, {"range", "contact", "shorter", "2.5 times"}));
}

/// Steps of 1 ms up to 5.5 ms and of 2 ms after.
Trial trial(std::int64_t most, double end) {
  testing::Script script;
  script.step = [](double t) { return t < 5.5e-3 ? 1e-3 : 2e-3; };
  testing::Scripted formulation(script, 4);
  RunSpec run;
  run.end = end;
  return take_trial_steps(formulation, run, {.most = most});
}

TEST(Trial, GivesTheMeanStepsOfItsLastTwoQuarters) {
  Trial const t = trial(8, 1);
  EXPECT_EQ(t.steps, 8);
  EXPECT_NEAR(t.time, 0.010, 1e-12);
  EXPECT_NEAR(t.step, 2e-3, 1e-12) << "steps 7 and 8";
  EXPECT_NEAR(t.earlier, 1e-3, 1e-12) << "steps 5 and 6";
  EXPECT_FALSE(t.over);
  EXPECT_FALSE(t.failure);
}

TEST(Trial, EndsAfterItsSecondsButNotBeforeTheFewestSteps) {
  testing::Scripted formulation({}, 4);
  RunSpec run;
  run.end = 1;
  Trial const t = take_trial_steps(formulation, run, {.fewest = 12, .seconds = 0});
  EXPECT_EQ(t.steps, 12);
  EXPECT_GT(t.step_seconds, 0);
}

TEST(Trial, OfOneStepHasNoEarlierOne) {
  Trial const t = trial(1, 1);
  EXPECT_EQ(t.steps, 1);
  EXPECT_EQ(t.step, 1e-3);
  EXPECT_EQ(t.earlier, 1e-3);
}

TEST(Trial, LeavesOutTheStepThatIsCutToTheEnd) {
  Trial const t = trial(100, 2.5e-3);
  EXPECT_TRUE(t.over);
  EXPECT_EQ(t.steps, 3);
  EXPECT_NEAR(t.step, 1e-3, 1e-12);
  EXPECT_NEAR(t.earlier, 1e-3, 1e-12);
  EXPECT_NEAR(trial(100, 0.4e-3).step, 0.4e-3, 1e-12) << "there is no other";
}

TEST(Trial, ReportsTheFailureOfItsLastStep) {
  Simulation s = testing::make_springs();
  testing::springs(s).fail_at = 5;
  Trial const t = take_trial_steps(*s.formulation, s.spec.run, {.most = 100});
  ASSERT_TRUE(t.failure);
  EXPECT_EQ(t.failure->what, "is inverted");
  EXPECT_EQ(t.steps, 5);
  EXPECT_FALSE(t.over);
}

}  // namespace
}  // namespace piola
