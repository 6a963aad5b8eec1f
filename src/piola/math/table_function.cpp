// SPDX-License-Identifier: Apache-2.0
#include "piola/math/table_function.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

bool same_sign(double a, double b) { return (a > 0 && b > 0) || (a < 0 && b < 0); }

/// Slope at the end of a table from its first two intervals: lengths h0, h1, secants d0, d1.
double end_slope(double h0, double h1, double d0, double d1) {
  double const slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!same_sign(slope, d0)) return 0;
  return !same_sign(d0, d1) && std::abs(slope) > 3 * std::abs(d0) ? 3 * d0 : slope;
}

}  // namespace

std::vector<double> monotone_slopes(std::vector<double> const& x, std::vector<double> const& y) {
  PIOLA_EXPECTS(x.size() >= 2 && x.size() == y.size());
  std::size_t const n = x.size();
  auto const h = [&](std::size_t k) { return x[k + 1] - x[k]; };
  auto const secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / h(k); };
  if (n == 2) return {secant(0), secant(0)};
  std::vector<double> slopes(n);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    double const before = secant(k - 1), after = secant(k);
    double const w1 = 2 * h(k) + h(k - 1), w2 = h(k) + 2 * h(k - 1);
    slopes[k] = same_sign(before, after) ? (w1 + w2) / (w1 / before + w2 / after) : 0;
  }
  slopes.front() = end_slope(h(0), h(1), secant(0), secant(1));
  slopes.back() = end_slope(h(n - 2), h(n - 3), secant(n - 2), secant(n - 3));
  return slopes;
}

TableFunction::TableFunction(std::vector<double> x, std::vector<double> y, Options options)
    : x_(std::move(x)), y_(std::move(y)), options_(options) {
  PIOLA_EXPECTS(x_.size() >= 2 && x_.size() == y_.size());
  PIOLA_EXPECTS(std::is_sorted(x_.begin(), x_.end(), std::less_equal<>()));
  if (options_.interpolation == Interpolation::smooth) slope_ = monotone_slopes(x_, y_);
}

double TableFunction::operator()(double x) const {
  if (x < x_.front()) return outside(y_.front(), options_.before);
  if (x > x_.back()) return outside(y_.back(), options_.after);
  return inside(x);
}

double TableFunction::outside(double end, Outside what) const {
  if (what == Outside::error) return std::numeric_limits<double>::quiet_NaN();
  return what == Outside::hold && options_.gives == Gives::value ? end : 0;
}

double TableFunction::inside(double x) const {
  auto const after = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
  std::size_t const k = std::min(after, x_.size() - 1) - 1;
  double const h = x_[k + 1] - x_[k], rise = y_[k + 1] - y_[k], s = (x - x_[k]) / h;
  bool const value = options_.gives == Gives::value;
  if (slope_.empty()) return !value ? rise / h : s == 1 ? y_[k + 1] : y_[k] + s * rise;
  double const a = slope_[k] * h, b = slope_[k + 1] * h;  // rises along the tangents
  double const c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
  if (!value) return (a + s * (2 * c2 + s * 3 * c3)) / h;
  return s == 1 ? y_[k + 1] : y_[k] + s * (a + s * (c2 + s * c3));
}

}  // namespace piola
