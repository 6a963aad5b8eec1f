// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/plot.hpp"
#include "piola/report/run_folder.hpp"
#include "piola/verification/verify.hpp"
#include <array>
#include <string>
#include <vector>

namespace piola::report {

/// Lowest and highest finite value of all curves, in SI.
struct PlotEnds {
  std::array<double, 2> x{}, y{};
};
PlotEnds ends_of(Plot const& plot);

/// Curves of the expected values of check rows whose quantities come from columns over time, within a plot of these
/// ends: a broken line across for a value, an upright one for a time, a ring for a value at a time, a curve for a
/// formula. Rows of other quantities, of quantities that are no value and no time of their column, such as a change,
/// and bounds are skipped; duplicates are drawn once.
std::vector<Curve> reference_curves(RunFolder const& run, std::vector<VerificationRow> const& rows,
                                    std::vector<std::string> const& columns, PlotEnds const& ends);

/// Adds reference_curves() to a plot over time. Returns how many were added.
int add_references(Plot& plot, RunFolder const& run, std::vector<VerificationRow> const& rows,
                   std::vector<std::string> const& columns);

}  // namespace piola::report
