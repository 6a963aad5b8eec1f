// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/state.hpp"
#include "piola/formulations/assembly.hpp"
#include <optional>
#include <vector>

namespace piola::adaptle {

enum class Description { adaptive, total_lagrangian, eulerian, patch };

/// Settings of one body in a case file.
struct BodyOptions {
  Description description = Description::adaptive;
  double smoothing_length = 1.2;           ///< h of spatial sums, in spacings
  double material_smoothing_length = 1.0;  ///< of sums over reference neighbours
  double alpha = 1, beta = 2;
  bool bulk_speed = true;  ///< viscosity with the bulk speed of sound, else that of pressure waves
  double convert_strain = 0, convert_damage = 1, jacobian_min = 0.3, jacobian_max = 3, tether = 1;
  double conversion_radius = 2;  ///< in h
  double blend = 4;              ///< width in spacings
  bool deletes = false, releases = false;
  double artificial_stress = 0.3;
  double hourglass = 0;
  double hourglass_stiffness = 0;
  double sheared_cfl = 0.3;  ///< see BodyConstants
  std::optional<Expression> eulerian_where, convert_when;
  std::optional<Expression> initial_pressure;  ///< positive in tension [Pa]
  std::optional<Expression> ignition;          ///< ignition time of an explosive [s]
  bool initial_pressure_lasts = true;
};

struct Options {
  Settings settings;
  std::vector<BodyOptions> bodies;
};

FormulationInfo info();

/// Throws InputError with all errors.
Options read_options(Assembly const& assembly);

}  // namespace piola::adaptle
