// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/verification/verify.hpp"
#include <filesystem>
#include <vector>

namespace piola::report {

/// Writes one HTML page about a verification: a table of all rows, each of which opens the section of its run with
/// summary, plots, last picture and case; particles in space have pages of their own (write_report). `results` holds
/// the folders of the runs, CASE/VARIANT (VerifyOptions::out). Returns the bytes of the page. Throws FileError.
double write_verification_report(std::filesystem::path const& page, std::vector<CaseVerification> const& cases,
                                 std::filesystem::path const& results);

}  // namespace piola::report
