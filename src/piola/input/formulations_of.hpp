// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/registry.hpp"
#include "piola/input/case_spec.hpp"
#include <cstddef>
#include <vector>

namespace piola {

/// The formulations of a case's bodies, each once, in the order of the bodies. Unknown names are left out.
std::vector<FormulationInfo> formulations_of(CaseSpec const& spec);

/// Whether a contact of its formulation's own acts on a body, between such bodies and with rigid shapes: not where the
/// case gives that to surfaces.
bool knows_contact(CaseSpec const& spec, std::size_t body);

/// Whether any body's formulation has.
bool knows_contact(CaseSpec const& spec);

/// Whether the case says of two, bodies or rigid shapes, by name, that nothing keeps them apart.
bool is_off(CaseSpec const& spec, std::string const& a, std::string const& b);

/// Whether a body has a surface by which others and rigid shapes can push it: a body without skew mirrors whose
/// formulation can be pushed, and which does not turn Eulerian.
bool has_surface(CaseSpec const& spec, std::size_t body);

/// The same, whether or not contact is switched off: ties need it, too.
bool can_have_surface(CaseSpec const& spec, std::size_t body);
/// Why a body has no surface that others could push, in words.
std::string why_without_surface(CaseSpec const& spec, std::size_t body);

/// Whether a tie of the case names the body.
bool is_tied(CaseSpec const& spec, std::size_t body);

/// Whether two bodies of a formulation with a contact of its own have surface contact first, which their particles lose
/// one by one to that contact: a [[contact]] table names the two, or they start within its reach (see
/// add_surface_contact), and both have surfaces.
bool starts_with_surface_contact(CaseSpec const& spec, std::size_t a, std::size_t b);
/// Whether a body has a surface at the start that its particles may lose, one by one, to a contact of their own.
bool can_lose_surface(CaseSpec const& spec, std::size_t body);

/// Whether the contact of their formulation alone keeps two bodies apart: not if they are tied or start with surface
/// contact.
bool has_own_contact(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether something keeps two bodies apart: the contact of their formulation, their surfaces or colours.
bool kept_apart(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether two bodies push each other by their surfaces: not if their formulation keeps them apart itself. Of a body
/// and itself: whether its surface does.
bool pushed_by_surface(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether two bodies, at least one of them without a surface, push each other by their colour: not at mirror planes.
bool pushed_by_colour(CaseSpec const& spec, std::size_t a, std::size_t b);

/// Whether something pushes bodies between steps: contact other than that of their formulation, or ties.
bool bodies_are_pushed(CaseSpec const& spec);

/// Whether a rigid shape pushes a body by its surface: not if the body's formulation keeps them apart itself, which it
/// cannot where the shape is free or turns.
bool pushed_by_rigid(CaseSpec const& spec, std::size_t body, std::size_t rigid);

/// Whether something keeps a body apart from rigid shapes.
bool meets_rigids(CaseSpec const& spec, std::size_t body);

/// Whether surfaces of this case can push each other or be pushed by rigid shapes.
bool surfaces_meet(CaseSpec const& spec);

/// Whether anything keeps bodies apart from others or from rigid shapes.
bool any_contact(CaseSpec const& spec);

}  // namespace piola
