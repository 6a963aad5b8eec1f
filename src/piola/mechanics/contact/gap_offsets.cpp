// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/gap_offsets.hpp"
#include <algorithm>

namespace piola::contact {

void GapOffsets::set(Index contact, Index target, double gap, double pushing) {
  double const depth = std::min(pushing, 0.0) - gap;
  if (depth > 0)
    depth_[{contact, target}] = depth;
  else
    depth_.erase({contact, target});
}

double GapOffsets::pushing(Index contact, Index target, double gap) {
  if (depth_.empty()) return gap;
  auto const from = depth_.find({contact, target});
  if (from == depth_.end()) return gap;
  from->second = std::min(from->second, std::max(-gap, 0.0));
  double const now = gap + from->second;
  if (!(from->second > 0)) depth_.erase(from);
  return now;
}

double GapOffsets::pushing_now(Index contact, Index target, double gap) const {
  auto const from = depth_.find({contact, target});
  return from == depth_.end() ? gap : gap + from->second;
}

}  // namespace piola::contact
