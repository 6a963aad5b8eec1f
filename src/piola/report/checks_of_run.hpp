// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/run_folder.hpp"
#include "piola/verification/verify.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola::report {

/// Rows of a checks.toml that need this run alone, judged by its summary. `variant` empty: the one whose case equals
/// that of the folder, up to keys that do not affect the state; `note` reports if there is none. Throws InputError for
/// a file that cannot be read, or a variant that it does not have.
std::vector<VerificationRow> rows_of_run(RunFolder const& run, std::filesystem::path const& checks,
                                         std::string const& variant, std::string& note);

}  // namespace piola::report
