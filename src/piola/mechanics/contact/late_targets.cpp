// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/late_targets.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>

namespace piola::contact {

void LateTargets::add(std::vector<char> const& marked) {
  if (known_.size() < marked.size()) known_.resize(marked.size(), no);
  for (std::size_t k = 0; k < marked.size(); ++k)
    if (marked[k] != 0 && known_[k] == no) known_[k] = since_last_evaluation;
}

double LateTargets::pushing_gap(Index contact, Index k, double gap) {
  PIOLA_EXPECTS(has(k));
  double const depth = std::max(-gap, 0.0);
  if (known_[static_cast<std::size_t>(k)] == since_last_evaluation) {
    if (depth > 0) depth_[{contact, k}] = depth;
    return gap + depth;
  }
  auto const from = depth_.find({contact, k});
  if (from == depth_.end()) return gap;
  from->second = std::min(from->second, depth);
  double const pushing = gap + from->second;
  if (!(from->second > 0)) depth_.erase(from);
  return pushing;
}

void LateTargets::settle() {
  for (char& known : known_)
    if (known == since_last_evaluation) known = yes;
}

void LateTargets::load(std::vector<double> const& state) {
  depth_ = pair_values_of(state);
  settle();
}

}  // namespace piola::contact
