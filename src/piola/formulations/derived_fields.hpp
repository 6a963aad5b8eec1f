// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/quantity_names.hpp"

/// Fields that are computed from others: PrincipalStress, PrincipalStrain and CompressivePressure [Pa], which is
/// -Pressure.
namespace piola {

/// Returns the derived field of this name; nullptr if there is none.
DerivedField const* find_derived(std::string_view field);
int components_of(DerivedField const& derived);

/// Computes a derived field from all values of its source field. `out` has components_of(derived) values per particle.
void derive(DerivedField const& derived, std::span<double const> from, std::span<double> out);

/// Returns the field of a frame from which `field` is read or computed: itself or its source field. Empty if the frame
/// has neither.
std::string stored_field(std::string const& field, std::span<std::string const> in_frame);

}  // namespace piola
