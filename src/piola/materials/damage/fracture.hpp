// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include <array>
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// Toughness of a solid: how much energy or displacement its failure takes, whatever the spacing.
struct Fracture {
  static constexpr std::array parameters{
      Parameter{"tensile_strength", "Pa",
                "stress in uniaxial tension beyond which a crack opens, which takes fracture_energy; in nodal",
                positive, unbounded, "no cracks"},
      Parameter{"fracture_energy", "J/m^2", "energy that a crack takes per area, with tensile_strength; in nodal",
                positive, 0, "none"},
      Parameter{"fracture_displacement", "m",
                "plastic displacement over which material of damage 1 loses its strength; in nodal", positive, 0,
                "strength is lost in the time that shear waves take for two spacings"}};
  static constexpr int size = static_cast<int>(parameters.size());

  double strength;      ///< [Pa]; infinity: no cracks
  double energy;        ///< [J/m^2]
  double displacement;  ///< [m]; 0: none

  /// v: values in the order of `parameters`; a strength of 0 is none.
  PIOLA_FN explicit Fracture(double const* v)
      : strength(v[0] > 0 ? v[0] : unbounded), energy(v[1]), displacement(v[2]) {}
};

/// Softening of a band of material that a crack crosses (Z. P. Bazant, B. H. Oh, Materiaux et Constructions 16, 1983,
/// pp. 155-177): the stress falls linearly with the strain of the band, so that the crack takes the fracture energy per
/// area.
struct CrackBand {
  double strength;  ///< stress at which softening starts [Pa]
  double last;      ///< undamaged stress at which the band carries nothing any more [Pa]
  bool weakened;    ///< the band is too wide for the strength, which is lowered to keep the energy

  /// Share of the stress that is lost, 0 to 1, for the largest undamaged stress so far [Pa].
  PIOLA_FN double softening(double stress) const {
    if (!(stress > strength)) return 0;
    if (!(stress < last)) return 1;
    return last / (last - strength) * (1 - strength / stress);
  }
};

/// Least ratio of the last stress of a band to its strength.
inline constexpr double least_ratio_of_band = 1.05;

/// Band of `width` [m] for a strength [Pa], a fracture energy [J/m^2] and a modulus of stress over strain across the
/// band [Pa]: last = 2 energy modulus / (width strength).
PIOLA_FN CrackBand crack_band(double strength, double energy, double modulus, double width) {
  double const last = 2 * energy * modulus / (width * strength);
  if (last >= least_ratio_of_band * strength) return {strength, last, false};
  double const lowered = std::sqrt(2 * energy * modulus / (least_ratio_of_band * width));
  return {lowered, least_ratio_of_band * lowered, true};
}

/// Stress over strain in tension across a crack, in D dimensions: uniaxial strain, plane strain, uniaxial stress [Pa].
PIOLA_FN double modulus_across_crack(int D, double kappa, double mu) {
  if (D == 1) return kappa + 4 * mu / 3;
  double const young = 9 * kappa * mu / (3 * kappa + mu), ratio = young / (2 * mu) - 1;
  return D == 2 ? young / (1 - ratio * ratio) : young;
}

/// 2 M w [Pa^2]: w the elastic energy per volume of the tensile principal stresses alone [J/m^3], M =
/// modulus_across_crack. It is the square of the stress across a crack. Under tension along several axes a band of
/// material holds more energy than the largest principal stress tells; with w as measure the crack takes the fracture
/// energy there, too.
PIOLA_FN double squared_tension(double const (&principal)[3], double modulus, double kappa, double mu) {
  double const young = 9 * kappa * mu / (3 * kappa + mu), ratio = young / (2 * mu) - 1;
  double sum = 0, squares = 0;
  for (double const stress : principal) {
    double const tensile = stress > 0 ? stress : 0;
    sum += tensile;
    squares += tensile * tensile;
  }
  return modulus / young * ((1 + ratio) * squares - ratio * sum * sum);
}

}  // namespace piola::inline PIOLA_BACKEND
