// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>

namespace piola {

/// Stress intensity factor of a crack that opens (mode I) [Pa m^0.5], from the stress normal to the crack [Pa] at some
/// distances straight ahead of the tip [m]. Each point gives K(r) = sqrt(2 pi r) stress, which is off by terms of order
/// r because only the first term of the expansion about the tip is singular; the line K0 + b r is fitted to all of them
/// by least squares, and K0 returned. Points that are all at one distance give their mean. Both lists have one or more
/// entries.
double stress_intensity(std::span<double const> r, std::span<double const> stress);

}  // namespace piola
