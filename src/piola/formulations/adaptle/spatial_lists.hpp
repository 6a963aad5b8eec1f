// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/memory.hpp"
#include "piola/exec/part_filled.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include <vector>

namespace piola::adaptle {

/// Cells, spatial neighbours and contacts of the current positions, made anew in every step. Particles that are
/// total-Lagrangian and far from Eulerian ones and from other bodies get none.
class SpatialLists {
 public:
  /// busy: grows by the time of what each rank does for its own particles alone [s].
  void build(System const& system, Machine const& machine, double& busy);
  void put_into(System& system);
  std::size_t bytes() const;
  Index longest() const { return longest_; }
  bool overflow() const { return overflow_; }  ///< a particle has more neighbours than can be listed
  /// Whether there is anything to list.
  static bool needed(System const& system) { return system.eulerians > 0 || touching(system); }
  static bool touching(System const& system) { return system.contact.law > 0 && system.bodies > 1; }
  /// Whether particles of other slots read what this one says of itself: in spatial sums, and in contacts.
  bool near(Index slot) const { return everyone_ || near_[static_cast<std::size_t>(slot)] != 0; }
  bool meets(Index slot) const { return meets_[static_cast<std::size_t>(slot)] != 0; }
  /// Of the last step, per slot; 0 where this rank has no list.
  PartFilled<int> neighbours_by_slot(System const& system) const;

 private:
  struct List {
    std::vector<Index> target, entry, length, found;
    Index capacity = 64;
  };
  void mark_cells(System const& system);
  void choose_targets(System const& system);
  void place_results(System const& system);
  void search(System const& system, Machine const& machine, List& list, bool across);

  MovingGrid grid_;
  std::vector<std::uint8_t> cell_has_eulerian_, cell_near_, near_, meets_;
  std::vector<std::int32_t> cell_low_, cell_high_, group_;
  std::vector<float> reach_;
  List spatial_, contact_;
  Memory records_, results_;
  std::vector<Index> result_of_;
  Index record_room_ = 0, longest_ = 0;
  double widest_ = 0;
  bool eulerian_ = false, overflow_ = false;
  bool everyone_ = false;  ///< every particle is a target
};

}  // namespace piola::adaptle
