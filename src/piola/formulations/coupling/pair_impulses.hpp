// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/force_moment.hpp"
#include <vector>

namespace piola {

/// Impulses between bodies in the last step: that of body b on body a, with its moment about the origin [N s], [N m s].
class PairImpulses {
 public:
  explicit PairImpulses(std::size_t bodies) : bodies_(bodies), impulses_(bodies * bodies) {}
  /// Starts a step.
  void clear() { impulses_.assign(impulses_.size(), {}); }
  /// Adds a force [N] of b on a during dt [s].
  void add(std::size_t a, std::size_t b, contact::ForceMoment const& load, double dt) {
    contact::ForceMoment& sum = impulses_[a * bodies_ + b];
    sum.force = sum.force + dt * load.force;
    sum.moment = sum.moment + dt * load.moment;
  }
  contact::ForceMoment const& operator()(std::size_t a, std::size_t b) const { return impulses_[a * bodies_ + b]; }
  /// By a, then b: for checkpoints.
  std::vector<contact::ForceMoment>& all() { return impulses_; }
  std::vector<contact::ForceMoment> const& all() const { return impulses_; }

 private:
  std::size_t bodies_;
  std::vector<contact::ForceMoment> impulses_;
};

}  // namespace piola
