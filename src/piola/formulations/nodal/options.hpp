// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/registry.hpp"
#include "piola/materials/registry.hpp"
#include <optional>
#include <vector>

namespace piola::nodal {

/// User options with all defaults resolved.
struct Options {
  double least_mass = 0.3;                ///< of a particle, over that of its cell
  double fluctuation_viscosity = 0;       ///< see Viscosity
  std::optional<double> shock_viscosity;  ///< coefficient of the viscous pressure of shocks; empty: that of the law
  bool viscous = false;                   ///< whether cells store viscous stresses beside those of solids in rate form
  double energy_tolerance = 1e-3;         ///< error of Verlet steps, relative to the largest energy; 0: any
  bool solids = false;                    ///< whether some material is a solid in rate form
  int block_history = -1;                 ///< see FieldNeeds
  bool failure = false;                   ///< whether cells may fail
  bool converts = false;                  ///< whether such cells become Eulerian
  bool conducts = false;                  ///< whether heat is conducted
  double convert_strain = unbounded;      ///< equivalent strain at which others do
  bool implicit_pressure = false;
  bool stress_free = false;  ///< plane stress, uniaxial stress
  double cfl = 0;            ///< step in units of spacing over p-wave speed at rest; 0: from the stability limit
};

/// Registry entry: keys, meanings, defaults, laws.
FormulationInfo info();

/// Options of a body with these materials: the main one and those of its parts. Throws InputError for unusable laws.
Options read_options(FormulationSpec const& spec, std::vector<MaterialParameters> const& materials, int dimension,
                     double cfl);

}  // namespace piola::nodal
