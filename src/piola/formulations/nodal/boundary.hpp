// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/actions.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/formulations/prescribed.hpp"
#include "piola/particles/ordering.hpp"
#include <array>
#include <vector>

namespace piola::nodal {

/// Supports and loads of one body: evaluates their formulas, releases them, and adds up their work. The passes of
/// boundary_passes.hpp apply them. Theory: docs/theory/boundaries.md, docs/theory/nodal.md.
class Boundary {
 public:
  /// What a body says of itself: masses per slot [kg], for each load on a face the part of it per slot, and
  /// centroids of cells.
  struct OfBody {
    SlotOrder const& order;
    std::vector<double> const& mass;
    std::vector<std::vector<FacePart>> const& parts;
    std::vector<double> const& centroid;
  };
  Boundary(Assembly const& assembly, std::size_t body, OfBody const& of_body);

  /// Gives the particles that supports hold the velocities of t = 0, and the loads of that time.
  void attach(BodyState& state);
  /// Before a step from `time` to time + dt: what is held and how fast, the loads at both ends.
  void begin_step(BodyState& state, double time, double dt);
  /// After it: adds the work and the impulses, and takes loads that end now out of the acceleration with which the next
  /// step begins.
  void end_step(BodyState& state, double time);
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_release(double time) const;

  /// Adds what supports and loads gave since the last call.
  void hand_over(Actions& actions);
  /// Multiplies the velocities that no support prescribes.
  void damp(BodyState& state, double factor) const;

  double external_work() const { return work_; }  ///< of loads and driven supports since the start [J]
  void set_external_work(double work) { work_ = work; }

 private:
  /// A particle with supports, those named last first: they have their way where two ask for different things.
  struct Particle {
    Index slot;
    std::array<double, 3> X;
    double mass;
    struct Row {
      std::size_t support;
      Direction direction;
    };
    std::vector<Row> rows;
  };
  struct LoadOnBody {
    std::vector<Index> place;  ///< in loaded_
    std::vector<double> factor;
    std::vector<std::array<double, 3>> X;
    std::vector<std::array<double, 3>> steady;  ///< acceleration of loads that do not depend on time
    std::array<Expression, 3> value;
    std::vector<Direction> normal;  ///< of a pressure
    double until;
    bool follows;
  };

  void take_supports(Assembly const& assembly, OfBody const& of_body);
  void take_loads(Assembly const& assembly, OfBody const& of_body);
  std::vector<double> factors(Load const& load, std::size_t number, OfBody const& of_body) const;
  void hold(Particle const& particle, double time, double end);
  double speed_of(Particle const& particle, Particle::Row const& row, double time) const;
  static Direction acceleration(LoadOnBody const& load, std::size_t k, double time);
  /// At an end of the step that `loaded_` is for, turned with the face where the load follows it.
  Direction acting(LoadOnBody const& load, std::size_t k, bool at_end, double time) const;
  void add_loads(double time, double evaluate_at, bool at_end);

  Body body_;
  int D_;
  std::vector<Index> slot_of_;
  std::vector<Support> supports_;                      ///< without their particles
  bool steady_supports_ = true, steady_loads_ = true;  ///< loads that follow a face are not
  bool follows_ = false;
  std::vector<Particle> particles_;
  std::vector<HeldDirection> held_;
  std::vector<std::size_t> held_by_;  ///< supports
  std::vector<Impulse> of_supports_, of_loads_;
  std::vector<LoadOnBody> loads_;
  std::vector<LoadedParticle> loaded_;
  double begun_ = 0;   ///< start of the step that `held_` and `loaded_` are for
  int released_ = -1;  ///< supports and loads that had ended then
  double work_ = 0;
};

}  // namespace piola::nodal
