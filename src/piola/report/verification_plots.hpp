// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/plot.hpp"
#include "piola/verification/verify.hpp"
#include <filesystem>
#include <vector>

namespace piola::report {

/// Plots over time of the columns used by checks of a case: the runs of its variants, at most six per plot, with the
/// expected values. Columns and variants without an expectation that can be drawn (reference_curves) are skipped.
/// `results` holds the folders of the runs, CASE/VARIANT (VerifyOptions::out). Throws FileError if a history cannot be
/// read.
std::vector<Plot> verification_plots(CaseVerification const& c, std::filesystem::path const& results);

}  // namespace piola::report
