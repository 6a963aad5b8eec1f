// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/ticks.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

std::string with_true_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return text;
}

/// A number with `decimals` decimals; in powers of ten if it is far from 1.
std::string tick_text(double value, int decimals, double largest) {
  if (largest >= 1e6 || largest < 1e-4) return with_true_minus(fmt::format("{:.3g}", value));
  std::string const text = fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals);
  return with_true_minus(text);
}

}  // namespace

std::vector<Tick> linear_ticks(double low, double high) {
  PIOLA_EXPECTS(low <= high);
  constexpr int about = 5;  // marks
  double const rough = (high - low) / about;
  double const power = std::pow(10, std::floor(std::log10(rough)));
  // The step with which the number of marks comes nearest to what is wanted.
  double step = power;
  for (double const digit : {2.0, 5.0, 10.0})
    if (std::abs(std::log(digit * power / rough)) < std::abs(std::log(step / rough))) step = digit * power;
  int const decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 15);
  double const largest = std::max(std::abs(low), std::abs(high));
  std::vector<Tick> ticks;
  double const first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  constexpr int most = 1000;  // where the range is round-off, counting on may change nothing
  for (int n = 0; n < most && first + n <= last; ++n) {
    double const value = (first + n) * step;
    ticks.push_back({value, tick_text(value, decimals, largest)});
  }
  return ticks;
}

std::vector<Tick> decade_ticks(double low, double high) {
  PIOLA_EXPECTS(low <= high);
  int const first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  int const last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  int const stride = std::max(1, (last - first + 8) / 9);
  std::vector<Tick> ticks;
  for (int k = first; k <= last; k += stride) ticks.push_back({std::pow(10, k), fmt::format("1e{}", k)});
  return ticks;
}

bool takes_prefix(std::string_view unit) {
  constexpr std::array<std::string_view, 9> units{"m", "s", "N", "J", "Pa", "m/s", "N m", "W", "Hz"};
  return std::find(units.begin(), units.end(), unit) != units.end();
}

Prefix prefix_for(double largest, std::string_view unit) {
  if (!takes_prefix(unit) || !(largest > 0)) return {"", 1};
  constexpr std::array prefixes{Prefix{"G", 1e9},  Prefix{"M", 1e6},       Prefix{"k", 1e3}, Prefix{"", 1},
                                Prefix{"m", 1e-3}, Prefix{"\u00b5", 1e-6}, Prefix{"n", 1e-9}};
  // Seconds and metres above a thousand get no prefix: ks and Mm are not in use.
  bool const small_only = unit == "s" || unit == "m" || unit == "m/s";
  for (Prefix const& prefix : prefixes)
    if (largest >= prefix.factor && !(small_only && prefix.factor > (unit == "s" ? 1 : 1e3))) return prefix;
  return prefixes.back();
}

}  // namespace piola
