// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/bench/bench_support.hpp"
#include <gtest/gtest.h>

namespace piola::testing {

/// What every benchmark of whole time steps promises: `bodies` rows for each machine, with memory and rates.
template <class Report>
void expect_rows(Report const& report, std::vector<std::string> const& backends, std::size_t bodies,
                 double least_bytes) {
  ASSERT_EQ(report.rows.size(), bodies * backends.size());
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    RateRow const& row = report.rows[k];
    EXPECT_EQ(row.backend, backends[k % backends.size()]);
    EXPECT_GT(row.bytes_per_particle, least_bytes) << row.name;
    EXPECT_GT(row.per_second, 0) << row.name;
    EXPECT_GT(row.per_cpu_second, 0) << row.name;
  }
}

}  // namespace piola::testing
