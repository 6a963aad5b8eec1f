// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/observation.hpp"
#include "piola/formulations/taylor_sph/body.hpp"
#include <span>

/// What users see of a Taylor-SPH state; reads, never writes.
namespace piola::taylor_sph {

void observe(TaylorBody const& body, ParticleSet const& set, Observation& observation);

/// The fields that Taylor-SPH offers to frames and probes.
std::vector<FieldInfo> observed_fields();

/// values[id * components + c] of one field for the particles of one body. Throws std::invalid_argument for an unknown
/// field.
void sample(TaylorBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::taylor_sph
