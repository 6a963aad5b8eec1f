// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/adaptle/rigid_shapes.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <optional>
#include <span>
#include <vector>

namespace piola::adaptle {

/// Supports, loads and rigid shapes of a run, and their resultants. Each step evaluates them for the local particles;
/// loops apply them by the arrays to which System points.
class BoundaryConditions {
 public:
  /// Points `system`, which must outlive this, to the prescribed values.
  BoundaryConditions(Assembly const& assembly, System& system);

  /// Before a step from `time` to time + dt [s]: velocities of supports at its end, loads and rigid shapes at half
  /// time.
  void begin_step(double time, double dt);
  /// After it: the resultants, which resultants() reduces.
  void end_step(double time, double dt);
  /// Whether a support holds component c of a local particle in the last step.
  bool holds(Index slot, int c) const;
  /// The next end of a support or a load after `time` [s]; infinity if there is none.
  double next_end_time(double time) const { return piola::next_end_time(time, supports_, loads_); }
  /// Reduces the resultants of the last step. Collective.
  Resultants resultants() const;
  void restore_resultants(std::span<double const> state) {
    unreduced_.reset();
    resultants_.restore(state);
  }
  RigidShapes& rigid_shapes() { return shapes_; }
  RigidShapes const& rigid_shapes() const { return shapes_; }

 private:
  void evaluate_supports(double time);
  void evaluate_loads(double time);
  /// Impulses of the supports, then of the loads, on the local particles in a step.
  std::vector<ImpulseSum> impulses(double time, double dt) const;

  System const& system_;
  std::vector<Support> supports_;
  std::vector<Load> loads_;
  LazyZeroArray<std::int8_t> held_;
  LazyZeroArray<std::size_t> holder_;  ///< per component: index of the support that holds it
  LazyZeroArray<double> held_velocity_, reaction_, load_;
  RigidShapes shapes_;
  Resultants resultants_;
  /// The local part of the last step.
  struct Unreduced {
    double dt;
    std::vector<ImpulseSum> impulses;               ///< of supports, then of loads
    std::vector<exec::ReproducibleSums<6>> rigids;  ///< force and moment of rigid shapes
  };
  std::optional<Unreduced> unreduced_;  ///< empty once it is in resultants_
};

}  // namespace piola::adaptle
