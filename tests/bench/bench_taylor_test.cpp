// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_taylor.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/taylor_sph/state.hpp"
#include "bench/bench_rows.hpp"
#include "exec/thread_count.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

TaylorBenchOptions small() {
  TaylorBenchOptions options;
  options.plate_side = 20;
  options.cube_side = 5;
  options.bar_particles = 50;
  options.repeats = 1;
  options.steps = 25;
  options.threads = {1};
  return options;
}

TEST(TaylorBench, MeasuresEachBodyBesideItsScalarPathInAllDimensions) {
  testing::Threads const keep(1);
  TaylorBenchReport const report = bench_taylor_sph(small());
  auto const names = speedup_over_scalar(report.backend, taylor_sph::backend_names());
  std::size_t const n = names.size();
  testing::expect_rows(report, names, 9, 8 * 8);
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    auto const& row = report.rows[k];
    EXPECT_EQ(row.particles, k < 5 * n ? 400 : k < 6 * n ? 50 : 125) << row.name;
    EXPECT_EQ(row.neighbours, report.rows[k / n * n].neighbours) << row.name;
  }
}

TEST(TaylorBench, LeavesTheScalarPathOutWhereItIsNotBuilt) {
  using Names = std::vector<std::string>;
  char const *const all[] = {"v4", "v3", "scalar", nullptr}, *const one[] = {"v4", nullptr};
  EXPECT_EQ(speedup_over_scalar("v4", all), (Names{"v4", "scalar"}));
  EXPECT_EQ(speedup_over_scalar("v4", one), Names{"v4"});
  EXPECT_EQ(speedup_over_scalar("scalar", all), Names{"scalar"});
}

TEST(TaylorBench, StrainsThePlateSoThatListsDoNotLast) {
  testing::Threads const keep(1);
  TaylorBenchReport const report = bench_taylor_sph(small());
  for (auto const& row : report.rows)
    EXPECT_EQ(row.list_updates > 0, row.name == "plate, moving, lists follow") << row.name;
  EXPECT_EQ(report.upkeep.particles, 400);
  EXPECT_GE(report.upkeep.cells, 2 * 18 * 18);
  EXPECT_GT(report.upkeep.list_update, 0);
  EXPECT_GT(report.upkeep.triangulation, 0);
}

TEST(TaylorBench, UpkeepIsSharedByTheStepsBetween) {
  TaylorUpkeep const upkeep{1000, 2000, 0.5, 4, 6};
  EXPECT_DOUBLE_EQ(upkeep.per_cpu_second(), 1000 / (0.5 + 10.0 / 20));
}

TEST(TaylorBench, IsPrintedAsTextAndAsJson) {
  TaylorBenchReport report;
  report.backend = "v4";
  report.rows.push_back({{"plate, fixed", "v4", 2, 400, 23.5, 800, 4e6, 2e6}, 3});
  report.upkeep = {1000, 2000, 0.5, 4, 6};
  auto const json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["formulation"], "taylor_sph");
  EXPECT_EQ(json["rows"][0]["particle_steps_per_second"], 4e6);
  EXPECT_EQ(json["rows"][0]["list_updates"], 3);
  EXPECT_EQ(json["upkeep"]["particle_steps_per_cpu_second"], 1000);
  std::string const text = to_text(report);
  EXPECT_NE(text.find("plate, fixed"), std::string::npos);
  EXPECT_NE(text.find("4.00         2.00"), std::string::npos) << text;
}

TEST(TaylorBench, RefusesAnUnknownMachine) {
  TaylorBenchOptions options = small();
  options.backend = "v9";
  EXPECT_THROW(bench_taylor_sph(options), InputError);
}

}  // namespace
}  // namespace piola
