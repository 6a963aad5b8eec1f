// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/formulations/observation.hpp"

/// What users see of a JST-SPH state; reads, never writes.
namespace piola::jst_sph {

struct JstObservation : Observation {
  exec::ExactSum mismatch_square;  ///< sum V (det F - volume ratio of the volumetric energy)^2
  double mismatch_max = 0;
  exec::ExactSum plastic_work;  ///< [J]
  double hourglass_energy = 0;  ///< [J]
};

void observe(JstBody const& body, JstObservation& observation);

/// Energies, momenta, extrema and the volume mismatch over all bodies.
Diagnostics finish(JstObservation const& observation);

/// The fields that JST-SPH offers to frames and probes; `solids`: with those of solids in rate form.
std::vector<FieldInfo> observed_fields(bool solids);

/// values[id * components + c] of one field for the particles of one body. Throws std::invalid_argument for an unknown
/// field.
void sample(JstBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::jst_sph
