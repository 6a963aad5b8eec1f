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

double LateTargets::pushing_gap(Index contact, Index k, double gap, double first) {
  PIOLA_EXPECTS(has(k));
  if (known_[static_cast<std::size_t>(k)] == since_last_evaluation) {
    depths_.set(contact, k, gap, first);
    return std::max(gap, first);
  }
  return depths_.pushing(contact, k, gap);
}

void LateTargets::settle() {
  for (char& known : known_)
    if (known == since_last_evaluation) known = yes;
}

void LateTargets::load(std::vector<double> const& state) {
  depths_.load(state);
  settle();
}

}  // namespace piola::contact
