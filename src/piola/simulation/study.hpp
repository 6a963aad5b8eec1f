// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/problems.hpp"
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace piola {

/// One case with several values of some of its keys (study.toml).
struct StudySpec {
  std::filesystem::path case_file;  ///< as given, relative to the study's file
  std::string out;                  ///< empty: NAME-study
  int jobs = 2;                     ///< runs at a time
  int threads = 0;                  ///< of each run; 0: the cores divided by `jobs`
  /// Keys as those of --set, and the TOML texts of their values.
  std::vector<std::pair<std::string, std::vector<std::string>>> parameters;
};

/// Throws InputError with all that is wrong.
StudySpec read_study(std::filesystem::path const& path);

/// One combination of the values.
struct StudyRun {
  std::string folder;                   ///< "run-07" in the study's folder
  std::vector<std::string> settings;    ///< "key=value" for each parameter
  std::vector<std::string> value_text;  ///< the values alone
};

/// All combinations; the last parameter changes fastest.
std::vector<StudyRun> combinations(StudySpec const& study);

/// Makes study.csv: a row for each run with its folder, values, status and the quantities of its summary; a status is
/// "failed" where there is no summary. Throws FileError.
void write_study_table(std::filesystem::path const& folder, StudySpec const& study, std::vector<StudyRun> const& runs);

/// "completed", "failed" or "stopped" of a results folder; "" if it has no summary.
std::string run_status(std::filesystem::path const& results);

}  // namespace piola
