// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_contact.hpp"
#include "exec/thread_count.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

TEST(ContactBench, SetsContactBesideNone) {
  testing::Threads const keep(1);
  ContactBenchReport const report = bench_contact({.cube_side = 6, .repeats = 1});
  EXPECT_EQ(report.particles, 432);
  ASSERT_EQ(report.rows.size(), 10U);
  for (ContactRow const& row : report.rows) EXPECT_GT(row.microseconds, 0) << row.name;
  for (std::size_t k = 0; k < 10; k += 5) {
    EXPECT_EQ(report.rows[k].share, 0);
    EXPECT_EQ(report.rows[k].step_ratio, 1);
    EXPECT_NEAR(report.rows[k + 1].step_ratio, 1, 1e-9) << "who does not touch steps as before";
    EXPECT_LT(report.rows[k + 2].step_ratio, 1);
  }
  auto const j = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(j["rows"].size(), 10U);
  EXPECT_NE(to_text(report).find("jst_sph, pressed, friction"), std::string::npos);
}

}  // namespace
}  // namespace piola
