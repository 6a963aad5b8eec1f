// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/output/history.hpp"
#include "piola/simulation/moment.hpp"
#include <array>
#include <filesystem>
#include <string>

namespace piola {

/// "(1, 2, 3) m", with four digits.
std::string point_text(std::array<double, 3> const& point);

/// What the user is told when the physics fails: particle, place, step, values, what limits the step, likely causes,
/// and where the last state lies. `causes`: the likely ones if they are known, else those of such failures.
std::string failure_text(Failure const& failure, std::string const& causes, Moment const& moment, double cfl,
                         std::filesystem::path const& results);

/// Adds what the energies did from the first to the last row of the history to the values of a failure, unless it has
/// energies of its own.
void add_energies(Failure& failure, HistoryTable const& history);

}  // namespace piola
