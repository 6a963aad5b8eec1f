// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/formulations/observation.hpp"

/// What users see of a nodal state; reads, never writes. The body's fields for observers are up to date.
namespace piola::nodal {

struct NodalObservation : Observation {
  double least_jacobian = 0;  ///< at a point of a cell
  double repeated_steps = 0;
  exec::ExactSum plastic_work;  ///< [J]
  Observation of_cells;         ///< of the pressure of cells, which is not smoothed
};

void observe(NodalBody const& body, NodalObservation& observation);

/// Energies, momenta and extrema over all bodies.
Diagnostics finish(NodalObservation const& observation);

/// The fields that nodal bodies offer to frames and probes; `solids`: with those of solids in rate form.
std::vector<FieldInfo> observed_fields(bool solids);

/// values[id * components + c] of one field for the particles of one body. Throws std::invalid_argument for an unknown
/// field.
void sample(NodalBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::nodal
