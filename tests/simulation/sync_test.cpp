// SPDX-License-Identifier: Apache-2.0
// The order in which files reach the disk, seen by standing in for fsync of the C library.
#include "piola/simulation/run_case.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <string>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace {
bool recording = false;
std::vector<std::string> synced;  // names of files, in order
}  // namespace

extern "C" int fsync(int file) {
  if (recording) {
    std::string const link = "/proc/self/fd/" + std::to_string(file);
    synced.push_back(std::filesystem::read_symlink(link).filename().string());
  }
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace piola {
namespace {

TEST(RunCase, HistoryIsOnTheDiskBeforeTheCheckpointThatCountsOnIt) {
  testing::TemporaryFolder const folder;
  Simulation s = testing::make_springs();
  Listener listener;
  std::atomic<int> const none{0};
  synced.clear();
  recording = true;
  run_case(s, {.folder = folder / "r"}, listener, none);
  recording = false;
  int checkpoints = 0;
  for (std::size_t k = 1; k < synced.size(); ++k) {
    if (synced[k].find(".h5") == std::string::npos) continue;
    ++checkpoints;
    EXPECT_EQ(synced[k - 1], "history.csv") << k;
  }
  EXPECT_GE(checkpoints, 4);
}

}  // namespace
}  // namespace piola
