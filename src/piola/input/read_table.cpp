// SPDX-License-Identifier: Apache-2.0
#include "piola/base/csv.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/sections.hpp"
#include "piola/input/table_keys.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>

/// Values that a table gives in place of a formula: amplitudes over time, profiles over a coordinate.
namespace piola {
namespace {

/// Units of the two columns; empty: any, as given.
struct TableUnits {
  std::string x, y;
};

/// Reads a quantity in a known unit, or one in any.
Quantity quantity_in(std::string_view text, std::string const& unit) {
  return unit.empty() ? read_any_quantity(text) : read_quantity(text, unit);
}

/// A column of a CSV file: SI value = offset + factor * number.
struct CsvColumn {
  std::size_t index = 0;
  double offset = 0, factor = 1;
};

/// Reads the two columns of a CSV file.
class TableFile {
 public:
  TableFile(std::string name, std::string column, TableUnits const& units, std::vector<std::string>& problems)
      : name_(std::move(name)), wanted_(std::move(column)), units_(units), problems_(problems) {}

  TablePoints read(std::string_view text) {
    text = without_byte_order_mark(text);
    if (std::string const wrong = refuse_csv_text(text, "give a CSV file"); !wrong.empty())
      return refuse(name_ + ": " + wrong);
    CsvLines lines(text);
    if (!lines.next())
      return refuse(name_ +
                    ": is empty (expected a header such as \"time [ms],force [kN]\" and rows of numbers) - "
                    "give another file");
    std::string_view const first = lines.line();
    separator_ = first.find(';') != std::string_view::npos    ? ';'
                 : first.find('\t') != std::string_view::npos ? '\t'
                                                              : ',';
    std::size_t const before = problems_.size();
    bool const header = read_header(first, lines.number());
    if (problems_.size() > before) return {};
    CsvProblems of_rows(name_, problems_);
    if (!header) take(first, lines.number(), of_rows);
    while (lines.next()) take(lines.line(), lines.number(), of_rows);
    if (rows_ < 2)
      of_rows.add(fmt::format("{}: has {} of numbers (expected two or more) - add rows", name_,
                              rows_ == 1 ? "one row" : "no row"));
    return std::move(points_);
  }

 private:
  TablePoints refuse(std::string text) {
    problems_.push_back(std::move(text));
    return {};
  }

  void add(std::int64_t line, std::size_t column, std::string const& text) {
    problems_.push_back(fmt::format("{}:{}:{}: {}", name_, line, column, text));
  }

  /// Decides on the columns. False: the first line holds numbers, which are in SI units.
  bool read_header(std::string_view line, std::int64_t number) {
    std::vector<CsvField> fields;
    if (std::size_t const mark = cut_csv_line(line, separator_, fields); mark > 0) {
      add(number, mark, "the quotation mark is not closed - close it");
      return true;
    }
    columns_ = fields.size();
    if (columns_ < 2) {
      add(number, 1,
          fmt::format("{} is one column (expected two or more, divided by commas, semicolons or tabs: x and "
                      "the values) - add a column",
                      in_quotes(line)));
      return true;
    }
    bool const header = read_csv_number(fields.front().text).problem.find("is not a number") != std::string::npos;
    std::vector<std::string> names;
    for (CsvField const& field : fields) names.emplace_back(title_of_field(field.text).name);
    choose(header ? std::span(names).subspan(1) : std::span<std::string>(), number);
    if (header) {
      scale(x_, fields[0], units_.x, number);
      scale(y_, fields[y_.index], units_.y, number);
    }
    return header;
  }

  /// The column of the values. `names`: those of all columns but the first; none without a header.
  void choose(std::span<std::string const> names, std::int64_t line) {
    y_.index = 1;
    auto const found = std::find(names.begin(), names.end(), wanted_);
    if (!wanted_.empty() && found != names.end()) {
      y_.index = static_cast<std::size_t>(found - names.begin()) + 1;
    } else if (!wanted_.empty()) {
      add(line, 1,
          fmt::format("has no column {} of values (columns: {}) - {}", in_quotes(wanted_),
                      names.empty() ? "no names, numbers alone" : joined(names),
                      names.empty() ? "add a header" : advice_for_name(wanted_, names)));
    } else if (columns_ > 2) {
      add(line, 1,
          fmt::format("has {} columns of values ({}) - choose one: column = {}", columns_ - 1,
                      names.empty() ? "without names" : joined(names),
                      names.empty() ? "\"NAME\", and add a header" : in_quotes(names.front())));
    }
  }

  void scale(CsvColumn& column, CsvField const& field, std::string const& unit, std::int64_t line) {
    CsvTitle const title = title_of_field(field.text);
    if (title.broken) {
      add(line, field.column,
          fmt::format("the unit in {} cannot be read (expected one in brackets, such as \"time "
                      "[ms]\") - write it so, or leave it out",
                      in_quotes(field.text)));
      return;
    }
    if (title.unit.empty()) return;
    std::string const of_unit(title.unit);
    Quantity const zero = quantity_in("0 " + of_unit, unit), one = quantity_in("1 " + of_unit, unit);
    if (one.problem)
      add(line, field.column, fmt::format("the unit of {}: {} - correct it", in_quotes(title.name), *one.problem));
    column.offset = zero.value;
    column.factor = one.value - zero.value;
  }

  void take(std::string_view line, std::int64_t number, CsvProblems& problems) {
    ++rows_;
    auto const wrong = [&](std::size_t column, std::string const& text) {
      problems.add(fmt::format("{}:{}:{}: {}", name_, number, column, text));
    };
    std::vector<CsvField> fields;
    if (std::size_t const mark = cut_csv_line(line, separator_, fields); mark > 0)
      return wrong(mark, "the quotation mark is not closed - close it");
    if (fields.size() != columns_)
      return wrong(1, fmt::format("has {} fields (expected {}) - {}", fields.size(), columns_,
                                  fields.size() > columns_ ? "remove the rest; numbers have a decimal point, no comma"
                                                           : "add what is missing, or remove the row"));
    std::array<double, 2> values{};
    for (auto const& [column, value] : {std::pair(&x_, &values[0]), std::pair(&y_, &values[1])}) {
      CsvField const& field = fields[column->index];
      CsvNumber const found = read_csv_number(field.text);
      *value = column->offset + column->factor * found.value;
      if (!found.problem.empty()) return wrong(field.column, found.problem);
      if (!std::isfinite(*value))
        return wrong(field.column, in_quotes(field.text) + " is not finite - correct or remove the row");
    }
    if (!points_.x.empty() && !(values[0] > points_.x.back()))
      return wrong(fields[0].column,
                   fmt::format("{} is not above the one before (expected increasing ones) - sort the rows; a jump "
                               "takes a short time",
                               in_quotes(fields[0].text)));
    points_.x.push_back(values[0]);
    points_.y.push_back(values[1]);
  }

  std::string name_, wanted_;
  TableUnits const& units_;
  std::vector<std::string>& problems_;
  char separator_ = ',';
  std::size_t columns_ = 0, rows_ = 0;
  CsvColumn x_, y_;
  TablePoints points_;
};

/// A number of a row of the key `table`, in the unit of its column.
std::optional<double> number_of_row(Value const& value, std::string const& unit, Problems& problems) {
  if (!unit.empty() || !value.node.is_text()) return read_number(value, unit, any_value, problems);
  Quantity const quantity = read_any_quantity(value.node.text);
  if (!quantity.problem) return quantity.value;
  problems.add(value.node.place, value.name + " cannot be read: " + *quantity.problem);
  return std::nullopt;
}

TablePoints points_of_rows(Value const& value, TableUnits const& units, Problems& problems) {
  constexpr std::size_t most = 1'000'000;  // a case file has no room for more
  TablePoints points;
  auto const rows = read_list(value, 2, most, problems);
  if (!rows) return points;
  for (Value const& row : *rows) {
    auto const pair = read_list(row, 2, 2, problems);
    if (!pair) continue;
    auto const x = number_of_row((*pair)[0], units.x, problems), y = number_of_row((*pair)[1], units.y, problems);
    if (!x || !y) continue;
    if (!points.x.empty() && !(*x > points.x.back()))
      problems.add(row.node.place,
                   fmt::format("{} begins with {}, which is not above the one before, {} (allowed: "
                               "increasing ones) - sort the rows; a jump takes a short time",
                               row.name, quantity_text(*x, units.x), quantity_text(points.x.back(), units.x)));
    points.x.push_back(*x);
    points.y.push_back(*y);
  }
  return points;
}

TablePoints points_of_file(Section const& section, std::string const& file, std::string const& column,
                           TableUnits const& units) {
  std::vector<std::string> problems;
  std::string const path = case_file(section, file).path.string();
  TablePoints points;
  try {
    points = TableFile(path, column, units, problems).read(read_text_file(path));
  } catch (FileError const& error) {
    problems.emplace_back(error.what());
  }
  for (std::string const& problem : problems) section.problems().add(section.place_of("file"), problem);
  return points;
}

/// SI unit of what a table is over; empty if it may be anything.
std::string unit_of_argument(std::string const& over) {
  if (over == "t") return "s";
  return over == "X" || over == "Y" || over == "Z" ? "m" : "";
}

/// Unit of the values in the table; of a derivative that of what is derived.
std::string unit_of_values(Section const& section, TableSpec const& spec, std::string const& over,
                           std::string_view unit) {
  if (!spec.derivative) return std::string(unit);
  if (unit.ends_with("/s") && over == "t") return std::string(unit.substr(0, unit.size() - 2));
  section.problems().add(section.place_of("derivative"),
                         section.name_of("derivative") + " is true for a quantity in " + in_quotes(unit) + " over " +
                             in_quotes(over) + " (allowed: for velocities, from displacements over t) - remove it");
  return std::string(unit);
}

/// "table force.csv over t (3 rows, 0 s to 2 ms; before: 0 Pa, after: 5 kPa)".
std::string text_of_table(TableSpec const& spec, std::string const& over, TablePoints const& points,
                          TableUnits const& units, double scale) {
  auto const text = [](double value, std::string const& unit) {
    return unit.empty() ? number_text(value) : quantity_text(value, unit);
  };
  auto const outside = [&](TableFunction::Outside what, double end) {
    if (what == TableFunction::Outside::error) return std::string("none");
    return spec.derivative || what == TableFunction::Outside::zero ? "0" : text(scale * end, units.y);
  };
  return fmt::format("{}{}table{} over {} ({} rows, {} to {}; before: {}, after: {})",
                     spec.options.interpolation == TableFunction::Interpolation::smooth ? "smooth " : "",
                     spec.derivative ? "slope of the " : "", spec.file.empty() ? "" : " " + spec.file, over,
                     count_text(static_cast<std::int64_t>(points.x.size())), text(points.x.front(), units.x),
                     text(points.x.back(), units.x), outside(spec.options.before, points.y.front()),
                     outside(spec.options.after, points.y.back()));
}

/// Whether a table has exactly one of rows and the name of a file.
bool has_one_source(Section const& section, std::string const& name) {
  bool const rows = section.has("table"), file = section.has("file");
  if (rows == file) section.refuse_count(name, rows ? 2 : 0, "table, file");
  if (!file) section.refuse("column", "is used only with file");
  return rows != file && file == (file && section.node().find("file")->is_text());
}

TablePoints points_of(Section const& section, TableSpec const& spec, TableUnits const& units) {
  if (section.has("table")) return points_of_rows(*section.find("table"), units, section.problems());
  return points_of_file(section, spec.file, spec.column, units);
}

}  // namespace

std::optional<TablePoints> read_table_points(Value const& value, std::array<std::string_view, 2> const& units,
                                             Problems& problems) {
  TableUnits const of{std::string(units[0]), std::string(units[1])};
  std::size_t const before = problems.count();
  TablePoints points;
  if (!value.node.is_table()) {
    points = points_of_rows(value, of, problems);
  } else {
    Section const section(value.node, "table", problems);
    TableSpec spec;
    read_members(section, table_keys(), spec);
    for (char const* const key : {"over", "interpolation", "before", "after", "derivative"})
      section.refuse(key, "is for tables in place of formulas, not for " + value.name);
    section.refuse_unknown();
    if (has_one_source(section, value.name) && problems.count() == before) points = points_of(section, spec, of);
    for (double& y : points.y) y *= spec.scale;
  }
  if (problems.count() > before) return std::nullopt;
  return points;
}

std::optional<Expression> read_table(Value const& value, std::string_view unit, Names const& names,
                                     Problems& problems) {
  Section const section(value.node, "table", problems);
  std::size_t const before = problems.count();
  TableSpec spec;
  read_members(section, table_keys(), spec);
  spec.options.gives = spec.derivative ? TableFunction::Gives::slope : TableFunction::Gives::value;
  auto over = section.has("over") ? section.formula("over", names) : Expression("t");
  section.refuse_unknown();
  if (!has_one_source(section, value.name) || !over) return std::nullopt;
  TableUnits const units{unit_of_argument(over->text()), unit_of_values(section, spec, over->text(), unit)};
  TablePoints points = points_of(section, spec, units);
  if (problems.count() > before) return std::nullopt;
  std::string const text = text_of_table(spec, over->text(), points, units, spec.scale);
  for (double& y : points.y) y *= spec.scale;
  auto const function = std::make_shared<TableFunction const>(std::move(points.x), std::move(points.y), spec.options);
  return Expression(
      text, [function](double x) { return (*function)(x); }, std::move(*over));
}

}  // namespace piola
