// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/threads.hpp"
#include "piola/exec/cpu_quota.hpp"
#include "support/temporary_folder.hpp"
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <sched.h>
#include <string>

namespace piola {
namespace {

namespace fs = std::filesystem;

/// Sets a variable of the environment, or removes it, while it lives.
class Variable {
 public:
  Variable(char const* name, char const* value) : name_(name) {
    if (char const* const before = std::getenv(name)) before_ = before;
    set(value);
  }
  Variable(Variable const&) = delete;
  Variable& operator=(Variable const&) = delete;
  ~Variable() { set(before_ ? before_->c_str() : nullptr); }

 private:
  void set(char const* value) const {
    if (value != nullptr)
      ::setenv(name_, value, 1);
    else
      ::unsetenv(name_);
  }
  char const* name_;
  std::optional<std::string> before_;
};

/// Confines this thread to one of its cores while it lives.
class OneCore {
 public:
  OneCore() {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int core = 0; core < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++core)
      if (CPU_ISSET(core, &before_)) CPU_SET(core, &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  OneCore(OneCore const&) = delete;
  OneCore& operator=(OneCore const&) = delete;
  ~OneCore() { sched_setaffinity(0, sizeof before_, &before_); }

 private:
  cpu_set_t before_{};
};

int with(char const* openmp, char const* slurm) {
  Variable const first("OMP_NUM_THREADS", openmp), second("SLURM_CPUS_PER_TASK", slurm);
  return exec_host::automatic_threads();
}

TEST(AutomaticThreads, FollowTheEnvironment) {
  int const alone = with(nullptr, nullptr);
  EXPECT_GE(alone, 1);
  EXPECT_EQ(with("3", nullptr), 3);
  EXPECT_EQ(with("1", "2"), 1) << "the more particular wish wins";
  EXPECT_EQ(with("5,2", nullptr), 5) << "the outer level of a list";
  EXPECT_EQ(with(nullptr, "1"), 1);
  EXPECT_EQ(with(nullptr, "4000"), alone) << "more than there are";
  for (char const* const wrong : {"", "0", "-2", "two", "2x", "99999999999"}) {
    EXPECT_EQ(with(wrong, nullptr), alone) << wrong;
    EXPECT_EQ(with(nullptr, wrong), alone) << wrong;
  }
}

TEST(AutomaticThreads, StayOnTheCoresOfThisProcess) {
  OneCore const confined;
  EXPECT_EQ(with(nullptr, nullptr), 1);
  EXPECT_EQ(with(nullptr, "2"), 1);
}

/// Control groups as files: version 2 below `mount`, version 1 below `mount/cpu,cpuacct`.
class Groups : public ::testing::Test {
 protected:
  void write(fs::path const& path, std::string const& text) const {
    fs::create_directories((folder_ / path).parent_path());
    std::ofstream(folder_ / path) << text;
  }
  std::optional<int> quota() const { return exec_host::processor_quota(folder_ / "groups", folder_ / "mount"); }

  testing::TemporaryFolder folder_;
};

TEST_F(Groups, GiveTheirQuotaRoundedUp) {
  write("groups", "0::/job/step\n");
  write("mount/job/step/cpu.max", "150000 100000\n");
  EXPECT_EQ(quota(), 2);
  write("mount/job/step/cpu.max", "20000 100000\n");
  EXPECT_EQ(quota(), 1);
}

TEST_F(Groups, AreBoundByThoseAboveThem) {
  write("groups", "0::/job/step\n");
  write("mount/job/step/cpu.max", "800000 100000\n");
  write("mount/job/cpu.max", "300000 100000\n");
  EXPECT_EQ(quota(), 3);
}

TEST_F(Groups, OfVersionOneAreRead) {
  write("groups", "5:cpuset:/\n4:cpu,cpuacct:/job\n1:name=systemd:/job\n");
  write("mount/cpu,cpuacct/job/cpu.cfs_quota_us", "400000\n");
  write("mount/cpu,cpuacct/job/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(quota(), 4);
  write("mount/cpu,cpuacct/job/cpu.cfs_quota_us", "-1\n");
  EXPECT_EQ(quota(), std::nullopt);
}

TEST_F(Groups, WithoutALimitGiveNone) {
  EXPECT_EQ(quota(), std::nullopt) << "no list of groups";
  write("groups", "0::/\n\nnonsense\n");
  EXPECT_EQ(quota(), std::nullopt) << "no cpu.max";
  for (char const* const text : {"max 100000\n", "", "0 0\n", "-5 100000\n", "100000\n", "x y\n"}) {
    write("mount/cpu.max", text);
    EXPECT_EQ(quota(), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace piola
