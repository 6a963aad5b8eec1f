// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/study.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace piola::app {

/// Reads the case of every run of a study before the first one begins. Returns their identities. Throws InputError,
/// with the settings of the run that cannot be read.
std::vector<std::string> identities_of(StudySpec const& study, std::vector<StudyRun> const& runs);

/// Makes the runs of a study in its folder, several at a time, each by this program in a process of its own; runs that
/// are completed there with the same identity are not made again. Tells of each, and writes study.csv. A stop signal
/// ends those that are under way. Throws FileError.
std::vector<RunOutcome> make_runs(StudySpec const& study, std::filesystem::path const& folder,
                                  std::vector<StudyRun> const& runs, std::vector<std::string> const& identities);

/// Threads of each run if nothing is said: the cores divided by the runs at a time.
int share_of_cores(int jobs);

/// The exit code of a study.
int code_of(std::vector<RunOutcome> const& outcomes);

}  // namespace piola::app
