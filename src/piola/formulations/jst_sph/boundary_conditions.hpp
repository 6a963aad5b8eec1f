// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/jst_sph/multipliers.hpp"
#include "piola/mechanics/body_boundary_conditions.hpp"
#include "piola/particles/ordering.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace piola::jst_sph {

/// Supports and loads of one body: those of BodyBoundary, plain supports at rest along axes, and multipliers. Theory:
/// docs/theory/boundaries.md.
class Boundary {
 public:
  /// `mirrors`: supports in addition to those of the assembly. `cloud`: for supports with multipliers; empty: direct
  /// supports.
  Boundary(Assembly const& assembly, std::size_t body, SlotOrder const& order, std::vector<Support> const& mirrors,
           std::optional<Cloud> cloud);

  /// Sets the supports of the body and the velocities of t = 0 of supported particles.
  void attach(BodyState& state);
  /// Before a step from `time` to time + dt: evaluates held directions, their speeds at its end, and the loads at both
  /// ends.
  void begin_step(BodyState& state, double time, double dt);
  /// After the step: adds the work, and removes loads that end now from the acceleration of Verlet's next step.
  void end_step(BodyState& state);
  /// Multiplies the velocities of the body by `factor`, except along the directions held in the last step.
  void damp(BodyState& state, double factor) const { driven_.damp(state.v, state.slots.last, factor); }
  /// Sets the local slots of a distributed body. Call before attach().
  void distribute(Range own);
  /// Adds the impulses of supports and loads in the last step. Collective if the body is distributed.
  void add_resultants_to(Resultants& actions) const;
  void reset_impulses() { driven_.reset_impulses(); }
  /// State for a checkpoint in addition to fields: accelerations by supports at the end of the last step, replicated.
  /// Collective if the body is distributed.
  std::vector<double> state() const;
  void restore(std::vector<double> const& state);
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_end_time(double time) const { return driven_.next_end_time(time); }
  std::size_t bytes() const { return multipliers_ ? multipliers_->bytes() : 0; }

 private:
  /// The support and the particle of a plain support component.
  struct SingleOwner {
    std::size_t support;
    double mass;
    std::size_t number = 0;  ///< of the component in the whole body
  };
  void take_supports(Assembly const& assembly, std::vector<Support> const& supports, std::vector<Index> const& slot_of);
  void take_loads(Assembly const& assembly, std::vector<Index> const& slot_of);
  void add_plain(SupportComponent const& component, SingleOwner const& owner, std::size_t& place, bool is_mirror);
  double mass_of(Assembly const& assembly, std::int64_t id) const;
  bool has(std::int64_t id) const { return id >= body_.first && id < body_.last; }

  Body body_;
  int D_;
  double rho0_ = 0;
  std::optional<Cloud> cloud_;
  BodyBoundary driven_;
  std::vector<SupportComponent> plain_;  ///< of local particles
  std::size_t plain_of_all_ = 0;         ///< number in the whole body
  std::vector<SingleOwner> plain_owner_;
  std::vector<std::array<double, 3>> plain_start_;  ///< at the start of the step [m]
  std::optional<Multipliers> multipliers_;
  std::optional<Range> own_;  ///< empty: all slots
};

}  // namespace piola::jst_sph
