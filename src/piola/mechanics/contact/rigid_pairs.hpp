// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/friction.hpp"
#include "piola/mechanics/contact/rigid.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace piola::contact {

/// Whether two rigid shapes can push each other, in any order: one of them is a sphere or a plane.
inline bool can_push(RigidShape::Kind a, RigidShape::Kind b) {
  using Kind = RigidShape::Kind;
  return a == Kind::sphere || b == Kind::sphere || a == Kind::plane || b == Kind::plane;
}

/// Contact of free rigid shapes with other rigid shapes: a few points of one against the distance from the other, with
/// the layer of a deformable body between them. Theory: docs/theory/contact.md, Rigid bodies.
class RigidPairs {
 public:
  struct Setting {
    double stiffness = 0;  ///< k of the layer, C_s M/dp [Pa/m]
    double spacing = 0;    ///< dp [m]
    FrictionLaw friction = {};
  };
  /// All pairs of which at least one is free; sizes: volumes of the shapes, for stiffnesses.
  RigidPairs(std::vector<RigidShape> const& shapes, int dimension, Setting const& setting);

  /// Without a move since the evaluation before: at the start.
  void start(std::vector<RigidSurface> const& shapes);
  /// dt [s] after the evaluation before.
  void evaluate(std::vector<RigidSurface> const& shapes, double dt);

  struct Load {
    Vec<3> force, moment;  ///< [N]; about the centre [N m]
  };
  Load const& on(std::size_t shape) const { return loads_[shape]; }
  /// Bounds the square of the frequency of pairs that touch [1/s2]; of_shapes: what other springs give each shape,
  /// summed. Each of those gets its own springs added.
  double frequency2(std::vector<double>& of_shapes) const;

  struct Totals {
    double energy = 0, spring_energy = 0, friction_work = 0;  ///< as of System [J]
    double deepest = 0;                                       ///< in spacings
    double touched = 0;                                       ///< points
  };
  Totals const& totals() const { return totals_; }
  /// The step in which no pair closes by more than half its gap and a tenth of a spacing, and which resolves a blow
  /// [s].
  double closing_step(std::vector<RigidSurface> const& shapes) const;

  /// What a checkpoint holds besides the places of the shapes.
  std::vector<double> state() const;
  void restore(std::vector<RigidSurface> const& shapes, std::vector<double> const& state);

 private:
  struct Pair {
    std::size_t a, b;  ///< points of a against the distance from b
    double stiffness;  ///< of one point [N/m]
    double area;       ///< the same [m2]
  };
  /// Where a pair touches, or would.
  struct Touch {
    Vec<3> y, normal;  ///< [m]; that of b
    double gap;        ///< [m]
  };
  /// The friction of one point of a pair.
  struct Stuck {
    std::size_t pair, point;
    Vec<3> stretch, force;  ///< [m] in the axes of b at the start; [N]
  };

  static std::vector<Touch> touches(RigidSurface const& a, RigidSurface const& b);
  void push(std::size_t pair, std::size_t point, Touch const& touch, std::vector<RigidSurface> const& shapes);
  Vec<3> rub(std::size_t pair, std::size_t point, Touch const& touch, double normal_force,
             std::vector<RigidSurface> const& shapes);
  void add(std::size_t shape, Vec<3> const& arm, Vec<3> const& force);
  void remember(std::vector<RigidSurface> const& shapes);

  Setting setting_;
  std::vector<Pair> pairs_;
  std::vector<Load> loads_;
  std::vector<double> frequency2_;
  std::vector<RigidPose> last_;
  std::vector<Stuck> stuck_, last_stuck_;
  double dt_ = 0;  ///< since the evaluation before [s]
  Totals totals_;
};

}  // namespace piola::contact
