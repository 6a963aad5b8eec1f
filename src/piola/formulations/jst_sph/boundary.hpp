// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/actions.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/jst_sph/multipliers.hpp"
#include "piola/particles/ordering.hpp"
#include <array>
#include <optional>
#include <vector>

namespace piola::jst_sph {

/// Supports and loads of one body: evaluates their formulas, releases them, and adds up their work. The passes of
/// boundary_passes.hpp apply them. Theory: docs/theory/boundaries.md.
class Boundary {
 public:
  /// `mirrors`: supports beside those of the assembly. `cloud`: for supports with multipliers; nothing: direct
  /// supports.
  Boundary(Assembly const& assembly, std::size_t body, SlotOrder const& order, std::vector<Support> const& mirrors,
           std::optional<Cloud> cloud);

  /// Gives the body its supports, and the particles that they hold the velocities of t = 0.
  void attach(BodyState& state);
  /// Before a step from `time` to time + dt: what is held, the velocities at its end, the loads at both ends.
  void begin_step(BodyState& state, double time, double dt);
  /// After it: adds the work; and loads that end now leave the acceleration with which Verlet's next step begins.
  void end_step(BodyState& state, double time);
  /// Multiplies the velocities of the body by `factor`, but not along the directions that were held in the last step.
  void damp(BodyState& state, double factor) const;
  /// Adds what supports and loads did in the last step.
  void add_actions(Actions& actions) const;
  /// What a checkpoint holds beside fields: accelerations that supports made up for at the end of the last step.
  std::vector<double> state() const;
  void restore(std::vector<double> const& state);
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_release(double time) const;
  std::size_t bytes() const { return multipliers_ ? multipliers_->bytes() : 0; }

 private:
  /// One prescribed velocity of one particle, as given: several may hold a particle, in any directions.
  struct Row {
    std::size_t support;
    std::array<double, 3> direction;
    double speed;  ///< at the time of the last evaluation [m/s]
    bool at_rest;
  };
  /// A particle with rows that move, end or are oblique; the rows named last come first.
  struct Particle {
    Index slot;
    std::array<double, 3> X;
    double mass;
    std::array<double, 3> position;  ///< at t = 0 [m]
    std::vector<Row> rows;
  };
  /// How the speed of a held direction follows from the rows of its particle.
  struct Origin {
    std::size_t particle;
    std::array<double, 3> weight;
    std::array<std::size_t, 3> row;
    int count;
  };
  struct LoadOnBody {
    std::vector<Index> place;  ///< in loaded_
    std::vector<double> factor;
    std::vector<std::array<double, 3>> X, acceleration;  ///< acceleration: of loads that do not depend on time
    std::array<Expression, 3> value;
    bool steady, named, pressure, follows;
    double until;
    std::vector<std::array<double, 3>> normal;    ///< of pressures
    std::vector<std::array<double, 3>> at_start;  ///< acceleration by named pressures that follow, as the step begins
    std::array<double, 3> normal_of(std::size_t k) const { return normal[k]; }
  };
  /// The support and the particle of a plain support component.
  struct PlainOwner {
    std::size_t support;
    double mass;
  };

  void take_supports(Assembly const& assembly, std::vector<Support> const& mirrors, std::vector<Index> const& slot_of);
  void take_loads(Assembly const& assembly, std::vector<Index> const& slot_of);
  void add_plain(SupportComponent const& component, PlainOwner const& owner, std::size_t& place, bool is_mirror);
  void note_places(BodyState const& state);
  void sum_impulses(BodyState const& state);
  void end_loads(BodyState& state, double time);
  void choose_directions(double time);
  void add_direction(std::size_t particle, std::size_t row);
  void evaluate_speeds(double time);
  /// Of particle k of the load, by it [m/s2].
  static std::array<double, 3> acceleration_of(LoadOnBody const& load, std::size_t k, double time);
  template <class Add>
  void each_load(double time, double evaluate_at, Add const& add) const;
  void evaluate_loads(double time, double end, bool follows);

  Body body_;
  int D_;
  double rho0_ = 0;
  std::vector<Support> driven_;  ///< without their particles
  std::vector<bool> steady_;     ///< per support: its velocity does not depend on time
  std::vector<SupportComponent> plain_;
  std::vector<PlainOwner> plain_owner_;
  std::vector<std::array<double, 3>> plain_start_, held_start_, loaded_start_;  ///< at the start of the step [m]
  std::vector<Impulse> of_support_, of_load_;
  std::vector<Particle> particles_;
  std::vector<HeldDirection> held_;
  std::vector<Origin> origins_;
  std::optional<Cloud> cloud_;
  std::optional<Multipliers> multipliers_;
  std::vector<LoadOnBody> loads_;
  std::vector<LoadedParticle> loaded_;
  double begun_ = 0, ended_ = 0;  ///< start and end of the step that `held_` and `loaded_` are for
  int released_ = -1;             ///< supports and loads that had ended when it began
};

}  // namespace piola::jst_sph
