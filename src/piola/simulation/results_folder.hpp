// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include <filesystem>
#include <optional>
#include <string>

namespace piola {

/// Whose results a folder is to hold.
struct ResultsOf {
  std::string title;
  std::filesystem::path case_file;  ///< that it was read from; empty if none
  bool force = false;               ///< use a folder that holds other things
};

/// Makes the folder if there is none, and says whether a new run may use it: one that is empty, holds an earlier run of
/// the same case (same title), or anything if `force`. A folder in which results would replace the case file itself is
/// never taken. Throws InputError (refused) or FileError (cannot be made).
void check_results(std::filesystem::path const& folder, ResultsOf const& run);

/// Where a set-up that is stopped may leave what it has made for a later run: a folder in the results; empty if these
/// would lie in a folder with other things.
std::filesystem::path folder_for_unfinished(std::filesystem::path const& results);

/// Removes the results of an earlier run: files with the names that Piola gives them, and its folders if nothing else
/// is in them. Links are removed, never followed. Throws FileError.
void clear_results(std::filesystem::path const& folder);

/// The case that the run in a folder was started with, and its particles if these are wanted; nothing if it is not
/// there or cannot be read any more.
std::optional<CaseSpec> case_in_results(std::filesystem::path const& folder, ParticleSet* particles = nullptr);

/// First line of log.txt, by which a results folder is known: "Piola VERSION: TITLE".
std::string log_headline(std::string const& title);

/// The default folder for the results of a case file: "twisting_column-results" beside the working folder; a file
/// called case.toml lends the name of its folder.
std::filesystem::path default_results(std::filesystem::path const& case_file);

}  // namespace piola
