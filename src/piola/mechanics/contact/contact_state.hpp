// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_forces.hpp"
#include "piola/mechanics/contact/friction_springs.hpp"
#include "piola/mechanics/contact/passages.hpp"

namespace piola::contact {

/// Result of an evaluation of contact, and what the next one reads of it.
struct ContactState {
  explicit ContactState(ContactModel const& model) : forces(model.points, model.rigids.size()), friction(model) {}
  ContactForces forces;
  FrictionSprings friction;
  Passages passages;
};

}  // namespace piola::contact
