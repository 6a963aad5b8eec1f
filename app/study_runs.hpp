// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/study/study.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola::app {

/// Reads the case of every run of a study before the first one starts. Returns their identities. Throws InputError,
/// with the settings of the run that cannot be read.
std::vector<std::string> identities_of(StudySpec const& study, std::vector<StudyRun> const& runs);

/// Runs a study in its folder, several runs at a time, each in a process of its own; skips runs that are completed
/// there with the same identity. Prints the status of each, and writes study.csv. A stop signal ends running ones.
/// Throws FileError.
std::vector<RunOutcome> make_runs(StudySpec const& study, std::filesystem::path const& folder,
                                  std::vector<StudyRun> const& runs, std::vector<std::string> const& identities);

/// Default threads of each run: the cores divided by the runs at a time.
int share_of_cores(int jobs);

/// The exit code of a study.
int code_of(std::vector<RunOutcome> const& outcomes);

}  // namespace piola::app
