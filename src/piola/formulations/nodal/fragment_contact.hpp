// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <vector>

namespace piola::nodal {

/// Contact of the pieces of one body whose cells have failed: linear springs between particles of broken cells and
/// those beside them, at least three spacings apart in the reference configuration, that come nearer than 0.6 spacings.
/// Pairs that are nearer when a cell beside them breaks, as in sheared material, push from that distance on, so that
/// the energy does not jump. Eulerian cells, which see all particles, have none. No friction. Central forces of an
/// energy of positions: momenta and energy are kept. Theory: docs/theory/nodal.md, "Failure".
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
  /// The pairs that push from a smaller distance on: two slots and the distance [m] of each, for a checkpoint.
  std::vector<double> state() const { return contact::numbers_of(nearer_); }
  /// Takes the pairs of a checkpoint, after all particles were added.
  void load(std::vector<double> const& state);
  double energy() const { return energy_; }          ///< [J], on all ranks alike
  double frequency2() const { return frequency2_; }  ///< bound on the square of the largest frequency [1/s2]

 private:
  bool acts_elsewhere(std::size_t k, std::size_t n) const;
  double rest_of(Index a, Index b, double r, double touching);
  void forget_parted(double touching);

  NodalBody& body_;
  std::vector<char> known_;     ///< per slot: 1 added, 2 added since the last evaluation
  std::vector<Index> slots_;    ///< ascending
  std::vector<Vec<3>> force_;   ///< per entry of slots_ [N]
  contact::PairValues nearer_;  ///< see state()
  double energy_ = 0, frequency2_ = 0;
};

}  // namespace piola::nodal
