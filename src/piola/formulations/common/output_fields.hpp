// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/math/tensor.hpp"
#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace piola {

/// Values of one particle for observers. A formulation fills those of the fields that it offers.
struct ParticleOutput {
  using Point = std::array<double, 3>;
  double id = 0, body = 0, neighbours = 0;
  Point displacement{}, x{}, v{};      ///< [m], [m], [m/s]
  double inertia = 0;                  ///< momentum per volume over velocity [kg/m3]
  double density = 0;                  ///< [kg/m3]
  double J = 1;                        ///< volume ratio
  double pressure = 0;                 ///< positive in tension [Pa]
  SymMat<3> cauchy{};                  ///< [Pa]
  Mat<3> P{}, F{};                     ///< first Piola-Kirchhoff stress [Pa], deformation gradient
  double cell_pressure = 0;            ///< not smoothed [Pa]
  double least_J = 1;                  ///< smallest volume ratio at the points of its cell
  double plastic_strain = 0;           ///< equivalent
  double damage = 0, kernel_type = 0;  ///< 0 to 1; 0: total-Lagrangian, 1: Eulerian
  double temperature = 0;              ///< [K]
  double specific_energy = 0;          ///< [J/kg]
  double strain_drift = 0;             ///< strain that is inconsistent with the stress
  double contact_pressure = 0;         ///< [Pa]
  double contact_gap = 0, slip = 0;    ///< [m]
  double friction_heat = 0;            ///< [J/m2]
  double law_value = 0;                ///< history value of a law on blocks of points that is asked for
};

/// A field of frames, probes and pictures.
struct OutputField {
  std::string_view word;  ///< in names of quantities, as "velocity" in "velocity_x"; empty: no quantity
  std::string_view name;  ///< VTK style
  std::string_view unit;  ///< SI, UDUNITS notation
  int components;
  void (*put)(ParticleOutput const&, double* out);  ///< nullptr: derived from other fields by any formulation
};

/// All fields; the only place where fields are declared.
std::span<OutputField const> output_field_table();

/// Returns the field of that name among the offered ones. Throws std::invalid_argument if there is none.
OutputField const& find_output_field(std::string_view name, std::span<std::string_view const> offered);

/// Descriptions of the offered fields.
std::vector<FieldInfo> field_infos(std::span<std::string_view const> offered);

/// Writes the field of one particle to values[id * components + c].
inline void put(OutputField const& field, ParticleOutput const& particle, std::span<double> values) {
  field.put(particle, &values[static_cast<std::size_t>(particle.id) * static_cast<std::size_t>(field.components)]);
}

}  // namespace piola
