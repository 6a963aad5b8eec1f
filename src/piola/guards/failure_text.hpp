// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/observers/time_state.hpp"
#include "piola/output/history.hpp"
#include <array>
#include <filesystem>
#include <string>

namespace piola {

/// "(1, 2, 3) m", with four digits.
std::string point_text(std::array<double, 3> const& point);

/// Error message of a physical failure: particle, position, step, values, what limits the step, likely causes, and the
/// location of the last state. `causes`: the likely ones if known, else general ones. `limit`: StepEstimate::limit, may
/// be empty.
std::string failure_text(Failure const& failure, std::string const& causes, TimeState const& moment,
                         std::string const& limit, std::filesystem::path const& results);

/// Adds the change of the energies over the history to the values of a failure, unless it has energies of its own.
void add_energies(Failure& failure, HistoryTable const& history);

}  // namespace piola
