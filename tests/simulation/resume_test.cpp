// SPDX-License-Identifier: Apache-2.0
// What a resumed run notices, and what it falls back to.
#include "piola/base/errors.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/frames.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <csignal>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace piola {
namespace {

using testing::make_springs;
using testing::springs;
using testing::TemporaryFolder;
using testing::text_of;

CaseOutcome run(Simulation& s, std::filesystem::path const& folder, bool resume = false,
                std::atomic<int>* stop = nullptr) {
  Listener listener;
  std::atomic<int> none{0};
  return run_case(s, {.folder = folder, .resume = resume, .force = false}, listener, stop ? *stop : none);
}

/// A run that was stopped at step 57, with a checkpoint there and one before.
void run_half(std::filesystem::path const& folder) {
  Simulation s = make_springs();
  std::atomic<int> stop{0};
  springs(s).stop_at = 57;
  springs(s).stop = &stop;
  run(s, folder, false, &stop);
}

std::vector<std::string> warnings_of_resume(std::filesystem::path const& folder) {
  Simulation s = make_springs();
  return run(s, folder, true).summary.warnings;
}

bool any_says(std::vector<std::string> const& warnings, std::string const& part) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](std::string const& line) { return line.find(part) != std::string::npos; });
}

TEST(Resume, GivesTheSameBytesFromTheOlderCheckpointWhereverTheNewestIsDamaged) {
  TemporaryFolder const folder;
  Simulation whole = make_springs();
  run(whole, folder / "whole");
  run_half(folder / "half");
  auto const newest = list_checkpoints(folder / "half").at(0).filename();
  std::size_t const size = std::filesystem::file_size(folder / "half/checkpoints" / newest);
  for (std::size_t k = 0; k < 12; ++k) {
    auto const parts = folder / ("parts" + std::to_string(k));
    std::filesystem::copy(folder / "half", parts, std::filesystem::copy_options::recursive);
    std::string text = text_of(parts / "checkpoints" / newest);
    text[k * size / 12] = static_cast<char>(text[k * size / 12] ^ 64);
    std::ofstream(parts / "checkpoints" / newest, std::ios::binary) << text;
    auto const warnings = warnings_of_resume(parts);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("the checkpoint before it is used"), std::string::npos) << warnings[0];
    for (char const* name : {"history.csv", "frames.hdf.series", "frames/000003.hdf", "frames/000004.hdf"})
      EXPECT_TRUE(text_of(folder / "whole" / name) == text_of(parts / name)) << name;
  }
}

TEST(Resume, RefusesParticlesThatAreNotThoseOfTheCheckpoint) {
  TemporaryFolder const folder;
  run_half(folder / "half");
  Simulation other = make_springs();
  other.particles.X[1][0] += 1e-12;
  other.particles.volume[2] *= 2;
  try {
    run(other, folder / "half", true);
    FAIL();
  } catch (InputError const& error) {
    std::string const said = error.what();
    EXPECT_NE(said.find("positions and volumes of its"), std::string::npos) << said;
  }
  EXPECT_TRUE(warnings_of_resume(folder / "half").empty()) << "the run can go on with its own";
}

TEST(Resume, FallsBackWhenTheFormulationCannotLoadTheNewestState) {
  TemporaryFolder const folder;
  Simulation whole = make_springs();
  run(whole, folder / "whole");
  run_half(folder / "parts");
  auto const newest = list_checkpoints(folder / "parts").at(0);
  Checkpoint c = read_checkpoint(newest);
  c.state.put("u", std::array{1.0, 2.0});
  write_checkpoint(newest, c);
  auto const warnings = warnings_of_resume(folder / "parts");
  EXPECT_TRUE(any_says(warnings, "'u' has 2 numbers (this case needs 48)"));
  EXPECT_TRUE(text_of(folder / "whole/history.csv") == text_of(folder / "parts/history.csv"));
}

TEST(Resume, WarnsOfAnotherVersionOrInstructionSet) {
  TemporaryFolder const folder;
  run_half(folder / "r");
  EXPECT_TRUE(warnings_of_resume(folder / "r").empty());
  auto const newest = list_checkpoints(folder / "r").at(0);
  Checkpoint c = read_checkpoint(newest);
  std::string const here = c.backend;
  c.version = "0.0.9";
  c.backend = "v9 of a processor with v9";
  write_checkpoint(newest, c);
  auto const warnings = warnings_of_resume(folder / "r");
  EXPECT_TRUE(any_says(warnings, "written by Piola 0.0.9"));
  EXPECT_TRUE(any_says(warnings, "instruction set v9 of a processor with v9, this is " + here));
}

TEST(Resume, NoticesRowsAndFramesThatAreMissing) {
  TemporaryFolder const folder;
  run_half(folder / "r");
  std::string history = text_of(folder / "r/history.csv");
  std::size_t const second_row = history.find('\n', history.find('\n') + 1) + 1;
  history.erase(second_row, history.find('\n', second_row) + 1 - second_row);
  std::ofstream(folder / "r/history.csv") << history;
  std::filesystem::remove(folder / "r/frames/000001.hdf");
  auto const warnings = warnings_of_resume(folder / "r");
  EXPECT_TRUE(any_says(warnings, "rows are missing or were changed"));
  EXPECT_TRUE(any_says(warnings, "frames/000001.hdf: 1 of 3 frames"));
}

/// Springs that run until `end`; further lines of the case as given.
Simulation springs_until(double end, std::string const& more = "") {
  Simulation s = make_springs();
  s.spec.run.end = end;
  s.spec.source += fmt::format("[run]\nend = {}\n", end) + more;
  return s;
}

void expect_same_files(std::filesystem::path const& a, std::filesystem::path const& b) {
  EXPECT_TRUE(text_of(a / "history.csv") == text_of(b / "history.csv"));
  EXPECT_TRUE(text_of(a / "frames.hdf.series") == text_of(b / "frames.hdf.series"));
  for (auto const& frame : std::filesystem::directory_iterator(a / "frames"))
    EXPECT_TRUE(text_of(frame.path()) == text_of(b / "frames" / frame.path().filename())) << frame.path();
  Checkpoint const ca = read_checkpoint(list_checkpoints(a).at(0)), cb = read_checkpoint(list_checkpoints(b).at(0));
  EXPECT_EQ(ca.state.arrays(), cb.state.arrays());
  EXPECT_EQ(ca.observers.arrays(), cb.observers.arrays());
}

TEST(Resume, ExtendsAFinishedRunAsIfItHadHadTheLaterEndFromTheStart) {
  TemporaryFolder const folder;
  Simulation whole = springs_until(2.1), first = springs_until(1), second = springs_until(1.5),
             third = springs_until(2.1);
  CaseOutcome const at_once = run(whole, folder / "whole");
  run(first, folder / "parts");
  run(second, folder / "parts", true);
  CaseOutcome const outcome = run(third, folder / "parts", true);
  EXPECT_EQ(outcome.summary.end_time, 2.1);
  EXPECT_EQ(outcome.summary.warnings, at_once.summary.warnings);
  expect_same_files(folder / "whole", folder / "parts");
  EXPECT_EQ(text_of(folder / "parts/case.toml"), third.spec.source);
  EXPECT_NE(text_of(folder / "parts/log.txt").find("changed: run.end: 1.5 -> 2.1"), std::string::npos);
}

TEST(Resume, SaysWhenOnlyTheStateAfterTheCutStepIsLeft) {
  TemporaryFolder const folder;
  Simulation first = springs_until(1), second = springs_until(2);
  run(first, folder / "r");
  auto const checkpoints = list_checkpoints(folder / "r");
  ASSERT_EQ(checkpoints.size(), 2U);
  EXPECT_TRUE(read_checkpoint(checkpoints[0]).cut_to_end);
  EXPECT_FALSE(read_checkpoint(checkpoints[1]).cut_to_end);
  std::filesystem::remove(checkpoints[1]);
  CaseOutcome const outcome = run(second, folder / "r", true);
  EXPECT_EQ(outcome.summary.end_time, 2);
  EXPECT_TRUE(any_says(outcome.summary.warnings, "the step before t = 1 s was cut to the end"));
}

TEST(Resume, TakesOtherIntervalsOfOutput) {
  TemporaryFolder const folder;
  Simulation whole = make_springs(), second = make_springs();
  for (Simulation* s : {&whole, &second}) {
    s->spec.output.frames_every = 0.1;
    s->spec.output.history_every = 0.125;
    s->spec.source += "[output.frames]\nevery = 0.1\n[output.history]\nevery = 0.125\n";
  }
  run(whole, folder / "whole");
  run_half(folder / "parts");
  double const from = read_checkpoint(list_checkpoints(folder / "parts").at(0)).time;
  run(second, folder / "parts", true);
  auto const later = [&](std::filesystem::path const& results) {
    std::vector<double> times;
    for (auto const& [time, path] : list_frames(results)) {
      if (time > from) times.push_back(time);
    }
    return times;
  };
  EXPECT_GE(later(folder / "whole").size(), 4U);
  EXPECT_EQ(later(folder / "whole"), later(folder / "parts"));
}

TEST(Resume, RefusesOtherChangesAndShowsThem) {
  TemporaryFolder const folder;
  Simulation first = springs_until(1, "[constants]\nL = 6\n"), second = springs_until(2, "[constants]\nL = 7\n");
  run(first, folder / "r");
  try {
    run(second, folder / "r", true);
    FAIL();
  } catch (InputError const& error) {
    std::string const said = error.what();
    EXPECT_NE(said.find("is not the case that this run was started with"), std::string::npos) << said;
    EXPECT_NE(said.find("\n  constants.L: 6 -> 7"), std::string::npos) << said;
    EXPECT_EQ(said.find("run.end: "), std::string::npos) << said;
  }
  Simulation earlier = springs_until(0.5, "[constants]\nL = 6\n");
  EXPECT_THROW(run(earlier, folder / "r", true), InputError);
  EXPECT_EQ(text_of(folder / "r/case.toml"), first.spec.source) << "a refused change leaves everything as it was";
}

/// Many outputs, none of them in threads: children of this process run it.
Simulation busy_springs() {
  Simulation s = make_springs();
  s.spec.output.compress = false;
  s.spec.output.checkpoints_every = 0.03;
  s.spec.output.frames_every = 0.04;
  return s;
}

/// Runs or resumes in a child that is killed after a while; returns whether it got to the end before.
bool run_until_killed(std::filesystem::path const& folder, useconds_t microseconds) {
  pid_t const child = fork();
  if (child == 0) {
    Simulation s = busy_springs();
    run(s, folder, !list_checkpoints(folder).empty());
    ::_exit(0);
  }
  ::usleep(microseconds);
  ::kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Resume, GivesTheSameBytesHoweverOftenARunIsKilled) {
  TemporaryFolder const folder;
  Simulation whole = busy_springs();
  run(whole, folder / "whole");
  int kills = 0;
  while (!run_until_killed(folder / "parts", static_cast<useconds_t>(1500 * (kills % 7) + 500 * kills))) ++kills;
  EXPECT_GE(kills, 3);
  expect_same_files(folder / "whole", folder / "parts");
}

}  // namespace
}  // namespace piola
