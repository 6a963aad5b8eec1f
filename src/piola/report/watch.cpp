// SPDX-License-Identifier: Apache-2.0
#include "piola/report/watch.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/output/history.hpp"
#include "piola/pictures/history_plot.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola::report {
namespace {

constexpr std::array<char const*, 8> blocks{"\u2581", "\u2582", "\u2583", "\u2584",
                                            "\u2585", "\u2586", "\u2587", "\u2588"};

/// A progress bar: "[#####.....]".
std::string progress_bar(double fraction, std::size_t width) {
  auto const full = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(width) + 0.5);
  return "[" + std::string(full, '#') + std::string(width - full, '.') + "]";
}

double largest_of(std::vector<double> const& values) {
  double most = 0;
  for (double const v : values) most = std::max(most, std::isfinite(v) ? std::abs(v) : 0);
  return most;
}

/// Time, step and all columns that are no energies, two in a line.
std::string row_text(HistoryTable const& table, std::size_t width) {
  std::vector<std::string> cells;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::string const& name = table.columns[c].name;
    std::string const unit = unit_of_column(name);
    if (unit == "J" || name == "time" || name == "step") continue;
    double const value = table.rows.back()[c];
    cells.push_back(
        fmt::format("{:<24} {}", column_words(name), std::isfinite(value) ? quantity_text(value, unit) : "-"));
  }
  std::size_t const across = std::max<std::size_t>(1, width / 40), lines = (cells.size() + across - 1) / across;
  std::string text;
  for (std::size_t line = 0; line < lines; ++line) {
    for (std::size_t k = line; k < cells.size(); k += lines)
      text += k + lines < cells.size() ? fmt::format("{:<40}", cells[k]) : cells[k];
    text += "\n";
  }
  return text;
}

std::string energies_text(HistoryTable const& table) {
  double const scale = largest_of(table.values("total_energy"));
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::string const& name = table.columns[c].name;
    double const value = table.rows.back()[c];
    bool const shown = unit_of_column(name) == "J" && name.find('.') == std::string::npos && std::isfinite(value);
    if (!shown || (value == 0 && name != "kinetic_energy")) continue;
    double const fraction = scale > 0 ? value / scale : 0;
    text += fmt::format("{:<26} {:>12}  {:>7.2f} %  {}\n", column_words(name), quantity_text(value, "J"),
                        100 * fraction, progress_bar(std::abs(fraction), 20));
  }
  return text;
}

std::string plot_lines(HistoryTable const& table, std::string const& column, std::size_t width) {
  auto const values = table.values(column);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (double const v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) return column_words(column) + " has no value yet\n";
  std::string const unit = unit_of_column(column), sign = sign_of_column(column);
  return fmt::format("{}{}{} from {} to {}\n{}\n", column_words(column), sign.empty() ? "" : ", ", sign,
                     quantity_text(low, unit), quantity_text(high, unit),
                     line_plot(table.values("time"), values, width));
}

}  // namespace

std::string line_plot(std::vector<double> const& x, std::vector<double> const& y, std::size_t width) {
  if (x.empty() || width == 0) return "";
  std::vector<double> last(width, std::numeric_limits<double>::quiet_NaN());
  double const from = x.front(), span = x.back() - from;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!std::isfinite(y[i]) || !std::isfinite(x[i])) continue;
    double const fraction = span > 0 ? (x[i] - from) / span : 0;
    last[static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(width - 1))] = y[i];
    low = std::min(low, y[i]);
    high = std::max(high, y[i]);
  }
  std::string line;
  double held = std::numeric_limits<double>::quiet_NaN();
  for (double const value : last) {
    if (std::isfinite(value)) held = value;  // a place between two rows shows the one before
    double const fraction = high > low ? (held - low) / (high - low) : 0;
    line += std::isfinite(held) ? blocks[static_cast<std::size_t>(fraction * (blocks.size() - 1) + 0.5)] : " ";
  }
  return line;
}

Watch::Look Watch::look(std::size_t width) {
  read_texts(run_);
  bool const over = run_.status != "running";
  HistoryTable const table = read_history(run_.path / "history.csv");
  if (table.columns.empty() || table.rows.empty())
    return {fmt::format("{}\n{}, history.csv has no row yet\n", run_.title, run_.status), over};
  if (auto const problem = missing_column(table, column_, run_.path); !problem.empty()) throw InputError(problem);
  double const time = table.values("time").back(), end = run_.spec ? run_.spec->run.end : 0;
  std::string text = fmt::format("{}\n{}, t = {}, step {}", run_.title, run_.status, quantity_text(time, "s"),
                                 number_text(table.values("step").back(), 12));
  if (end > 0)
    text += fmt::format(" {} {:.0f} % of {}", progress_bar(time / end, 20), 100 * time / end, quantity_text(end, "s"));
  text +=
      fmt::format("\n\n{}\n{}\n{}", energies_text(table), plot_lines(table, column_, width), row_text(table, width));
  if (!run_.failure.empty()) text += "\n" + run_.failure + "\n";
  return {text, over};
}

}  // namespace piola::report
