// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_nodal.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "bench/bench_rows.hpp"
#include "exec/thread_count.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

NodalBenchOptions small() {
  NodalBenchOptions options;
  options.cube_side = 6;
  options.cloud_side = 5;
  options.lengths = {12};
  options.repeats = 1;
  options.threads = {1};
  return options;
}

TEST(NodalBench, MeasuresLatticesAndCloudsBesideTheirScalarPathAndTheirSetUp) {
  testing::Threads const keep(1);
  NodalBenchReport const report = bench_nodal(small());
  auto const names = speedup_over_scalar(report.backend, nodal::backend_names());
  testing::expect_rows(report, names, 5, 110 * 8);
  for (auto const& row : report.rows) {
    EXPECT_GT(row.neighbours, 15) << row.name;
    EXPECT_LT(row.neighbours, 57) << row.name;
  }
  ASSERT_EQ(report.set_up.size(), 6U);
  long const particles[]{216, 125, 625, 625, 117, 300};
  for (std::size_t k = 0; k < report.set_up.size(); ++k) {
    auto const& row = report.set_up[k];
    EXPECT_EQ(row.particles, particles[k]);
    EXPECT_GT(row.iterations, 0) << row.name;
    EXPECT_GE(row.tight, row.iterations) << row.name;
    for (double const part : {row.cells, row.fits, row.closure, row.masses, row.tables, row.right_side})
      EXPECT_GT(part, 0) << row.name;
  }
}

TEST(NodalBench, MeasuresWhatItIsAskedForAndPrintsIt) {
  testing::Threads const keep(1);
  NodalBenchOptions options = small();
  options.set_up = false;
  EXPECT_TRUE(bench_nodal(options).set_up.empty());
  NodalBenchReport report;
  report.backend = "v4";
  report.rows.push_back({"cube, lattice", "v4", 2, 216, 40.5, 900, 6e6, 3e6});
  report.set_up.push_back({"cube, lattice", 216, 0.001, 0.004, 0.003, 0.0005, 0.0005, 12, 30, 0.002});
  auto const json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["rows"][0]["stages_per_second"], 6e6);
  EXPECT_EQ(json["set_up"][0]["integration_iterations"], 12);
  std::string const text = to_text(report);
  EXPECT_NE(text.find("6.00          3.00"), std::string::npos) << text;
  EXPECT_NE(text.find("9.0       2.000     2.0"), std::string::npos) << text;
}

TEST(NodalBench, RefusesAnUnknownMachine) {
  NodalBenchOptions options = small();
  options.backend = "v9";
  EXPECT_THROW(bench_nodal(options), InputError);
}

}  // namespace
}  // namespace piola
