// SPDX-License-Identifier: Apache-2.0
#include "piola/output/checkpoint.hpp"
#include "piola/base/problems.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

namespace piola {
namespace {

Checkpoint sample(std::int64_t step) {
  Checkpoint c;
  c.time = 0.1;
  c.step = step;
  c.dt = 1.0 / 3;
  c.first_dt = 0.25;
  c.wall_seconds = 7;
  c.version = "0.1.0";
  c.source = "title = \"a\"\n";
  c.state.put("u", std::array{1.0, -0.0, 1e-310, 1.0 / 7});
  c.state.put("body0/F", std::array{2.0});
  c.state.put("none", std::span<double const>());
  c.observers.put("next", std::array{3.0});
  return c;
}

/// Changes one byte of a stored number.
void damage(std::filesystem::path const& path) {
  std::string text = testing::text_of(path);
  double const number = 1.0 / 7;
  auto const at = text.find(std::string(reinterpret_cast<char const*>(&number), sizeof number));
  ASSERT_NE(at, std::string::npos);
  text[at] = static_cast<char>(text[at] ^ 1);
  std::ofstream(path, std::ios::binary) << text;
}

TEST(Checkpoint, GivesBackEveryBit) {
  testing::TemporaryFolder const folder;
  Checkpoint const c = sample(12);
  write_checkpoint(folder / "a.h5", c);
  Checkpoint const back = read_checkpoint(folder / "a.h5");
  EXPECT_EQ(back.time, c.time);
  EXPECT_EQ(back.step, 12);
  EXPECT_EQ(back.dt, c.dt);
  EXPECT_EQ(back.first_dt, c.first_dt);
  EXPECT_EQ(back.source, c.source);
  EXPECT_EQ(back.version, c.version);
  EXPECT_EQ(back.state.arrays(), c.state.arrays());
  EXPECT_TRUE(std::signbit(back.state.all("u")[1]));
  EXPECT_EQ(back.observers.arrays(), c.observers.arrays());
}

TEST(Checkpoint, KeepsTheLastTwo) {
  testing::TemporaryFolder const folder;
  for (std::int64_t step : {5, 90, 1000}) keep_checkpoint(folder.path(), sample(step));
  auto const list = list_checkpoints(folder.path());
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].filename(), "000001000.h5");
  EXPECT_EQ(list[1].filename(), "000000090.h5");
}

TEST(Checkpoint, FallsBackToTheOneBeforeADamagedOne) {
  testing::TemporaryFolder const folder;
  keep_checkpoint(folder.path(), sample(5));
  keep_checkpoint(folder.path(), sample(6));
  damage(checkpoint_path(folder.path(), 6));
  std::vector<std::string> warnings;
  EXPECT_EQ(read_newest_checkpoint(folder.path(), warnings).step, 5);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("check sum"), std::string::npos) << warnings[0];
}

TEST(Checkpoint, FallsBackFromATruncatedFile) {
  testing::TemporaryFolder const folder;
  keep_checkpoint(folder.path(), sample(5));
  keep_checkpoint(folder.path(), sample(6));
  std::filesystem::resize_file(checkpoint_path(folder.path(), 6), 900);
  std::vector<std::string> warnings;
  EXPECT_EQ(read_newest_checkpoint(folder.path(), warnings).step, 5);
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(Checkpoint, SaysSoWhenThereIsNone) {
  testing::TemporaryFolder const folder;
  std::vector<std::string> warnings;
  EXPECT_THROW(read_newest_checkpoint(folder.path(), warnings), InputError);
}

TEST(Checkpoint, RefusesAStateOfAnotherSize) {
  NamedState state;
  state.put("u", std::array{1.0, 2.0});
  std::array<double, 3> three{};
  EXPECT_THROW(state.get("u", three), FileError);
  EXPECT_THROW(state.get("v", three), FileError);
}

}  // namespace
}  // namespace piola
