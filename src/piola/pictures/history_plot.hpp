// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/plot.hpp"
#include "piola/output/history.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

struct HistoryPlotOptions {
  std::vector<std::string> columns = {};  ///< none: the energies as a ledger
  std::string against = "time";
  std::vector<std::filesystem::path> with = {};  ///< results of other runs, drawn as dashed lines
  bool log_x = false, log_y = false;
};

/// Plots columns of history.csv of a run and of other runs. Columns that contain only round-off (rounding_levels.hpp)
/// are drawn as zero, with a remark, unless an axis of values is logarithmic. Throws InputError for folders without a
/// history and for missing columns; FileError if a history cannot be read.
Plot history_plot(std::filesystem::path const& folder, HistoryPlotOptions const& options);

/// Error message for a column that a history lacks; "" if it exists. `folder`: of the run.
std::string missing_column(HistoryTable const& table, std::string const& column, std::filesystem::path const& folder);

/// A column in words: "kinetic energy".
std::string column_words(std::string name);

/// The sign convention of a column, see sign_of; "" if there is none.
std::string sign_of_column(std::string const& name);

/// The SI unit of a column of history.csv, "" if unknown.
std::string unit_of_column(std::string const& name);

}  // namespace piola
