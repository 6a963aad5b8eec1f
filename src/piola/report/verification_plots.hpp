// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/plot.hpp"
#include "piola/simulation/verify.hpp"
#include <filesystem>
#include <vector>

namespace piola::report {

/// The columns that checks of a case look at, over time: the runs of its variants, at most six in a plot, and what is
/// expected of them. A column of which nothing is expected that can be drawn (reference_curves) has no plot, nor have
/// variants of which nothing is. `results` holds the folders of the runs, CASE/VARIANT (VerifyOptions::out). Throws
/// FileError if a history cannot be read.
std::vector<Plot> verification_plots(CaseVerification const& c, std::filesystem::path const& results);

}  // namespace piola::report
