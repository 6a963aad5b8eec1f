// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"

namespace piola {

/// The particles that a case describes, body after body.
ParticleSet make_particles(CaseSpec const& spec);

/// What can be found out only with the particles: bodies without any, regions of supports, loads and probes that select
/// none, points of probes outside their body, formulas whose value is not a finite number at a particle, initial
/// deformation gradients that turn a particle inside out, supports and mirrors that contradict each other.
void check_regions(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

/// Ids of a body's particles that a condition selects; all of them without a condition.
std::vector<std::int64_t> select_particles(ParticleSet const& particles, Body const& body, Expression const* where);

/// Ids of the particles that a load acts on; of a traction, only those of its face.
std::vector<std::int64_t> loaded_particles(ParticleSet const& particles, Body const& body, LoadSpec const& load);

}  // namespace piola
