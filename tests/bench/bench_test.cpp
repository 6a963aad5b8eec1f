// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench.hpp"
#include "piola/base/errors.hpp"
#include "piola/bench/bench_files.hpp"
#include "piola/exec/backend_registry.hpp"
#include "exec/thread_count.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

/// Benchmarks of the program with at most 512 particles, measured once on one thread.
std::vector<BenchRow> measure_small(std::vector<std::string> const& names, std::string const& backend = "auto") {
  testing::Threads const keep(1);
  return measure_steps({.cases = testing::source_folder() + "/bench/cases",
                        .names = names,
                        .most_per_side = 8,
                        .repeats = 1,
                        .threads = {1},
                        .backend = backend});
}

TEST(Bench, MeasuresEachRowBesideItsScalarPath) {
  auto const rows = measure_small({"nodal/rates", "taylor_sph/bar", "adaptle/plate"});
  std::size_t const backends =
      rows.front().backend != "scalar" && exec_host::usable_backends().back() == "scalar" ? 2 : 1;
  ASSERT_EQ(rows.size(), backends * 11);
  EXPECT_EQ(rows.front().particles, 8 * 8 * 8);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto const& row = rows[k];
    EXPECT_EQ(row.backend == "scalar", rows.front().backend == "scalar" || k % backends == 1) << row.name;
    EXPECT_NEAR(row.neighbours, rows[k - k % backends].neighbours, 0.1) << row.name;
    EXPECT_GT(row.neighbours, 1) << row.name;
    EXPECT_GT(row.bytes_per_particle, 8 * 8) << row.name;
    for (double const seconds : {row.set_up, row.wall, row.cpu, row.time_step, row.observation})
      EXPECT_GT(seconds, 0) << row.name;
    double sum = 0;
    for (auto const& part : row.parts) sum += part.second;
    EXPECT_GT(sum, 0) << row.name;
    EXPECT_LT(sum, 1 + 1e-9) << row.name;
  }
}

TEST(Bench, ComparesRowsInTurnWithTheFirst) {
  auto const rows = measure_small({"jst_sph/variables"});
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].relative_cost, 1);
  for (auto const& row : rows) {
    EXPECT_EQ(row.particles, 512);
    EXPECT_EQ(row.neighbours, rows[0].neighbours);
    EXPECT_DOUBLE_EQ(row.relative_cost, row.cpu * rows[0].stages / (rows[0].cpu * row.stages));
  }
  auto const json = nlohmann::json::parse(to_json(rows));
  EXPECT_EQ(json["rows"].size(), 4U);
  EXPECT_EQ(json["rows"][3]["name"], "{p,F}, filtered");
  EXPECT_NE(to_text(rows).find("{p,F}, filtered"), std::string::npos);
}

TEST(Bench, MeasuresTheMeanOfTheStepsThatARowAsksFor) {
  auto const rows = measure_small({"jst_sph/column"});
  ASSERT_EQ(rows.size(), 2U);
  for (auto const& row : rows) EXPECT_EQ(row.particles, 5 * 25 * 5);
  EXPECT_GT(rows[1].time_step, 0);
}

TEST(Bench, BuildsEachContactOfBothFormulations) {
  auto const rows = measure_small({"contact"});
  ASSERT_EQ(rows.size(), 10U);
  for (auto const& row : rows) EXPECT_EQ(row.particles, 2 * 6 * 6 * 6) << row.name;
  EXPECT_EQ(rows[5].relative_cost, 1);
}

TEST(Bench, RefusesUnknownNamesAndInstructionSets) {
  EXPECT_THROW(measure_small({"nodal/rate"}), InputError);
  EXPECT_THROW(measure_small({"nodal/rates"}, "v9"), InputError);
}

TEST(Bench, ReadsEveryKeyOfItsRows) {
  testing::TemporaryFolder const folder;
  std::filesystem::create_directories(folder / "a/b");
  auto const write = [&](std::string const& text) { std::ofstream(folder / "a/b/rows.toml") << text; };
  write("in_turn = true\n[[row]]\nname = \"one\"\nset = [\"x=1\"]\nscalar = true\nwarm_up = 2\nsteps = 3\n");
  auto const files = read_benchmarks(folder.path(), {"a"});
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].name, "a/b");
  EXPECT_TRUE(files[0].in_turn && files[0].rows[0].scalar);
  EXPECT_EQ(files[0].rows[0].set, std::vector<std::string>{"x=1"});
  EXPECT_EQ(10 * files[0].rows[0].warm_up + files[0].rows[0].steps, 23);
  for (char const* wrong : {"[[row]]\nset = []", "[[row]]\nname = 1", "row = 1", "turn = true",
                            "[[row]]\nname = \"a\"\nsteps = 0", "[[row]]\nname = \"a\"\nset = \"x=1\""}) {
    write(wrong);
    EXPECT_THROW(read_benchmarks(folder.path(), {"a"}), InputError) << wrong;
  }
}

}  // namespace
}  // namespace piola
