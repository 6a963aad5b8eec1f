// SPDX-License-Identifier: Apache-2.0
#include "piola/study/convergence.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

constexpr double highest_order = 2;   // that of all formulations in smooth solutions
constexpr double lowest_order = 0.5;  // below it the limit is more than four changes away at a ratio of 1.5
constexpr double factor_three = 1.25, factor_two = 3;  // of Roache, for three and two grids
constexpr double factor_unordered = 3;                 // of Eca and Hoekstra
// Relative differences of this size are rounding in sums of thousands of terms and of the digits of files.
constexpr double round_off = 1e-10;

/// (h1^p - h2^p) / (h2^p - h3^p), which grows with p, and its limit ln(h1/h2) / ln(h2/h3) for p = 0.
double change_ratio(std::span<double const> h, double p) {
  double const a = h[0] / h[1], b = h[2] / h[1];
  if (p < 1e-9) return std::log(a) / -std::log(b);
  return (std::pow(a, p) - 1) / (1 - std::pow(b, p));
}

/// The order for which the changes have this ratio; nothing if it is not above 0.
std::optional<double> order_for(std::span<double const> h, double ratio) {
  double low = 0, high = 50;
  if (!(ratio > change_ratio(h, low))) return std::nullopt;
  for (int k = 0; k < 100; ++k) {
    double const middle = 0.5 * (low + high);
    (change_ratio(h, middle) < ratio ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The limit that the two finest values have with this order.
double limit_of(std::span<double const> h, std::vector<double> const& q, double order) {
  std::size_t const n = q.size();
  return q[n - 1] + (q[n - 1] - q[n - 2]) / (std::pow(h[n - 2] / h[n - 1], order) - 1);
}

void estimate_errors(Convergence& c, double limit, double factor) {
  for (double const value : c.values) c.errors.push_back(factor * std::abs(value - limit));
}

}  // namespace

Convergence convergence_of(std::span<double const> spacings, std::span<double const> values) {
  using Kind = Convergence::Kind;
  Convergence c;
  if (values.size() != spacings.size() || values.size() < 2) return c;
  c.values.assign(values.begin(), values.end());
  auto const [least, most] = std::minmax_element(c.values.begin(), c.values.end());
  c.spread = *most - *least;
  if (c.spread <= round_off * std::max(std::abs(*least), std::abs(*most))) {
    c.kind = Kind::unchanged;
    c.extrapolated = c.values.back();
    c.errors.assign(c.values.size(), 0);
    return c;
  }
  if (values.size() == 2) {
    c.kind = Kind::two_values;
    estimate_errors(c, limit_of(spacings, c.values, highest_order), factor_two);
    return c;
  }
  double const first = values[1] - values[0], second = values[2] - values[1];
  if (first * second <= 0) {
    c.kind = Kind::oscillating;
    c.errors.assign(c.values.size(), factor_unordered * c.spread);
    return c;
  }
  c.order = order_for(spacings, first / second);
  if (!c.order || *c.order < lowest_order) {
    c.kind = c.order ? Kind::slow : Kind::diverging;
    return c;
  }
  c.kind = Kind::monotonic;
  c.extrapolated = limit_of(spacings, c.values, std::min(*c.order, highest_order));
  estimate_errors(c, *c.extrapolated, factor_three);
  return c;
}

}  // namespace piola
