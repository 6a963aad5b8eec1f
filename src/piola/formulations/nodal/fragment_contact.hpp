// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include <vector>

namespace piola::nodal {

/// Contact of the pieces of one body whose cells have failed: linear springs between particles of broken cells and
/// those beside them, at least three spacings apart in the reference configuration, that come nearer than 0.6 spacings.
/// No friction. Central forces of an energy of positions: momenta and energy are kept. Theory: docs/theory/nodal.md,
/// "Failure".
class FragmentContact {
 public:
  /// Keeps a reference to the body.
  explicit FragmentContact(NodalBody& body) : body_(body) {}

  /// Adds the particle of a slot, on all ranks alike.
  void add(Index slot);
  /// Computes the forces at the present positions. Collective.
  void evaluate();
  /// Adds the impulse of the forces during dt [s] to the velocities.
  void kick(double dt) const;
  double energy() const { return energy_; }          ///< [J], on all ranks alike
  double frequency2() const { return frequency2_; }  ///< bound on the square of the largest frequency [1/s2]

 private:
  NodalBody& body_;
  std::vector<char> known_;    ///< per slot
  std::vector<Index> slots_;   ///< ascending
  std::vector<Vec<3>> force_;  ///< per entry of slots_ [N]
  double energy_ = 0, frequency2_ = 0;
};

}  // namespace piola::nodal
