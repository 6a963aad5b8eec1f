// SPDX-License-Identifier: Apache-2.0
#include "piola/output/frame_index.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <csignal>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace piola {
namespace {

FrameIndex::Entry entry(std::size_t k) { return {0.25 * static_cast<double>(k), fmt::format("frames/{:06}.hdf", k)}; }

std::uint64_t inode_of(std::filesystem::path const& file) {
  struct stat now {};
  ::stat(file.c_str(), &now);
  return now.st_ino;
}

/// Bytes that this process has handed to the system for writing; 0 where the system does not tell.
std::uint64_t written_bytes() {
  std::string const text = testing::text_of("/proc/self/io");
  auto const at = text.find("wchar: ");
  return at == std::string::npos ? 0 : std::stoull(text.substr(at + 7));
}

TEST(FrameIndex, GrowsInPlaceAtTheSameCostHoweverManyFramesThereAre) {
  testing::TemporaryFolder const folder;
  FrameIndex index(folder / "i");
  index.write({entry(0)});
  std::uint64_t const inode = inode_of(folder / "i");
  for (std::size_t k = 1; k < 400; ++k) ASSERT_TRUE(index.add(entry(k)));
  std::uint64_t const before = written_bytes();
  ASSERT_TRUE(index.add(entry(400)));
  EXPECT_LT(written_bytes() - before, 200U);
  EXPECT_EQ(inode_of(folder / "i"), inode);
  auto const series = nlohmann::json::parse(testing::text_of(folder / "i"));
  EXPECT_EQ(series["file-series-version"], "1.0");
  ASSERT_EQ(series["files"].size(), 401U);
  EXPECT_EQ(series["files"][400]["name"], "frames/000400.hdf");
  EXPECT_EQ(series["files"][400]["time"], 100.0);
}

TEST(FrameIndex, IsTheSameWhetherWrittenAtOnceOrFrameByFrame) {
  testing::TemporaryFolder const folder;
  FrameIndex grown(folder / "a"), whole(folder / "b");
  grown.write({entry(0)});
  ASSERT_TRUE(grown.add(entry(1)));
  ASSERT_TRUE(grown.add(entry(2)));
  whole.write({entry(0), entry(1), entry(2)});
  EXPECT_EQ(testing::text_of(folder / "a"), testing::text_of(folder / "b"));
}

TEST(FrameIndex, ThatSomebodyChangedIsNotAddedTo) {
  testing::TemporaryFolder const folder;
  FrameIndex index(folder / "i");
  EXPECT_FALSE(index.add(entry(0)));
  index.write({entry(0)});
  std::ofstream(folder / "i", std::ios::app) << "more";
  std::string const before = testing::text_of(folder / "i");
  EXPECT_FALSE(index.add(entry(1)));
  EXPECT_EQ(testing::text_of(folder / "i"), before);
  std::filesystem::remove(folder / "i");
  EXPECT_FALSE(index.add(entry(1)));
}

TEST(FrameIndex, GivesTheWholeFramesOfOneThatWasCutOff) {
  testing::TemporaryFolder const folder;
  FrameIndex index(folder / "i");
  index.write({entry(0), entry(1), entry(2)});
  std::string const text = testing::text_of(folder / "i");
  std::size_t const third = text.find("frames/000002.hdf");
  for (std::size_t cut = third; cut < text.size(); ++cut) {
    std::ofstream(folder / "i") << text.substr(0, cut);
    auto const entries = read_frame_index(folder / "i");
    EXPECT_GE(entries.size(), 2U);
    EXPECT_EQ(entries[1], entry(1));
  }
  for (char const* bad : {"", "{}", "[1, 2]", "{\"files\": [{\"name\": 3, \"time\": 0}]}", "no index"}) {
    std::ofstream(folder / "i") << bad;
    EXPECT_THROW(read_frame_index(folder / "i"), FileError) << bad;
  }
}

TEST(FrameIndex, IsReadableWheneverItsWriterIsKilled) {
  testing::TemporaryFolder const folder;
  for (int k = 0; k < 20; ++k) {
    pid_t const child = fork();
    if (child == 0) {
      FrameIndex index(folder / "i");
      index.write({entry(0)});
      for (std::size_t n = 1;; ++n) index.add(entry(n));
    }
    while (!std::filesystem::exists(folder / "i")) ::usleep(100);
    ::usleep(static_cast<useconds_t>(300 * k));
    ::kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    auto const entries = read_frame_index(folder / "i");
    ASSERT_GE(entries.size(), 1U);
    EXPECT_EQ(entries.back(), entry(entries.size() - 1));
  }
}

/// In a child, because the limit cannot be lifted again. Exit status 0: as it should be.
int add_beyond_the_limit(std::filesystem::path const& file) {
  std::signal(SIGXFSZ, SIG_IGN);
  FrameIndex index(file);
  index.write({entry(0)});
  std::string const before = testing::text_of(file);
  rlimit const limit{before.size() + 20, before.size() + 20};
  setrlimit(RLIMIT_FSIZE, &limit);
  try {
    index.add(entry(1));
    return 1;
  } catch (FileError const&) {
  }
  return testing::text_of(file) == before ? 0 : 2;
}

TEST(FrameIndex, StaysAsItWasWhenTheNextLineDoesNotFitOnTheDisk) {
  testing::TemporaryFolder const folder;
  pid_t const child = fork();
  if (child == 0) ::_exit(add_beyond_the_limit(folder / "i"));
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace piola
