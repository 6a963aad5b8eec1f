// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/formulations/observation.hpp"
#include <limits>

/// What users see of a nodal state; reads, never writes. The body's fields for observers are up to date.
namespace piola::nodal {

struct NodalObservation : Observation {
  double least_jacobian = std::numeric_limits<double>::infinity();  ///< at a point of a cell
  double repeated_steps = 0;
  exec::ExactSums<1> plastic_work;  ///< [J]
  Observation of_cells;             ///< of the pressure of cells, which is not smoothed
};

/// Of the particles of this rank; collective where ranks share the body.
void observe(NodalBody const& body, NodalObservation& observation);

/// Energies, momenta and extrema over all bodies. Collective where ranks share them.
Diagnostics finish(NodalObservation observation);

/// The fields that nodal bodies offer to frames and probes; `solids`: with those of solids in rate form.
std::vector<FieldInfo> observed_fields(bool solids);

/// values[id * components + c] of one field for the particles of one body; on ranks that share it collective, and rank
/// 0 has them. Throws std::invalid_argument for an unknown field.
void sample(NodalBody const& body, int body_number, std::string_view field, std::span<double> values);
/// Of the particles of this rank alone. Collective where ranks share the body.
void sample_own(NodalBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::nodal
