// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/mechanics/contact/ties.hpp"
#include "piola/particles/particle_set.hpp"

namespace piola {

/// The particles that a case describes, body after body, with its cracks. Throws InputError where no crack can be.
ParticleSet make_particles(CaseSpec const& spec);
/// The same; cracks that cannot be are problems, and are left out.
ParticleSet make_particles(CaseSpec const& spec, Problems& problems);

/// What can be found out only with the particles: bodies without any, regions of supports, loads and probes that select
/// none, points of probes outside their body, formulas whose value is not a finite number at a particle, initial
/// deformation gradients that turn a particle inside out, supports and mirrors that contradict each other, rigid
/// shapes that hold particles. Also cracks, mirrors, rings, rigid shapes and contact that the formulation does not
/// know.
void check_regions(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

/// What the ties of a case find at the start, in their order; nothing if one of them cannot be.
std::vector<contact::Ties::Found> found_by_ties(CaseSpec const& spec, ParticleSet const& particles);

/// Ids of a body's particles that a condition selects; all of them without a condition.
std::vector<std::int64_t> select_particles(ParticleSet const& particles, Body const& body, Expression const* where);

/// Ids of the particles that a support holds.
std::vector<std::int64_t> supported_particles(ParticleSet const& particles, Body const& body,
                                              SupportSpec const& support);

/// Of a support on a patch: with their parts of it.
std::vector<FaceShare> supported_shares(ParticleSet const& particles, Body const& body, SupportSpec const& support);
/// Whether a support holds a patch itself, where its formulation can, and not the particles along it.
bool holds_surface(CaseSpec const& spec, SupportSpec const& support);

/// The particle of a body whose reference position is nearest to a place [m]; of several, the first. The body has one
/// or more.
std::int64_t nearest_particle(ParticleSet const& particles, Body const& body, std::array<double, 3> const& at);

/// Ids of the particles that a probe of kind stress_intensity looks at: straight ahead of the particle nearest to `at`,
/// off that line by at most 1e-3 of the distance, at distances in [from, to] with a slack of 1e-6 of them.
std::vector<std::int64_t> particles_ahead(ParticleSet const& particles, Body const& body, ProbeSpec const& probe);

/// Ids of the particles that a load acts on; of a traction or a pressure, only those of its face.
std::vector<std::int64_t> loaded_particles(ParticleSet const& particles, Body const& body, LoadSpec const& load);
/// Of a traction or a pressure: with their parts of the face.
std::vector<FaceShare> loaded_shares(ParticleSet const& particles, Body const& body, LoadSpec const& load);

}  // namespace piola
