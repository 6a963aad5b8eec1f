// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/output/summary.hpp"
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piola {

/// One case with several values of some of its keys (study.toml).
struct StudySpec {
  std::filesystem::path case_file;    ///< as given, relative to the study's file
  std::filesystem::path out;          ///< as given, relative to the study's file; empty: NAME-study
  int jobs = 2;                       ///< number of concurrent runs
  int threads = 0;                    ///< per run; 0: the cores divided by `jobs`
  std::vector<std::string> settings;  ///< "key=value", for all runs
  /// Keys as those of --set, and the TOML texts of their values.
  std::vector<std::pair<std::string, std::vector<std::string>>> parameters;
};

/// Relative paths start from the folder of the file. Throws InputError with all errors.
StudySpec read_study(std::filesystem::path const& path);

/// One combination of the values.
struct StudyRun {
  std::string folder;                   ///< "run-07" in the study's folder
  std::vector<std::string> settings;    ///< "key=value": those of all runs, then one for each parameter
  std::vector<std::string> value_text;  ///< the values of the parameters alone
};

/// All combinations; the last parameter changes fastest.
std::vector<StudyRun> combinations(StudySpec const& study);

/// Folder names of `count` runs: "run-07".
std::vector<std::string> run_folders(std::size_t count);

/// Status and quantities of a run of a study.
struct RunOutcome {
  std::string status;                        ///< "completed", "failed" or "stopped"; "not run": it was not started
  std::vector<MeasuredQuantity> quantities;  ///< empty unless this run wrote them
  std::string why = {};                      ///< reason if it has no quantities; else empty
};

/// Status and quantities in summary.json of a results folder. Empty if the summary belongs to another identity
/// (Identity::run), or if the identity is empty.
std::optional<RunOutcome> outcome_in(std::filesystem::path const& results, std::string const& identity);

/// The text of summary.json; empty if there is none.
std::string summary_text(std::filesystem::path const& results);

/// Result of a run whose process has ended.
struct EndedRun {
  std::string identity;        ///< expected in its summary
  std::string summary_before;  ///< summary_text before its start
  std::string_view ended_as;   ///< status from its exit code: "completed", "failed", "stopped"; empty: none
};

/// Outcome of a run from its own summary, identified by `identity` and the status of its exit code. Without one:
/// "failed", no quantities. The folder may hold the results of an earlier run.
RunOutcome outcome_of(std::filesystem::path const& results, EndedRun const& run);

/// Writes study.csv: a row for each run with its folder, values, status and quantities. Throws FileError.
void write_study_table(std::filesystem::path const& folder, StudySpec const& study, std::vector<StudyRun> const& runs,
                       std::vector<RunOutcome> const& outcomes);

}  // namespace piola
