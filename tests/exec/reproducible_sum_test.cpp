// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/reproducible_sum.hpp"
#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace piola {
namespace {

using exec::ReproducibleSum;
using exec::ReproducibleSums;

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

double exact(std::vector<double> const& x) {
  ReproducibleSum sum;
  for (double const v : x) sum += v;
  return sum.value();
}

/// Numbers of both signs and many sizes, from 2^low to 2^high.
std::vector<double> numbers(std::mt19937_64& generator, std::size_t n, int low, int high) {
  std::uniform_real_distribution<double> digits(-1, 1);
  std::uniform_int_distribution<int> size(low, high);
  std::vector<double> x;
  for (std::size_t k = 0; k < n; ++k) x.push_back(std::ldexp(digits(generator), size(generator)));
  return x;
}

TEST(ReproducibleSum, HasTheSameBitsInAnyOrderAndAnySplit) {
  std::mt19937_64 generator(1);
  for (auto const& [low, high] : {std::pair{-3, 0}, {-30, 30}, {-200, 200}, {-1070, -920}, {-980, 980}, {20, 22}}) {
    auto x = numbers(generator, 500, low, high);
    auto const once = bits_of(exact(x));
    for (int round = 0; round < 100; ++round) {
      std::shuffle(x.begin(), x.end(), generator);
      ASSERT_EQ(bits_of(exact(x)), once) << low << " to " << high;
      std::vector<ReproducibleSum> owners(1 + generator() % 9);
      for (double const v : x) owners[generator() % owners.size()] += v;
      std::shuffle(owners.begin(), owners.end(), generator);
      for (std::size_t k = 1; k < owners.size(); ++k) owners[0] += owners[k];
      ASSERT_EQ(bits_of(owners[0].value()), once) << low << " to " << high;
    }
  }
}

/// Summands on the borders of levels and halfway between the multiples of folds, where rounding has to choose.
TEST(ReproducibleSum, TiesAndBordersOfLevelsDoNotDependOnTheOrder) {
  std::mt19937_64 generator(2);
  std::vector<double> candidates;
  for (int e = -130; e <= 130; ++e)
    for (double const factor : {1.0, 1 + 0x1p-52, 1 - 0x1p-53, 1.5, 1.25, 1 + 0x1p-21, 1 + 0x1p-42})
      for (double const sign : {1.0, -1.0}) candidates.push_back(sign * std::ldexp(factor, e));
  for (int set = 0; set < 300; ++set) {
    std::vector<double> x;
    int const most = static_cast<int>(generator() % 40) + 2;
    for (int k = 0; k < most; ++k) x.push_back(candidates[generator() % candidates.size()]);
    auto const once = bits_of(exact(x));
    for (int round = 0; round < 20; ++round) {
      std::shuffle(x.begin(), x.end(), generator);
      ASSERT_EQ(bits_of(exact(x)), once);
    }
  }
}

/// Multiples of 2^-40 below 2^20: all sums are exact in 128-bit integers.
TEST(ReproducibleSum, IsCorrectlyRoundedWhereFoldsReach) {
  std::mt19937_64 generator(3);
  for (int set = 0; set < 200; ++set) {
    __extension__ __int128 reference = 0;
    ReproducibleSum sum;
    for (int k = 0; k < 1000; ++k) {
      auto const whole = static_cast<std::int64_t>(generator() >> 11) - (std::int64_t{1} << 52);
      reference += whole;
      sum += std::ldexp(static_cast<double>(whole), -40);
    }
    EXPECT_EQ(sum.value(), std::ldexp(static_cast<double>(reference), -40));
  }
}

TEST(ReproducibleSum, HugeTermsCancelAndLeaveTheSmallOnes) {
  EXPECT_EQ(exact({1e15, 1, -1e15}), 1);
  EXPECT_EQ(exact({1, 1e15, 0x1p-10, -1e15}), 1 + 0x1p-10);
  std::vector<double> x;
  for (int k = 1; k <= 1000; ++k) x.insert(x.end(), {1e12 / k, 1e-6 * k, -1e12 / k});
  // 2^-63 of the largest, for each summand
  EXPECT_NEAR(exact(x), 1e-6 * 500500, std::ldexp(3000 * 1e12, -63));
  EXPECT_GT(std::abs(std::accumulate(x.begin(), x.end(), 0.0) - 1e-6 * 500500), 1e-7) << "plain sums are worse";
}

TEST(ReproducibleSum, ErrorIsBelowTheBound) {
  std::mt19937_64 generator(4);
  for (int set = 0; set < 200; ++set) {
    auto const x = numbers(generator, 400, -60, 0);
    long double reference = 0, largest = 0;
    for (double const v : x) {
      reference += static_cast<long double>(v);
      largest = std::max(largest, std::abs(static_cast<long double>(v)));
    }
    // The reference has 64 digits itself: half a unit of the partial sums for each summand.
    long double const bound = 400 * 0x1p-63L * largest + 0x1p-53L * std::abs(reference) + 400 * 0x1p-63L * 20 * largest;
    EXPECT_LE(std::abs(static_cast<long double>(exact(x)) - reference), bound);
  }
}

TEST(ReproducibleSum, SpecialValuesDecideAsIeeeHasIt) {
  double const inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bits_of(exact({})), bits_of(0.0));
  EXPECT_EQ(bits_of(exact({-0.0, -0.0})), bits_of(0.0));
  EXPECT_EQ(bits_of(exact({3.5, -3.5})), bits_of(0.0));
  EXPECT_EQ(exact({1, inf, 2}), inf);
  EXPECT_TRUE(std::isnan(exact({1, -inf, 1e300}))) << "huge ones count as infinite";
  EXPECT_TRUE(std::isnan(exact({inf, 1, -inf})));
  EXPECT_TRUE(std::isnan(exact({1, nan})));
  EXPECT_TRUE(std::isnan(exact({nan, inf})));
  EXPECT_EQ(exact({0x1p986}), inf);
  EXPECT_EQ(exact({0x1.fp985}), 0x1.fp985);
  EXPECT_EQ(exact({0x1p-987, 0x1p-987}), 0x1p-986);
  EXPECT_EQ(exact({0x1p-1060, 0x1p-1060}), 0);
  ReproducibleSum a, b;
  a += 1;
  b += nan;
  a += b;
  EXPECT_TRUE(std::isnan(a.value()));
}

TEST(ReproducibleSum, ManySumsAtOnceAreTheOnesOfEach) {
  constexpr int N = 7;
  std::mt19937_64 generator(5);
  ReproducibleSums<N> first, second;
  std::vector<ReproducibleSum> each(N);
  for (int k = 0; k < 1000; ++k) {
    double x[N];
    for (int c = 0; c < N; ++c) x[c] = numbers(generator, 1, -9 * c, 13 * c)[0];
    (k % 3 == 0 ? first : second).add(x);
    for (int c = 0; c < N; ++c) each[static_cast<std::size_t>(c)] += x[c];
  }
  second.add(first);
  for (int c = 0; c < N; ++c) EXPECT_EQ(second.value(c), each[static_cast<std::size_t>(c)].value());
}

}  // namespace
}  // namespace piola
