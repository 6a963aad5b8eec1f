// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/registry.hpp"
#include "piola/materials/registry.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace piola {

/// Particles whose velocity is held at zero in some directions.
struct Support {
  std::vector<std::int64_t> particles;  ///< ids
  std::array<bool, 3> fix{};
};

/// Everything that a formulation is built from: plain numbers in Id order, no input text.
struct Assembly {
  ParticleSet particles;
  std::vector<MaterialParameters> materials;                ///< one per body
  std::vector<FormulationSpec> formulations;                ///< one per body
  std::vector<std::array<double, 3>> initial_velocity;      ///< m/s, one per particle, or empty: at rest
  std::vector<std::array<double, 3>> initial_displacement;  ///< m, one per particle, or empty: none
  std::vector<std::array<double, 9>>
      initial_deformation_gradient;  ///< row by row, one per particle, or empty: from the displacement
  std::vector<Support> supports;
  double cfl = std::numeric_limits<double>::quiet_NaN();  ///< nan: the scheme's default
  std::string machine = "auto";                           ///< instruction set: auto, scalar, v2, v3, v4
};

}  // namespace piola
