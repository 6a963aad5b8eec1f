// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_accuracy.hpp"
#include "exec/thread_count.hpp"
#include "support/places.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

TEST(BenchAccuracy, RunsEveryProblemWithEverySchemeAndMeasuresErrorsAgainstFiniteElements) {
  testing::Threads const keep(1);
  auto const rows = measure_accuracy({.cases = testing::source_folder() + "/cases", .across = {3}});
  ASSERT_EQ(rows.size(), 12U);
  for (auto const& row : rows) {
    EXPECT_EQ(row.particles, 3 * 13 * 3);
    EXPECT_GT(row.cpu, row.set_up);
    if (row.formulation != "nodal") continue;
    // Theory and other code: finite elements, within what three particles across can do.
    EXPECT_LT(std::abs(row.error), 0.06) << row.problem << " " << row.poissons_ratio;
    EXPECT_GT(std::abs(row.error), 1e-6);
  }
  EXPECT_EQ(nlohmann::json::parse(to_json(rows))["accuracy"].size(), 12U);
  EXPECT_NE(to_text(rows).find("jst_sph paper"), std::string::npos);
}

}  // namespace
}  // namespace piola
