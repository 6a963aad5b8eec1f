// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
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

}  // namespace piola
