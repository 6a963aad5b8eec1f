// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/quantity_names.hpp"
#include <array>

namespace piola {

/// The sign convention of a component of a field, e.g. "tension positive", for legends, axes and frames. Empty where
/// there is none to choose: magnitudes, shear stresses, fields that are never negative.
std::string_view sign_of(std::string_view field, int component = whole_field);

/// The range of a field whose ends mean something, as 0 (whole) and 1 (failed) of a damage: what a legend shows unless
/// another range is asked for.
std::optional<std::array<double, 2>> whole_range(std::string_view field);

}  // namespace piola
