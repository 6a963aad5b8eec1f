// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/plot.hpp"
#include "piola/report/run_folder.hpp"
#include "piola/simulation/verify.hpp"
#include <string>
#include <vector>

namespace piola::report {

/// Adds to a plot over time what rows of checks expect of quantities that are taken from its columns: a broken line
/// across for a value, a broken upright line for a time. Rows of other quantities, of quantities that are no value and
/// no time of their column, such as a change, and bounds are left out. Returns how many were added.
int add_references(Plot& plot, RunFolder const& run, std::vector<VerificationRow> const& rows,
                   std::vector<std::string> const& columns);

}  // namespace piola::report
