// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include <functional>
#include <vector>

namespace piola::jst_sph {

/// Groups of SIMD lanes of a lattice that have the same neighbours and volumes, and hence the same reference data,
/// which are stored once; see FieldRef::group. Empty for bodies without a lattice.
class UniqueLaneGroups {
 public:
  /// volume(slot): of a particle; 0 for slots without one.
  UniqueLaneGroups(BodyState const& state, Index slots, int lanes, std::function<double(Index)> const& volume);

  Index stored_slots() const { return static_cast<Index>(first_.size()) * lanes_; }
  /// Per group of lanes: index of the stored group.
  std::int32_t const* stored() const { return stored_.data(); }
  /// Calls f(place, slot) for every stored place.
  template <class F>
  void each(F const& f) const {
    exec_host::parallel_for(stored_slots(), [&](Index place) {
      f(place, first_[static_cast<std::size_t>(place / lanes_)] + place % lanes_);
    });
  }
  std::size_t bytes() const { return stored_.size() * sizeof(stored_[0]); }

 private:
  int lanes_;
  std::vector<std::int32_t> stored_;
  std::vector<Index> first_;  ///< per stored group: first slot
};

}  // namespace piola::jst_sph
