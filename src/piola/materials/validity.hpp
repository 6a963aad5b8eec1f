// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

namespace piola {

/// Range of strains and rotations in which a law is valid, and its errors beyond, for the manual; "" if the law itself
/// sets no bound.
std::string_view validity_of_law(std::string_view name);

}  // namespace piola
