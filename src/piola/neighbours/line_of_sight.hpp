// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <functional>
#include <utility>

namespace piola {

/// Which places of a body see each other: the straight line between them does not cross a slit or a re-entrant corner.
/// A line that only grazes a hollow surface counts as inside.
class LineOfSight {
 public:
  using Point = std::array<double, 3>;
  /// distance: signed distance from the surface, negative inside, in absolute value at most the true one [m]; empty:
  /// all places see each other. spacing: of particles [m].
  LineOfSight(std::function<double(Point const&)> distance, double spacing)
      : distance_(std::move(distance)), spacing_(spacing) {}

  /// False for places that are not in the body, as images behind mirror planes.
  bool is_blocked(Point const& a, Point const& b) const;

 private:
  std::function<double(Point const&)> distance_;
  double spacing_;
};

}  // namespace piola
