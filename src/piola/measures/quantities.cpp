// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/quantities.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/units.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace piola {
namespace {

using Statistic = QuantitySpec::Statistic;

/// The samples of one column, without the empty cells.
struct Series {
  std::vector<double> time, value;
};

Series series_of(HistoryTable const& history, std::string_view column) {
  Series out;
  auto const time = history.values("time");
  auto const value = history.values(column);
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (!std::isfinite(value[k])) continue;
    out.time.push_back(time[k]);
    out.value.push_back(value[k]);
  }
  return out;
}

/// Vertex of the parabola through (t[k], y[k]), k = 0, 1, 2; the middle sample if the three lie on a line.
Peak vertex(double const* t, double const* y) {
  double const left = (y[1] - y[0]) / (t[1] - t[0]), right = (y[2] - y[1]) / (t[2] - t[1]);
  double const curvature = (right - left) / (t[2] - t[0]);
  if (curvature == 0) return {t[1], y[1]};
  double const slope = left + curvature * (t[1] - t[0]);  // at t[1]
  double const shift = -slope / (2 * curvature);
  return {t[1] + shift, y[1] + slope * shift + curvature * shift * shift};
}

/// Time at which the column first passes the threshold upwards (sign = 1) or downwards (sign = -1), linear between
/// samples.
std::optional<double> first_crossing(Series const& s, double threshold, double sign) {
  for (std::size_t k = 0; k < s.value.size(); ++k) {
    double const above = sign * (s.value[k] - threshold);
    if (above < 0) continue;
    if (k == 0) return s.time[0];
    double const before = sign * (s.value[k - 1] - threshold);
    return s.time[k - 1] + (s.time[k] - s.time[k - 1]) * before / (before - above);
  }
  return std::nullopt;
}

std::optional<double> interpolate(Series const& s, double time) {
  if (time < s.time.front() || time > s.time.back() * (1 + 1e-12)) return std::nullopt;
  auto const after = std::lower_bound(s.time.begin(), s.time.end(), time);
  if (after == s.time.end()) return s.value.back();
  auto const k = static_cast<std::size_t>(after - s.time.begin());
  if (k == 0) return s.value[0];
  double const share = (time - s.time[k - 1]) / (s.time[k] - s.time[k - 1]);
  return s.value[k - 1] + share * (s.value[k] - s.value[k - 1]);
}

/// Whether a row lies between the times `from` and `until` of a quantity.
bool counts(QuantitySpec const& spec, double time) {
  constexpr double rounding = 1e-12;
  return time >= spec.from * (1 - rounding) && time <= spec.until * (1 + rounding);
}

/// The rows to evaluate. All of them for a change, which needs values at two times, between rows.
Series rows_of(QuantitySpec const& spec, Series all) {
  if (spec.take == Statistic::change) return all;
  Series part;
  for (std::size_t k = 0; k < all.time.size(); ++k) {
    if (!counts(spec, all.time[k])) continue;
    part.time.push_back(all.time[k]);
    part.value.push_back(all.value[k]);
  }
  return part;
}

/// How far the values are from a formula.
std::optional<double> compare(QuantitySpec const& spec, Series const& s) {
  Expression const reference = spec.reference.value_or(Expression());
  double sum = 0, squares = 0, whole = 0;
  for (std::size_t k = 0; k < s.value.size(); ++k) {
    double const r = reference({0, 0, 0}, s.time[k]), d = s.value[k] - r;
    sum += std::abs(d);
    squares += d * d;
    whole += r * r;
  }
  if (spec.take == Statistic::mean_absolute_difference) return sum / static_cast<double>(s.value.size());
  return squares == 0 ? 0 : std::sqrt(squares / whole);
}

/// The value at one time minus that at another; without an end, the last value.
std::optional<double> change(QuantitySpec const& spec, Series const& s) {
  auto const before = interpolate(s, spec.from);
  auto const after = std::isinf(spec.until) ? s.value.back() : interpolate(s, spec.until);
  if (!before || !after) return std::nullopt;
  return *after - *before;
}

/// Mean over time, linear between samples; of a single sample that one.
double mean_of(Series const& s) {
  if (s.time.size() == 1) return s.value.front();
  double sum = 0;
  for (std::size_t k = 1; k < s.value.size(); ++k)
    sum += (s.time[k] - s.time[k - 1]) * (s.value[k] + s.value[k - 1]) / 2;
  return sum / (s.time.back() - s.time.front());
}

/// Times at which the column passes a level, upwards or downwards, linear between samples.
std::vector<double> crossings(Series const& s, double level) {
  std::vector<double> times;
  double side = 0;  // where the last sample off the level was
  for (std::size_t k = 0; k < s.value.size(); ++k) {
    double const now = s.value[k] - level;
    if (now == 0) continue;
    if (side * now < 0) {
      double const before = s.value[k - 1] - level;
      times.push_back(s.time[k - 1] + (s.time[k] - s.time[k - 1]) * before / (before - now));
    }
    side = now > 0 ? 1 : -1;
  }
  return times;
}

/// Mean time from one crossing of the mean to the next but one, which goes the same way: right even where the mean of
/// the rows is not the middle of the oscillation. Nothing for less than three crossings.
std::optional<double> oscillation_period(Series const& s) {
  std::vector<double> const times = crossings(s, mean_of(s));
  if (times.size() < 3) return std::nullopt;
  double sum = 0;
  for (std::size_t k = 2; k < times.size(); ++k) sum += times[k] - times[k - 2];
  return sum / static_cast<double>(times.size() - 2);
}

/// SI unit of the number that is taken from a column.
std::string unit_of(Statistic take, std::string const& column_unit) {
  switch (take) {
    case Statistic::time_of_first_peak:
    case Statistic::time_of_maximum:
    case Statistic::time_of_minimum:
    case Statistic::first_time_above:
    case Statistic::first_time_below:
    case Statistic::oscillation_period: return "s";
    case Statistic::relative_error: return "1";
    default: return column_unit;
  }
}

std::optional<double> evaluate(QuantitySpec const& spec, Series const& s) {
  auto const high = std::max_element(s.value.begin(), s.value.end());
  auto const low = std::min_element(s.value.begin(), s.value.end());
  auto const time_of = [&](auto at) { return s.time[static_cast<std::size_t>(at - s.value.begin())]; };
  switch (spec.take) {
    case Statistic::maximum: return *high;
    case Statistic::minimum: return *low;
    case Statistic::initial_value: return s.value.front();
    case Statistic::final_value: return s.value.back();
    case Statistic::time_of_maximum: return time_of(high);
    case Statistic::time_of_minimum: return time_of(low);
    case Statistic::first_time_above: return first_crossing(s, spec.threshold, 1);
    case Statistic::first_time_below: return first_crossing(s, spec.threshold, -1);
    case Statistic::at_time: return interpolate(s, spec.time);
    case Statistic::mean_absolute_difference:
    case Statistic::relative_error: return compare(spec, s);
    case Statistic::oscillation_period: return oscillation_period(s);
    case Statistic::range: return *high - *low;
    case Statistic::change: return change(spec, s);
    case Statistic::mean: return mean_of(s);
    case Statistic::first_peak:
    case Statistic::time_of_first_peak: break;
  }
  auto const peak = first_peak(s.time, s.value);
  if (!peak) return std::nullopt;
  return spec.take == Statistic::first_peak ? peak->value : peak->time;
}

}  // namespace

std::optional<Peak> first_peak(std::vector<double> const& time, std::vector<double> const& y) {
  PIOLA_EXPECTS(time.size() == y.size());
  double largest = 0;
  for (double v : y) largest = std::max(largest, std::abs(v));
  for (std::size_t k = 1; k + 1 < y.size(); ++k) {
    double const here = std::abs(y[k]);
    bool const local = here >= std::abs(y[k - 1]) && here > std::abs(y[k + 1]);
    if (local && here > 0.5 * largest) return vertex(&time[k - 1], &y[k - 1]);
  }
  return std::nullopt;
}

std::optional<MeasuredQuantity> measure(QuantitySpec const& spec, HistoryTable const& history, std::string& why) {
  auto const column = history.find(spec.column);
  if (!column) {
    why = fmt::format("quantity '{}': history.csv has no column '{}'", spec.name, spec.column);
    return std::nullopt;
  }
  Series const s = rows_of(spec, series_of(history, spec.column));
  std::optional<double> const value = s.value.empty() ? std::nullopt : evaluate(spec, s);
  if (!value || !std::isfinite(*value)) {
    why = fmt::format("quantity '{}': the history of '{}' does not contain it (the run may be too short)", spec.name,
                      spec.column);
    return std::nullopt;
  }
  std::string const si = unit_of(spec.take, history.columns[*column].unit);
  // "1" also stands for "no unit given": the value is then shown in SI.
  if (spec.unit.empty() || spec.unit == "1" || spec.unit == si) return MeasuredQuantity{spec.name, *value, si};
  try {
    return MeasuredQuantity{spec.name, convert_from_si(*value, si, spec.unit), spec.unit};
  } catch (std::invalid_argument const&) {
    why = fmt::format("quantity '{}': '{}' is not a unit for {}; shown in SI", spec.name, spec.unit, si);
    return MeasuredQuantity{spec.name, *value, si};
  }
}

}  // namespace piola
