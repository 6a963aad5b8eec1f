// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace piola {

struct HistoryColumn {
  std::string name;  ///< as in the first line of history.csv
  std::string unit;  ///< SI, UDUNITS notation
};

/// history.csv in memory: rows[r][c]; an empty cell is nan.
struct HistoryTable {
  std::vector<HistoryColumn> columns;
  std::vector<std::vector<double>> rows;
  std::optional<std::size_t> find(std::string_view column) const;
  /// Values from the first to the last row. Throws std::invalid_argument for an unknown column.
  std::vector<double> values(std::string_view column) const;
};

/// The columns of every run, then those that only this formulation has.
std::vector<HistoryColumn> diagnostic_columns(Diagnostics const& diagnostics);
/// Their values, in the same order.
std::vector<double> diagnostic_values(double time, std::int64_t step, double dt, Diagnostics const& diagnostics);

/// history.csv on the disk: a line is complete as soon as `append` returns.
class HistoryFile {
 public:
  /// Starts a new file. Throws FileError.
  HistoryFile(std::filesystem::path path, std::vector<HistoryColumn> columns);
  /// Continues a file after its last row with time <= `time`; later rows are cut off. Throws FileError if the file is
  /// missing or has other columns.
  HistoryFile(std::filesystem::path path, std::vector<HistoryColumn> columns, double time);
  /// Adds a line. Numbers that are not finite become empty cells; returns the names of their columns.
  std::vector<std::string> append(std::vector<double> const& row);
  HistoryTable const& table() const { return table_; }

 private:
  void open(char const* mode);
  void put(std::string const& line);
  std::filesystem::path path_;
  HistoryTable table_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

}  // namespace piola
