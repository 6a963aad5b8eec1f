// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"

namespace piola::geometry {

/// The volume [m3; 2D m2]: exact_volume() of the solid if it has one. Otherwise the sum over blocks of an eighth of
/// `spacing` [m], each weighted by its inner fraction from distance and normal at its centre (errors of 1e-4 and less).
double volume_of(Solid const& solid, double spacing);

/// A patch of the surface, added up.
struct PatchFacts {
  std::string name;
  double area = 0;     ///< [m2; 2D m]
  Vec<3> centre{};     ///< [m]
  Vec<3> direction{};  ///< sum of its vector areas over the area: of length 1 if flat, 0 if closed
};

/// The patches with an area, in order, from pieces of `edge` [m].
std::vector<PatchFacts> patch_facts(Solid const& solid, double edge);

}  // namespace piola::geometry
