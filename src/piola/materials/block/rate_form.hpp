// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/block/points.hpp"
#include "piola/materials/hypoelastic_solid.hpp"
#include "piola/materials/piola_strain.h"
#include <cmath>

/// Parts of laws in rate form with a corotated Cauchy stress.
namespace piola::block_laws {

/// Stress of a point, split.
struct SplitStress {
  SymMat<3> deviator;   ///< [Pa]
  double pressure = 0;  ///< positive in compression [Pa]
  double mises = 0;     ///< von Mises stress sqrt(3/2 s:s) [Pa]
};

/// Stress at the end of the step if it is elastic with the moduli mu and kappa [Pa].
inline SplitStress elastic_trial(piola_points const& at, int p, double mu, double kappa) {
  double d[6];
  piola_strain_increment(&at, p, d);
  double const volume = d[0] + d[1] + d[2];
  SplitStress r{symmetric_at(at.stress, at, p)};
  double const mean = (r.deviator.c[0] + r.deviator.c[1] + r.deviator.c[2]) / 3;
  for (int c = 0; c < 6; ++c) r.deviator.c[c] += 2 * mu * (c < 3 ? d[c] - volume / 3 : d[c]) - (c < 3 ? mean : 0);
  r.pressure = -mean - kappa * volume;
  r.mises = von_mises(r.deviator);
  return r;
}

/// Stores a stress whose deviator is that of `trial`, scaled to the von Mises stress `mises` [Pa].
inline void put_returned(SplitStress const& trial, double mises, double pressure, piola_points const& at, int p) {
  double const factor = trial.mises > 0 ? mises / trial.mises : 1;
  for (int c = 0; c < 6; ++c) at.stress[c * at.stride + p] = factor * trial.deviator.c[c] - (c < 3 ? pressure : 0);
}

/// Sets the speed of pressure waves from the modulus of uniaxial strain [Pa] in the current configuration.
inline void put_sound_speed(double modulus, piola_points const& at, int p) {
  at.sound_speed[p] = std::sqrt(modulus * determinant(matrix_at(at.F_new, at, p)) / at.density);
}

}  // namespace piola::block_laws
