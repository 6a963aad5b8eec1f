// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/plot.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

struct StudyPlotOptions {
  std::vector<std::string> quantities = {};  ///< none: the only one that there is
  std::string against = {};                  ///< a parameter; empty: the first that has several values
  bool log_x = false, log_y = false;
};

/// study.csv itself, or that of a study's folder; nothing if it is neither.
std::filesystem::path study_table_at(std::filesystem::path const& path);

/// Quantities of a study against one of its parameters: a curve, with a ring at each run that is completed, for each
/// quantity and each combination of the other parameters. Units are those of the quantities, which the runs beside
/// study.csv have, and of the first value of the parameter. Throws InputError if study.csv does not have what is asked
/// for, or if the values of the parameter are no numbers; FileError if it cannot be read.
Plot study_plot(std::filesystem::path const& table, StudyPlotOptions const& options);

}  // namespace piola
