// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <bit>
#include <cmath>
#include <cstdint>

namespace piola::inline PIOLA_MACHINE {
namespace exec {

// nvcc does not read it as an alias. NOLINTNEXTLINE(modernize-use-using)
__extension__ typedef __int128 Wide;

/// N sums whose bits depend on what is added alone: not on its order, nor on how it was split into sums that were added
/// to each other. Pre-rounded sums (Demmel and Nguyen, Parallel reproducible summation, IEEE Trans. Comput. 64, 2015):
/// every summand is split into multiples of 2^(21 J), 2^(21 (J - 1)), ... 2^(21 (J - 3)), its folds, each of which adds
/// up without rounding. J, the level, is the lowest at which the largest summand |x| is below 2^(21 (J + 1) - 1). So
/// the sum is that of the summands rounded to multiples of 2^(21 (J - 3)), correctly rounded: its error is below
///   2^-63 n max|x| + half a unit in the last place,
/// for n summands (at most 2^32) of which one is at least 2^-925; smaller ones are rounded to multiples of 2^-987.
/// Summands that are not finite are kept aside and decide the sum as IEEE 754 has it: infinite, or not a number. Of
/// 2^986 or more they count as infinite. Sums of nothing are +0. Test: tests/exec/exact_sum_test.cpp.
template <int N>
class ExactSums {
 public:
  ExactSums() {
    for (int c = 0; c < N; ++c) set_level(c, lowest);
  }

  /// One summand for each sum.
  void add(double const* x) {
    int outside = 0;
    for (int c = 0; c < N; ++c) outside += std::fabs(x[c]) < limit_[c] ? 0 : 1;
    if (outside == 0) return deposit(x);
    double made_to_fit[N];
    for (int c = 0; c < N; ++c) made_to_fit[c] = fit(c, x[c]);
    deposit(made_to_fit);
  }
  void add(ExactSums const& other) {
    for (int c = 0; c < N; ++c) {
      special_[c] += other.special_[c];
      if (other.level_[c] > level_[c]) raise(c, other.level_[c]);
      int const shift = level_[c] - other.level_[c];
      for (int k = shift; k < folds; ++k) fold_[k][c] += other.fold_[k - shift][c];
    }
  }

  double value(int c = 0) const {
    if (!(std::fabs(special_[c]) <= 0)) return special_[c];
    // Which fold has how much of the sum may depend on the order; the sum of them does not.
    Wide total = 0;
    for (int k = 0; k < folds; ++k)
      total = (total << bits) + static_cast<std::int64_t>(fold_[k][c] * power_of_two(-bits * (level_[c] - k)));
    return static_cast<double>(total) * power_of_two(bits * (level_[c] - folds + 1));
  }

 private:
  static constexpr int bits = 21, folds = 4, lowest = -44, highest = 46;

  /// 2^e, of which neither e nor -e is an exponent of subnormal numbers.
  static double power_of_two(int e) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + e) << 52); }
  static int exponent_of(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1023; }
  void set_level(int c, int level) {
    level_[c] = level;
    limit_[c] = power_of_two(bits * (level + 1) - 1);
    magnet_[c] = 1.5 * power_of_two(bits * level + 52);
  }
  /// Folds that become too fine are left out: what is in the others is what had been there from the start.
  void raise(int c, int level) {
    int const shift = level - level_[c];
    for (int k = folds - 1; k >= 0; --k) fold_[k][c] = k >= shift ? fold_[k - shift][c] : 0;
    set_level(c, level);
  }
  /// x, with the level that it needs, or 0 if it is none for the folds.
  double fit(int c, double x) {
    if (std::fabs(x) < limit_[c]) return x;
    if (!(std::fabs(x) < power_of_two(bits * (highest + 1) - 1))) {
      special_[c] += std::isnan(x) ? x : std::copysign(HUGE_VAL, x);
      return 0;
    }
    constexpr int positive = 100;  // levels, so that the division rounds down
    raise(c, (exponent_of(x) + bits + 1 + bits * positive) / bits - positive - 1);
    return x;
  }
  void deposit(double const* x) {
    constexpr double finer = 1.0 / (std::int64_t{1} << bits);
    for (int c = 0; c < N; ++c) {
      double rest = x[c], magnet = magnet_[c];
      for (int k = 0; k < folds; ++k) {
        double const part = (rest + magnet) - magnet;
        fold_[k][c] += part;
        rest -= part;
        magnet *= finer;
      }
    }
  }

  double fold_[folds][N]{};
  double magnet_[N]{};   ///< added and taken away again it rounds to the level's multiples
  double limit_[N]{};    ///< summands are below
  double special_[N]{};  ///< sum of those that are not finite
  int level_[N]{};
};

/// One such sum.
class ExactSum {
 public:
  ExactSum& operator+=(double x) {
    sum_.add(&x);
    return *this;
  }
  ExactSum& operator+=(ExactSum const& other) {
    sum_.add(other.sum_);
    return *this;
  }
  double value() const { return sum_.value(); }

 private:
  ExactSums<1> sum_;
};

}  // namespace exec
}  // namespace piola::inline PIOLA_MACHINE
