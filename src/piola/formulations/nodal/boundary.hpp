// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/mechanics/boundary.hpp"
#include "piola/mechanics/surface_hold.hpp"
#include "piola/particles/ordering.hpp"
#include <optional>
#include <vector>

namespace piola::nodal {

/// Supports and loads of one body: a BodyBoundary with the masses of particles and their parts of faces, and places of
/// the surface that supports hold. Theory: docs/theory/boundaries.md, docs/theory/nodal.md.
class Boundary {
 public:
  /// What a body says of itself: masses per slot [kg], for each load on a face the part of it per slot, centroids of
  /// cells, and the places of the surface that supports hold.
  struct OfBody {
    SlotOrder const& order;
    PartFilled<double> const& mass;
    std::vector<PartFilled<FacePart>> const& parts;
    PartFilled<double> const& centroid;
    std::vector<HeldPlace> const& held;
    std::optional<Range> own = std::nullopt;  ///< slots for which this rank answers; nothing: all
    Range slots() const { return own.value_or(Range{0, order.slots()}); }
  };
  /// Where ranks share the body every rank calls this, and what changes or measures the state.
  Boundary(Assembly const& assembly, std::size_t body, OfBody const& of_body);

  /// Gives the particles that supports hold the velocities of t = 0, and the loads of that time.
  void attach(BodyState& state);
  /// Before a step from `time` to time + dt: what is held and how fast, the loads at both ends.
  void begin_step(BodyState& state, double time, double dt);
  /// After it: adds the work and the impulses, and takes loads that end now out of the acceleration with which the next
  /// step begins.
  void end_step(BodyState& state);
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_release(double time) const { return driven_.next_release(time); }

  /// Adds what supports and loads gave since forget_impulses().
  void hand_over(Actions& actions) const;
  void forget_impulses() {
    driven_.forget_impulses();
    surface_.forget_impulses();
  }
  /// Multiplies the velocities that no support prescribes.
  void damp(BodyState& state, double factor) const;
  /// Whether a particle is within the reach of a part of the surface that supports hold.
  bool moves_surface(Index slot) const { return surface_.reaches(slot); }
  /// After something has pushed particles: supports give back what moves the surface that they hold.
  void withstand(BodyState& state) { surface_.keep_velocity(state.x, state.v, work_); }
  /// sum m a^2 of the part of accelerations that supports take away [N m/s2]: by the surface, of all ranks, and along
  /// directions of particles, of those of this rank.
  double square_of_surface(BodyState const& state) const { return surface_.square_of_held(state.a); }
  exec::ExactSum square_of_held(BodyState const& state) const;
  std::size_t bytes() const { return surface_.bytes(); }

  SharedTotal& external_work() { return work_; }  ///< of loads and driven supports since the start [J]
  SharedTotal const& external_work() const { return work_; }

 private:
  void take_loads(Assembly const& assembly, OfBody const& of_body, std::vector<Index> const& slot_of);
  void share(Range own);
  PartFilled<double> factors(Load const& load, std::size_t number, OfBody const& of_body,
                             std::vector<Index> const& slot_of) const;

  Body body_;
  int D_;
  BodyBoundary driven_;
  SurfaceHold surface_;
  std::vector<double> centroid_;  ///< of the cells of loaded particles, relative to these [m]
  SharedTotal work_;
  std::optional<Range> own_;  ///< nothing: all slots
  bool follows_ = false;      ///< whether some load turns with the deformed face, on any rank
};

}  // namespace piola::nodal
