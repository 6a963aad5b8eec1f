// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/part_filled.hpp"
#include "piola/formulations/adaptle/fields.hpp"
#include "piola/formulations/adaptle/material_rows.hpp"
#include <algorithm>
#include <vector>

namespace piola::adaptle {

/// Reference neighbours of the particles of this rank, which never change as long as it has the same, and who takes
/// part in material sums, which changes whenever a particle converts.
class MaterialLists {
 public:
  /// Within 2h of each body, in order of ids, with what the sums of `settings` need; the neighbours get their places
  /// and volumes. Particles whose correction is singular keep plain gradients. own: of each body. Collective.
  void build(ParticleSet const& set, ParticleOrder const& order, std::vector<BodyConstants> const& bodies,
             std::vector<Range> const& own, Fields& fields, Settings const& settings, int lanes);

  /// Who needs a deformation gradient, and who feels material forces. Kinematic ones are marked by gap = 0, others by
  /// -1. Deleted ones leave the sums of their neighbours. phi and alive are read of all particles.
  void choose(Fields& fields, bool printed);

  /// f(b) for the reference neighbours of a within the distance [m].
  template <class F>
  void each_neighbour(Index a, double within, Fields const& fields, F const& f) const {
    for (Offset k = begin_[static_cast<std::size_t>(a)]; k < begin_[static_cast<std::size_t>(a) + 1]; ++k) {
      Index const b = neighbour_[static_cast<std::size_t>(k)];
      if (b >= particles_) continue;
      double square = 0;
      for (int c = 0; c < 3; ++c) {
        double const d = fields.X.at(b, c) - fields.X.at(a, c);
        square += d * d;
      }
      if (square <= within * within) f(b);
    }
  }

  /// f(b) for the reference neighbours b of the slots of a range.
  template <class F>
  void each_neighbour_of(Range slots, F const& f) const {
    for (Offset k = begin_[static_cast<std::size_t>(slots.first)]; k < begin_[static_cast<std::size_t>(slots.last)];
         ++k)
      if (Index const b = neighbour_[static_cast<std::size_t>(k)]; b < particles_) f(b);
  }

  void put_into(MaterialTable& table) const;
  bool built() const { return !begin_.empty(); }
  /// Whether some body has lists only, so that records are read from a table of all particles.
  bool needs_records() const {
    return std::any_of(rows_.begin(), rows_.end(), [](LatticeRows const& rows) { return !rows.has_rows(); });
  }
  int neighbours(Index a) const {
    auto const i = static_cast<std::size_t>(a);
    return static_cast<int>(begin_[i + 1] - begin_[i]) - filled_[i];
  }
  std::size_t bytes() const;

 private:
  struct OfBody {
    Body const& geometry;
    BodyConstants const& constants;
    Range own;
  };
  void list(ParticleSet const& set, ParticleOrder const& order, OfBody const& body, int lanes);
  /// f(slot) for the particles of this rank.
  template <class F>
  void each_own(F const& f) const {
    for (Range const& own : own_)
      for (Index i = own.first; i < own.last; ++i) f(i);
  }
  bool has(Index slot, Range const& own) const { return slot >= own.first && slot < own.last; }
  void find_edge();
  void mark_mixed(Fields const& fields);
  void add_pair(int dimension, double h, Index j, double square);
  void correct(Fields& fields, std::vector<BodyConstants> const& bodies, int dimension);
  void invert(Fields& fields, int dimension, bool corrected);
  template <class F>
  void sum_gradients(F const& alive, Fields& fields);
  /// s of pair k as the sums see it.
  double gradient(Offset k) const {
    auto const place = static_cast<std::size_t>(k);
    return rounded_ ? static_cast<double>(gradient_[place]) : s_[place];
  }

  Index particles_ = 0;
  bool published_ = false, rounded_ = false, deleted_ = false;
  std::vector<Range> own_;
  std::vector<Index> edge_;  ///< own particles with neighbours of other ranks
  PartFilled<Offset> begin_;
  std::vector<Index> neighbour_;
  std::vector<float> gradient_;
  std::vector<double> s_, W_;
  PartFilled<std::uint8_t> filled_;  ///< per slot: fillers at the end of its list
  PartFilled<std::uint8_t> part_;
  std::vector<LatticeRows> rows_;        ///< per body
  std::vector<MaterialRows> row_views_;  ///< per body
};

}  // namespace piola::adaptle
