// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/actions.hpp"
#include "piola/mechanics/prescribed.hpp"
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

/// Adds to the supports what rows bear of an impulse of which only the sum is known: m (d.z) d of each, z being the
/// rigid motion for which they sum to `rest` in all that the rows hold.
void share_out(std::vector<SupportRow> const& rows, Impulse const& rest, std::vector<Impulse>& of_support);

}  // namespace piola
