// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/block_law.hpp"
#include <vector>

/// The laws of examples/user-materials/, compiled into the tests.
namespace piola::testing {

/// In parameters: mu, kappa.
piola_material const& example_neo_hookean();
/// In parameters: Young's modulus, Poisson's ratio, yield stress, saturation, hardening rate.
piola_material const& example_voce();

/// Material of a law that is not in a library, with the density and the parameters of the law. The law must stay.
MaterialParameters material_of(piola_material const& law, std::vector<double> const& values);

}  // namespace piola::testing
