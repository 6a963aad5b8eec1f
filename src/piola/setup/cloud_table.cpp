// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_table.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/setup/cloud_header.hpp"
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace piola {
namespace {

constexpr std::int64_t most_cloud_lines = 5;  // of problems of one kind; a file may have as many as rows

struct CloudNumber {
  double value = 0;
  std::string problem;  ///< empty: none
};

CloudNumber read_cloud_number(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  CloudNumber number;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number.value);
  if (error == std::errc::result_out_of_range) {
    number.problem =
        in_quotes(text) + " cannot be held as a number (at most 1.8e308, at least 5e-324) - correct or remove the row";
  } else if (error != std::errc() || end != digits.data() + digits.size()) {
    number.problem = in_quotes(text) + " is not a number (expected one such as 0.0015) - correct or remove the row";
  }
  return number;
}

/// The lines of a text, without their ends, that hold something else than blanks and comments.
class CloudLines {
 public:
  explicit CloudLines(std::string_view text) : rest_(text) {}
  /// Steps to the next such line; false at the end.
  bool next() {
    while (!rest_.empty()) {
      std::size_t const end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      std::size_t const first = line_.find_first_not_of(" \t");
      if (first != std::string_view::npos && line_[first] != '#') return true;
    }
    return false;
  }
  std::string_view line() const { return line_; }
  std::int64_t number() const { return number_; }

 private:
  std::string_view rest_, line_;
  std::int64_t number_ = 0;
};

/// Takes the rows of a table, one after the other.
class CloudRows {
 public:
  CloudRows(CloudHeader const& header, CloudTable& table, CloudProblems& problems)
      : header_(header), table_(table), problems_(problems) {}

  void take(std::string_view line, std::int64_t number) {
    if (std::size_t const mark = cut_cloud_line(line, header_.separator, fields_); mark > 0)
      return add(number, mark, "the quotation mark is not closed - close it");
    if (fields_.size() != header_.columns.size()) return refuse_count(number);
    std::array<double, 6> values{};
    std::string_view body;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      CloudColumn const column = header_.columns[k];
      if (column == CloudColumn::body) body = fields_[k].text;
      if (column >= CloudColumn::body) continue;
      CloudNumber const found = read_cloud_number(fields_[k].text);
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
  CloudProblems& problems_;
  std::vector<CloudField> fields_;
  std::map<std::string, int, std::less<>> known_;
};

/// Refuses texts that are no table, whatever their lines contain.
std::string refuse_text(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    return "is a text in UTF-16 (expected UTF-8) - save it as \"CSV UTF-8\"";
  if (text.find('\0') != std::string_view::npos)
    return "is no text (it holds a NUL byte) - give a CSV file, or a frame whose name ends in .hdf";
  return {};
}

}  // namespace

std::string CloudSource::place(std::size_t point) const {
  PIOLA_EXPECTS(point < row.size());
  return lines ? fmt::format("{}:{}", file, row[point]) : fmt::format("{}, particle {}", file, row[point]);
}

std::string CloudSource::name(std::size_t point) const {
  PIOLA_EXPECTS(point < row.size());
  return fmt::format("{} {}", lines ? "line" : "particle", row[point]);
}

void CloudProblems::add(std::string text) {
  if (++count_ <= most_cloud_lines) list_.push_back(std::move(text));
}

CloudProblems::~CloudProblems() {
  if (count_ > most_cloud_lines)
    list_.push_back(fmt::format("{}: {} more such problems", file_, count_text(count_ - most_cloud_lines)));
}

CloudTable read_cloud_table(std::string_view text, std::string const& name, double length_unit,
                            std::vector<std::string>& problems) {
  CloudTable table;
  table.source.file = name;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (std::string const wrong = refuse_text(text); !wrong.empty()) {
    problems.push_back(name + ": " + wrong);
    return table;
  }
  CloudLines lines(text);
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
  CloudProblems of_rows(name, problems);
  CloudRows rows(header, table, of_rows);
  while (lines.next()) rows.take(lines.line(), lines.number());
  return table;
}

}  // namespace piola
