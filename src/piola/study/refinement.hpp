// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

/// Settings "key=value" that multiply the spacing of every body by `factor`. The numbers of intervals (or of cells) of
/// boxes are divided by the factor and rounded, so that all directions change alike; a direction with one particle on
/// its faces keeps it. A factor of 1 changes nothing. Throws InputError for bodies whose particles come from a file.
/// `spec`: of the case `file` with `settings`.
std::vector<std::string> spacing_settings(std::filesystem::path const& file, std::vector<std::string> const& settings,
                                          CaseSpec const& spec, double factor);

/// The setting that adds quantities to those of a case: each the last value of a column of history.csv, or COLUMN:TAKE
/// with another word of quantity.take, with the name COLUMN_TAKE without dots.
std::string quantity_setting(std::filesystem::path const& file, std::vector<std::string> const& settings,
                             std::vector<std::string> const& columns);

/// Ratio of the spacings of two cases, body by body.
struct SpacingRatio {
  double mean = 1;  ///< geometric mean over bodies and directions
  double least = 1, most = 1;
};
SpacingRatio spacing_ratio(CaseSpec const& fine, CaseSpec const& coarse);

/// The smallest spacing of all bodies [m].
double finest_spacing(CaseSpec const& spec);

}  // namespace piola
