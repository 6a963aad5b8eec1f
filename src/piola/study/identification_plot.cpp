// SPDX-License-Identifier: Apache-2.0
#include "piola/study/identification_plot.hpp"
#include "piola/base/csv.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include <array>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

constexpr std::size_t identified_columns = 5;  // curve, x, measured, start, fitted

/// The curves that start at a row with a new name: measured, start, fitted.
std::array<Curve, 3> curves_named(std::string_view name, int colour) {
  std::array<Curve, 3> curves;
  for (Curve& curve : curves) curve.colour = colour;
  curves[0].marks = true;
  curves[1].dash = 1;
  curves[2].label = name;
  return curves;
}

/// Empty and broken fields are gaps of a curve.
double value_or_gap(CsvField const& field) {
  CsvNumber const number = read_csv_number(field.text);
  return number.problem.empty() ? number.value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::filesystem::path identified_curves_at(std::filesystem::path const& folder) {
  std::error_code ignored;
  std::filesystem::path table = folder / "curves.csv";
  return std::filesystem::is_regular_file(table, ignored) ? table : std::filesystem::path();
}

Plot identification_plot(std::filesystem::path const& table, bool log_x, bool log_y) {
  std::string const text = read_text_file(table);
  CsvLines lines(text);
  std::vector<CsvField> fields;
  if (lines.next()) cut_csv_line(lines.line(), ',', fields);
  if (fields.size() != identified_columns || fields[0].text != "curve")
    throw InputError(
        fmt::format("{}: is no table of curves (curve, x, measured, start and fitted are needed) - give "
                    "the folder that 'piola identify' wrote to",
                    table.string()));
  Plot plot;
  plot.title = table.parent_path().filename().string();
  plot.note = "rings: measured, broken: start, whole: fitted";
  plot.x = {std::string(fields[1].text), "", log_x};
  plot.y = {std::string(fields[2].text), "", log_y};
  std::string name;
  int colour = 0;
  while (lines.next()) {
    cut_csv_line(lines.line(), ',', fields);
    if (fields.size() != identified_columns) continue;
    if (plot.curves.empty() || fields[0].text != name) {
      name = fields[0].text;
      for (Curve& curve : curves_named(name, colour++)) plot.curves.push_back(std::move(curve));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      Curve& curve = plot.curves[plot.curves.size() - 3 + k];
      curve.x.push_back(value_or_gap(fields[1]));
      curve.y.push_back(value_or_gap(fields[2 + k]));
    }
  }
  return plot;
}

}  // namespace piola
