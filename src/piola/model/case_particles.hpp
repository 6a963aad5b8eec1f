// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/mechanics/contact/ties.hpp"
#include "piola/particles/particle_set.hpp"

namespace piola {

/// Generates the particles of a case, body after body, with its cracks. Throws InputError if a crack is impossible.
ParticleSet make_particles(CaseSpec const& spec);
/// As above; impossible cracks are added to `problems` and skipped.
ParticleSet make_particles(CaseSpec const& spec, Problems& problems);

/// Checks that require the particles: bodies without particles, regions of supports, loads and probes that select none,
/// points of probes outside their body, formulas whose value is not a finite number at a particle, initial deformation
/// gradients that turn a particle inside out, supports and mirrors that contradict each other, rigid shapes that hold
/// particles. Also cracks, mirrors, rings, rigid shapes and contact that the formulation does not support.
void check_with_particles(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

/// Pairs found by each tie of a case at the start, in the order of the ties; empty if a tie is impossible.
std::vector<contact::Ties::TieReport> found_by_ties(CaseSpec const& spec, ParticleSet const& particles);

/// Ids of a body's particles that a condition selects; all of them without a condition.
std::vector<std::int64_t> select_particles(ParticleSet const& particles, Body const& body, Expression const* where);

/// Ids of the particles that a support holds.
std::vector<std::int64_t> supported_particles(ParticleSet const& particles, Body const& body,
                                              SupportSpec const& support);

/// Particles along the patch that a support holds, with their parts of its area.
std::vector<FaceWeight> supported_weights(ParticleSet const& particles, Body const& body, SupportSpec const& support);
/// Whether a support holds a patch itself, if its formulation supports that, instead of the particles along it.
bool holds_surface(CaseSpec const& spec, SupportSpec const& support);

/// The particle of a body whose reference position is nearest to a place [m]; of several, the first. Precondition: the
/// body has particles.
std::int64_t nearest_particle(ParticleSet const& particles, Body const& body, std::array<double, 3> const& at);

/// Ids of the particles that a probe of kind stress_intensity evaluates: straight ahead of the particle nearest to
/// `at`, off that line by at most 1e-3 of the distance, at distances in [from, to] with a slack of 1e-6 of them.
std::vector<std::int64_t> particles_ahead(ParticleSet const& particles, Body const& body, ProbeSpec const& probe);

/// Ids of the particles that a load acts on; of a traction or a pressure, only those of its face.
std::vector<std::int64_t> loaded_particles(ParticleSet const& particles, Body const& body, LoadSpec const& load);
/// Particles that a traction or a pressure acts on, with their parts of the area of the face.
std::vector<FaceWeight> loaded_weights(ParticleSet const& particles, Body const& body, LoadSpec const& load);

}  // namespace piola
