// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/formulation.hpp"

namespace piola::adaptle {

std::vector<FieldInfo> output_field_names();
/// values[k * components + c] of the k-th local particle.
void sample_local_slots(Particles const& particles, std::string_view field, std::span<double> values);
/// Gathers the values of all particles on rank 0, by id. Collective.
void sample(Particles const& particles, std::string_view field, std::span<double> values);
Diagnostics observe(Particles const& particles, ParticleSet const& set);

}  // namespace piola::adaptle
