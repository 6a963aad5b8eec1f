// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// Two bodies, or a body and a rigid shape, that start close to each other.
struct Clearance {
  std::size_t body = 0;
  std::size_t other = 0;  ///< another body, or the rigid shape
  double distance = 0;    ///< between their nearest particles; of the nearest particle from the surface of a shape [m]
  double spacing = 0;     ///< mean of the two bodies' spacings; half the body's before a shape [m]
  std::array<double, 3> at{};  ///< the nearest particle of `body` [m]
};

/// Pairs of bodies whose nearest particles start less than `reach` spacings apart, each pair once. The spacing of a
/// body is its largest one, as for contact.
std::vector<Clearance> close_bodies(CaseSpec const& spec, ParticleSet const& particles, double reach);

/// Bodies that start with a particle nearer to a rigid shape than half a spacing.
std::vector<Clearance> close_shapes(CaseSpec const& spec, ParticleSet const& particles);

/// Gives surface contact (see starts_with_surface_contact) to total-Lagrangian bodies whose nearest particles start
/// less than 1.5 spacings apart: the contact of their formulation would push them off with an energy out of nothing.
/// Adds the pairs to the case. Not where the case names a law of contact, nor for bodies whose particles may convert,
/// which a
/// [[contact]] table must name.
void add_surface_contact(CaseSpec& spec, ParticleSet const& particles);

/// Particles of one body that start inside the shape of another, beyond round-off.
struct Overclosure {
  std::int64_t particles = 0;
  double depth = 0;  ///< of the deepest, from the surface of the shape [m]
};
Overclosure overclosure(CaseSpec const& spec, ParticleSet const& particles, std::size_t guest, std::size_t host);

}  // namespace piola
