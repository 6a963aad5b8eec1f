// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

/// Modes of motion that measurements of step limits iterate.
namespace piola {

/// From -0.5 to 0.5: the same numbers on every machine, without a pattern that a mode could be orthogonal to.
double pseudo_random(std::uint64_t k);

/// The largest |u_k|.
double largest_of(std::vector<double> const& u);

/// The mode of the last measurement, of size 1, with a random part, so that a mode that has grown elsewhere is found; a
/// random one where there is none.
void refresh_mode(std::vector<double>& mode);

}  // namespace piola
