// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/formulations/observation.hpp"
#include <limits>

/// Observed quantities of a nodal state; read-only. Precondition: the body's fields for observers are up to date.
namespace piola::nodal {

struct NodalObservation : Observation {
  double least_jacobian = std::numeric_limits<double>::infinity();  ///< at a point of a cell
  double repeated_steps = 0;
  exec::ExactSums<1> plastic_work;  ///< [J]
  Observation of_cells;             ///< of the unsmoothed pressure of cells
};

/// Adds the local particles. Collective if the body is distributed.
void observe(NodalBody const& body, NodalObservation& observation);

/// Energies, momenta and extrema over all bodies. Collective if they are distributed.
Diagnostics finish(NodalObservation observation);

/// The fields of nodal bodies for frames and probes; `solids`: with those of solids in rate form.
std::vector<FieldInfo> observed_fields(bool solids);

/// Gathers one field of one body on rank 0, values[id * components + c]. Collective if the body is distributed. Throws
/// std::invalid_argument for an unknown field.
void sample(NodalBody const& body, int body_number, std::string_view field, std::span<double> values);
/// As sample(), for the local particles only. Collective if the body is distributed.
void sample_own(NodalBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::nodal
