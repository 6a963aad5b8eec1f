// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/reproducible_sum.hpp"
#include "piola/mechanics/load.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include "piola/mechanics/support.hpp"
#include <array>
#include <span>
#include <string>
#include <vector>

/// Forces on the bodies by supports, loads and rigid shapes in one step.
namespace piola {

/// Mean force of a support, a load or a rigid shape on the bodies over the last step.
struct Action {
  std::string name;
  std::array<double, 3> force{};   ///< N
  std::array<double, 3> moment{};  ///< N m, about the mean position of its particles at the start or the centre of the
                                   ///< shape
};

/// Impulse of a support, a load or a rigid shape on the bodies.
struct Impulse {
  std::array<double, 3> linear{};   ///< [N s]
  std::array<double, 3> angular{};  ///< about the origin [N m s]
  void add(Impulse const& other);
};

/// The impulse of forces on many particles, added in any order.
class ImpulseSum {
 public:
  /// Adds the impulse p [N s] of a force at x [m].
  void add(std::array<double, 3> const& x, std::array<double, 3> const& p);
  void add(ImpulseSum const& other) { sums_.add(other.sums_); }
  Impulse value() const;

 private:
  exec::ReproducibleSums<6> sums_;  ///< linear, angular
};

/// Impulses of the last step; divided by dt they become forces and moments. The force of a support is the mass of its
/// particles times the acceleration that it cancels, so that the forces of supports, loads and rigid shapes sum to the
/// rate of the linear momentum. Test: tests/formulations/actions_test.cpp.
class Resultants {
 public:
  Resultants(std::vector<Support> const& of_supports, std::vector<Load> const& of_loads,
             std::vector<RigidShape> const& of_rigids);

  std::vector<Impulse> supports, loads, rigids;    ///< in the order of the case
  std::vector<std::array<double, 3>> rigid_about;  ///< reference points of the moments of rigid shapes now [m]

  /// Starts a step of dt [s]; discards the impulses of the last one.
  void begin(double dt);
  /// Names, forces and moments: all supports, the loads that have names, all rigid shapes. Zero before the first step.
  std::vector<Action> report() const;

  /// State for a checkpoint: rows of history.csv may follow before the next step.
  std::vector<double> state() const;
  void restore(std::span<double const> state);

 private:
  struct Named {
    std::string name;
    std::array<double, 3> about;
  };
  std::vector<Named> named_supports_, named_loads_, named_rigids_;
  double dt_ = 0;
};

}  // namespace piola
