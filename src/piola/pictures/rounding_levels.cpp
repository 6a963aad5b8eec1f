// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/rounding_levels.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/pictures/history_plot.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

/// Round-off of 1e-16 in each of some thousand steps and sums.
constexpr double rounding = 1e-12;

/// The scales in the summary of a run.
std::map<std::string, double> scales_in(std::filesystem::path const& folder) {
  std::map<std::string, double> scales;
  std::error_code error;
  if (!std::filesystem::exists(folder / "summary.json", error)) return scales;
  auto const summary = nlohmann::json::parse(read_text_file(folder / "summary.json"), nullptr, false);
  if (!summary.is_object() || !summary.contains("scales") || !summary["scales"].is_object()) return scales;
  for (auto const& [unit, scale] : summary["scales"].items())
    if (scale.is_number()) scales[unit] = scale.get<double>();
  return scales;
}

/// "tip.velocity" of "tip.velocity_x"; empty: the name does not end in a component.
std::string stem_of(std::string const& column) {
  auto const end = column.rfind('_');
  if (end == std::string::npos) return "";
  std::string const word = column.substr(end + 1);
  for (int const components : {3, 6, 9}) {
    auto const words = component_words(components);
    if (std::find(words.begin(), words.end(), word) != words.end()) return column.substr(0, end);
  }
  constexpr std::array<std::string_view, 4> others{"1", "2", "3", "magnitude"};
  return std::find(others.begin(), others.end(), word) == others.end() ? "" : column.substr(0, end);
}

}  // namespace

RoundingLevels::RoundingLevels(HistoryTable const& table, std::filesystem::path const& folder)
    : table_(table), scale_(scales_in(folder)) {
  for (HistoryColumn const& column : table.columns)
    if (unit_of_column(column.name) == "J") scale_["J"] = std::max(scale_["J"], largest(column.name));
}

double RoundingLevels::largest(std::string const& column) const {
  double most = 0;
  for (double const v : table_.values(column))
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  return most;
}

double RoundingLevels::of(std::string const& column) const {
  auto const known = scale_.find(unit_of_column(column));
  double scale = known == scale_.end() ? 0 : known->second;
  std::string const stem = stem_of(column);
  for (HistoryColumn const& other : table_.columns)
    if (!stem.empty() && stem_of(other.name) == stem) scale = std::max(scale, largest(other.name));
  return rounding * scale;
}

bool RoundingLevels::is_rounding(std::string const& column) const {
  double const level = of(column);
  return level > 0 && largest(column) <= level;
}

}  // namespace piola
