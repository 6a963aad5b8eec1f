// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/boundary_conditions.hpp"
#include "piola/mechanics/resultants.hpp"
#include <array>
#include <vector>

namespace piola::taylor_sph {

/// Actions of supports and loads on one body: impulses in the last step, work since the start, and the momentum that a
/// body without supports must have. Refers to the particles, the boundary and the state of the body, which must outlive
/// it.
class ExternalActions {
 public:
  /// Evolved state.
  struct Totals {
    double work = 0;                   ///< since the start [J]
    double power = 0;                  ///< of the boundary now [W]
    std::array<double, 6> momentum{};  ///< linear and angular, which a body without supports must conserve
  };
  /// Half the impulse of a traction on a particle.
  struct HalfImpulse {
    std::size_t load;
    Index particle;
    std::array<double, 3> impulse;  ///< [N s]
  };

  ExternalActions(Assembly const& assembly, Particles const& particles, Boundary& boundary, Backend const& backend,
                  BodyState& state);

  /// Takes the momentum at the start.
  void set_initial_momentum();
  Impulse momentum() const;  ///< of the body now
  /// Adds the impulses of loads in a step. `tractions`: applied to the particles; null: those of the surface at half
  /// time, whose normals are those of now afterwards.
  void add_loads(double time, double dt, std::vector<HalfImpulse> const* tractions);
  /// Restores the momentum of a body without supports.
  void conserve_momentum();
  /// Impulses of supports. `before`: momentum at the start of the step. Call after add_loads().
  void find_reactions(Impulse const& before, double dt);
  void update_power() { totals.power = boundary_.power(); }
  /// Adds the work of the boundary in a step, with the mean of its power at both ends.
  void add_boundary_work(double dt);
  /// Adds the momentum of a change of velocity.
  void add_momentum(Index particle, std::array<double, 3> const& change);
  void add_to(Resultants& actions) const;

  Totals totals;

 private:
  template <class F>
  void each_impulse(double time, double dt, std::vector<HalfImpulse> const* tractions, F const& add);
  void move_surface(double ahead);

  Particles const& particles_;
  Boundary& boundary_;
  Backend const& backend_;
  BodyState& state_;
  std::vector<Impulse> of_support_, of_load_;  ///< in the last step
};

}  // namespace piola::taylor_sph
