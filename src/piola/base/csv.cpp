// SPDX-License-Identifier: Apache-2.0
#include "piola/base/csv.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr std::int64_t most_csv_lines = 5;  // of problems of one kind; a file may have as many as rows

/// The end of a text in quotation marks that starts at `from`: the mark that is not followed by another one.
std::size_t closing_mark(std::string_view line, std::size_t from) {
  std::size_t at = line.find('"', from + 1);
  while (at != std::string_view::npos && at + 1 < line.size() && line[at + 1] == '"') at = line.find('"', at + 2);
  return at;
}

}  // namespace

bool CsvLines::next() {
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

std::size_t cut_csv_line(std::string_view line, char separator, std::vector<CsvField>& fields) {
  PIOLA_EXPECTS(separator != '"');
  fields.clear();
  for (std::size_t at = 0; at <= line.size();) {
    std::size_t const start = std::min(line.find_first_not_of(" \t", at), line.size());
    std::size_t from = at;
    if (start < line.size() && line[start] == '"') {
      from = closing_mark(line, start);
      if (from == std::string_view::npos) return start + 1;
    }
    std::size_t const end = std::min(line.find(separator, from), line.size());
    std::string_view text = without_blanks(line.substr(at, end - at));
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    fields.push_back({text, std::min(start, end) + 1});
    at = end + 1;
  }
  return 0;
}

CsvTitle title_of_field(std::string_view text) {
  std::size_t const open = text.find('[');
  if (open == std::string_view::npos) return {text, {}, text.find(']') != std::string_view::npos};
  bool const closed = text.ends_with(']');
  std::string_view const unit = without_blanks(text.substr(open + 1, text.size() - open - (closed ? 2 : 1)));
  return {without_blanks(text.substr(0, open)), unit, !closed || unit.empty()};
}

CsvNumber read_csv_number(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  CsvNumber number;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number.value);
  if (error == std::errc::result_out_of_range) {
    number.problem =
        in_quotes(text) + " cannot be held as a number (at most 1.8e308, at least 5e-324) - correct or remove the row";
  } else if (error != std::errc() || end != digits.data() + digits.size()) {
    number.problem = in_quotes(text) + " is not a number (expected one such as 0.0015) - correct or remove the row";
  }
  return number;
}

std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

std::string refuse_csv_text(std::string_view text, std::string_view other) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    return "is a text in UTF-16 (expected UTF-8) - save it as \"CSV UTF-8\"";
  if (text.find('\0') != std::string_view::npos) return "is no text (it holds a NUL byte) - " + std::string(other);
  return {};
}

void CsvProblems::add(std::string text) {
  if (++count_ <= most_csv_lines) list_.push_back(std::move(text));
}

CsvProblems::~CsvProblems() {
  if (count_ > most_csv_lines)
    list_.push_back(fmt::format("{}: {} more such problems", file_, count_text(count_ - most_csv_lines)));
}

}  // namespace piola
