// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include "piola/parallel/rank_set.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// Which particles read something of others that are near in space, judged by cells as wide as they read: those of a
/// cell read what lies in it and in those around. All of a cell are judged alike, from a few words of all ranks about
/// their cells, so that all know who reads what.
class CellMarks {
 public:
  /// Kinds of reading, as bits: what particles that flow have for each other, and what bodies that touch have.
  enum Kind : std::uint8_t { flow = 1, touch = 2 };

  /// What a rank says of a cell in which it has particles.
  struct Cell {
    Index cell, particles;
    Index body;   ///< whose particles these are, or `several`
    Index flows;  ///< 1 if one does
    void add(Index of_body, bool flows_too) {
      particles += 1;
      if (body != of_body) body = several;
      if (flows_too) flows = 1;
    }
  };
  static constexpr Index several = -2;

  /// shape: cells along each axis, x fastest, of which the outermost stay empty; dimension: 2 or 3. owners: whether
  /// it matters who has what.
  void start(std::array<Index, 3> const& shape, int dimension, bool owners);
  /// Before finish(): a particle of a body, which flows or does not, and whose it is.
  void add(Index cell, Index body, bool flows) {
    auto const c = static_cast<std::size_t>(cell);
    Index const before = body_[c];
    if (before != body) body_[c] = before == nobody ? body : several;
    if (flows) flows_[c] = 1;
  }
  void add(Cell const& of_rank, int rank) {
    add(of_rank.cell, of_rank.body, of_rank.flows != 0);
    owners_[static_cast<std::size_t>(of_rank.cell)].add(rank);
  }
  /// touching: whether bodies can touch. Then what follows may be asked.
  void finish(bool touching);

  /// What particles of a cell read: where something flows in it or around, and where bodies meet.
  std::uint8_t reads(Index cell) const { return reads_[static_cast<std::size_t>(cell)]; }
  /// What others read of particles of a cell.
  std::uint8_t told(Index cell) const { return told_[static_cast<std::size_t>(cell)]; }
  /// The ranks of those who read something in a cell.
  RankSet readers(Index cell) const;
  std::size_t bytes() const;

 private:
  static constexpr Index nobody = -1;

  /// f(cell) for a cell and those around it.
  template <class F>
  void each_around(Index cell, F const& f) const {
    Index const row = shape_[0], layer = shape_[0] * shape_[1], deep = dimension_ == 3 ? 1 : 0;
    for (Index dz = -deep; dz <= deep; ++dz)
      for (Index dy = -1; dy <= 1; ++dy)
        for (Index dx = -1; dx <= 1; ++dx) f(static_cast<std::size_t>(cell + dz * layer + dy * row + dx));
  }
  /// f(cell), at once, for those that hold a particle.
  template <class F>
  void each_occupied(F const& f) const;

  std::array<Index, 3> shape_{};
  int dimension_ = 3;
  std::vector<Index> body_;
  std::vector<std::uint8_t> flows_, reads_, told_;
  std::vector<RankSet> owners_;
};

}  // namespace piola
