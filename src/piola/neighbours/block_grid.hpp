// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/cell_sums.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// A body as blocks of a sixth of the spacing, aligned with the box around it. A block is inside if its middle is.
class BlockGrid {
 public:
  using Point = std::array<double, 3>;
  using Place = std::array<long, 3>;

  /// Keeps a reference to the outline of the body. Tests the blocks in threads.
  BlockGrid(Body const& body, int dimension);

  std::size_t dimension() const { return D_; }
  /// Rows of blocks along the first axis, and blocks of a row.
  long rows() const { return count_[1] * count_[2]; }
  long rows_in_plane() const { return count_[1]; }
  long in_row() const { return count_[0]; }
  Place place_of(long row, long i) const { return {i, row % count_[1], row / count_[1]}; }
  std::size_t index(Place const& at) const;
  Point middle(Place const& at) const;
  bool is_inside(Place const& at) const;
  /// Whether the place beside a block is beyond the box.
  bool is_beyond(Place const& at) const;
  /// Calls f(place) for the blocks inside that are in rows [first, last), row by row.
  template <class F>
  void each_inside(long first, long last, F const& f) const {
    for (long row = first; row < last; ++row)
      for (long i = 0; i < in_row(); ++i)
        if (Place const place = place_of(row, i); is_inside(place)) f(place);
  }
  /// Calls f(place) for all blocks inside.
  template <class F>
  void each_inside(F const& f) const {
    each_inside(0, rows(), f);
  }
  static Place beside(Place at, std::size_t axis, bool upper) {
    at[axis] += upper ? 1 : -1;
    return at;
  }

  /// Corners are numbered like blocks, with one more in each direction.
  std::size_t corners() const;
  std::size_t corner_index(Place const& at) const;
  Point corner_at(Place const& at) const;
  /// The corners of the side of a block, in the order of BlockSide.
  std::array<Place, 4> corners_of(Place low, std::size_t axis, bool upper) const;

 private:
  void fill_inside();

  Outline const& outline_;
  std::size_t D_;
  Place count_{1, 1, 1};
  Point edge_{};
  std::vector<char> inside_;  ///< empty: all
};

}  // namespace piola
