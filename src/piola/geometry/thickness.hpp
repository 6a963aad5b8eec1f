// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"
#include <optional>

namespace piola::geometry {

/// Where a solid is thinnest.
struct Thinnest {
  double thickness = 0;  ///< [m]
  Vec<3> X{};            ///< the middle between the two faces [m]
};

/// Measures from each piece of the surface, `edge` [m] wide, along the inward normal to a face of opposite normal
/// (within 37 degrees). Returns the thinnest place; nothing if no two faces are opposite. Tips of cones, and edges
/// sharper than that, are measured at the piece nearest to them. The result does not depend on the number of threads.
std::optional<Thinnest> thinnest(Solid const& solid, double edge);

}  // namespace piola::geometry
