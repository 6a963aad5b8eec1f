// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/step_observer.hpp"
#include "support/key_words.hpp"
#include "support/scripted_run.hpp"
#include <sstream>

namespace piola {
namespace {

using test::expect_words;

/// Lines of log.txt about steps of a run of 10 ms with these steps, in which particle 7 moves to the right.
std::vector<std::string> lines(std::function<double(double)> step, double max_step = 1) {
  testing::Script script;
  script.step = std::move(step);
  script.limiting_particle = 7;
  script.displacement = [](std::size_t i, double t) { return testing::Point{i == 7 ? t : 0, 0, 0}; };
  Simulation of = testing::simulation(script);
  of.spec.run.end = 0.01;
  of.spec.run.max_step = max_step;
  testing::TemporaryFolder const folder;
  testing::run(of, folder / "r");
  std::istringstream log(testing::text_of(folder / "r/log.txt"));
  std::vector<std::string> found;
  for (std::string line; std::getline(log, line);)
    if (line.find("the step falls") != std::string::npos) found.push_back(line);
  return found;
}

TEST(StepObserver, LogsWhatLimitsAStepThatHasHalved) {
  auto const found = lines([](double t) { return t < 3.5e-3 ? 1e-3 : t < 5.5e-3 ? 4e-4 : t < 7e-3 ? 3e-4 : 1e-4; });
  ASSERT_EQ(found.size(), 2U) << "3e-4 is no half of 4e-4";
  expect_words(found[0], {"t = 0.004 s", "falls to 0.0004 s", "the longest was 0.001 s", "limited by the script",
                          "particle 7 of body 'plate'", "X = (3, 1, 0)", "x = (3.004, 1, 0)"});
  expect_words(found[1], {"falls to 0.0001 s", "particle 7"});
}

TEST(StepObserver, LogsAStepThatRecoversOnce) {
  auto const dips = [](double t) { return std::fmod(t, 2e-3) < 1e-3 ? 5e-4 : 1e-4; };
  EXPECT_EQ(lines(dips).size(), 1U);
}

TEST(StepObserver, DoesNotLogStepsThatTheCaseBounds) {
  EXPECT_TRUE(lines([](double t) { return t < 5e-3 ? 1e-3 : 3e-4; }, 4e-4).empty());
  EXPECT_TRUE(lines([](double) { return 3e-3; }).empty()) << "the last one is cut to the end";
}

}  // namespace
}  // namespace piola
