// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include <array>
#include <vector>

namespace piola::adaptle {

/// The rigid shapes of a run, with prescribed motion: their poses, and what they exert on the local particles.
class RigidShapes {
 public:
  /// Points `system` to poses and results.
  RigidShapes(std::vector<RigidShape> const& shapes, System& system);
  RigidShapes(RigidShapes const&) = delete;
  RigidShapes& operator=(RigidShapes const&) = delete;

  /// Moves the shapes over a step of dt from `time` [s]; loops see the poses at half time.
  void move(double time, double dt);
  /// Force [N] and moment about the origin [N m] of each shape in the last step.
  std::vector<exec::ReproducibleSums<6>> actions() const;
  /// Discards the actions: a partition may have fewer blocks than the one before.
  void clear_actions();
  /// Centre of a shape at half time of the last step [m].
  std::array<double, 3> centre_at_half_time(std::size_t shape) const;

  std::size_t count() const { return shapes_.size(); }
  /// Centres at the end of the last step [m], for checkpoints.
  std::vector<double>& centres() { return centre_; }
  std::vector<double> const& centres() const { return centre_; }

 private:
  std::vector<RigidShape> shapes_;
  std::vector<RigidPoseAtHalfTime> pose_;
  std::vector<double> centre_;
  LazyZeroArray<double> power_;  ///< per slot
  std::vector<double> action_;   ///< [block of a body][shape][6]
};

}  // namespace piola::adaptle
