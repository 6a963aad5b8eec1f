// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// Bounding box of particles within a cell, rounded outwards to 1/256 of its edge.
class QuantisedBounds {
 public:
  /// place: position relative to the corner of the cell [edges]. A position outside 0 to 1, or NaN, makes the box
  /// unbounded.
  void add(std::array<double, 3> const& place);
  /// Bounds relative to the origin of `corner` [edges].
  struct Bounds {
    std::array<double, 3> low, high;
    /// Squared distance of a position from the box [edges^2]; 0 inside.
    double square_from(std::array<double, 3> const& place) const {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        double const below = low[c] - place[c], above = place[c] - high[c];
        double const outside = below > 0 ? below : above > 0 ? above : 0;
        sum += outside * outside;
      }
      return sum;
    }
  };
  Bounds bounds(std::array<double, 3> const& corner) const;

 private:
  std::array<std::uint8_t, 3> low_{255, 255, 255}, high_{0, 0, 0};
  std::uint8_t anywhere_ = 0;
};

/// Determines the spatial halo from cells whose edge is the search radius. A particle reads particles of its own and
/// the adjacent cells. A rank derives which ranks need its particles from its local cells and the remote cells around
/// them.
class HaloCells {
 public:
  /// Reasons for reading, as bits: Eulerian particles in or next to the cell, contact between bodies.
  enum Kind : std::uint8_t { flow = 1, touch = 2 };
  static constexpr Index several = -2;

  /// Summary of the particles of one rank in one cell.
  struct Cell {
    Index cell;
    Index body;  ///< body of these particles, or `several`
    QuantisedBounds box{};
    std::uint8_t is_eulerian = 0;  ///< 1 if a particle is Eulerian
    /// place: see QuantisedBounds::add().
    void add(Index of_body, bool is_eulerian_too, std::array<double, 3> const& place) {
      if (body != of_body) body = several;
      if (is_eulerian_too) is_eulerian = 1;
      box.add(place);
    }
  };
  /// A cell of another rank whose particles read particles of the adjacent cells.
  struct Reader {
    int rank;
    Index cell;
    QuantisedBounds box;
  };

  /// Clears all cells. shape: cells along each axis, x fastest; the outermost layer must stay empty. dimension: 2 or 3.
  void start(std::array<Index, 3> const& shape, int dimension);
  /// Adds a particle of a body. Precondition: before finish().
  void add(Index cell, Index body, bool is_eulerian) {
    auto const c = static_cast<std::size_t>(cell);
    Index const before = body_[c];
    if (before != body) body_[c] = before == no_body ? body : several;
    if (is_eulerian) has_eulerian_[c] = 1;
  }
  /// Adds the summary of a cell of one rank. Precondition: before finish().
  void add(Cell const& of_rank, int rank);
  /// Derives what each cell reads and exports. touching: bodies can be in contact. Precondition of all queries below.
  void finish(bool touching);

  /// Kinds that particles of a cell read: `flow` if a particle in or around it is Eulerian, `touch` if several bodies
  /// are.
  std::uint8_t reads(Index cell) const { return reads_[static_cast<std::size_t>(cell)]; }
  /// Kinds for which particles of a cell are read by particles in it or around it.
  std::uint8_t exports(Index cell) const { return exports_[static_cast<std::size_t>(cell)]; }
  /// Cells of other ranks than `own` whose particles may read particles of `cell`, sorted by rank.
  std::vector<Reader> readers(Index cell, int own) const;
  /// Calls f(rank) for each rank other than `own` with exported particles in this cell or around it; does nothing if
  /// the cell reads nothing. The counterpart of readers(). A rank may be visited several times.
  template <class F>
  void each_exporter(Index cell, int own, F const& f) const {
    if (reads(cell) == 0) return;
    each_around(cell, [&](std::size_t other) {
      if (exports_[other] == 0) return;
      for (Index k = first_[other]; k != none; k = said_[static_cast<std::size_t>(k)].next)
        if (int const rank = said_[static_cast<std::size_t>(k)].rank; rank != own) f(rank);
    });
  }
  std::size_t bytes() const;

 private:
  static constexpr Index no_body = -1, none = -1;
  struct OccupancyRecord {
    Cell cell;
    int rank;
    Index next;  ///< next entry of the same cell
  };

  /// Returns whether is(c) holds for `cell` or an adjacent cell.
  template <class F>
  bool any_around(Index cell, F const& is) const {
    Index const row = shape_[0], layer = shape_[0] * shape_[1], deep = dimension_ == 3 ? 1 : 0;
    for (Index dz = -deep; dz <= deep; ++dz)
      for (Index dy = -1; dy <= 1; ++dy)
        for (Index dx = -1; dx <= 1; ++dx)
          if (is(static_cast<std::size_t>(cell + dz * layer + dy * row + dx))) return true;
    return false;
  }
  /// Calls f(c) for `cell` and all adjacent cells.
  template <class F>
  void each_around(Index cell, F const& f) const {
    any_around(cell, [&](std::size_t other) {
      f(other);
      return false;
    });
  }
  /// Calls f(cell), in parallel, for all occupied cells.
  template <class F>
  void each_occupied(F const& f) const;

  std::array<Index, 3> shape_{};
  int dimension_ = 3;
  std::vector<Index> body_, first_;  // per cell; first_: index into said_
  std::vector<std::uint8_t> has_eulerian_, reads_, exports_;
  std::vector<OccupancyRecord> said_;
};

}  // namespace piola
