// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/observers/run_log.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/time_loop.hpp"
#include <filesystem>
#include <optional>
#include <vector>

namespace piola {

/// Restores a simulation and its observers from the newest valid checkpoint in a results folder. Empty if there is
/// none. A checkpoint after a step shortened to an earlier end of the run is used only if `cut_too`. Throws InputError
/// if the case or its particles differ from those of the run. Collective.
std::optional<TimeState> restore(Simulation& s, std::filesystem::path const& folder, RunLog& journal,
                                 std::vector<Observer*> const& observers, bool cut_too);

}  // namespace piola
