// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>

namespace piola {

/// Stress intensity factor of a crack in mode I [Pa m^0.5], from the stress normal to the crack [Pa] at some distances
/// straight ahead of the tip [m]. Each point gives K(r) = sqrt(2 pi r) stress, with an error of order r, because only
/// the first term of the expansion about the tip is singular. Fits the line K0 + b r by least squares and returns K0,
/// or the mean if all points are at one distance. Both lists have one or more entries.
double stress_intensity(std::span<double const> r, std::span<double const> stress);

}  // namespace piola
