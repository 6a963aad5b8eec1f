// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::geometry {

/// Cuts a polygon, nearly flat and of one loop, into triangles of its corners by taking ears off. Where there is no ear
/// (the loop crosses itself), the corner that turns most is taken. Appends size - 2 triangles.
void cut_polygon(std::span<Vec<3> const> X, std::span<int const> loop, std::vector<std::array<int, 3>>& triangles);

}  // namespace piola::geometry
