// SPDX-License-Identifier: Apache-2.0
#include "piola/output/folder_lock.hpp"
#include "piola/base/errors.hpp"
#include "support/temporary_folder.hpp"
#include <csignal>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace piola {
namespace {

TEST(FolderLock, NamesTheProcessThatHoldsIt) {
  testing::TemporaryFolder const folder;
  FolderLock const first(folder.path());
  ASSERT_TRUE(first.held());
  try {
    FolderLock const second(folder.path());
    FAIL();
  } catch (InputError const& error) {
    std::string const said = error.what();
    EXPECT_NE(said.find("is in use by process " + std::to_string(::getpid()) + " on host '"), std::string::npos)
        << said;
    EXPECT_NE(said.find("' since 20"), std::string::npos) << said;
  }
}

TEST(FolderLock, NeverWritesToWhatIsNoLock) {
  testing::TemporaryFolder const folder;
  auto const refusal = [&]() -> std::string {
    try {
      FolderLock const lock(folder.path());
    } catch (std::runtime_error const& error) {
      return error.what();
    }
    return "";
  };
  auto const lock = folder / "lock";
  std::ofstream(folder / "precious") << "precious";
  std::filesystem::create_symlink(folder / "precious", lock);
  EXPECT_NE(refusal().find("a link stands there"), std::string::npos) << refusal();
  std::filesystem::remove(lock);
  std::filesystem::create_hard_link(folder / "precious", lock);
  EXPECT_NE(refusal().find("is not a lock of Piola"), std::string::npos) << refusal();
  std::filesystem::remove(lock);
  std::ofstream(lock) << "my lock";
  EXPECT_NE(refusal().find("is not a lock of Piola"), std::string::npos) << refusal();
  EXPECT_EQ(testing::text_of(folder / "precious"), "precious");
  EXPECT_EQ(testing::text_of(lock), "my lock");
}

TEST(FolderLock, LeavesNothingBehindAndCanBeTakenAgain) {
  testing::TemporaryFolder const folder;
  for (int k = 0; k < 3; ++k) {
    FolderLock const lock(folder.path());
    EXPECT_TRUE(lock.held());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FolderLock, OfAKilledProcessBlocksNobody) {
  testing::TemporaryFolder const folder;
  pid_t const child = fork();
  if (child == 0) {
    FolderLock const lock(folder.path());
    ::raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(std::filesystem::exists(folder / lock_name));
  FolderLock const lock(folder.path());
  EXPECT_TRUE(lock.held());
  EXPECT_NE(testing::text_of(folder / lock_name).find("process " + std::to_string(::getpid()) + " "),
            std::string::npos);
}

TEST(FolderLock, SaysThatAFolderCannotBeWritten) { EXPECT_THROW(FolderLock("/proc/self"), FileError); }

}  // namespace
}  // namespace piola
