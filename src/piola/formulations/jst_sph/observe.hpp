// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/formulations/observation.hpp"

/// What users see of a JST-SPH state; reads, never writes.
namespace piola::jst_sph {

struct JstObservation : Observation {
  /// sum V (det F - volume ratio of the volumetric energy)^2; [J]
  exec::ExactSums<2> mismatch_square_and_plastic_work;
  double mismatch_max = 0;
  double hourglass_energy = 0;  ///< [J]
};

/// Of the particles of this rank; collective where ranks share the body.
void observe(JstBody const& body, JstObservation& observation);

/// Energies, momenta, extrema and the volume mismatch over all bodies. Collective where ranks share them.
Diagnostics finish(JstObservation observation);

/// The fields that JST-SPH offers to frames and probes; `solids`: with those of solids in rate form.
std::vector<FieldInfo> observed_fields(bool solids);

/// values[id * components + c] of one field for the particles of one body; on ranks that share it collective, and rank
/// 0 has them. Throws std::invalid_argument for an unknown field.
void sample(JstBody const& body, int body_number, std::string_view field, std::span<double> values);
/// The same of the particles of this rank, slot by slot.
void sample_own(JstBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::jst_sph
