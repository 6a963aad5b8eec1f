// SPDX-License-Identifier: Apache-2.0
#include "piola/input/history_names.hpp"
#include "piola/output/history.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(HistoryNames, AreTheColumnsThatAreWritten) {
  std::vector<HistoryColumn> const written = diagnostic_columns(Diagnostics{});
  auto const known = history_names();
  ASSERT_EQ(known.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(known[i].name, written[i].name);
    EXPECT_EQ(known[i].unit, written[i].unit);
  }
}

}  // namespace
}  // namespace piola
