// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/quantity_names.hpp"
#include <array>

namespace piola {

/// The sign convention of a component of a field, e.g. "tension positive", for legends, axes and frames. Empty for
/// magnitudes, shear stresses and fields that are never negative.
std::string_view sign_of(std::string_view field, int component = whole_field);

/// The range of a field with meaningful limits, as 0 (whole) and 1 (failed) of a damage: default range of a legend.
std::optional<std::array<double, 2>> whole_range(std::string_view field);

}  // namespace piola
