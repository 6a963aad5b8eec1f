// SPDX-License-Identifier: Apache-2.0
#include "piola/output/checkpoint.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
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
  c.cut_to_end = true;
  c.wall_seconds = 7;
  c.version = "0.1.0";
  c.backend = "v3 of a processor with v4";
  c.source = "title = \"a\"\n";
  c.state.put("u", std::array{1.0, -0.0, 1e-310, 1.0 / 7});
  c.state.put("body0/F", std::array{2.0});
  c.state.put("none", std::span<double const>());
  c.observers.put("next", std::array{3.0});
  return c;
}

/// Step of the checkpoint that a resumed run would start from.
std::int64_t newest_usable(std::filesystem::path const& folder, std::vector<std::string>& warnings) {
  std::int64_t step = -1;
  use_newest_checkpoint(folder, warnings, [&](Checkpoint const& c) {
    step = c.step;
    return true;
  });
  return step;
}

void write_text(std::filesystem::path const& path, std::string const& text) {
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
  EXPECT_TRUE(back.cut_to_end);
  EXPECT_EQ(back.source, c.source);
  EXPECT_EQ(back.version, c.version);
  EXPECT_EQ(back.backend, c.backend);
  EXPECT_EQ(back.state.arrays(), c.state.arrays());
  EXPECT_TRUE(std::signbit(back.state.all("u")[1]));
  EXPECT_EQ(back.observers.arrays(), c.observers.arrays());
}

// As a run writes it: the state comes array by array and is never a part of the checkpoint in memory.
TEST(Checkpoint, TakesTheStateWhileItIsWritten) {
  testing::TemporaryFolder const folder;
  Checkpoint const c = sample(12);
  Checkpoint rest = c;
  rest.state = {};
  write_checkpoint(folder / "a.h5", rest, [&](StateWriter& writer) {
    for (auto const& [name, values] : c.state.arrays()) writer.put(name, values);
  });
  EXPECT_EQ(read_checkpoint(folder / "a.h5").state.arrays(), c.state.arrays());
  write_checkpoint(folder / "b.h5", c);
  EXPECT_EQ(read_text_file(folder / "a.h5"), read_text_file(folder / "b.h5"));
}

TEST(Checkpoint, ByteEqualWhateverTimeTheRunTook) {
  testing::TemporaryFolder const folder;
  Checkpoint slow = sample(5);
  slow.wall_seconds = 1e4;
  slow.stepping_seconds = 0.1;
  keep_checkpoint(folder / "quick", sample(5));
  keep_checkpoint(folder / "slow", slow);
  EXPECT_EQ(testing::text_of(checkpoint_path(folder / "quick", 5)),
            testing::text_of(checkpoint_path(folder / "slow", 5)));
  auto const taken = [&](char const* name) {
    std::array<double, 2> seconds{};
    std::vector<std::string> warnings;
    use_newest_checkpoint(folder / name, warnings, [&](Checkpoint const& c) {
      seconds = {c.wall_seconds, c.stepping_seconds};
      return true;
    });
    EXPECT_TRUE(warnings.empty());
    return seconds;
  };
  EXPECT_EQ(taken("quick"), (std::array{7.0, 0.0}));
  EXPECT_EQ(taken("slow"), (std::array{1e4, 0.1}));
  // Nothing that a run computes depends on it.
  auto const file = folder / "slow" / "checkpoints" / durations_name;
  for (char const* text : {"", "step\n5 nan 1\n", "step\n5 17", "step\n6 17 18\n"}) {
    write_text(file, text);
    EXPECT_EQ(taken("slow"), (std::array{0.0, 0.0})) << text;
  }
  std::filesystem::remove(file);
  EXPECT_EQ(taken("slow"), (std::array{0.0, 0.0}));
}

TEST(Checkpoint, KeepsTheLastTwo) {
  testing::TemporaryFolder const folder;
  for (std::int64_t step : {5, 90, 1000}) keep_checkpoint(folder.path(), sample(step));
  auto const list = list_checkpoints(folder.path());
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].filename(), "000001000.h5");
  EXPECT_EQ(list[1].filename(), "000000090.h5");
  std::string const times = testing::text_of(folder / "checkpoints" / durations_name);
  EXPECT_EQ(times.substr(times.find('\n')), "\n90 7 0\n1000 7 0\n");
}

TEST(Checkpoint, NoFlippedBitPassesWhereverItIs) {
  testing::TemporaryFolder const folder;
  keep_checkpoint(folder.path(), sample(5));
  keep_checkpoint(folder.path(), sample(6));
  auto const path = checkpoint_path(folder.path(), 6);
  std::string const whole = testing::text_of(path);
  std::size_t const positions = 400;
  for (std::size_t k = 0; k < positions; ++k) {
    // Evenly spread over the file, and every byte of the seal at its end.
    std::size_t const at = k < 100 ? whole.size() - 1 - k : (k - 100) * whole.size() / (positions - 100);
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (k % 8)));
    write_text(path, bad);
    std::vector<std::string> warnings;
    EXPECT_EQ(newest_usable(folder.path(), warnings), 5) << "byte " << at;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("check sum"), std::string::npos) << warnings[0];
  }
  write_text(path, whole);
  std::vector<std::string> warnings;
  EXPECT_EQ(newest_usable(folder.path(), warnings), 6);
}

TEST(Checkpoint, FallsBackFromATruncatedOrEmptyOrLongerFile) {
  testing::TemporaryFolder const folder;
  keep_checkpoint(folder.path(), sample(5));
  keep_checkpoint(folder.path(), sample(6));
  auto const path = checkpoint_path(folder.path(), 6);
  std::string const whole = testing::text_of(path);
  for (std::string const& bad :
       {std::string(), whole.substr(0, 20), whole.substr(0, 900), whole.substr(0, whole.size() - 1), whole + "\n",
        whole + whole, std::string(whole.size(), '\0')}) {
    write_text(path, bad);
    std::vector<std::string> warnings;
    EXPECT_EQ(newest_usable(folder.path(), warnings), 5) << bad.size();
    EXPECT_EQ(warnings.size(), 1U);
  }
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  std::vector<std::string> warnings;
  EXPECT_EQ(newest_usable(folder.path(), warnings), 5);
}

TEST(Checkpoint, FallsBackWhenItsUserCannotUseIt) {
  testing::TemporaryFolder const folder;
  keep_checkpoint(folder.path(), sample(5));
  keep_checkpoint(folder.path(), sample(6));
  std::vector<std::string> warnings;
  std::int64_t used = 0;
  use_newest_checkpoint(folder.path(), warnings, [&](Checkpoint& c) {
    if (c.step == 6) c.in_file->get("something else", {});
    used = c.step;
    return true;
  });
  EXPECT_EQ(used, 5);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("000000006.h5: checkpoint: has no 'something else'"), std::string::npos) << warnings[0];
}

TEST(Checkpoint, IsPassedOverWithoutAWordWhereItIsDeclined) {
  testing::TemporaryFolder const folder;
  keep_checkpoint(folder.path(), sample(5));
  keep_checkpoint(folder.path(), sample(6));
  std::vector<std::string> warnings;
  std::vector<std::int64_t> seen;
  EXPECT_FALSE(use_newest_checkpoint(folder.path(), warnings, [&](Checkpoint& c) {
    seen.push_back(c.step);
    return false;
  }));
  EXPECT_EQ(seen, (std::vector<std::int64_t>{6, 5}));
  EXPECT_TRUE(warnings.empty());
}

TEST(Checkpoint, SaysWhyNoneCanBeUsed) {
  testing::TemporaryFolder const folder;
  std::vector<std::string> warnings;
  EXPECT_THROW(newest_usable(folder.path(), warnings), InputError);
  keep_checkpoint(folder.path(), sample(6));
  write_text(checkpoint_path(folder.path(), 6), "no checkpoint at all");
  try {
    newest_usable(folder.path(), warnings);
    FAIL();
  } catch (InputError const& error) {
    EXPECT_NE(std::string(error.what()).find("000000006.h5: does not end with its check sum"), std::string::npos)
        << error.what();
  }
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
