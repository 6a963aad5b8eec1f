// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace piola {

/// The particles on a straight line through a body, and why no crack can be there if so.
struct CrackPath {
  std::vector<std::int64_t> particles;          ///< ids, from one end to the other
  bool tip_at_from = false, tip_at_to = false;  ///< ends inside the body, on none of its outermost layers
  std::string problem;                          ///< empty: a crack can be opened here
  std::string key = {};                         ///< the end that is at fault, "from" or "to"; empty: the crack
};

/// Finds the particles of a two-dimensional body on the line between two points [m], within 1e-6 of the spacing. A
/// crack needs three or more particles, one at each end, each a lattice neighbour of the previous one (in a row or
/// across a cell). It must not lie on the boundary of the body or touch another crack.
CrackPath trace_crack(ParticleSet const& set, std::size_t body, std::array<double, 3> const& from,
                      std::array<double, 3> const& to);

/// Opens a crack in the last body of a set: each particle on it becomes two, one for each face, with half the tributary
/// volume each and all other data kept; a tip stays single. The original is on the left of from -> to (crack_side +1),
/// the copy (-1) at the end of the body. Throws InputError if no crack is possible.
void open_crack(ParticleSet& set, std::size_t body, std::array<double, 3> const& from, std::array<double, 3> const& to);

}  // namespace piola
