// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include <filesystem>
#include <optional>
#include <string>

namespace piola {

/// Owner of a results folder.
struct ResultsOf {
  std::string title;
  std::filesystem::path case_file;  ///< source of the case; empty if none
  bool force = false;               ///< allow a folder with other content
};

/// Creates the folder if necessary, and checks that a new run may use it: it is empty, holds an earlier run of the same
/// case (same title), or `force` is set. A folder in which results would replace the case file itself is always
/// refused. Throws InputError (refused) or FileError (cannot be created).
void check_results(std::filesystem::path const& folder, ResultsOf const& run);

/// Folder in the results where an interrupted set-up may store intermediate data for a later run; empty if the results
/// folder has other content.
std::filesystem::path folder_for_unfinished(std::filesystem::path const& results);

/// Removes the results of an earlier run: files with names of Piola output, and its folders if they are then empty.
/// Links are removed, never followed. Throws FileError.
void clear_results(std::filesystem::path const& folder);

/// The case with which the run in a folder was started, and its particles if requested; empty if missing or unreadable.
std::optional<CaseSpec> case_in_results(std::filesystem::path const& folder, ParticleSet* particles = nullptr);

/// First line of log.txt, which identifies a results folder: "Piola VERSION: TITLE".
std::string log_headline(std::string const& title);

/// The default results folder of a case file: "twisting_column-results" in the working folder; for a file case.toml the
/// name comes from its folder.
std::filesystem::path default_results(std::filesystem::path const& case_file);

}  // namespace piola
