// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/block_grid.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// Fits the blocks of a body to its surface. Every outer side gets the patch that it stands for, and every corner of an
/// outer side is moved onto all patches that meet there: onto the surface, an edge, or a corner of the body. Without
/// Outline::patches sides keep their steps.
class SurfaceFit {
 public:
  using Point = BlockGrid::Point;
  using Place = BlockGrid::Place;

  /// Keeps references. spacing [m].
  SurfaceFit(BlockGrid const& grid, Outline const& outline, double spacing);

  /// The side of a block inside.
  BlockSide side(Place const& place, std::size_t axis, bool upper) const;
  /// Patch of an outer side; -1: not known.
  int patch(Place const& place, std::size_t axis, bool upper) const;
  double farthest_move() const { return farthest_; }  ///< [spacings]
  std::int64_t unmoved() const { return unmoved_; }   ///< corners that would have moved too far

 private:
  struct OuterSide {
    Place place;
    std::size_t axis;
    bool upper;
    int patch = -1;
    bool operator<(OuterSide const& other) const;
  };
  /// A corner of outer sides, and the patches that meet there.
  struct Corner {
    std::vector<int> patches;
    Point X{};
  };

  void collect_corners();
  void label(OuterSide& side) const;
  double move(Corner& corner) const;
  void step(Corner const& corner, Point& X) const;
  double exact_height(Point const& X, double height) const;

  BlockGrid const& grid_;
  Outline const& outline_;
  double h_;
  std::vector<OuterSide> outer_;
  std::vector<Corner> corners_;
  std::vector<std::int32_t> corner_number_;  ///< of all corners of blocks; -1: not at the surface
  double farthest_ = 0;
  std::int64_t unmoved_ = 0;
};

}  // namespace piola
