// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>

namespace piola {

/// Makes a folder ready for a new run. The results of an earlier run of the same case (same title) are removed; a
/// folder with anything else in it is refused unless `force`, and even then only files with Piola's names are removed.
/// Throws InputError (refused) or FileError (cannot be made or written).
void prepare_results(std::filesystem::path const& folder, std::string const& title, bool force);

/// First line of log.txt, by which a results folder is known: "Piola VERSION: TITLE".
std::string log_headline(std::string const& title);

/// The default folder for the results of a case file: "twisting_column-results" beside the working folder; a file
/// called case.toml lends the name of its folder.
std::filesystem::path default_results(std::filesystem::path const& case_file);

}  // namespace piola
