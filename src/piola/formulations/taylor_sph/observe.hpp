// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/diagnostics_sum.hpp"
#include "piola/formulations/taylor_sph/body.hpp"
#include <span>
#include <vector>

/// Observed quantities of a Taylor-SPH state; read-only.
namespace piola::taylor_sph {

void add_diagnostics(TaylorBody const& body, ParticleSet const& set, DiagnosticsSum& sum);

/// Strain that is inconsistent with the stress, by particle; zeros in the fixed configuration.
std::vector<double> strain_drift(TaylorBody const& body);

/// The fields of Taylor-SPH for frames and probes.
std::vector<FieldInfo> output_field_names();

/// values[id * components + c] of one field for the particles of one body. Throws std::invalid_argument for an unknown
/// field.
void sample(TaylorBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::taylor_sph
