// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/quaternion.hpp"
#include "piola/mechanics/rigid_mass.hpp"

namespace piola::contact {

/// A free rigid body with momenta m v and L. Kicks change the momenta; drifts keep them and change the pose. Theory:
/// docs/theory/contact.md, Rigid bodies.
class RigidBody {
 public:
  RigidBody(RigidShape const& shape, int dimension);

  Vec<3> centre;     ///< [m]
  Vec<3> velocity;   ///< [m/s]
  Vec<3> spin;       ///< L: angular momentum about the centre [kg m2/s]
  Quaternion turn;   ///< since the start
  double angle = 0;  ///< 2D: rotation angle including whole turns [rad]

  double mass() const { return mass_; }
  Vec<3> angular_velocity() const;  ///< [rad/s]
  /// In space [1/(kg m2)]; zero if the body cannot rotate.
  Mat<3> inverse_inertia() const;
  double moving_energy() const { return 0.5 * mass_ * dot(velocity, velocity); }  ///< of the centre [J]
  double turning_energy() const { return 0.5 * dot(spin, angular_velocity()); }   ///< [J]

  /// The part of an impulse [N s] in free directions.
  Vec<3> free_part(Vec<3> impulse) const;
  /// Applies an impulse [N s] and its moment about the centre [N m s]. Returns the work of what keeps held directions
  /// from changing their velocity [J].
  double kick(Vec<3> const& impulse, Vec<3> const& moment);
  /// Advances the pose by h [s]: rotations about the body axes z y x y z, all but x in halves, each at the rate of L
  /// about it. Reversible.
  void drift(double h);

 private:
  void turn_about_own_axis(int k, double h);
  int dimension_;
  double mass_;
  PrincipalInertia inertia_;  ///< at the start
  std::array<bool, 3> held_;
  bool can_turn_;
};

}  // namespace piola::contact
