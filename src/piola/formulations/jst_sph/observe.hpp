// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/jst_sph/body.hpp"

/// What users see of a JST-SPH state; reads, never writes.
namespace piola::jst_sph {

/// Sums over bodies that Diagnostics are made of.
struct Observation {
  Diagnostics totals;
  double pressure_square = 0;  ///< sum V p^2
  double volume = 0;           ///< sum V
  double second_difference_square = 0;
  double second_difference_count = 0;
  double mismatch_square = 0;  ///< sum V (det F - volume ratio of the volumetric energy)^2
  double mismatch_max = 0;
};

void observe(JstBody const& body, Observation& observation);

/// Energies, momenta, extrema over all bodies; pressure oscillation: rms over all lattice lines of
/// (p[i+1] - 2 p[i] + p[i-1]) / 4, divided by the volume-weighted rms of p.
Diagnostics finish(Observation const& observation);

/// The fields that JST-SPH offers to frames and probes.
std::vector<FieldInfo> observed_fields();

/// values[id * components + c] of one field for the particles of one body. Throws std::invalid_argument for an unknown
/// field.
void sample(JstBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::jst_sph
