// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/registry.hpp"
#include <span>
#include <string>

namespace piola {

/// The material of a law of a library, outside a case: `settings` are parameters as "density=1100 kg/m^3". `law` may be
/// empty if the library has one only. Throws InputError.
MaterialParameters read_library_material(std::string const& library, std::string const& law,
                                         std::span<std::string const> settings);

}  // namespace piola
