// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/unique_lane_groups.hpp"
#include <map>

namespace piola::jst_sph {

UniqueLaneGroups::UniqueLaneGroups(BodyState const& state, Index slots, int lanes,
                                   std::function<double(Index)> const& volume)
    : lanes_(lanes) {
  if (!state.regular) return;
  std::map<std::vector<double>, std::int32_t> known;
  std::vector<double> key, last;
  stored_.assign(static_cast<std::size_t>(slots / lanes), 0);
  for (Index first = state.slots.first; first < state.slots.last; first += lanes) {
    Index const group = first / lanes;
    std::int32_t& stored = stored_[static_cast<std::size_t>(group)];
    key.assign(1, static_cast<double>(state.stencil.pattern_of[group]));
    for (Index i = first; i < first + lanes; ++i) key.push_back(volume(i));
    if (key == last) {  // as most groups
      stored = stored_[static_cast<std::size_t>(group) - 1];
      continue;
    }
    last = key;
    auto const [at, is_new] = known.try_emplace(key, static_cast<std::int32_t>(first_.size()));
    if (is_new) first_.push_back(first);
    stored = at->second;
  }
}

}  // namespace piola::jst_sph
