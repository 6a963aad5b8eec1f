// SPDX-License-Identifier: Apache-2.0
#include "piola/report/plot_references.hpp"
#include "piola/base/units.hpp"
#include "piola/simulation/history_plot.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace piola::report {
namespace {

using Take = QuantitySpec::Take;

bool is_value(Take take) {
  return take == Take::maximum || take == Take::minimum || take == Take::final_value || take == Take::initial_value ||
         take == Take::first_peak || take == Take::at_time || take == Take::mean;
}

/// Lowest and highest finite value of all curves.
std::array<double, 2> ends_of(Plot const& plot, std::vector<double> Curve::*values) {
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

}  // namespace

int add_references(Plot& plot, RunFolder const& run, std::vector<VerificationRow> const& rows,
                   std::vector<std::string> const& columns) {
  constexpr int black = 4, dotted = 2;
  auto const x = ends_of(plot, &Curve::x), y = ends_of(plot, &Curve::y);
  int added = 0;
  for (VerificationRow const& row : rows) {
    if (!run.spec) break;
    if (!row.tolerance.starts_with("within")) continue;  // a bound is no value that is expected
    auto const& quantities = run.spec->quantities;
    auto const quantity = std::find_if(quantities.begin(), quantities.end(),
                                       [&](QuantitySpec const& q) { return q.name == row.quantity; });
    if (quantity == quantities.end()) continue;
    bool const drawn = std::find(columns.begin(), columns.end(), quantity->column) != columns.end();
    bool const across = is_value(quantity->take), upright = takes_instant(quantity->take);
    if (!drawn || !(across || upright)) continue;
    auto const at = in_si(row, across ? unit_of_column(quantity->column) : "s");
    if (!at || !std::isfinite(*at)) continue;
    Curve line{.label = row.evidence, .x = {x[0], x[1]}, .y = {*at, *at}, .colour = black, .dash = dotted};
    if (upright) {
      line.x = {*at, *at};
      line.y = {y[0], y[1]};
    }
    plot.curves.push_back(std::move(line));
    ++added;
  }
  return added;
}

}  // namespace piola::report
