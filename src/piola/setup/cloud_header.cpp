// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_header.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/csv.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr std::string_view cloud_example = "such as \"x [mm],y [mm],z [mm],volume [mm^3]\"";

CloudColumn meaning_of(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  constexpr std::array<std::string_view, 6> names{"x", "y", "z", "volume", "kernel_volume", "body"};
  return static_cast<CloudColumn>(std::find(names.begin(), names.end(), name) - names.begin());
}

bool is_cloud_length(CloudColumn column) { return column <= CloudColumn::z; }
bool is_cloud_volume(CloudColumn column) {
  return column == CloudColumn::volume || column == CloudColumn::kernel_volume;
}

/// Reads a header, title by title.
class CloudHeaderReader {
 public:
  CloudHeaderReader(std::string const& place, double length_unit, std::vector<std::string>& problems)
      : place_(place), length_unit_(length_unit), problems_(problems), before_(problems.size()) {}

  CloudHeader read(std::string_view text) {
    header_.separator = text.find(';') != std::string_view::npos ? ';' : ',';
    if (std::size_t const mark = cut_csv_line(text, header_.separator, fields_); mark > 0) {
      add(mark, "the quotation mark is not closed - close it");
      return header_;
    }
    for (CsvField const& field : fields_) titles_.push_back(title_of_field(field.text));
    if (begins_with_numbers()) return header_;
    for (std::size_t k = 0; k < fields_.size(); ++k) take(k);
    int const dimension = count_components();
    if (dimension > 0) take_units(dimension);
    if (problems_.size() == before_) header_.dimension = dimension;
    return header_;
  }

 private:
  void add(std::size_t column, std::string const& text) {
    problems_.push_back(fmt::format("{}:{}: {}", place_, column, text));
  }

  bool begins_with_numbers() {
    std::string_view const first = fields_.front().text;
    bool const number = !first.empty() && std::string_view("+-.0123456789").find(first[0]) != std::string_view::npos;
    if (number) {
      problems_.push_back(
          fmt::format("{}: {} stands where the header should be (expected a line {}) - write the names "
                      "of the columns above the numbers, without #",
                      place_, in_quotes(first), cloud_example));
    }
    return number;
  }

  void take(std::size_t k) {
    CloudColumn const column = meaning_of(std::string(titles_[k].name));
    bool& there = header_.has[static_cast<std::size_t>(column)];
    if (column == CloudColumn::unused) header_.not_used.push_back(titles_[k].name);
    if (there && column != CloudColumn::unused)
      add(fields_[k].column, fmt::format("the column {} stands twice - remove one", in_quotes(titles_[k].name)));
    if (titles_[k].broken && column != CloudColumn::unused)
      add(fields_[k].column, fmt::format("the unit in {} cannot be read (expected one in brackets, such as \"x [mm]\") "
                                         "- write it so, or leave it out",
                                         in_quotes(fields_[k].text)));
    there = true;
    header_.columns.push_back(column);
    header_.names += (header_.names.empty() ? "" : ", ") + std::string(titles_[k].name);
  }

  /// 0 if components are missing.
  int count_components() {
    bool const x = header_.has[0], y = header_.has[1], z = header_.has[2];
    if (x && (y || !z)) return z ? 3 : y ? 2 : 1;
    problems_.push_back(
        fmt::format("{}: has no column \"{}\" (columns: {}; expected a line {}, in 2D without z) - name "
                    "the columns so",
                    place_, x ? "y" : "x", in_quotes(header_.names), cloud_example));
    return 0;
  }

  void take_units(int dimension) {
    std::size_t with = 0, without = 0;
    CsvTitle bare;
    for (std::size_t k = 0; k < titles_.size(); ++k) {
      CloudColumn const column = header_.columns[k];
      bool const measured = is_cloud_length(column) || is_cloud_volume(column);
      header_.factor.push_back(measured ? factor_of(k, is_cloud_length(column) ? 1 : dimension) : 1);
      if (measured && titles_[k].unit.empty()) bare = titles_[k];
      with += measured && !titles_[k].unit.empty() ? 1 : 0;
      without += measured && titles_[k].unit.empty() ? 1 : 0;
    }
    if (problems_.size() > before_) return;
    if (with > 0 && without > 0)
      problems_.push_back(
          fmt::format("{}: the column {} has no unit, others have one - give every length and volume a "
                      "unit, or none",
                      place_, in_quotes(bare.name)));
    if (with > 0 && length_unit_ != 1)
      problems_.push_back(
          fmt::format("{}: gives units, and the case gives one for this file - leave out one of them", place_));
  }

  double factor_of(std::size_t k, int power) {
    double own = 1;
    for (int p = 0; p < power; ++p) own *= length_unit_;
    if (titles_[k].unit.empty() || titles_[k].broken) return own;
    std::string const si = power == 1 ? "m" : fmt::format("m^{}", power);
    Quantity const one = read_quantity("1 " + std::string(titles_[k].unit), si);
    if (!one.problem && one.value > 0) return one.value;
    add(fields_[k].column,
        fmt::format("{} is not a unit of {} (expected one such as {}) - correct it", in_quotes(titles_[k].unit),
                    in_quotes(titles_[k].name), power == 1 ? "mm" : fmt::format("mm^{}", power)));
    return 1;
  }

  std::string const& place_;
  double length_unit_;
  std::vector<std::string>& problems_;
  std::size_t before_;
  CloudHeader header_;
  std::vector<CsvField> fields_;
  std::vector<CsvTitle> titles_;
};

}  // namespace

CloudHeader read_cloud_header(std::string_view text, std::string const& place, double length_unit,
                              std::vector<std::string>& problems) {
  return CloudHeaderReader(place, length_unit, problems).read(text);
}

}  // namespace piola
