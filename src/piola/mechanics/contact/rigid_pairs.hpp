// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/friction.hpp"
#include "piola/mechanics/contact/rigid_samples.hpp"
#include "piola/mechanics/contact/rigid_surface.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace piola::contact {

/// Contact of free rigid shapes with other rigid shapes: points of one against the distance from the other, with the
/// layer of a deformable body between them. A few points if one of the two is a sphere or a plane; for boxes and
/// cylinders points on the surfaces of both in turn. Theory: docs/theory/contact.md, Rigid bodies.
class RigidPairs {
 public:
  struct Setting {
    double stiffness = 0;  ///< k of the layer, C_s M/dp [Pa/m]
    double spacing = 0;    ///< dp [m]
    FrictionLaw friction = {};
  };
  /// Creates all pairs with at least one free shape; sizes: volumes of the shapes, for stiffnesses.
  RigidPairs(std::vector<RigidShape> const& shapes, int dimension, Setting const& setting);

  /// Evaluates the initial state, without motion before it.
  void start(std::vector<RigidSurface> const& shapes);
  /// dt [s] after the last evaluation.
  void evaluate(std::vector<RigidSurface> const& shapes, double dt);

  struct Load {
    Vec<3> force, moment;  ///< [N]; about the centre [N m]
  };
  Load const& on(std::size_t shape) const { return loads_[shape]; }
  /// Bounds the square of the frequency of pairs in contact [1/s2]. of_shapes: in, the sum for each shape over other
  /// springs; out, with the springs of its pairs added.
  double frequency2(std::vector<double>& of_shapes) const;

  struct Totals {
    double energy = 0, spring_energy = 0, friction_work = 0;  ///< as in SurfaceContactSystem [J]
    double deepest = 0;                                       ///< in spacings
    double touched = 0;                                       ///< points
  };
  Totals const& totals() const { return totals_; }
  /// The step in which no pair approaches by more than half its gap plus a tenth of a spacing, and which resolves an
  /// impact [s].
  double contact_time_step(std::vector<RigidSurface> const& shapes) const;

  /// State for a checkpoint, without the poses of the shapes.
  std::vector<double> state() const;
  void restore(std::vector<RigidSurface> const& shapes, std::vector<double> const& state);

 private:
  struct Pair {
    std::size_t a, b;  ///< points of a are tested against the distance from b
    double stiffness;  ///< of one point [N/m]; of sampled surfaces by area [Pa/m]
    double area;       ///< of one point [m2]; of sampled surfaces the weight of this pass
    bool sampled;
  };
  /// A contact point of a pair, or a possible one.
  struct ContactPoint {
    Vec<3> y, normal;   ///< [m]; that of b
    double gap;         ///< [m]
    double weight = 1;  ///< of sampled surfaces: the area [m2]
  };
  /// The friction of one point of a pair.
  struct StickState {
    std::size_t pair, point;
    Vec<3> stretch, force;  ///< [m] in the axes of b at the start; [N]
    bool operator<(StickState const& o) const { return pair != o.pair ? pair < o.pair : point < o.point; }
  };

  std::vector<ContactPoint> touches(Pair const& pair, std::vector<RigidSurface> const& shapes) const;
  std::vector<ContactPoint> sampled_touches(std::vector<SurfaceSample> const& samples, RigidSurface const& a,
                                            RigidSurface const& b) const;
  void push(std::size_t pair, std::size_t point, ContactPoint const& touch, std::vector<RigidSurface> const& shapes);
  Vec<3> apply_friction(std::size_t pair, std::size_t point, ContactPoint const& touch, double normal_force,
                        std::vector<RigidSurface> const& shapes);
  void add(std::size_t shape, Vec<3> const& arm, Vec<3> const& force);
  void remember(std::vector<RigidSurface> const& shapes);

  Setting setting_;
  std::vector<Pair> pairs_;
  std::vector<std::vector<SurfaceSample>> samples_;  ///< by shape, if a pair needs them
  std::vector<Load> loads_;
  std::vector<double> frequency2_;
  std::vector<RigidPose> last_;
  std::vector<StickState> stuck_, last_stuck_;
  double dt_ = 0;  ///< since the last evaluation [s]
  Totals totals_;
};

}  // namespace piola::contact
