// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <array>
#include <vector>

namespace piola {

/// A prescribed velocity of one particle.
struct SupportRow {
  std::size_t support;
  std::array<double, 3> x;  ///< [m]
  Direction direction;
  double mass;  ///< [kg]
};

/// Distributes the impulse `rest`, a sum over all rows, to the supports. Each row gets m (d.z) d, where z is the rigid
/// motion for which these impulses sum to `rest` in all components that the rows hold.
void share_out(std::vector<SupportRow> const& rows, Impulse const& rest, std::vector<Impulse>& of_support);

}  // namespace piola
