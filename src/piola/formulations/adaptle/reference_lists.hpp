// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/adaptle/axis_correction.hpp"
#include "piola/formulations/adaptle/fields.hpp"
#include "piola/formulations/adaptle/lattice_stencils.hpp"
#include <vector>

namespace piola::adaptle {

/// Reference neighbours of the local particles, constant between repartitions, and participation in material sums,
/// updated at each conversion. Images behind the axis of axisymmetric bodies are neighbours (System::image_of).
class ReferenceLists {
 public:
  /// Builds lists within 2h of each body, in order of ids, with the data for the sums of `settings`; sets positions and
  /// volumes of ghosts. Particles with a singular correction keep plain gradients. own: local slots of each body.
  /// Collective.
  void build(ParticleSet const& set, std::vector<BodyConstants> const& bodies, std::vector<Range> const& own,
             Fields& fields, Settings const& settings, int lanes);

  /// Determines which particles need a deformation gradient and which receive material forces. Kinematic ones get gap =
  /// 0, others -1. Deleted ones are removed from the sums of their neighbours. Reads phi and active of all particles.
  void choose(Fields& fields);

  /// Calls f(b) for the reference neighbours of a, and for particles whose images are, within the distance [m].
  template <class F>
  void each_neighbour(Index a, double within, Fields const& fields, F const& f) const {
    for (Offset k = begin_[static_cast<std::size_t>(a)]; k < begin_[static_cast<std::size_t>(a) + 1]; ++k) {
      Index const b = neighbour_[static_cast<std::size_t>(k)];
      if (b == particles_) continue;
      double square = 0;
      for (int c = 0; c < 3; ++c) {
        double const d = fields.X.at(b, c) - fields.X.at(a, c);
        square += d * d;
      }
      if (square <= within * within) f(source_of(b, particles_));
    }
  }

  /// Calls f(b) for the reference neighbours b of the slots of a range.
  template <class F>
  void each_neighbour_of(Range slots, F const& f) const {
    for (Offset k = begin_[static_cast<std::size_t>(slots.first)]; k < begin_[static_cast<std::size_t>(slots.last)];
         ++k)
      if (Index const b = neighbour_[static_cast<std::size_t>(k)]; b != particles_) f(source_of(b, particles_));
  }

  void put_into(MaterialTable& table);
  bool built() const { return !begin_.empty(); }
  int neighbours(Index a) const {
    auto const i = static_cast<std::size_t>(a);
    return static_cast<int>(begin_[i + 1] - begin_[i]) - filled_[i];
  }
  std::size_t bytes() const;

 private:
  struct BodyInput {
    Body const& geometry;
    BodyConstants const& constants;
    Range own;
  };
  void list(ParticleSet const& set, BodyInput const& body, int lanes);
  /// Calls f(slot) for the local particles.
  template <class F>
  void for_each_local(F const& f) const {
    for (Range const& own : own_)
      for (Index i = own.first; i < own.last; ++i) f(i);
  }
  bool has(Index slot, Range const& own) const { return slot >= own.first && slot < own.last; }
  void find_edge();
  template <int D>
  void allocate_records();
  void mark_mixed(Fields const& fields);
  void add_pair(double h, Index j, double square);
  void end_list(Index i, int lanes);
  void find_images();
  void correct_axis(std::vector<BodyConstants> const& bodies, Fields const& fields);
  double gradient_along(int axis, Index i, Offset k, Fields const& fields) const;
  void correct(Fields& fields, std::vector<BodyConstants> const& bodies, int dimension);
  void invert(Fields& fields, int dimension);
  template <class F>
  void sum_gradients(F const& active, Fields& fields);
  /// s of pair k as used by the sums.
  double gradient(Offset k) const {
    auto const place = static_cast<std::size_t>(k);
    return equations_.rounds_gradients() ? static_cast<double>(gradient_[place]) : s_[place];
  }

  Index particles_ = 0;
  EquationSet equations_;
  KernelFunction kernel_ = nullptr;
  bool deleted_ = false;
  std::vector<Range> own_;
  std::vector<Index> edge_;   ///< local particles with ghost neighbours
  std::vector<Index> image_;  ///< particles whose images behind the axis are neighbours
  AxisCorrection axis_;
  LazyZeroArray<Offset> begin_;
  std::vector<Index> neighbour_;
  std::vector<float> gradient_;
  std::vector<double> s_, W_;
  LazyZeroArray<std::uint8_t> filled_;  ///< per slot: number of fillers at the end of its list
  LazyZeroArray<std::uint8_t> part_;
  std::vector<LatticeStencils> rows_;    ///< per body
  std::vector<MaterialRows> row_views_;  ///< per body
  Memory records_;                       ///< of all particles; empty if all bodies are on lattices
};

}  // namespace piola::adaptle
