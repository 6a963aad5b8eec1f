// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include <vector>

namespace piola::nodal {

/// Which particles of a body see each other: the straight line between them does not cross a slit or a re-entrant
/// corner. A line that only grazes a hollow surface counts as inside. All particles of a body see each other if nothing
/// is known of distances from its surface.
class LineOfSight {
 public:
  /// X: of all particles and images, in spacings h [m].
  LineOfSight(SetUp const& from, Points const& X, std::array<double, 3> const& h);

  bool is_blocked(std::size_t a, std::size_t b) const;

 private:
  /// Signed distance of a place from the surface of the whole body, negative inside [spacings].
  double depth(std::array<double, 3> X) const;

  SetUp const& from_;
  Points const& X_;
  std::array<double, 3> h_;
  double spacing_ = 1;            ///< the least [m]
  std::vector<double> distance_;  ///< of each particle, as depth(); empty: unknown
};

}  // namespace piola::nodal
