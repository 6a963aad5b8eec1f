// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/rigid_body.hpp"
#include "piola/mechanics/contact/rigid_pairs.hpp"
#include "piola/mechanics/contact/rigid_springs.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/mechanics/rigid_state.hpp"
#include <optional>
#include <vector>

namespace piola::contact {

/// Motion of all rigid shapes of a run: driven ones as prescribed, free ones by bodies, gravity, forces, springs and
/// other shapes. Sets the surfaces of a SurfaceContactSystem and reads the forces of bodies from it.
class RigidMotion {
 public:
  RigidMotion(std::vector<RigidShape> const& shapes, int dimension, RigidPairs::Setting const& between,
              std::vector<RigidSpring> springs = {});

  /// Sets velocities, rotations and masses of the surfaces.
  void place(std::vector<RigidSurface>& surfaces) const;
  /// Moves the surfaces from time to time + dt [s].
  void move(std::vector<RigidSurface>& surfaces, double time, double dt);
  /// Computes the forces between shapes in their initial pose, after those of the bodies.
  void start(SurfaceContactSystem const& bodies);
  void evaluate(SurfaceContactSystem const& bodies, double dt);  ///< dt [s] after the last evaluation
  /// Applies the impulses of `half` [s] by the present forces, and by gravity, forces and torques at `time`, and
  /// updates the velocities of the surfaces.
  void kick(SurfaceContactSystem& bodies, double time, double half);
  /// Applies the impulses of the dashpots over `half` [s]: after kick() at the begin of a step; before kick(), and
  /// `backwards`, at its end.
  void kick_by_dashpots(SurfaceContactSystem& bodies, double half, bool backwards);
  void damp(SurfaceContactSystem& bodies, double factor);

  /// Load of other shapes and bodies on a shape; moment about its centre.
  RigidPairs::Load on(SurfaceContactSystem const& bodies, std::size_t shape) const;
  RigidPairs::Totals const& between_shapes() const { return pairs_.totals(); }
  double frequency2() const { return frequency2_; }  ///< bound for free shapes [1/s2]
  double contact_time_step(
      std::vector<RigidSurface> const& surfaces) const;  ///< step limit by contact and by rotation [s]

  double kinetic_energy() const;  ///< of free shapes [J]
  /// Work of gravity, forces, torques and held directions of free shapes, and of driven shapes on springs, since the
  /// start [J].
  double work() const { return work_; }
  double damping_loss() const { return damping_loss_; }  ///< without dashpots [J]
  RigidSprings const& springs() const { return springs_; }
  RigidSprings& springs() { return springs_; }
  Vec<3> linear_momentum() const;   ///< of free shapes [kg m/s]
  Vec<3> angular_momentum() const;  ///< about the origin [kg m2/s]
  std::vector<RigidState> states(std::vector<RigidSurface> const& surfaces) const;

  /// Whether some shape is free or rotates; else no state is needed in checkpoints.
  bool any() const { return any_; }
  std::vector<double> state() const;
  /// Call before the surfaces are used again; centres and velocities of surfaces are not in the state.
  void restore(std::vector<RigidSurface>& surfaces, std::vector<double> const& state);

 private:
  struct Shape {
    RigidShape given;
    Vec<3> axis;                    ///< at the start
    std::optional<RigidBody> body;  ///< free
    Quaternion turn;                ///< driven, since the start
    double angle = 0;               ///< driven, in 2D [rad]
    Vec<3> rate;                    ///< driven [rad/s]
  };
  void bound_frequency(SurfaceContactSystem const& bodies);
  void act(Shape& shape, double time, double half);
  RigidSprings::BodyOf free_bodies();
  void drive(Shape& shape, RigidSurface& surface, double time, double dt) const;

  int dimension_;
  bool any_ = false;
  std::vector<Shape> shapes_;
  RigidPairs pairs_;
  RigidSprings springs_;
  double work_ = 0, damping_loss_ = 0, frequency2_ = 0;
  double of_shapes_ = 0;  ///< square of the largest frequency of a free shape on its springs [1/s2]
};

}  // namespace piola::contact
