// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

namespace piola {

/// For which strains and rotations a law is right, and what is wrong beyond, for the manual; "" where the law itself
/// sets no bound.
std::string_view validity_of_law(std::string_view name);

}  // namespace piola
