// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/registry.hpp"
#include "piola/input/case_spec.hpp"
#include <cstddef>
#include <vector>

namespace piola {

/// The formulations of a case's bodies, each once, in the order of the bodies. Unknown names are left out.
std::vector<FormulationInfo> formulations_of(CaseSpec const& spec);

/// Whether the contact of its own formulation acts on a body, between such bodies and with rigid shapes. False if the
/// case sets surface contact instead.
bool has_kernel_contact(CaseSpec const& spec, std::size_t body);

/// Whether has_kernel_contact() holds for any body.
bool has_kernel_contact(CaseSpec const& spec);

/// Whether the case switches off contact between two bodies or rigid shapes, by name.
bool is_off(CaseSpec const& spec, std::string const& a, std::string const& b);

/// Whether a body has a surface for contact with other bodies and rigid shapes. Requires a formulation that supports
/// it, no antisymmetric mirrors, and no conversion to Eulerian.
bool has_surface(CaseSpec const& spec, std::size_t body);

/// As has_surface(), even if contact is switched off; for ties.
bool can_have_surface(CaseSpec const& spec, std::size_t body);
/// Reason, in words, why a body has no surface for contact.
std::string why_without_surface(CaseSpec const& spec, std::size_t body);

/// Whether a tie of the case refers to the body.
bool is_tied(CaseSpec const& spec, std::size_t body);

/// Whether two bodies start with surface contact, which their particles later replace one by one by the contact of
/// their formulation. Requires that both have surfaces, and that a [[contact]] table names the two or they start within
/// its reach (see add_surface_contact).
bool starts_with_surface_contact(CaseSpec const& spec, std::size_t a, std::size_t b);
/// Whether a body starts with a surface that its particles may replace, one by one, by the contact of their
/// formulation.
bool can_lose_surface(CaseSpec const& spec, std::size_t body);

/// Whether the contact of their formulation alone acts between two bodies. False if they are tied or start with surface
/// contact.
bool has_own_contact(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether any contact acts between two bodies: that of their formulation, of surfaces or of colours.
bool has_contact_between(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether surface contact acts between two bodies. False if the contact of their formulation does. a = b:
/// self-contact.
bool pushed_by_surface(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether colour contact acts between two bodies, at least one of which has no surface. Not at mirror planes.
bool pushed_by_colour(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether contact other than that of a formulation, or ties, change velocities between steps.
bool bodies_are_pushed(CaseSpec const& spec);

/// Whether surface contact acts between a rigid shape and a body. False if the contact of the body's formulation does,
/// which requires a shape that is neither free nor rotates.
bool pushed_by_rigid(CaseSpec const& spec, std::size_t body, std::size_t rigid);

/// Whether any contact acts between a body and rigid shapes.
bool has_rigid_contact(CaseSpec const& spec, std::size_t body);

/// Whether surface contact acts between any bodies, or between a body and a rigid shape.
bool has_surface_contact(CaseSpec const& spec);

/// Whether any contact acts between bodies, or between bodies and rigid shapes.
bool any_contact(CaseSpec const& spec);

}  // namespace piola
