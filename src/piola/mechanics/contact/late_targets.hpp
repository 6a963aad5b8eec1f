// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/gap_offsets.hpp"
#include <cstddef>
#include <vector>

namespace piola::contact {

/// Targets that join a contact during a run: particles that have lost their surface. Each pushes from the depth that it
/// has when it joins, or from less if its surface stored energy, so that the energy does not jump. This depth falls
/// while the gap opens, and never rises.
class LateTargets {
 public:
  /// Adds the marked particles, by index.
  void add(std::vector<char> const& marked);
  bool has(Index k) const { return static_cast<std::size_t>(k) < known_.size() && known_[static_cast<std::size_t>(k)]; }
  /// Returns the gap [m] by which a target pushes whose gap is `gap` [m] in contact number `contact`. Call it in each
  /// evaluation for all targets whose gap may be negative. first: gap by which a target pushes when it joins [m].
  double pushing_gap(Index contact, Index k, double gap, double first = 0);
  /// Ends an evaluation.
  void settle();
  /// The targets that push from a depth: contact, index and depth [m] of each, for a checkpoint.
  std::vector<double> state() const { return depths_.state(); }
  /// Takes the state of a checkpoint, after all targets of then were added.
  void load(std::vector<double> const& state);

 private:
  enum Known : char { no, since_last_evaluation, yes };

  std::vector<char> known_;  ///< by index
  GapOffsets depths_;        ///< by contact and index
};

}  // namespace piola::contact
