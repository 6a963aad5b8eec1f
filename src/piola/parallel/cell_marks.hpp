// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// Where particles are within a cell, to a 256th of its edge.
class CellBox {
 public:
  /// place: seen from the corner of the cell [edges]; outside of 0 to 1, or not a number: they may be anywhere.
  void add(std::array<double, 3> const& place);
  /// Seen from where places are counted from; corner: of the cell [edges].
  struct Bounds {
    std::array<double, 3> low, high;
    /// Square of the least distance from a place [edges].
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

/// Which particles read something of others that are near in space, judged by cells as wide as they read: those of a
/// cell read what lies in it and in those around, as far as an edge reaches. All ranks know a few words of all others
/// about their cells, and so who reads what.
class CellMarks {
 public:
  /// Kinds of reading, as bits: what particles that flow have for each other, and what bodies that touch have.
  enum Kind : std::uint8_t { flow = 1, touch = 2 };
  static constexpr Index several = -2;

  /// What a rank says of a cell in which it has particles.
  struct Cell {
    Index cell;
    Index body;  ///< whose particles these are, or `several`
    CellBox box{};
    std::uint8_t flows = 0;  ///< 1 if one does
    /// place: as CellBox has it.
    void add(Index of_body, bool flows_too, std::array<double, 3> const& place) {
      if (body != of_body) body = several;
      if (flows_too) flows = 1;
      box.add(place);
    }
  };
  /// Particles of another rank that read what is around.
  struct Reader {
    int rank;
    Index cell;
    CellBox box;
  };

  /// shape: cells along each axis, x fastest, of which the outermost stay empty; dimension: 2 or 3.
  void start(std::array<Index, 3> const& shape, int dimension);
  /// Before finish(): a particle of a body, which flows or does not.
  void add(Index cell, Index body, bool flows) {
    auto const c = static_cast<std::size_t>(cell);
    Index const before = body_[c];
    if (before != body) body_[c] = before == nobody ? body : several;
    if (flows) flows_[c] = 1;
  }
  /// The same of all particles of a rank.
  void add(Cell const& of_rank, int rank);
  /// touching: whether bodies can touch. Then what follows may be asked.
  void finish(bool touching);

  /// What particles of a cell read: where something flows in it or around, and where bodies meet.
  std::uint8_t reads(Index cell) const { return reads_[static_cast<std::size_t>(cell)]; }
  /// What others read of particles of a cell.
  std::uint8_t told(Index cell) const { return told_[static_cast<std::size_t>(cell)]; }
  /// Those of other ranks than `own` that may read what lies in a cell, rank by rank.
  std::vector<Reader> readers(Index cell, int own) const;
  /// The other way: f(rank) for the ranks whose readers() of some cell has one of rank `own` in this cell.
  template <class F>
  void each_teller(Index cell, int own, F const& f) const {
    if (reads(cell) == 0) return;
    each_around(cell, [&](std::size_t other) {
      if (told_[other] == 0) return;
      for (Index k = first_[other]; k != none; k = said_[static_cast<std::size_t>(k)].next)
        if (int const rank = said_[static_cast<std::size_t>(k)].rank; rank != own) f(rank);
    });
  }
  std::size_t bytes() const;

 private:
  static constexpr Index nobody = -1, none = -1;
  struct Said {
    Cell cell;
    int rank;
    Index next;  ///< of the same cell
  };

  /// Whether is(cell) for a cell or one around it.
  template <class F>
  bool any_around(Index cell, F const& is) const {
    Index const row = shape_[0], layer = shape_[0] * shape_[1], deep = dimension_ == 3 ? 1 : 0;
    for (Index dz = -deep; dz <= deep; ++dz)
      for (Index dy = -1; dy <= 1; ++dy)
        for (Index dx = -1; dx <= 1; ++dx)
          if (is(static_cast<std::size_t>(cell + dz * layer + dy * row + dx))) return true;
    return false;
  }
  /// f(cell) for a cell and those around it.
  template <class F>
  void each_around(Index cell, F const& f) const {
    any_around(cell, [&](std::size_t other) {
      f(other);
      return false;
    });
  }
  /// f(cell), at once, for those that hold a particle.
  template <class F>
  void each_occupied(F const& f) const;

  std::array<Index, 3> shape_{};
  int dimension_ = 3;
  std::vector<Index> body_, first_;  // per cell; first_: of said_
  std::vector<std::uint8_t> flows_, reads_, told_;
  std::vector<Said> said_;
};

}  // namespace piola
