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

/// From each piece of the surface, `edge` [m] wide, straight inwards to the face that looks the other way (within 37
/// degrees); nothing where no two faces do. Tips of cones, and edges sharper than that, are as thin as the piece
/// nearest to them tells. The same for any number of threads.
std::optional<Thinnest> thinnest(Solid const& solid, double edge);

}  // namespace piola::geometry
