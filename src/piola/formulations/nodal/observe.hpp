// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/diagnostics_sum.hpp"
#include "piola/formulations/nodal/body.hpp"
#include <limits>

/// Observed quantities of a nodal state; read-only. Precondition: Solver::update_output_fields was called for
/// it.
namespace piola::nodal {

struct NodalDiagnosticsSum : DiagnosticsSum {
  double least_jacobian = std::numeric_limits<double>::infinity();  ///< at a point of a cell
  double repeated_steps = 0;
  double radiated_energy = 0;              ///< through non-reflecting patches [J], on all ranks alike
  exec::ReproducibleSums<1> plastic_work;  ///< [J]
  exec::ReproducibleSums<4>
      failure;              ///< failed cells; energy lost by softening [J]; area of cracks [m2]; Eulerian cells
  DiagnosticsSum of_cells;  ///< of the unsmoothed pressure of cells
};

/// Adds the local particles. Collective if the body is distributed.
void add_diagnostics(NodalBody const& body, NodalDiagnosticsSum& sum);

/// Energies, momenta and extrema over all bodies. Collective if they are distributed.
Diagnostics finish(NodalDiagnosticsSum sum);

/// The fields of nodal bodies for frames and probes; `solids`: with those of solids in rate form; `converts`: and of
/// cells that become Eulerian.
std::vector<FieldInfo> output_field_names(bool solids, bool converts);
/// Adds the history values of laws on blocks of points.
void add_fields_of_laws(NodalBody const& body, std::vector<FieldInfo>& fields);

/// Gathers one field of one body on root, values[id * components + c]. Collective if the body is distributed. Throws
/// std::invalid_argument for an unknown field.
void sample_on_root(NodalBody const& body, int body_number, std::string_view field, std::span<double> values);
/// As sample_on_root(), for the local particles only. Collective if the body is distributed.
void sample_local_slots(NodalBody const& body, int body_number, std::string_view field, std::span<double> values);

}  // namespace piola::nodal
