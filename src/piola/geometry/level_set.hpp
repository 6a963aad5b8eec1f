// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include "piola/geometry/solid.hpp"
#include <array>

namespace piola::geometry {

/// The two sides of a formula "f < c" or "c > f" (<= and >= alike) as "(f) - (c)", negative inside; nothing if it is no
/// single comparison.
std::optional<std::string> level_of(std::string const& formula);

/// The places in a box at which a formula is negative. The distance is f/|grad f|, refined to the foot point near the
/// surface; `spacing` [m] is the scale of differences (1e-4 of it) and of what is near. One patch, "surface".
/// The formula must be negative nowhere on the faces of the box.
SolidPtr level_set(Expression const& f, Bounds const& box, double spacing, int dimension);

}  // namespace piola::geometry
