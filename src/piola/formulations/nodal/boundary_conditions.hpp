// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/nodal/absorbing_surface.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/mechanics/body_boundary_conditions.hpp"
#include "piola/mechanics/surface_constraint.hpp"
#include "piola/particles/ordering.hpp"
#include <optional>
#include <vector>

namespace piola::nodal {

/// Supports and loads of one body: a BodyBoundary with the masses of particles and their parts of faces, and the
/// surface places that supports hold. Theory: docs/theory/boundaries.md, docs/theory/nodal.md.
class Boundary {
 public:
  /// Data of a body: masses per slot on this side of mirror planes [kg], for each load on a face its part per slot,
  /// centroids of cells, the surface places that supports hold, and the parts of non-reflecting patches.
  struct BodyInput {
    SlotOrder const& order;
    LazyZeroArray<double> const& mass;
    std::vector<LazyZeroArray<FacePart>> const& parts;
    LazyZeroArray<double> const& centroid;
    std::vector<ConstrainedFacet> const& held;
    std::vector<AbsorbingFacet> const& absorbing;
    std::optional<Range> own = std::nullopt;  ///< local slots; empty: all
    Range slots() const { return own.value_or(Range{0, order.slots()}); }
  };
  /// Collective if the body is distributed, like all members that change or measure the state.
  Boundary(Assembly const& assembly, std::size_t body, BodyInput const& of_body);

  /// Sets the velocities of supported particles, and the loads, of t = 0.
  void attach(BodyState& state);
  /// Before a step from `time` to time + dt: evaluates held directions, their speeds, and the loads at both ends.
  void begin_step(BodyState& state, double time, double dt);
  /// After the step: adds work and impulses, and removes loads that end now from the acceleration of the next step.
  void end_step(BodyState& state);
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_end_time(double time) const { return driven_.next_end_time(time); }

  /// Adds the impulses of supports and loads since reset_impulses().
  void add_resultants_to(Resultants& actions) const;
  void reset_impulses() {
    driven_.reset_impulses();
    surface_.reset_impulses();
  }
  /// Multiplies the velocities that no support prescribes.
  void damp(BodyState& state, double factor) const;
  /// Removes the held directions of particles from a field of vectors.
  void remove_held(FieldRef const& field);
  /// As remove_held() for an acceleration that acts during the whole step dt [s]. Impulses and work of the supports
  /// take what is removed.
  void carry_held(FieldRef const& a, double dt);
  /// Removes from velocities what supports at rest do not allow.
  void hold_at_rest(BodyState& state);
  /// Whether a particle contributes to a surface place that supports hold.
  bool moves_surface(Index slot) const { return surface_.reaches(slot); }
  /// After velocities were changed by contact: supports restore the velocity of the surface that they hold.
  void project_out_reactions(BodyState& state) { surface_.keep_velocity(state.x, state.v, work_); }
  /// sum m a^2 of the part of accelerations that supports remove [N m/s2]: by all surface places, and along
  /// directions of local particles.
  double square_of_surface(BodyState const& state) const { return surface_.square_of_held(state.a); }
  /// sum m a^2 of the part of accelerations that non-reflecting patches remove, by all of them [N m/s2].
  double square_of_absorbed(BodyState const& state) const {
    return absorbing_.square_of_absorbed({state.x, state.v, state.a});
  }
  exec::ReproducibleSum square_of_held(BodyState const& state) const;
  std::size_t bytes() const { return surface_.bytes(); }

  /// Energy that has left through non-reflecting patches since the start [J].
  double radiated_energy() const { return absorbing_.radiated(); }
  void set_radiated_energy(double energy) { absorbing_.set_radiated(energy); }
  bool absorbs() const { return !absorbing_.empty(); }

  DeferredGlobalSum& external_work() { return work_; }  ///< of loads and driven supports since the start [J]
  DeferredGlobalSum const& external_work() const { return work_; }

 private:
  void take_loads(Assembly const& assembly, BodyInput const& of_body, std::vector<Index> const& slot_of);
  void refuse_held_beside_absorbing() const;
  void distribute(Range own);
  LazyZeroArray<double> factors(Load const& load, std::size_t number, BodyInput const& of_body,
                                std::vector<Index> const& slot_of) const;

  Body body_;
  int D_;
  BodyBoundary driven_;
  SurfaceConstraint surface_;
  AbsorbingSurface absorbing_;
  std::vector<double> centroid_;  ///< of the cells of loaded particles, relative to the particles [m]
  std::vector<double> radius_;    ///< axisymmetric bodies: see BoundaryState::loaded_radius
  DeferredGlobalSum work_;
  std::optional<Range> own_;  ///< empty: all slots
  bool follows_ = false;      ///< whether any load is a follower load (replicated)
};

}  // namespace piola::nodal
