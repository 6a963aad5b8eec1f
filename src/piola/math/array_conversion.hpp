// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <array>

/// Places are arrays where they are stored and vectors where they are computed with.
namespace piola {

inline Vec<3> vector_of(std::array<double, 3> const& a) { return {{a[0], a[1], a[2]}}; }
inline std::array<double, 3> array_of(Vec<3> const& v) { return {v[0], v[1], v[2]}; }

}  // namespace piola
