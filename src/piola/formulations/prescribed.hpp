// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include <array>
#include <optional>
#include <vector>

/// What supports and loads mean, for every formulation.
namespace piola {

using Direction = std::array<double, 3>;

/// Steps end at releases to round-off of a sum of many steps.
bool has_ended(double until, double time);

/// None of the formulas depends on time.
bool is_steady(std::array<Expression, 3> const& formulas);

double dot(Direction const& a, Direction const& b);

/// Takes the parts along unit vectors out of d; what is left, as a unit vector. False if nothing is.
bool make_orthogonal(Direction& d, std::vector<Direction> const& to);

/// The directions that a support holds, in a body of D dimensions; a direction along an axis is that axis.
std::vector<Direction> directions_of(Support const& support, int D);

/// Prescribed speed along d of the particle with reference position X [m/s].
double speed_along(std::array<Expression, 3> const& velocity, Direction const& d, std::array<double, 3> const& X,
                   double time);

/// The acceleration factor * value at X, or factor * (-value[0] normal) by a pressure [m/s2].
Direction acceleration_by(std::array<Expression, 3> const& value, std::optional<Direction> const& normal, double factor,
                          std::array<double, 3> const& X, double time);

/// dt, or less, so that a step ends after `rest` [s], where a support or a load does: the impulse of what drives a body
/// would else depend on the step. The last steps before are alike, so that none is a sliver.
double up_to_release(double dt, double rest);

}  // namespace piola
