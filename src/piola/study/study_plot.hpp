// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/plot.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

struct StudyPlotOptions {
  std::vector<std::string> quantities = {};  ///< none: the only one
  std::string against = {};                  ///< a parameter; empty: the first one with several values
  bool log_x = false, log_y = false;
};

/// Path of study.csv, given itself or by its folder; empty if it is neither.
std::filesystem::path study_table_at(std::filesystem::path const& path);

/// Plots quantities of a study against one of its parameters: a curve, with a marker at each completed run, for each
/// quantity and each combination of the other parameters. Units come from the summaries of the runs and from the first
/// value of the parameter. Throws InputError if study.csv lacks the data, or if values of the parameter are no numbers;
/// FileError if it cannot be read.
Plot study_plot(std::filesystem::path const& table, StudyPlotOptions const& options);

}  // namespace piola
