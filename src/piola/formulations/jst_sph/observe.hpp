// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/diagnostics_sum.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/jst_sph/body.hpp"

/// Observed quantities of a JST-SPH state; read-only.
namespace piola::jst_sph {

struct JstDiagnosticsSum : DiagnosticsSum {
  /// sum V (det F - volume ratio of the volumetric energy)^2
  exec::ReproducibleSums<1> mismatch_square;
  double mismatch_max = 0;
};

/// Adds the local particles. Collective if the body is distributed.
void add_diagnostics(JstBody const& body, JstDiagnosticsSum& sum);

/// Energies, momenta, extrema and the volume mismatch over all bodies. Collective if they are distributed.
Diagnostics finish(JstDiagnosticsSum sum);

/// The fields of JST-SPH for frames and probes.
std::vector<FieldInfo> output_field_names();

/// Gathers one field of one body on root, values[id * components + c]. Collective if the body is distributed. Throws
/// std::invalid_argument for an unknown field.
void sample_on_root(JstBody const& body, int body_number, std::string_view field, std::span<double> values);
/// As sample_on_root(), for the local particles, slot by slot.
void sample_local_slots(JstBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::jst_sph
