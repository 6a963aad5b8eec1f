// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/bound_keys.hpp"
#include "piola/input/case_spec.hpp"
#include <span>

/// Rows of the schema of supports, loads, mirrors, rigid shapes, springs, contact and ties. Order: that of the manual.
namespace piola {

using SupportKey = BoundKey<SupportSpec>;
using LoadKey = BoundKey<LoadSpec>;
using MirrorKey = BoundKey<MirrorSpec>;
using RigidKey = BoundKey<RigidSpec>;
using SpringKey = BoundKey<SpringSpec>;
using ContactKey = BoundKey<ContactSpec>;
using FrictionKey = BoundKey<contact::FrictionLaw>;
using TieKey = BoundKey<TieSpec>;

std::span<SupportKey const> support_keys();
std::span<LoadKey const> load_keys();
std::span<MirrorKey const> mirror_keys();
std::span<RigidKey const> rigid_keys();
std::span<SpringKey const> spring_keys();
std::span<ContactKey const> contact_keys();
std::span<FrictionKey const> friction_keys();  ///< of [contact] and its pairs
std::span<TieKey const> tie_keys();

}  // namespace piola
