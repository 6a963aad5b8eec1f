// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/section.hpp"
#include "piola/math/tensor.hpp"
#include <vector>

namespace piola {

/// Corners of a polygon [m], each a list of two lengths; the first of which is not negative if it is a radius. Empty
/// (and a problem) if one cannot be. A last corner that repeats the first one is left out.
std::vector<Vec<2>> read_polygon(Value const& value, bool radius_first, Problems& problems);

/// Reports polygons without area, and lines that cross or touch one another.
void check_polygons(std::vector<std::vector<Vec<2>>> const& polygons, Place const& place, std::string const& name,
                    Problems& problems);

}  // namespace piola
