// SPDX-License-Identifier: Apache-2.0
#include "piola/study/convergence_table.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

using Kind = Convergence::Kind;

constexpr std::array<std::string_view, 7> kind_words{"monotonic",   "two values", "unchanged", "slow",
                                                     "oscillating", "diverging",  "missing"};

/// An error relative to its value: "1.3 %", or absolute if the value is 0.
std::string error_text(double error, double size) {
  double const percent = 100 * error / size;
  if (size > 0) return percent < 10 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
  return number_text(error, 2);
}

std::string sentence(std::string const& name, Convergence const& c) {
  double const size = c.values.empty() ? 0 : std::abs(c.values.back());
  std::string const spread = size > 0 ? error_text(c.spread, size) + " of the last value" : number_text(c.spread, 2);
  switch (c.kind) {
    case Kind::slow:
      return fmt::format(
          "{}: converges slowly, with the order {:.2f}: the error is larger than the last change, and is "
          "not known - use finer spacings",
          name, *c.order);
    case Kind::oscillating:
      return fmt::format(
          "{}: does not converge monotonically, so that no order is known; the values differ by {}, and "
          "three times that is taken for the error",
          name, spread);
    case Kind::diverging:
      return fmt::format(
          "{}: does not converge, its changes do not become smaller; the values differ by {} - use finer "
          "spacings, or look for what has no limit (a singular stress, a point that moves)",
          name, spread);
    case Kind::missing:
      return fmt::format("{}: a run has no value of it - see study.csv and the text of the run", name);
    default: return "";
  }
}

std::string padded(std::vector<std::vector<std::string>> const& lines) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (auto const& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  std::string text;
  for (auto const& line : lines) {
    std::string out;
    for (std::size_t k = 0; k < line.size(); ++k) out += fmt::format("{:<{}}  ", line[k], widths[k]);
    text += out.substr(0, out.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace

ConvergenceTable::ConvergenceTable(std::vector<QuantitySpec> const& quantities, std::vector<double> spacings,
                                   std::vector<RunOutcome> const& outcomes)
    : spacings_(std::move(spacings)) {
  PIOLA_EXPECTS(outcomes.size() == spacings_.size());
  for (QuantitySpec const& quantity : quantities) {
    Row row{quantity.name, quantity.unit, {}};
    std::vector<double> values;
    for (RunOutcome const& outcome : outcomes)
      for (MeasuredQuantity const& measured : outcome.quantities)
        if (measured.name == quantity.name && outcome.status == "completed") values.push_back(measured.value);
    row.convergence = convergence_of(spacings_, values);
    rows_.push_back(std::move(row));
  }
}

bool ConvergenceTable::has_errors() const {
  return std::all_of(rows_.begin(), rows_.end(), [](Row const& row) { return row.convergence.has_errors(); });
}

std::string ConvergenceTable::text() const {
  std::vector<std::string> head{"quantity"};
  for (double const spacing : spacings_) head.push_back(quantity_text(spacing, "m"));
  head.insert(head.end(), {"unit", "order", "spacing 0"});
  for (double const spacing : spacings_) head.push_back("error at " + quantity_text(spacing, "m"));
  std::vector<std::vector<std::string>> lines{head};
  std::string sentences;
  for (Row const& row : rows_) {
    Convergence const& c = row.convergence;
    std::vector<std::string> line{row.name};
    for (std::size_t k = 0; k < spacings_.size(); ++k)
      line.push_back(c.values.empty() ? "-" : number_text(c.values[k], 5));
    line.push_back(row.unit);
    line.push_back(c.order ? fmt::format("{:.2f}", *c.order) : "-");
    line.push_back(c.extrapolated ? number_text(*c.extrapolated, 5) : "-");
    double const size = c.extrapolated ? std::abs(*c.extrapolated) : c.values.empty() ? 0 : std::abs(c.values.back());
    for (std::size_t k = 0; k < spacings_.size(); ++k)
      line.push_back(c.errors.empty() ? "?" : error_text(c.errors[k], size));
    lines.push_back(std::move(line));
    if (std::string const words = sentence(row.name, c); !words.empty()) sentences += words + "\n";
  }
  return padded(lines) + sentences;
}

std::string ConvergenceTable::csv() const {
  std::string text = "quantity,unit";
  for (double const spacing : spacings_) text += ",at " + exact_text(spacing) + " m";
  text += ",kind,order,extrapolated";
  for (double const spacing : spacings_) text += ",error at " + exact_text(spacing) + " m";
  text += "\n";
  for (Row const& row : rows_) {
    Convergence const& c = row.convergence;
    text += row.name + "," + row.unit;
    for (std::size_t k = 0; k < spacings_.size(); ++k) text += "," + (c.values.empty() ? "" : exact_text(c.values[k]));
    text += "," + std::string(kind_words[static_cast<std::size_t>(c.kind)]);
    text += "," + (c.order ? exact_text(*c.order) : "") + "," + (c.extrapolated ? exact_text(*c.extrapolated) : "");
    for (std::size_t k = 0; k < spacings_.size(); ++k) text += "," + (c.errors.empty() ? "" : exact_text(c.errors[k]));
    text += "\n";
  }
  return text;
}

}  // namespace piola
