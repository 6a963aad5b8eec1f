// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_accuracy.hpp"
#include "exec/thread_count.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

TEST(BenchAccuracy, RunsEveryProblemWithEverySchemeAndMeasuresErrorsAgainstFiniteElements) {
  testing::Threads const keep(1);
  AccuracyOptions options;
  options.across = {3};
  AccuracyReport const report = bench_accuracy(options);
  ASSERT_EQ(report.rows.size(), 12U);
  for (auto const& row : report.rows) {
    EXPECT_EQ(row.particles, 3 * 13 * 3);
    EXPECT_GT(row.cpu, row.set_up);
    if (row.formulation != "nodal") continue;
    // Theory and other code: finite elements, within what three particles across can do.
    EXPECT_LT(std::abs(row.error), 0.06) << row.problem << " " << row.poissons_ratio;
    EXPECT_GT(std::abs(row.error), 1e-6);
  }
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["accuracy"].size(), 12U);
  EXPECT_NE(to_text(report).find("0.3 %"), std::string::npos);
}

}  // namespace
}  // namespace piola
