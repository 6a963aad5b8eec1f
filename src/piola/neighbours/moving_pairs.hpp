// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <array>
#include <cstdint>
#include <vector>

/// Neighbours of particles that move: cells by counting sort in every step, then a search in single precision.
namespace piola {

/// What a search reads and writes: plain data that crosses between machines. Particles are sorted by cell.
struct MovingSearch {
  int dimension = 3;
  Index sources = 0;
  float const* place[3] = {};           ///< coordinates in units of a cell
  std::int32_t const* group = nullptr;  ///< of each sorted particle: null: all pairs
  bool across = false;                  ///< pairs of different groups, else of the same group
  Index const* cell = nullptr;          ///< of each sorted particle: its cell, x fastest
  Index const* begin = nullptr;         ///< first particle of each cell, one more at the end
  std::array<Index, 3> cells{};         ///< along each axis, with one empty layer around
  float const* reach = nullptr;         ///< squared radius of the search of each group (or one), in cells
  Index targets = 0;
  Index const* target = nullptr;  ///< sorted numbers
  Index capacity = 0;
  Index* list = nullptr;    ///< [target][capacity]
  Index* length = nullptr;  ///< found, filled up to whole lanes; more than the capacity: not stored
  Index* found = nullptr;   ///< without filling
};

/// Particles sorted by cubic cells, cell by cell with x fastest; within a cell in an order that is given.
class MovingGrid {
 public:
  /// x: positions, `stride` doubles apart. cell: edge [m], not below the largest search radius. origin: a corner of
  /// cells [m]. With the same edge and origin the order does not depend on how far the particles reach, and pairs at
  /// the edge of the search hardly do. Particles far outside of the others share cells at the border, which costs time
  /// but loses no pair. order: where the first, second, ... particle of a cell stands in x; null: as in x.
  void sort(double const* x, std::ptrdiff_t stride, Index particles, int dimension, double cell,
            std::array<double, 3> const& origin = {}, Index const* order = nullptr);

  Index const* slots() const { return slot_.data(); }     ///< of each sorted particle
  Index const* sorted() const { return sorted_.data(); }  ///< of each particle
  Index const* cells() const { return cell_.data(); }     ///< of each sorted particle
  Index const* begins() const { return begin_.data(); }
  Index cell_count() const { return static_cast<Index>(begin_.size()) - 1; }
  std::array<Index, 3> shape() const { return count_; }
  float const* place(int axis) const { return place_[static_cast<std::size_t>(axis)].data(); }
  /// Largest error of a distance in `place`, in cells.
  double slack() const { return slack_; }
  std::size_t bytes() const;

 private:
  std::array<Index, 3> count_{};
  double slack_ = 0;
  std::vector<Index> slot_, sorted_, cell_, begin_, key_;
  std::array<std::vector<float>, 3> place_;
};

}  // namespace piola
