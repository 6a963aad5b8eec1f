// SPDX-License-Identifier: Apache-2.0
#include "piola/output/history.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace piola {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

bool ends_with_any(std::string_view name, std::initializer_list<std::string_view> ends) {
  return std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return name.ends_with(end); });
}

/// Columns that only one formulation has are named after what they are.
std::string unit_of_extra(std::string_view name) {
  if (ends_with_any(name, {"_energy", "_work", "_loss", "_heat", "_dissipation"})) return "J";
  if (name.starts_with("pressure") || ends_with_any(name, {"_stress", "_pressure"})) return "Pa";
  if (ends_with_any(name, {"_force"})) return "N";
  return "1";
}

std::string header(std::vector<HistoryColumn> const& columns) {
  std::string line;
  for (HistoryColumn const& c : columns) line += (line.empty() ? "" : ",") + c.name;
  return line + "\n";
}

/// The columns of a header by their present names.
std::vector<HistoryColumn> columns_of(std::string const& line) {
  std::vector<HistoryColumn> columns;
  std::istringstream names(line);
  for (std::string name; std::getline(names, name, ',');) columns.push_back({current_output_name(name), ""});
  return columns;
}

/// Gives the columns of a history.csv their present names. Returns whether any had another one.
bool use_current_columns(std::string& text) {
  std::size_t const end = std::min(text.find('\n'), text.size());
  std::string const before = text.substr(0, end) + "\n", now = header(columns_of(text.substr(0, end)));
  if (now == before) return false;
  text.replace(0, std::min(end + 1, text.size()), now);
  return true;
}

std::vector<double> read_row(std::string_view line, std::size_t columns) {
  std::vector<double> row;
  while (row.size() < columns) {
    std::size_t const comma = std::min(line.find(','), line.size());
    double value = missing;
    std::from_chars(line.data(), line.data() + comma, value);
    row.push_back(value);
    line.remove_prefix(std::min(comma + 1, line.size()));
  }
  return row;
}

}  // namespace

std::optional<std::size_t> HistoryTable::find(std::string_view column) const {
  auto const found =
      std::find_if(columns.begin(), columns.end(), [&](HistoryColumn const& c) { return c.name == column; });
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::vector<double> HistoryTable::values(std::string_view column) const {
  auto const index = find(column);
  if (!index) throw std::invalid_argument(fmt::format("history.csv has no column '{}'", column));
  std::vector<double> out;
  for (auto const& row : rows) out.push_back(row[*index]);
  return out;
}

HistoryTable read_history(std::filesystem::path const& path) {
  HistoryTable table;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return table;
  std::istringstream file(read_text_file(path));
  std::string line;
  if (!std::getline(file, line)) return table;
  table.columns = columns_of(line);
  while (std::getline(file, line)) table.rows.push_back(read_row(line, table.columns.size()));
  return table;
}

std::vector<HistoryColumn> diagnostic_columns(Diagnostics const& diagnostics) {
  std::vector<HistoryColumn> columns{{"time", "s"},
                                     {"step", "1"},
                                     {"dt", "s"},
                                     {"kinetic_energy", "J"},
                                     {"strain_energy", "J"},
                                     {"total_energy", "J"},
                                     {"stabilisation_loss", "J"},
                                     {"external_work", "J"},
                                     {"linear_momentum_x", "kg m/s"},
                                     {"linear_momentum_y", "kg m/s"},
                                     {"linear_momentum_z", "kg m/s"},
                                     {"angular_momentum_x", "kg m^2/s"},
                                     {"angular_momentum_y", "kg m^2/s"},
                                     {"angular_momentum_z", "kg m^2/s"},
                                     {"jacobian_min", "1"},
                                     {"jacobian_max", "1"},
                                     {"pressure_min", "Pa"},
                                     {"pressure_max", "Pa"},
                                     {"pressure_oscillation", "1"},
                                     {"projection_loss", "J"},
                                     {"damping_loss", "J"}};
  for (auto const& extra : diagnostics.more) columns.push_back({extra.first, unit_of_extra(extra.first)});
  auto const add = [&](std::string const& part, std::span<PartQuantity const> quantities) {
    for (PartQuantity const& q : quantities)
      columns.push_back({fmt::format("{}.{}", part, q.word), std::string(q.unit)});
  };
  if (diagnostics.bodies.size() > 1)
    for (BodyDiagnostics const& body : diagnostics.bodies) add(body.name, body_quantities());
  for (Action const& action : diagnostics.actions) add(action.name, action_quantities());
  for (RigidState const& rigid : diagnostics.rigids) add(rigid.name, rigid_quantities());
  return columns;
}

namespace {

void add_rigid(std::vector<double>& row, RigidState const& rigid) {
  for (auto const& vector : {rigid.centre, rigid.velocity, rigid.turn, rigid.angular_velocity})
    row.insert(row.end(), vector.begin(), vector.end());
  row.insert(row.end(), {rigid.kinetic_energy, rigid.rotational_energy});
}

}  // namespace

std::vector<double> diagnostic_values(double time, std::int64_t step, double dt, Diagnostics const& d) {
  PIOLA_EXPECTS(step >= 0);
  auto const& p = d.linear_momentum;
  auto const& l = d.angular_momentum;
  std::vector<double> row{time,
                          static_cast<double>(step),
                          dt,
                          d.kinetic_energy,
                          d.strain_energy,
                          d.total_energy(),
                          d.stabilisation_loss,
                          d.external_work,
                          p[0],
                          p[1],
                          p[2],
                          l[0],
                          l[1],
                          l[2],
                          d.jacobian_min,
                          d.jacobian_max,
                          d.pressure_min,
                          d.pressure_max,
                          d.pressure_oscillation,
                          d.projection_loss,
                          d.damping_loss};
  for (auto const& extra : d.more) row.push_back(extra.second);
  auto const add = [&](auto const& values) { row.insert(row.end(), values.begin(), values.end()); };
  if (d.bodies.size() > 1)
    for (BodyDiagnostics const& body : d.bodies) {
      add(std::array{body.kinetic_energy, body.strain_energy});
      add(body.linear_momentum);
    }
  for (Action const& action : d.actions) {
    add(action.force);
    add(action.moment);
  }
  for (RigidState const& rigid : d.rigids) add_rigid(row, rigid);
  return row;
}

HistoryFile::HistoryFile(std::filesystem::path path, std::vector<HistoryColumn> columns) : path_(std::move(path)) {
  PIOLA_EXPECTS(!columns.empty());
  table_.columns = std::move(columns);
  open(Opening::replace);
  put(header(table_.columns));
}

HistoryFile::HistoryFile(std::filesystem::path path, std::vector<HistoryColumn> columns, double time,
                         std::optional<HistoryMark> mark)
    : path_(std::move(path)) {
  table_.columns = std::move(columns);
  std::string const first = header(table_.columns);
  bool const there = std::filesystem::exists(path_);
  std::string text = there ? read_text_file(path_) : first;
  std::size_t const size = text.size();
  CheckSum sum;
  if (mark) sum.add(std::string_view(text).substr(0, mark->bytes));
  bool const whole = mark && mark->bytes <= size && sum.value() == mark->check_sum;
  if (whole) text.resize(mark->bytes);
  bool const renamed = !text.starts_with(first) && use_current_columns(text);
  if (!text.starts_with(first)) {
    throw FileError(fmt::format("{}: has other columns than this run would write - run the case again in a new folder",
                                path_.string()));
  }
  take_rows(text, time);
  if (!there || renamed || bytes_ != size) write_whole_file(path_, std::string_view(text).substr(0, bytes_));
  if (mark && !whole) {
    complaint_ = fmt::format("{}: {} rows up to t = {} s where the checkpoint counts on {}; {}", path_.string(),
                             table_.rows.size(), time, mark->rows,
                             there ? "rows are missing or were changed" : "the file was missing and starts here");
  }
  open(Opening::append);
}

void HistoryFile::take_rows(std::string_view text, double time) {
  std::size_t kept = header(table_.columns).size();
  for (std::size_t at = kept, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
    auto row = read_row(text.substr(at, end - at), table_.columns.size());
    if (!(row[0] <= time)) break;
    table_.rows.push_back(std::move(row));
    kept = end + 1;
  }
  bytes_ = kept;
  sum_.add(text.substr(0, kept));
}

void HistoryFile::sync() {
  if (!file_) return;
  if (::fsync(::fileno(file_.get())) != 0) throw FileError(write_error_text(path_, errno));
}

void HistoryFile::open(Opening how) {
  if (path_.empty()) return;
  file_ = open_result_file(path_, how);
  if (!file_) throw FileError(write_error_text(path_, errno));
}

void HistoryFile::put(std::string const& line) {
  if (!file_) return;
  if (!still_there(::fileno(file_.get()), path_)) throw FileError(was_removed(path_));
  bool const written = std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size();
  if (!written || std::fflush(file_.get()) != 0) throw FileError(write_error_text(path_, errno));
  bytes_ += line.size();
  sum_.add(line);
}

std::vector<std::string> HistoryFile::append(std::vector<double> const& row) {
  PIOLA_EXPECTS(row.size() == table_.columns.size());
  std::vector<std::string> bad;
  fmt::memory_buffer line;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (c > 0) line.push_back(',');
    if (std::isfinite(row[c])) {
      fmt::format_to(std::back_inserter(line), "{}", row[c]);
    } else {
      bad.push_back(table_.columns[c].name);
    }
  }
  line.push_back('\n');
  put(fmt::to_string(line));
  table_.rows.push_back(row);
  return bad;
}

}  // namespace piola
