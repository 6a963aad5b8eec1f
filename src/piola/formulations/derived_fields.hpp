// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/quantity_names.hpp"

/// Fields that follow from others: PrincipalStress, PrincipalStrain and CompressivePressure [Pa], which is -Pressure.
namespace piola {

/// nullptr: the field follows from no other one.
DerivedField const* find_derived(std::string_view field);
int components_of(DerivedField const& derived);

/// Makes a derived field of all values of the field it follows from; `out` has components_of(derived) values of each
/// particle.
void derive(DerivedField const& derived, std::span<double const> from, std::span<double> out);

/// The field of a frame from which `field` is read or made: itself, or what it follows from. Empty: neither is there.
std::string stored_field(std::string const& field, std::span<std::string const> in_frame);

}  // namespace piola
