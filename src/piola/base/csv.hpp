// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Parts of readers of CSV files: lines, fields, titles such as "time [ms]", numbers, and lists of problems.

/// The lines of a text, without their ends, that hold something else than blanks and comments.
class CsvLines {
 public:
  explicit CsvLines(std::string_view text) : rest_(text) {}
  /// Steps to the next such line; false at the end.
  bool next();
  std::string_view line() const { return line_; }
  std::int64_t number() const { return number_; }  ///< from 1

 private:
  std::string_view rest_, line_;
  std::int64_t number_ = 0;
};

/// One field of a line.
struct CsvField {
  std::string_view text;   ///< without blanks around it and without its quotation marks
  std::size_t column = 1;  ///< of its first character in the line
};

/// Divides a line into its fields. Returns the column of a quotation mark that is not closed, or 0.
std::size_t cut_csv_line(std::string_view line, char separator, std::vector<CsvField>& fields);

/// A title such as "volume [mm^3]".
struct CsvTitle {
  std::string_view name;
  std::string_view unit;  ///< empty: none is given
  bool broken = false;    ///< a bracket without the other
};
CsvTitle title_of_field(std::string_view text);

struct CsvNumber {
  double value = 0;
  std::string problem;  ///< empty: none
};
/// Reads a number with a decimal point. "nan" and "inf" are read as such.
CsvNumber read_csv_number(std::string_view text);

/// The text without the mark of UTF-8 at its start.
std::string_view without_byte_order_mark(std::string_view text);

/// The reason why a text is no table, whatever its lines hold: UTF-16, NUL bytes. Empty: none. `other`: advice about
/// files that are no text.
std::string refuse_csv_text(std::string_view text, std::string_view other);

/// Adds problems of single places: the first few in words, then how many more there are.
class CsvProblems {
 public:
  CsvProblems(std::string file, std::vector<std::string>& list) : file_(std::move(file)), list_(list) {}
  CsvProblems(CsvProblems const&) = delete;
  CsvProblems& operator=(CsvProblems const&) = delete;
  ~CsvProblems();
  void add(std::string text);

 private:
  std::string file_;
  std::vector<std::string>& list_;
  std::int64_t count_ = 0;
};

}  // namespace piola
