// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/exact_sum.hpp"
#include "piola/mechanics/load.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include "piola/mechanics/support.hpp"
#include <array>
#include <span>
#include <string>
#include <vector>

/// What acts on the bodies from outside in one step.
namespace piola {

/// What a support, a load or a rigid shape does to the bodies, on average over the last step.
struct Action {
  std::string name;
  std::array<double, 3> force{};   ///< N
  std::array<double, 3> moment{};  ///< N m, about the middle of its particles at the start or the centre of the shape
};

/// What a support, a load or a rigid shape gave to the bodies.
struct Impulse {
  std::array<double, 3> linear{};   ///< [N s]
  std::array<double, 3> angular{};  ///< about the origin [N m s]
  void add(Impulse const& other);
};

/// The impulse of forces on many particles, which may come in any order.
class ImpulseSum {
 public:
  /// The impulse p [N s] of a force at x [m].
  void add(std::array<double, 3> const& x, std::array<double, 3> const& p);
  void add(ImpulseSum const& other) { sums_.add(other.sums_); }
  Impulse value() const;

 private:
  exec::ExactSums<6> sums_;  ///< linear, angular
};

/// Impulses of the step that was taken last, which become forces and moments: impulse over dt. The force of a support
/// is the mass of its particles times the acceleration that it made up for, so that the forces of supports, loads and
/// rigid shapes sum to the rate of the linear momentum. Test: tests/formulations/actions_test.cpp.
class Actions {
 public:
  Actions(std::vector<Support> const& of_supports, std::vector<Load> const& of_loads,
          std::vector<RigidShape> const& of_rigids);

  std::vector<Impulse> supports, loads, rigids;    ///< in the order they were given
  std::vector<std::array<double, 3>> rigid_about;  ///< points of the moments of rigid shapes now [m]

  /// Forgets the step before.
  void begin(double dt);
  /// Names, forces and moments: all supports, the loads that have names, all rigid shapes. Zero before the first step.
  std::vector<Action> report() const;

  /// What a checkpoint holds: rows of history.csv may follow before the next step.
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
