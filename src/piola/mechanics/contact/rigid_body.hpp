// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/quaternion.hpp"
#include "piola/mechanics/rigid_mass.hpp"

namespace piola::contact {

/// A free rigid body. Its momenta m v and L are what forces and moments change, and nothing else does: kicks alternate
/// with drifts, in which both stay as they are. Theory: docs/theory/contact.md, Rigid bodies.
class RigidBody {
 public:
  RigidBody(RigidShape const& shape, int dimension);

  Vec<3> centre;     ///< [m]
  Vec<3> velocity;   ///< [m/s]
  Vec<3> spin;       ///< L: angular momentum about the centre [kg m2/s]
  Quaternion turn;   ///< since the start
  double angle = 0;  ///< 2D: the same as an angle that counts whole turns, too [rad]

  double mass() const { return mass_; }
  Vec<3> angular_velocity() const;  ///< [rad/s]
  /// In space [1/(kg m2)]; zero of a body that cannot turn.
  Mat<3> inverse_inertia() const;
  double moving_energy() const { return 0.5 * mass_ * dot(velocity, velocity); }  ///< of the centre [J]
  double turning_energy() const { return 0.5 * dot(spin, angular_velocity()); }   ///< [J]

  /// What is left of an impulse [N s] where directions are held.
  Vec<3> free_part(Vec<3> impulse) const;
  /// An impulse [N s] and its moment about the centre [N m s].
  void kick(Vec<3> const& impulse, Vec<3> const& moment);
  /// Goes on for h [s]: turns about the axes z y x y z of the body, by halves but x, each at the rate that L has about
  /// it, so that the way back is the way there.
  void drift(double h);

 private:
  void turn_about_own_axis(int k, double h);
  int dimension_;
  double mass_;
  PrincipalInertia inertia_;  ///< of the start
  std::array<bool, 3> held_;
  bool can_turn_;
};

}  // namespace piola::contact
