// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/history.hpp"
#include "piola/output/plot.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

struct HistoryPlotOptions {
  std::vector<std::string> columns = {};  ///< none: the energies as a ledger
  std::string against = "time";
  std::vector<std::filesystem::path> with = {};  ///< results of other runs, drawn broken
  bool log_x = false, log_y = false;
};

/// Columns of history.csv of a run, and of others beside it. Columns that hold nothing but round-off
/// (rounding_levels.hpp) are drawn as zero, with a remark, unless an axis of values is logarithmic. Throws InputError
/// for folders without a history and for columns that it does not have; FileError if one cannot be read.
Plot history_plot(std::filesystem::path const& folder, HistoryPlotOptions const& options);

/// What is wrong with asking a history for a column that it does not have; "" if it has it. `folder`: of the run.
std::string missing_column(HistoryTable const& table, std::string const& column, std::filesystem::path const& folder);

/// A column in words: "kinetic energy".
std::string column_words(std::string name);

/// The sign convention of a column, see sign_of; "" if there is none to choose.
std::string sign_of_column(std::string const& name);

/// The unit of a column of history.csv in SI, "" if its name does not tell.
std::string unit_of_column(std::string const& name);

}  // namespace piola
