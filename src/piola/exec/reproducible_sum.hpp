// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <bit>
#include <cmath>
#include <cstdint>

namespace piola::inline PIOLA_BACKEND {
namespace exec {

// nvcc does not read it as an alias. NOLINTNEXTLINE(modernize-use-using)
__extension__ typedef __int128 Wide;

/// N reproducible sums: their bits do not depend on the order of the summands, nor on how they are split into partial
/// sums. Pre-rounded sums (Demmel and Nguyen, Parallel reproducible summation, IEEE Trans. Comput. 64, 2015): every
/// summand is split into multiples of 2^(21 J), 2^(21 (J - 1)), ... 2^(21 (J - 3)), its folds, each of which adds up
/// without rounding. J, the level, is the lowest at which the largest summand |x| is below 2^(21 (J + 1) - 1). So the
/// sum is that of the summands rounded to multiples of 2^(21 (J - 3)), correctly rounded: its error is below
///   2^-63 n max|x| + half a unit in the last place,
/// for n summands (at most 2^32) of which one is at least 2^-925; smaller ones are rounded to multiples of 2^-987.
/// Summands that are not finite are summed separately and make the sum infinite or NaN by IEEE 754. Summands of 2^986
/// or more count as infinite. An empty sum is +0. Test: tests/exec/reproducible_sum_test.cpp.
template <int N>
class ReproducibleSums {
 public:
  ReproducibleSums() {
    for (int c = 0; c < N; ++c) set_level(c, lowest);
  }

  /// Adds x[c] to sum c.
  void add(double const* x) {
    int outside = 0;
    for (int c = 0; c < N; ++c) outside += std::fabs(x[c]) < limit_[c] ? 0 : 1;
    if (outside == 0) return deposit(x);
    double made_to_fit[N];
    for (int c = 0; c < N; ++c) made_to_fit[c] = fit(c, x[c]);
    deposit(made_to_fit);
  }
  void add(ReproducibleSums const& other) {
    for (int c = 0; c < N; ++c) {
      special_[c] += other.special_[c];
      if (other.level_[c] > level_[c]) raise(c, other.level_[c]);
      int const shift = level_[c] - other.level_[c];
      for (int k = shift; k < folds; ++k) fold_[k][c] += other.fold_[k - shift][c];
    }
  }

  double value(int c = 0) const {
    if (!(std::fabs(special_[c]) <= 0)) return special_[c];
    // The distribution of the sum over folds may depend on the order; the sum of the folds does not.
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
  /// Drops the folds that become too fine; the others are what they would be if this had been the level from the start.
  void raise(int c, int level) {
    int const shift = level - level_[c];
    for (int k = folds - 1; k >= 0; --k) fold_[k][c] = k >= shift ? fold_[k - shift][c] : 0;
    set_level(c, level);
  }
  /// Raises the level as |x| requires and returns x. Returns 0 for infinite, NaN or too large x, which go to special_.
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
  double magnet_[N]{};   ///< rounds a summand to multiples of the level when added and subtracted
  double limit_[N]{};    ///< upper bound of |x| at the present level
  double special_[N]{};  ///< sum of the summands that are not finite
  int level_[N]{};
};

/// One reproducible sum; see ReproducibleSums.
class ReproducibleSum {
 public:
  ReproducibleSum& operator+=(double x) {
    sum_.add(&x);
    return *this;
  }
  ReproducibleSum& operator+=(ReproducibleSum const& other) {
    sum_.add(other.sum_);
    return *this;
  }
  double value() const { return sum_.value(); }

 private:
  ReproducibleSums<1> sum_;
};

}  // namespace exec
}  // namespace piola::inline PIOLA_BACKEND
