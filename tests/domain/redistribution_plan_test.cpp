// SPDX-License-Identifier: Apache-2.0
// On one rank, which has everything; several are for ranks_test.py.
#include "piola/domain/redistribution_plan.hpp"
#include <gtest/gtest.h>
#include <vector>

namespace piola {
namespace {

TEST(RedistributionPlan, PutsRowsInOrderAndBack) {
  std::vector<Index> const places{3, 0, 4, 1, 2};
  RedistributionPlan const plan({.count = 5, .places = places}, 2);
  EXPECT_EQ(plan.own().first, 0);
  EXPECT_EQ(plan.own().last, 5);
  std::vector<double> const rows{30, 31, 0, 1, 40, 41, 10, 11, 20, 21};
  std::vector<double> const whole = plan.collect<double>(rows, 2);
  EXPECT_EQ(whole, (std::vector<double>{0, 1, 10, 11, 20, 21, 30, 31, 40, 41}));
  std::vector<double> back(rows.size());
  plan.from_file_order<double>(whole, back, 2);
  EXPECT_EQ(back, rows);
}

TEST(RedistributionPlan, LeavesRowsInOrderAsTheyAre) {
  RedistributionPlan const plan({.count = 3}, 4096);
  std::vector<float> const rows{7, 8, 9};
  EXPECT_EQ(plan.collect<float>(rows, 1), rows);
}

TEST(RedistributionPlan, TakesATableWithoutRows) {
  RedistributionPlan const plan({.count = 0}, 1);
  EXPECT_TRUE(plan.collect<double>({}, 3).empty());
}

}  // namespace
}  // namespace piola
