// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/plot.hpp"
#include "piola/verification/verify.hpp"
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace piola {

/// Whether no row falls short or passes contrary to expectation.
bool all_accepted(std::vector<CaseVerification> const& cases);

/// One sentence: number of rows per kind of evidence. Checks of the code are no evidence and are counted separately.
std::string evidence_text(std::vector<CaseVerification> const& cases);

std::string verification_json(std::vector<CaseVerification> const& cases);
std::string verification_table(std::vector<CaseVerification> const& cases);

/// Makes the plots of a case.
using PlotCase = std::function<std::vector<Plot>(CaseVerification const&)>;

/// Writes the page folder/README.md: one section per case with its table, the wall time of each variant, a copy of its
/// last picture, and the plots of the case as SVG files. Throws FileError.
void write_verification_page(std::filesystem::path const& folder, std::vector<CaseVerification> const& cases,
                             PlotCase const& plots_of = {});

}  // namespace piola
