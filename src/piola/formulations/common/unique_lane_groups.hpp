// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/exec/lazy_zero_array.hpp"
#include <cstdint>
#include <functional>
#include <vector>

namespace piola {

/// Groups of SIMD lanes of a lattice that have the same reference data, which are stored once per distinct group; see
/// FieldRef::group.
struct UniqueLaneGroups {
  /// Groups the lanes of `slots`; the body has `all_slots` slots. add_key(first, key) adds to `key` the numbers that
  /// determine the reference data of the group whose first slot is `first`.
  UniqueLaneGroups(Range slots, Index all_slots, int group_lanes,
                   std::function<void(Index first, std::vector<double>& key)> const& add_key);

  Index stored_slots() const { return static_cast<Index>(first.size()) * lanes; }
  /// Index at which data of a slot are stored.
  Index place(Index slot) const { return stored[static_cast<std::size_t>(slot / lanes)] * lanes + slot % lanes; }
  /// Calls f(place, particle) for each stored place of the first `particles` slots, in parallel.
  template <class F>
  void each(Index particles, F const& f) const {
    exec_host::parallel_for(stored_slots(), [&](Index at) {
      Index const particle = first[static_cast<std::size_t>(at / lanes)] + at % lanes;
      if (particle < particles) f(at, particle);
    });
  }

  int lanes;
  LazyZeroArray<std::int32_t> stored;  ///< per group of lanes: index of the stored group
  std::vector<Index> first;            ///< per stored group: first slot of a group with its data; never empty
};

}  // namespace piola
