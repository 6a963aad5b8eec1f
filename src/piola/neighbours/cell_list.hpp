// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

/// Neighbours of particles that move: cells by counting sort in every step, then a search in single precision.
namespace piola {

/// Input and output of a search. Plain data, so that code of different instruction sets may exchange it. Does not own
/// its arrays. Particles are sorted by cell.
struct CellListSearch {
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

/// Bounds of the finite coordinates of points along each axis; no points: low > high.
struct CoordinateBounds {
  std::array<double, 3> low, high;
  bool all_finite = true;  ///< whether no other coordinates were seen
  CoordinateBounds();
  void add(std::size_t axis, double at_least, double at_most) {
    low[axis] = at_least < low[axis] ? at_least : low[axis];
    high[axis] = at_most > high[axis] ? at_most : high[axis];
  }
  void add(CoordinateBounds const& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) add(axis, other.low[axis], other.high[axis]);
    all_finite = all_finite && other.all_finite;
  }
};

/// Some slots in an order; null: the first `count` of them.
struct SlotList {
  Index count = 0;
  Index const* slot = nullptr;
  Index operator[](Index k) const { return slot != nullptr ? slot[k] : k; }
};

/// x: positions, `stride` doubles apart.
CoordinateBounds bounds_of(double const* x, std::ptrdiff_t stride, SlotList const& some, int dimension);

/// Particles sorted by cubic cells, cell by cell with x fastest; within a cell in an order that is given.
class CellList {
 public:
  /// Returns the coordinates of all particles along an axis. Called only if few particles are far from the rest.
  using Coordinates = std::function<std::vector<double>(std::size_t axis)>;
  /// Places the cells. all: bounds of `particles` particles. cell: edge [m], not below the largest search radius.
  /// origin: a corner of cells [m]. For fixed edge and origin, the order does not depend on the extent of the
  /// particles, and pairs at the edge of the search hardly do. Outlying particles share cells at the border, which
  /// costs time but loses no pair.
  void lay(CoordinateBounds const& all, Index particles, int dimension, double cell,
           std::array<double, 3> const& origin, Coordinates const& coordinates);
  /// Finds the cells of the particles in `some`. x: positions, `stride` doubles apart; must stay valid until sort().
  void find_cells(double const* x, std::ptrdiff_t stride, SlotList const& some);
  /// Calls lay() and find_cells() for all particles.
  void find_cells(double const* x, std::ptrdiff_t stride, Index particles, int dimension, double cell,
                  std::array<double, 3> const& origin = {});
  /// Sorts the particles in `some` by cell. Within a cell the order of `some` is kept. Precondition: find_cells() for
  /// them.
  void sort(SlotList const& some);

  Index const* keys() const { return key_.data(); }                 ///< of each particle: its cell
  Index count() const { return static_cast<Index>(slot_.size()); }  ///< sorted particles
  Index const* slots() const { return slot_.data(); }               ///< of each sorted particle
  Index const* sorted() const { return sorted_.data(); }            ///< of each particle that is sorted
  Index const* cells() const { return cell_.data(); }               ///< of each sorted particle
  Index const* begins() const { return begin_.data(); }
  /// Position of a particle, and corner of a cell, relative to the origin [edges].
  std::array<double, 3> where(Index slot) const;
  std::array<double, 3> corner(Index cell) const;
  /// Indices along each axis of a cell, and of the cell that holds a position [m]. They start at 1, those of unused
  /// axes are 0. A position that is not a number is in the first cell.
  std::array<Index, 3> indices_of(Index cell) const;
  std::array<Index, 3> indices_of(std::array<double, 3> const& x) const;
  Index cell_count() const { return count_[0] * count_[1] * count_[2]; }
  std::array<Index, 3> shape() const { return count_; }
  float const* place(int axis) const { return place_[static_cast<std::size_t>(axis)].data(); }
  /// Largest error of a distance in `place`, in cells.
  double slack() const { return slack_; }
  /// Largest distance at which pairs can be found [edges].
  double search_radius_in_cells() const { return (1 + slack_) * (1 + 1e-6); }
  std::size_t bytes() const;

 private:
  /// Cells [low, low + count) along an axis. Whole numbers; what lies outside falls into the cells at the border.
  struct Span {
    double low = 0, count = 1;
  };
  Span span(CoordinateBounds const& bounds, std::size_t axis) const;
  void fit(CoordinateBounds const& bounds, Coordinates const& coordinates);
  double in_cells(double x, std::size_t axis) const { return (x - origin_[axis]) / cell_edge_; }
  double kept(double x, std::size_t axis) const;
  Index index_along(double x, std::size_t axis) const;

  double const* x_ = nullptr;
  std::ptrdiff_t stride_ = 3;
  Index particles_ = 0;
  std::size_t dimension_ = 3;
  double cell_edge_ = 1;
  std::array<double, 3> origin_{}, base_{};  // base_: of places in single precision [cells]
  std::array<Span, 3> span_;
  std::array<Index, 3> count_{};
  double slack_ = 0;
  std::vector<Index> slot_, cell_, begin_;
  LazyZeroArray<Index> sorted_, key_;  // per particle
  std::array<std::vector<float>, 3> place_;
};

}  // namespace piola
