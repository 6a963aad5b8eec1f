// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_cells.hpp"
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/exec/memory.hpp"
#include "piola/formulations/adaptle/spatial_halo_exchange.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include <vector>

namespace piola::adaptle {

/// Cells, spatial neighbours and contacts of the current positions, rebuilt in every step. Total-Lagrangian particles
/// far from Eulerian ones and from other bodies get none. On several ranks each sorts its local particles and their
/// spatial ghosts.
class SpatialLists {
 public:
  /// Input from other ranks: the spatial halo exchange (null on one rank), and bounds of all particles and of those of
  /// each rank.
  struct RemoteParticles {
    SpatialHaloExchange* near = nullptr;
    CoordinateBounds all{};
    std::vector<CoordinateBounds> of_ranks{};
  };
  /// busy: increased by the time of the work on local particles [s].
  void build(System const& system, RemoteParticles const& others, Backend const& backend, double& busy);
  void put_into(System& system);
  std::size_t bytes() const;
  Index longest() const { return longest_; }
  /// Whether there are Eulerian particles or contact.
  static bool needed(System const& system) { return system.description.eulerians > 0 || touching(system); }
  static bool touching(System const& system) { return system.contact.law != ContactLaw::none && system.bodies > 1; }
  /// In the last step, per slot; 0 without a list on this rank.
  LazyZeroArray<int> neighbours_by_slot(System const& system) const;

 private:
  struct List {
    std::vector<Index> target, entry, length, found;
    Index capacity = 64;
  };
  void sort_all(System const& system);
  void sort_with_images(System const& system);
  void sort_with_ghosts(System const& system, RemoteParticles const& others);
  void choose_targets(System const& system);
  void make_room(System const& system);
  void place_results(System const& system);
  void search(System const& system, Backend const& backend, List& list, bool across);

  CellList grid_;
  HaloCells marks_;
  LazyZeroArray<std::uint8_t> near_;  ///< per sorted slot: whether another particle reads its record
  std::vector<Index> present_;        ///< axisymmetric bodies: slots of particles, and of images near the axis
  std::vector<std::int32_t> group_;
  std::vector<float> reach_;
  List spatial_, contact_;
  Memory records_, results_;
  LazyZeroArray<Index> result_of_;
  Index record_room_ = 0, longest_ = 0;
  double widest_ = 0;
  bool eulerian_ = false, overflow_ = false;
  bool all_interact_ = false;
};

}  // namespace piola::adaptle
