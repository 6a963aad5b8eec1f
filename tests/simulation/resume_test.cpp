// SPDX-License-Identifier: Apache-2.0
// What a resumed run notices, and what it falls back to.
#include "piola/base/problems.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

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
  std::string const here = c.machine;
  c.version = "0.0.9";
  c.machine = "v9 of a processor with v9";
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
  EXPECT_TRUE(any_says(warnings, "frames/000001.hdf: 1 of 3 frames up to the checkpoint is missing"));
}

}  // namespace
}  // namespace piola
