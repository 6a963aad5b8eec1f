// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/memory.hpp"
#include "piola/exec/part_filled.hpp"
#include "piola/formulations/adaptle/near_exchange.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/parallel/cell_marks.hpp"
#include <vector>

namespace piola::adaptle {

/// Cells, spatial neighbours and contacts of the current positions, made anew in every step. Particles that are
/// total-Lagrangian and far from Eulerian ones and from other bodies get none. Of a run on several ranks each sorts
/// its own particles and those of others that it reads.
class SpatialLists {
 public:
  /// Of a run on several ranks what these have to say; near: null on one rank.
  struct Others {
    NearExchange* near = nullptr;
    CoordinateBounds bounds{};  ///< of the particles of all
  };
  /// busy: grows by the time of what each rank does for its own particles alone [s].
  void build(System const& system, Others const& others, Machine const& machine, double& busy);
  void put_into(System& system);
  std::size_t bytes() const;
  Index longest() const { return longest_; }
  bool overflow() const { return overflow_; }  ///< a particle has more neighbours than can be listed
  /// Whether there is anything to list.
  static bool needed(System const& system) { return system.eulerians > 0 || touching(system); }
  static bool touching(System const& system) { return system.contact.law > 0 && system.bodies > 1; }
  double widest() const { return widest_; }  ///< edge of a cell [m]
  /// Of the last step, per slot; 0 where this rank has no list.
  PartFilled<int> neighbours_by_slot(System const& system) const;

 private:
  struct List {
    std::vector<Index> target, entry, length, found;
    Index capacity = 64;
  };
  void sort_all(System const& system);
  void sort_with_others(System const& system, Others const& others);
  void choose_targets(System const& system);
  void make_room(System const& system);
  void place_results(System const& system);
  void search(System const& system, Machine const& machine, List& list, bool across);

  MovingGrid grid_;
  CellMarks marks_;
  PartFilled<std::uint8_t> near_;  ///< per slot that is sorted: whether somebody reads its record
  std::vector<std::int32_t> group_;
  std::vector<float> reach_;
  List spatial_, contact_;
  Memory records_, results_;
  PartFilled<Index> result_of_;
  Index record_room_ = 0, longest_ = 0;
  double widest_ = 0;
  bool eulerian_ = false, overflow_ = false;
  bool everyone_ = false;
};

}  // namespace piola::adaptle
