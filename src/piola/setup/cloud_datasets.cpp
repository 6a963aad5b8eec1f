// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_datasets.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/output/foreign_hdf5.hpp"
#include "piola/setup/cloud_header.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace piola {
namespace {

/// "x [mm],y [mm],volume [mm^3]": the header that a table of these lists would have.
std::string header_of(std::vector<DataColumn> const& columns) {
  std::string header;
  for (DataColumn const& column : columns) {
    header += (header.empty() ? "" : ",") + column.name;
    if (!column.unit.empty()) header += " [" + column.unit + "]";
  }
  return header;
}

/// A name or unit with these characters would be misread in a header.
bool fits_header(std::string_view text) { return text.find_first_of(",;\"[]#\n") == std::string_view::npos; }

/// Drops columns whose name or unit is not allowed in a header; their data are not used.
void drop_odd_names(DataColumns& found) {
  auto const odd = [&](DataColumn const& column) {
    bool const fits = fits_header(column.name) && fits_header(column.unit);
    if (!fits) found.others.push_back(column.name);
    return !fits;
  };
  found.columns.erase(std::remove_if(found.columns.begin(), found.columns.end(), odd), found.columns.end());
}

bool has_places(std::vector<DataColumn> const& columns) {
  return std::any_of(columns.begin(), columns.end(), [](auto const& c) { return c.name == "x" || c.name == "X"; });
}

/// Lists of the points must be of one length.
bool lengths_agree(std::string const& path, CloudHeader const& header, std::vector<DataColumn> const& columns,
                   std::vector<std::string>& problems) {
  std::size_t const before = problems.size();
  DataColumn const* first = nullptr;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (header.columns[k] == CloudColumn::unused) continue;
    if (first == nullptr) first = &columns[k];
    if (columns[k].values.size() != first->values.size())
      problems.push_back(fmt::format("{}: {} has {} values and {} has {} - give each point one of each", path,
                                     in_quotes(columns[k].name), count_text(std::int64_t(columns[k].values.size())),
                                     in_quotes(first->name), count_text(std::int64_t(first->values.size()))));
  }
  return problems.size() == before;
}

/// Bodies that are called by whole numbers.
void take_bodies(DataColumn const& column, CloudTable& table, std::vector<std::string>& problems) {
  std::vector<double> kinds = column.values;
  std::sort(kinds.begin(), kinds.end());
  kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
  constexpr double largest = 1e15;
  bool const whole = std::all_of(kinds.begin(), kinds.end(),
                                 [](double v) { return v >= -largest && v <= largest && v == std::floor(v); });
  if (!whole) {
    problems.push_back(table.source.file + ": \"body\" holds values that are no whole numbers - number the bodies");
    return;
  }
  for (double const kind : kinds) table.bodies.push_back(fmt::format("{:.0f}", kind));
  for (double const value : column.values)
    table.body.push_back(static_cast<int>(std::lower_bound(kinds.begin(), kinds.end(), value) - kinds.begin()));
}

/// The lists of a header that can be used.
void take_lists(CloudHeader const& header, std::vector<DataColumn> const& columns, CloudTable& table,
                std::vector<std::string>& problems) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    CloudColumn const meaning = header.columns[k];
    std::vector<double> values = columns[k].values;
    for (double& value : values) value *= header.factor[k];
    if (meaning <= CloudColumn::z) {
      table.X.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) table.X[i][static_cast<std::size_t>(meaning)] = values[i];
    } else if (meaning == CloudColumn::volume) {
      table.volume = std::move(values);
    } else if (meaning == CloudColumn::kernel_volume) {
      table.kernel_volume = std::move(values);
    } else if (meaning == CloudColumn::body) {
      take_bodies(columns[k], table, problems);
    }
  }
}

void note_unused(CloudHeader const& header, DataColumns const& found, CloudTable& table) {
  std::vector<std::string> names = found.others;
  for (std::string_view const name : header.not_used) names.emplace_back(name);
  if (!names.empty())
    table.notes.push_back(
        fmt::format("{}: data sets that are not used: {}", table.source.file, in_quotes(joined(names))));
}

}  // namespace

CloudTable read_cloud_datasets(std::string const& path, std::string const& group, double length_unit,
                               std::vector<std::string>& problems) {
  CloudTable table;
  table.source = {path, false, {}};
  DataColumns found;
  try {
    found = read_data_columns(path, group.empty() ? "/" : group);
  } catch (FileError const& error) {
    problems.emplace_back(error.what());
    return table;
  }
  drop_odd_names(found);
  if (!has_places(found.columns)) {
    std::vector<std::string> names = found.others;
    for (DataColumn const& column : found.columns) names.push_back(column.name);
    problems.push_back(fmt::format(
        "{}: has no places{} (it has {}; expected a data set \"points\" of two or three columns, or lists \"x\", "
        "\"y\", \"z\") - name them so, or give the group that holds them",
        path, group.empty() ? "" : " in the group " + in_quotes(group), in_quotes(joined(names))));
    return table;
  }
  std::string const text = header_of(found.columns);
  CloudHeader const header = read_cloud_header(text, path + ": data sets", length_unit, problems);
  if (header.dimension == 0 || !lengths_agree(path, header, found.columns, problems)) return table;
  table.dimension = header.dimension;
  take_lists(header, found.columns, table, problems);
  note_unused(header, found, table);
  table.source.row.resize(table.X.size());
  std::iota(table.source.row.begin(), table.source.row.end(), std::int64_t{0});
  return table;
}

}  // namespace piola
