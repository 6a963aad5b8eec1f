// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/state_vector.hpp"
#include <vector>

namespace piola::contact {

/// Depths from which targets push that were in deep when what they are in contact with changed, so that the energy does
/// not jump. Such a depth falls while the gap opens, and never rises.
class GapOffsets {
 public:
  bool empty() const { return depth_.empty(); }
  /// Lets a target push as by the gap `pushing` [m], negative inside, where its gap is `gap` [m]: from then on.
  void set(Index contact, Index target, double gap, double pushing);
  /// The gap by which a target pushes whose gap is `gap` [m]. To be called in each evaluation for all targets whose gap
  /// may be negative.
  double pushing(Index contact, Index target, double gap);
  /// As of the last call of pushing() or set().
  double pushing_now(Index contact, Index target, double gap) const;
  /// Contact, target and depth [m] of each, for a checkpoint.
  std::vector<double> state() const { return numbers_of(depth_); }
  void load(std::vector<double> const& state) { depth_ = pair_values_of(state); }

 private:
  PairValues depth_;  ///< by contact and target [m]
};

}  // namespace piola::contact
