// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/registry.hpp"

namespace piola::jst_advection {

/// User options with all defaults resolved.
struct Options {
  double wave_speed = 1;  ///< c [m/s]
  double eps4 = 0.125;    ///< biharmonic coefficient
  double cfl = 0.3;       ///< alpha = c dt / h
};

/// Registry entry: keys, meanings, defaults, laws.
FormulationInfo info();

Options read_options(FormulationSpec const& spec, double cfl);

}  // namespace piola::jst_advection
