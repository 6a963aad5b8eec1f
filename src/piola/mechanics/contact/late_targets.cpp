// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/late_targets.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>

namespace piola::contact {

void LateTargets::add(std::vector<char> const& marked) {
  if (known_.size() < marked.size()) known_.resize(marked.size(), no);
  for (std::size_t k = 0; k < marked.size(); ++k) {
    if (marked[k] == 0 || known_[k] != no) continue;
    known_[k] = since_last_evaluation;
    any_ = true;
  }
}

double LateTargets::pushing_gap(std::size_t contact, Index k, double gap) {
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

std::vector<double> LateTargets::state() const {
  std::vector<double> all;
  for (auto const& [target, depth] : depth_)
    all.insert(all.end(), {static_cast<double>(target.first), static_cast<double>(target.second), depth});
  return all;
}

void LateTargets::load(std::vector<double> const& state) {
  PIOLA_EXPECTS(state.size() % 3 == 0);
  depth_.clear();
  for (std::size_t k = 0; k < state.size(); k += 3)
    depth_[{static_cast<std::size_t>(state[k]), static_cast<Index>(state[k + 1])}] = state[k + 2];
  settle();
}

}  // namespace piola::contact
