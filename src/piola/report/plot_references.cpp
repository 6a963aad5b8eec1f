// SPDX-License-Identifier: Apache-2.0
#include "piola/report/plot_references.hpp"
#include "piola/base/units.hpp"
#include "piola/pictures/history_plot.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace piola::report {
namespace {

using Statistic = QuantitySpec::Statistic;

constexpr int black = 4, dotted = 2;

bool is_value(Statistic take) {
  return take == Statistic::maximum || take == Statistic::minimum || take == Statistic::final_value ||
         take == Statistic::initial_value || take == Statistic::first_peak || take == Statistic::at_time ||
         take == Statistic::mean;
}

std::array<double, 2> ends_of_values(Plot const& plot, std::vector<double> Curve::*values) {
  std::array<double, 2> ends{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (Curve const& curve : plot.curves)
    for (double const v : curve.*values)
      if (std::isfinite(v)) ends = {std::min(ends[0], v), std::max(ends[1], v)};
  return ends;
}

/// The reference of a row in SI; nothing if its unit is not that of the column.
std::optional<double> in_si(VerificationRow const& row, std::string const& unit) {
  if (row.unit.empty() || row.unit == "1") return row.reference;
  Quantity const one = read_quantity("1 " + row.unit, unit.empty() ? "1" : unit);
  if (one.problem) return {};
  return row.reference * one.value;
}

/// The formula that a column is compared with, over the times at which it is.
Curve formula_curve(QuantitySpec const& quantity, PlotEnds const& ends) {
  constexpr int steps = 400;
  double const from = std::max(ends.x[0], quantity.from), until = std::min(ends.x[1], quantity.until);
  Curve curve;
  for (int k = 0; k <= steps && from < until; ++k) {
    curve.x.push_back(from + (until - from) * k / steps);
    curve.y.push_back((*quantity.reference)({}, curve.x.back()));
  }
  return curve;
}

/// Without points if the row expects nothing that can be drawn.
Curve reference_curve(QuantitySpec const& quantity, VerificationRow const& row, PlotEnds const& ends) {
  if (quantity.reference) return formula_curve(quantity, ends);
  if (!row.tolerance.starts_with("within")) return {};  // a bound is no value that is expected
  bool const across = is_value(quantity.take);
  if (!across && !needs_time(quantity.take)) return {};
  auto const at = in_si(row, across ? unit_of_column(quantity.column) : "s");
  if (!at || !std::isfinite(*at)) return {};
  if (quantity.take == Statistic::at_time) return {.label = {}, .x = {quantity.time}, .y = {*at}, .marks = true};
  if (across)
    return {
        .label = {}, .x = {std::max(ends.x[0], quantity.from), std::min(ends.x[1], quantity.until)}, .y = {*at, *at}};
  return {.label = {}, .x = {*at, *at}, .y = {ends.y[0], ends.y[1]}};
}

}  // namespace

PlotEnds ends_of(Plot const& plot) { return {ends_of_values(plot, &Curve::x), ends_of_values(plot, &Curve::y)}; }

std::vector<Curve> reference_curves(RunFolder const& run, std::vector<VerificationRow> const& rows,
                                    std::vector<std::string> const& columns, PlotEnds const& ends) {
  std::vector<Curve> curves;
  if (!run.spec) return curves;
  auto const& quantities = run.spec->quantities;
  for (VerificationRow const& row : rows) {
    auto const quantity = std::find_if(quantities.begin(), quantities.end(),
                                       [&](QuantitySpec const& q) { return q.name == row.quantity; });
    if (quantity == quantities.end()) continue;
    if (std::find(columns.begin(), columns.end(), quantity->column) == columns.end()) continue;
    Curve curve = reference_curve(*quantity, row, ends);
    curve.label = row.evidence;
    curve.colour = black;
    curve.dash = dotted;
    bool const known = std::any_of(curves.begin(), curves.end(), [&](Curve const& other) {
      return other.label == curve.label && other.x == curve.x && other.y == curve.y;
    });
    if (!curve.x.empty() && !known) curves.push_back(std::move(curve));
  }
  return curves;
}

int add_references(Plot& plot, RunFolder const& run, std::vector<VerificationRow> const& rows,
                   std::vector<std::string> const& columns) {
  auto const curves = reference_curves(run, rows, columns, ends_of(plot));
  plot.curves.insert(plot.curves.end(), curves.begin(), curves.end());
  return static_cast<int>(curves.size());
}

}  // namespace piola::report
