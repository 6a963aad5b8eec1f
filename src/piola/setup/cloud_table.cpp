// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_table.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/csv.hpp"
#include "piola/base/text.hpp"
#include "piola/setup/cloud_header.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace piola {
namespace {

/// Takes the rows of a table, one after the other.
class CloudRows {
 public:
  CloudRows(CloudHeader const& header, CloudTable& table, CsvProblems& problems)
      : header_(header), table_(table), problems_(problems) {}

  void take(std::string_view line, std::int64_t number) {
    if (std::size_t const mark = cut_csv_line(line, header_.separator, fields_); mark > 0)
      return add(number, mark, "the quotation mark is not closed - close it");
    if (fields_.size() != header_.columns.size()) return refuse_count(number);
    std::array<double, 6> values{};
    std::string_view body;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      CloudColumn const column = header_.columns[k];
      if (column == CloudColumn::body) body = fields_[k].text;
      if (column >= CloudColumn::body) continue;
      CsvNumber const found = read_csv_number(fields_[k].text);
      if (!found.problem.empty()) return add(number, fields_[k].column, found.problem);
      values[static_cast<std::size_t>(column)] = found.value * header_.factor[k];
    }
    store(values, body, number);
  }

 private:
  bool has(CloudColumn column) const { return header_.has[static_cast<std::size_t>(column)]; }

  void add(std::int64_t number, std::size_t column, std::string const& text) {
    problems_.add(fmt::format("{}:{}:{}: {}", table_.source.file, number, column, text));
  }

  void refuse_count(std::int64_t number) {
    bool const more = fields_.size() > header_.columns.size();
    bool const commas = more && header_.separator == ',';
    problems_.add(fmt::format("{}:{}: has {} fields (expected {}: {}) - {}", table_.source.file, number, fields_.size(),
                              header_.columns.size(), in_quotes(header_.names),
                              commas ? "remove the rest; numbers have a decimal point, no comma"
                              : more ? "remove the rest"
                                     : "add what is missing, or remove the row"));
  }

  void store(std::array<double, 6> const& values, std::string_view body, std::int64_t number) {
    table_.X.push_back({values[0], values[1], values[2]});
    if (has(CloudColumn::volume)) table_.volume.push_back(values[3]);
    if (has(CloudColumn::kernel_volume)) table_.kernel_volume.push_back(values[4]);
    if (has(CloudColumn::body)) table_.body.push_back(index_of(body));
    table_.source.row.push_back(number);
  }

  int index_of(std::string_view body) {
    auto const found = known_.find(body);
    if (found != known_.end()) return found->second;
    auto const index = static_cast<int>(table_.bodies.size());
    table_.bodies.emplace_back(body);
    known_.emplace(body, index);
    return index;
  }

  CloudHeader const& header_;
  CloudTable& table_;
  CsvProblems& problems_;
  std::vector<CsvField> fields_;
  std::map<std::string, int, std::less<>> known_;
};

}  // namespace

std::string CloudSource::place(std::size_t point) const {
  PIOLA_EXPECTS(point < row.size());
  return lines ? fmt::format("{}:{}", file, row[point]) : fmt::format("{}, particle {}", file, row[point]);
}

std::string CloudSource::name(std::size_t point) const {
  PIOLA_EXPECTS(point < row.size());
  return fmt::format("{} {}", lines ? "line" : "particle", row[point]);
}

CloudTable read_cloud_table(std::string_view text, std::string const& name, double length_unit,
                            std::vector<std::string>& problems) {
  CloudTable table;
  table.source.file = name;
  text = without_byte_order_mark(text);
  if (std::string const wrong = refuse_csv_text(text, "give a CSV file, or a frame whose name ends in .hdf");
      !wrong.empty()) {
    problems.push_back(name + ": " + wrong);
    return table;
  }
  CsvLines lines(text);
  if (!lines.next()) {
    problems.push_back(name +
                       ": is empty (expected a header such as \"x [mm],y [mm],z [mm]\" and a row for each "
                       "point) - give another file");
    return table;
  }
  CloudHeader const header =
      read_cloud_header(lines.line(), fmt::format("{}:{}", name, lines.number()), length_unit, problems);
  table.dimension = header.dimension;
  if (header.dimension == 0) return table;
  if (!header.not_used.empty())
    table.notes.push_back(fmt::format("{}: columns that are not used: {}", name, in_quotes(joined(header.not_used))));
  CsvProblems of_rows(name, problems);
  CloudRows rows(header, table, of_rows);
  while (lines.next()) rows.take(lines.line(), lines.number());
  return table;
}

}  // namespace piola
