// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench.hpp"
#include "exec/thread_count.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

BenchOptions small() {
  BenchOptions options;
  options.particles_per_side = 8;
  options.repeats = 1;
  options.threads = {1};
  options.column_particles = {5, 25, 5};
  options.column_steps = 3;
  return options;
}

TEST(Bench, MeasuresTheColumnWithBothSupportsInEqualSteps) {
  testing::Threads const keep(1);
  BenchOptions options = small();
  options.rates = options.variables = false;
  BenchReport const report = bench_jst_sph(options);
  EXPECT_TRUE(report.rows.empty());
  EXPECT_EQ(report.column_particles, 5 * 25 * 5);
  ASSERT_EQ(report.column.size(), 2U);
  for (auto const& row : report.column) {
    EXPECT_EQ(row.steps, 3);
    EXPECT_GT(row.simulated, 0);
    EXPECT_GT(row.cpu, 0);
    EXPECT_DOUBLE_EQ(row.milliseconds_per_cpu_second(), 1e3 * row.simulated / row.cpu);
  }
}

TEST(Bench, ComparesUnknownsAtEqualNeighbours) {
  testing::Threads const keep(1);
  BenchOptions options = small();
  options.rates = options.column = false;
  BenchReport const report = bench_jst_sph(options);
  ASSERT_EQ(report.variables.size(), 5U);
  EXPECT_EQ(report.variables_particles, 512);
  EXPECT_EQ(report.variables[0].relative_cost, 1);
  for (auto const& row : report.variables) {
    EXPECT_EQ(row.neighbours, report.variables[0].neighbours);
    EXPECT_GT(row.right_sides_per_cpu_second, 0);
  }
  auto const json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["variables"].size(), 5U);
  EXPECT_FALSE(json.contains("column"));
  EXPECT_NE(to_text(report).find("{p,F,H,J}, paper"), std::string::npos);
}

}  // namespace
}  // namespace piola
