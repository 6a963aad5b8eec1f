// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/version.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(Problems, AllAreReportedInOneMessage) {
  Problems problems;
  EXPECT_NO_THROW(problems.raise_if_any());
  problems.add({"case.toml", 3, 7}, "first");
  problems.add({"case.toml", 0, 0}, "second");
  problems.add({"--set run.end=x", 0, 0}, "third");
  problems.add({}, "fourth");
  EXPECT_EQ(problems.count(), 4u);
  try {
    problems.raise_if_any();
    FAIL() << "no exception";
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "case.toml:3:7: first\ncase.toml: second\n--set run.end=x: third\nfourth");
  }
}

TEST(Contracts, ABrokenOneNamesTheCondition) {
  try {
    contract_broken("expectation", "n > 0", "file.cpp", 12);
  } catch (ContractError const& error) {
    EXPECT_STREQ(error.what(), "file.cpp:12: expectation does not hold: n > 0");
  }
  [[maybe_unused]] int const n = 1;
  EXPECT_NO_THROW(PIOLA_EXPECTS(n > 0));
  EXPECT_NO_THROW(PIOLA_ENSURES(n > 0));
}

TEST(Version, HasThreeNumbers) { EXPECT_FALSE(version().empty()); }

}  // namespace
}  // namespace piola
