// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/checksum_trailer.hpp"
#include <cstdint>
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

/// history.csv of a run as it is, without units; empty if there is no such file.
HistoryTable read_history(std::filesystem::path const& path);

/// The columns of every run, then those that only this formulation has.
std::vector<HistoryColumn> diagnostic_columns(Diagnostics const& diagnostics);
/// Values of the diagnostic columns, in their order.
std::vector<double> diagnostic_values(double time, std::int64_t step, double dt, Diagnostics const& diagnostics);

/// How much of history.csv a checkpoint counts on.
struct HistoryMark {
  std::uint64_t rows = 0, bytes = 0;
  std::uint32_t check_sum = 0;  ///< CRC-32 of these bytes
};

/// history.csv on the disk: a line is complete as soon as `append` returns.
class HistoryFile {
 public:
  /// Starts a new file; an empty path: rows are kept in the table only. Throws FileError.
  HistoryFile(std::filesystem::path path, std::vector<HistoryColumn> columns);
  /// Continues a file after its last row with time <= `time`; later rows are removed. complaint() describes differences
  /// from the `mark` of the checkpoint. Creates a missing file. Throws FileError if the file has other columns.
  HistoryFile(std::filesystem::path path, std::vector<HistoryColumn> columns, double time,
              std::optional<HistoryMark> mark = {});
  /// Adds a line. Numbers that are not finite become empty cells; returns the names of their columns.
  std::vector<std::string> append(std::vector<double> const& row);
  HistoryTable const& table() const { return table_; }
  HistoryMark mark() const { return {table_.rows.size(), bytes_, sum_.value()}; }
  /// Describes what was missing or changed when the file was continued, in one sentence; empty if nothing was.
  std::string const& repair_note() const { return complaint_; }
  /// Waits until every row is on the disk. Throws FileError.
  void sync();

 private:
  void take_rows(std::string_view text, double time);
  void open(Opening how);
  void put(std::string const& line);
  std::filesystem::path path_;
  HistoryTable table_;
  std::uint64_t bytes_ = 0;
  CheckSum sum_;
  std::string complaint_;
  ResultFile file_{nullptr, &std::fclose};
};

}  // namespace piola
