// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>

/// Modes of motion that measurements of step limits iterate.
namespace piola {

/// From -0.5 to 0.5: the same numbers on every machine, without a pattern that a mode could be orthogonal to.
double pseudo_random(std::uint64_t k);

/// The largest |u_k|.
double largest_of(std::span<double const> u);

/// A number of the mode that the last measurement has found, with a random part, so that a mode that has grown
/// elsewhere is found; a random one where there was none. `most`: the largest of all numbers. `k`: which one it is.
double refreshed(double value, double most, std::uint64_t k);

}  // namespace piola
