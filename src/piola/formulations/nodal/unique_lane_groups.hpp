// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/local_fits.hpp"
#include <algorithm>
#include <map>

namespace piola::nodal {

/// Groups of SIMD lanes with identical neighbour geometry. Reference data that depend on this geometry alone are stored
/// once per distinct group; see FieldRef::group.
struct UniqueLaneGroups {
  int lanes = 1;
  LazyZeroArray<std::int32_t> stored;  ///< per group of lanes: index of the stored group
  std::vector<std::size_t> first;      ///< per stored group: first slot of a group with this geometry; never empty

  UniqueLaneGroups() = default;
  /// Groups the lanes of `slots`; the body has `all_slots` slots.
  template <int D>
  UniqueLaneGroups(LocalFits<D> const& fits, Range slots, Index all_slots, int group_lanes)
      : lanes(group_lanes), stored(static_cast<std::size_t>(all_slots / group_lanes)) {
    std::map<std::vector<std::size_t>, std::int32_t> known;
    std::vector<std::size_t> kinds, last;
    for (Index begin = slots.first; begin < slots.last; begin += lanes) {
      std::int32_t& group = stored[static_cast<std::size_t>(begin / lanes)];
      kinds.clear();
      auto const end = std::min(static_cast<std::size_t>(begin + lanes), fits.X().size());
      for (auto a = static_cast<std::size_t>(begin); a < end; ++a) kinds.push_back(fits.representative(a));
      if (kinds == last && begin > slots.first) {  // same kinds as the last stored group, the common case
        group = stored[static_cast<std::size_t>(begin / lanes) - 1];
        continue;
      }
      last = kinds;
      auto const [at, is_new] = known.try_emplace(kinds, static_cast<std::int32_t>(known.size()));
      group = at->second;
      if (is_new) first.push_back(static_cast<std::size_t>(begin));
    }
    if (first.empty()) first.push_back(fits.X().size());  // no local slots
  }

  Index slots() const { return static_cast<Index>(first.size()) * lanes; }
  /// Index at which data of a slot are stored.
  Index place(Index slot) const { return stored[static_cast<std::size_t>(slot / lanes)] * lanes + slot % lanes; }
  /// Calls f(place, particle) for each stored place of the first `particles` slots.
  template <class F>
  void each(std::size_t particles, F const& f) const {
    for (std::size_t g = 0; g < first.size(); ++g)
      for (std::size_t l = 0; l < static_cast<std::size_t>(lanes); ++l)
        if (first[g] + l < particles) f(g * static_cast<std::size_t>(lanes) + l, first[g] + l);
  }
};

}  // namespace piola::nodal
