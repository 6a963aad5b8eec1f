// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include "piola/setup/shapes.hpp"
#include <array>
#include <string_view>

namespace piola {

/// Names in formulas of a body in addition to X, Y, Z: depth below the surface [m], negative outside, and the outward
/// unit normal at the nearest place of the surface.
inline constexpr std::array<std::string_view, 4> own_names_of_places{"depth", "NX", "NY", "NZ"};

/// Adds them for a shape in 2D or 3D that has a surface; constants of the same name keep their meaning. `usable`: the
/// shape was read without a problem; otherwise the names are known, and 0.
void add_names_of_places(ShapeSpec const& shape, bool usable, Names& names);

}  // namespace piola
