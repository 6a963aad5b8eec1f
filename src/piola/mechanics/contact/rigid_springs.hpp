// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/force_moment.hpp"
#include "piola/mechanics/contact/rigid_body.hpp"
#include "piola/mechanics/contact/rigid_surface.hpp"
#include "piola/mechanics/rigid_spring.hpp"
#include <functional>
#include <vector>

namespace piola::contact {

class StateVector;

/// Springs and dashpots of free rigid shapes. Theory: docs/theory/contact.md, Rigid bodies.
class RigidSprings {
 public:
  /// The free body of a shape; null: the shape moves as prescribed.
  using BodyOf = std::function<RigidBody*(std::size_t shape)>;

  /// `shapes`: at the start.
  RigidSprings(std::vector<RigidSpring> springs, std::vector<RigidShape> const& shapes);

  bool any() const { return !springs_.empty(); }
  /// Computes lengths and forces of the springs in this pose of the shapes.
  void evaluate(std::vector<RigidSurface> const& shapes);
  /// Adds the squares of the frequencies that the springs give their shapes [1/s2].
  void add_frequencies2(std::vector<RigidSurface> const& shapes, std::vector<double>& of_shapes) const;
  /// Bounds the square of the frequency of shapes on springs, from the sums over all springs of each shape [1/s2].
  double frequency2(std::vector<double> const& of_shapes) const;

  /// Starts a step: the impulses of the last one are discarded.
  void begin();
  /// Applies the impulses of the springs over `half` [s] to free bodies. Returns the work of shapes that move as
  /// prescribed, and of held directions of free ones, on the rest [J].
  double kick_by_springs(std::vector<RigidSurface> const& shapes, BodyOf const& body_of, double half);
  /// As kick_by_springs() for the dashpots: the velocity along one decays by exp(-damping half / mass). Several act one
  /// after the other, in the reverse order if `backwards`, so that both halves of a step are symmetric.
  double kick_by_dashpots(std::vector<RigidSurface> const& shapes, BodyOf const& body_of, double half, bool backwards);

  double energy() const;                         ///< of the springs [J]
  double dashpot_loss() const { return loss_; }  ///< since the start [J]
  /// Impulses on the first shape in the present step, about the origin, in the order of the case [N s], [N m s].
  std::vector<ForceMoment> const& impulses() const { return impulses_; }
  std::vector<RigidSpring> const& springs() const { return springs_; }

  std::vector<double> state() const;
  /// For shapes in the pose of the checkpoint.
  void restore(std::vector<RigidSurface> const& shapes, StateVector& from);

 private:
  /// One spring in the present pose.
  struct Now {
    std::array<Vec<3>, 2> ends;  ///< [m]
    Vec<3> along;                ///< unit vector from the first end to the second; zero if they coincide
    double length = 0;           ///< [m]
    double tension = 0;          ///< [N]
  };
  Vec<3> end_of(std::size_t spring, std::size_t end, std::vector<RigidSurface> const& shapes) const;
  double apply(std::size_t spring, double impulse, std::vector<RigidSurface> const& shapes, BodyOf const& body_of);
  std::optional<std::size_t> shape_of(std::size_t spring, std::size_t end) const {
    return end == 0 ? std::optional(springs_[spring].first) : springs_[spring].second;
  }

  std::vector<RigidSpring> springs_;
  std::vector<std::array<Vec<3>, 2>> arms_;  ///< from the centres of the shapes, or places at rest, at the start [m]
  std::vector<Now> now_;
  std::vector<ForceMoment> impulses_;
  double loss_ = 0;
};

}  // namespace piola::contact
