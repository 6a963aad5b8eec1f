// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/state_vector.hpp"
#include <vector>

namespace piola::contact {

/// Depths of targets that were inside a body already when the surface of that body changed. Such a target pushes only
/// by how much deeper it goes, so that the energy does not jump. A depth falls while the gap opens, and never rises.
class GapOffsets {
 public:
  /// Sets the depth of a target so that it pushes by the gap `pushing` [m] where its gap is `gap` [m]; both are
  /// negative inside.
  void set(Index contact, Index target, double gap, double pushing);
  /// The gap by which a target pushes whose gap is `gap` [m]. To be called in each evaluation for all targets whose gap
  /// may be negative.
  double pushing(Index contact, Index target, double gap);
  /// The gap by which a target pushes, with its depth of the last call of pushing() or set().
  double pushing_now(Index contact, Index target, double gap) const;
  /// Contact, target and depth [m] of each, for a checkpoint.
  std::vector<double> state() const { return numbers_of(depth_); }
  void load(std::vector<double> const& state) { depth_ = pair_values_of(state); }

 private:
  PairValues depth_;  ///< by contact and target [m]
};

}  // namespace piola::contact
