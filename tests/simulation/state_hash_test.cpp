// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/state_hash.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace piola::testing {
namespace {

/// Hash of a table of two columns, whose rows are given in the order of `places`.
std::string hash_of_rows(std::vector<Index> const& places, std::vector<double> const& values) {
  StateHash hash;
  DistributedRows const rows{0, static_cast<Index>(places.size()), places, 2};
  hash.put_rows("x", rows, values);
  hash.end_rows();
  return hash.text();
}

std::string hash_of(std::string_view name, std::vector<double> const& values) {
  StateHash hash;
  hash.put(name, values);
  hash.end_rows();
  return hash.text();
}

TEST(StateHash, DoesNotDependOnTheOrderOfRows) {
  std::vector<double> const values{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(hash_of_rows({0, 1, 2}, values), hash_of("x", values));
  EXPECT_EQ(hash_of_rows({2, 0, 1}, {5, 6, 1, 2, 3, 4}), hash_of("x", values));
}

TEST(StateHash, TellsNamesPlacesAndLastBitsApart) {
  std::vector<double> const values{1, 2, 2};
  EXPECT_NE(hash_of("x", values), hash_of("v", values));
  EXPECT_NE(hash_of("x", values), hash_of("x", {2, 1, 2}));
  EXPECT_NE(hash_of("x", values), hash_of("x", {1, 2, std::nextafter(2, 3)}));
  EXPECT_NE(hash_of("x", {0.0}), hash_of("x", {-0.0}));
  EXPECT_EQ(hash_of("x", values).size(), 16);
  EXPECT_EQ(hash_of("x", {}), "0000000000000000");
}

}  // namespace
}  // namespace piola::testing
