// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/unique_lane_groups.hpp"
#include "piola/base/contracts.hpp"
#include <map>

namespace piola {

UniqueLaneGroups::UniqueLaneGroups(Range slots, Index all_slots, int group_lanes,
                                   std::function<void(Index first, std::vector<double>& key)> const& add_key)
    : lanes(group_lanes), stored(static_cast<std::size_t>(all_slots / group_lanes)) {
  PIOLA_EXPECTS(slots.first % lanes == 0);
  std::map<std::vector<double>, std::int32_t> known;
  std::vector<double> key, last;
  for (Index begin = slots.first; begin < slots.last; begin += lanes) {
    std::int32_t& group = stored[static_cast<std::size_t>(begin / lanes)];
    key.clear();
    add_key(begin, key);
    if (key == last && begin > slots.first) {  // as that before, the common case
      group = stored[static_cast<std::size_t>(begin / lanes) - 1];
      continue;
    }
    last = key;
    auto const [at, is_new] = known.try_emplace(key, static_cast<std::int32_t>(known.size()));
    group = at->second;
    if (is_new) first.push_back(begin);
  }
  if (first.empty()) first.push_back(all_slots);  // no local slots
}

}  // namespace piola
