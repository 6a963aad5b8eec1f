// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/math/envelope_cholesky.hpp"
#include "piola/mechanics/boundary.hpp"
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace piola {

/// A part of a body's surface that supports hold: its mean motion is a weighted sum over particles.
struct HeldPlace {
  struct Weight {
    Index slot;
    double weight;
  };
  std::array<double, 3> X{};               ///< its middle in the reference configuration [m]
  std::vector<Weight> weights = {};        ///< in an order of the body; they sum to one
  std::vector<std::size_t> supports = {};  ///< that hold it
};

/// Supports that hold the surface of a body where its particles lie inside, by Lagrange multipliers. With the value
/// y = sum_b w_b v_b of a place along a direction as row of C, the acceleration is
///   a + M^-1 C^T lambda,   C M^-1 C^T lambda = (wanted values) - C a,
/// the least change of a in the norm of the masses M. The force C^T lambda has the resultant of lambda in the place
/// itself, and its work is lambda times the way of the place. For Verlet steps, as the passes of boundary_passes.hpp.
/// Theory: docs/theory/packing.md.
class SurfaceHold {
 public:
  using Point = std::array<double, 3>;

  /// `supports`: those of the assembly; `mass` [kg] and `X` [m] per slot.
  SurfaceHold(int dimension, std::vector<Support> const& supports, std::vector<HeldPlace> const& places,
              std::span<double const> mass, std::vector<Point> const& X);

  bool empty() const { return places_.empty(); }
  /// Ranks share the body: this one has the particles in these slots right. What follows but hand_over() is then
  /// collective; every rank solves for all places.
  void share(Range own) { own_ = own; }
  /// Whether the motion of a place depends on the particle.
  bool reaches(Index slot) const { return particle_in(slot) < particles_.size(); }
  /// Before a step from `time` to time + dt, after supports have chosen which `particles` they hold: those within the
  /// reach of a place keep what is prescribed of them. `changed`: others than before.
  void begin_step(FieldRef const& x, std::span<HeldDirection> particles, bool changed, double time, double dt);
  /// Gives the places the velocities of the end of the step, without asking what that takes: at t = 0, after damping.
  void set_velocity(FieldRef const& v) const;
  /// Before the first kick, after the particles: adds to the acceleration what takes the places to their prescribed
  /// velocities.
  void kick_first(FieldRef const& v, FieldRef const& rate, double dt);
  /// After the second kick: the velocities at the end of the step.
  void kick_last(FieldRef const& v);
  /// After the step: adds the work to `work` [J], and the impulses.
  void end_step(FieldRef const& x, SharedTotal& work);
  /// The velocities at the end of the step once more, after something has pushed particles.
  void keep_velocity(FieldRef const& x, FieldRef const& v, SharedTotal& work);
  /// sum m a^2 of the part of accelerations that reactions of places take away beside those of particles.
  double square_of_held(FieldRef const& rate) const;
  /// Adds what supports gave since the last call.
  void hand_over(Actions& actions) const { driven_.hand_over(actions); }
  void forget_impulses() { driven_.forget_impulses(); }
  std::size_t bytes() const;

 private:
  struct Particle {
    Index slot;
    double mass;
    Point X;
  };
  struct Weight {
    std::size_t particle;  ///< in particles_
    double weight;
  };
  struct Place {
    Point X;
    std::size_t first, last;  ///< in weights_
  };
  /// A prescribed value: of a place, or of a particle that supports hold within the reach of one.
  struct Row {
    Point X, direction;
    std::size_t first, last;  ///< in weights_
    HeldDirection* held;
    bool of_place;
  };
  /// Its number in particles_, or their count.
  std::size_t particle_in(Index slot) const;
  void make_rows(std::span<HeldDirection> particles);
  template <class Of>
  std::vector<double> solved(FieldRef const& field, Of const& wanted) const;
  void add(std::vector<double> const& lambda, FieldRef const& to) const;
  double value(Row const& row, FieldRef const& field) const;
  FieldRef places_at(FieldRef const& x);
  void complete(FieldRef const& field) const;

  int D_;
  BodyBoundary driven_;              ///< of the places, as if they were particles of unit mass
  std::vector<Particle> particles_;  ///< within the reach of places, in the order in which these name them
  std::vector<std::pair<Index, std::size_t>> number_of_slot_;  ///< of them, by slot
  std::vector<Weight> weights_;                                ///< place by place, then the particles themselves
  std::vector<Place> places_;
  std::vector<Row> rows_;
  EnvelopeCholesky matrix_{{}};            ///< C M^-1 C^T
  std::vector<double> place_coordinates_;  ///< of the places, D each [m]
  std::vector<Index> slots_;               ///< of particles_
  std::optional<Range> own_;               ///< nothing: all slots
};

}  // namespace piola
