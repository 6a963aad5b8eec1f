// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/math/envelope_cholesky.hpp"
#include "piola/mechanics/body_boundary_conditions.hpp"
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace piola {

/// A part of a body's surface that supports hold by its mean motion, a weighted sum over particles.
struct ConstrainedFacet {
  struct Weight {
    Index slot;
    double weight;
  };
  std::array<double, 3> X{};               ///< its mean reference position [m]
  std::vector<Weight> weights = {};        ///< particles numbered as in the body; they sum to one
  std::vector<std::size_t> supports = {};  ///< indices of the supports that hold it
};

/// Supports that hold the surface of a body whose particles lie inside, by Lagrange multipliers. With the value y =
/// sum_b w_b v_b of a place along a direction as row of C, the acceleration is a + M^-1 C^T lambda with C M^-1 C^T
/// lambda = (prescribed values) - C a, the least change of a in the norm of the masses M. The force C^T lambda has its
/// resultant lambda at the place, and its work is lambda times the displacement of the place. For Verlet steps, like
/// the passes of boundary_passes.hpp. Theory: docs/theory/packing.md.
class SurfaceConstraint {
 public:
  using Point = std::array<double, 3>;

  /// `supports`: those of the assembly; `mass` [kg] and `X` [m] per slot.
  SurfaceConstraint(int dimension, std::vector<Support> const& supports, std::vector<ConstrainedFacet> const& places,
                    std::span<double const> mass, std::vector<Point> const& X);

  bool empty() const { return places_.empty(); }
  /// Sets the local slots of a distributed body. All further members except add_resultants_to() are then collective;
  /// the solution for all places is replicated.
  void share(Range own) { own_ = own; }
  /// Whether the particle contributes to the motion of a place.
  bool reaches(Index slot) const { return particle_in(slot) < particles_.size(); }
  /// Before a step from `time` to time + dt, after the held `particles` have been chosen. Those that contribute to a
  /// place keep their prescribed motion. `changed`: whether the held particles have changed.
  void begin_step(FieldRef const& x, std::span<PrescribedDirection> particles, bool changed, double time, double dt);
  /// Sets the velocities of the places to those of the end of the step, without recording impulses: at t = 0, after
  /// damping.
  void set_velocity(FieldRef const& v) const;
  /// Before the first kick, after the held particles: adds the acceleration that gives the places their prescribed
  /// velocities.
  void kick_first(FieldRef const& v, FieldRef const& rate, double dt);
  /// After the second kick: sets the velocities of the end of the step.
  void kick_last(FieldRef const& v);
  /// After the step: adds the work to `work` [J], and the impulses.
  void end_step(FieldRef const& x, DeferredGlobalSum& work);
  /// Restores the velocities of the end of the step after contact has changed velocities; adds the work [J].
  void keep_velocity(FieldRef const& x, FieldRef const& v, DeferredGlobalSum& work);
  /// sum m a^2 of the part of accelerations that the reactions of places remove, without those of held particles.
  double square_of_held(FieldRef const& rate) const;
  /// Adds the impulses of supports since the last call.
  void add_resultants_to(Resultants& actions) const { driven_.add_resultants_to(actions); }
  void reset_impulses() { driven_.reset_impulses(); }
  std::size_t bytes() const;

 private:
  struct Particle {
    Index slot;
    double mass;
    Point X;
  };
  struct Weight {
    std::size_t particle;  ///< index in particles_
    double weight;
  };
  struct Place {
    Point X;
    std::size_t first, last;  ///< indices in weights_
  };
  /// A prescribed value: of a place, or of a held particle that contributes to one.
  struct Row {
    Point X, direction;
    std::size_t first, last;  ///< indices in weights_
    PrescribedDirection* held;
    bool of_place;
  };
  /// Index in particles_, or their count if absent.
  std::size_t particle_in(Index slot) const;
  void make_rows(std::span<PrescribedDirection> particles);
  template <class Of>
  std::vector<double> solved(FieldRef const& field, Of const& wanted) const;
  void add(std::vector<double> const& lambda, FieldRef const& to) const;
  double value(Row const& row, FieldRef const& field) const;
  FieldRef places_at(FieldRef const& x);
  void complete(FieldRef const& field) const;

  int D_;
  BodyBoundary driven_;              ///< of the places, as particles of unit mass
  std::vector<Particle> particles_;  ///< that contribute to places, in the order of their first occurrence
  std::vector<std::pair<Index, std::size_t>> number_of_slot_;  ///< slot -> index in particles_
  std::vector<Weight> weights_;                                ///< place by place, then the held particles
  std::vector<Place> places_;
  std::vector<Row> rows_;
  EnvelopeCholesky matrix_{{}};            ///< C M^-1 C^T
  std::vector<double> place_coordinates_;  ///< of the places, D each [m]
  std::vector<Index> slots_;               ///< of particles_
  std::optional<Range> own_;               ///< empty: all slots
};

}  // namespace piola
