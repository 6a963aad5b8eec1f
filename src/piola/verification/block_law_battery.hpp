// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/registry.hpp"
#include <string>
#include <vector>

namespace piola {

/// A check of a law on blocks of points.
struct LawCheck {
  std::string what;  ///< what must hold
  double value = 0;  ///< what was measured
  double bound = 0;  ///< the largest value allowed
  bool passed() const { return value <= bound; }
};

/// Checks that a law keeps the rules of piola_material.h and of mechanics: it writes within its arrays, gives the same
/// results alone, in blocks, twice and in several threads, is objective, has a symmetric Cauchy stress, and a stress
/// that is the derivative of its energy, or one that dissipates.
std::vector<LawCheck> check_block_law(MaterialParameters const& material);

/// Time of the law for a point and step, over a block of 4,096 points [s].
double seconds_per_point(MaterialParameters const& material);

}  // namespace piola
