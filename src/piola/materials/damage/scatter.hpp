// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include "piola/math/hash.hpp"
#include <array>
#include <cmath>
#include <cstdint>

namespace piola::inline PIOLA_BACKEND {

/// Scatter of the failure strength between particles of one material (W. Weibull, J. Appl. Mech. 18, 1951, pp.
/// 293-297): fracture strains, spall pressures and tensile strengths are multiplied by x, with the probability 1 -
/// exp(-ln 2 (V/V0) x^m) to be below x in a volume V. In the volume V0 half of them fail at the numbers of the
/// material. Larger volumes fail sooner, so that finer particles do not strengthen the body.
struct Scatter {
  static constexpr std::array parameters{
      Parameter{"weibull_modulus", "1",
                "m, of the scatter of fracture strains, spall pressures and tensile strengths between particles",
                positive, unbounded, "no scatter"},
      Parameter{"weibull_volume", "m^3", "V0, volume in which half fail at the numbers of the material", positive, 0,
                "that of a particle"},
      Parameter{"weibull_seed", "1", "another number makes another draw", Interval{0, 1e9}, 1}};
  static constexpr int size = static_cast<int>(parameters.size());

  double modulus;  ///< infinity: all are alike
  double volume;   ///< [m^3]; 0: that of the particle
  double seed;

  /// v: values in the order of `parameters`.
  PIOLA_FN explicit Scatter(double const* v) : modulus(v[0] > 0 ? v[0] : unbounded), volume(v[1]), seed(v[2]) {}

  /// The factor of a particle of a volume [m^3]: a function of its number and the seed alone.
  double factor(std::uint64_t particle, double own_volume) const {
    if (!(modulus < unbounded)) return 1;
    double const chance = uniform(static_cast<std::uint64_t>(seed), particle),
                 share = volume > 0 ? volume / own_volume : 1;
    return std::pow(share * -std::log(chance) / std::log(2.0), 1 / modulus);
  }
};

}  // namespace piola::inline PIOLA_BACKEND
