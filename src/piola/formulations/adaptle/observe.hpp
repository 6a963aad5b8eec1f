// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/formulation.hpp"

namespace piola::adaptle {

std::vector<FieldInfo> output_field_names();
/// values[k * components + c] of the k-th local particle.
void sample_local_slots(Particles const& particles, std::string_view field, std::span<double> values);
/// As Observables::sample(). Collective.
void sample(Particles const& particles, std::string_view field, std::span<double> values);
Diagnostics observe(Particles const& particles, ParticleSet const& set);

}  // namespace piola::adaptle
