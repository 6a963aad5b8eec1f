// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include <array>
#include <string>

/// The columns of Lee et al. (2016) for benchmarks: rubber, 1 m x 6 m x 1 m, clamped at the foot.
namespace piola {

/// neo_hookean, 1100 kg/m^3, 17 MPa.
MaterialParameters rubber(double poissons_ratio = 0.45);

enum class Column {
  twisting,  ///< example 8.9: omega = 105 sin(pi Y / 12) rad/s about Y
  bending    ///< example 8.8: v_x = 10 Y / 6 m/s
};

/// A column as one body named "column", particles on its faces.
Assembly column(Column which, std::array<int, 3> const& particles, MaterialParameters const& material,
                FormulationSpec const& formulation, std::string const& backend);

}  // namespace piola
