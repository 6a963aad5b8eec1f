// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/deferred_global_sum.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/prescribed_data.hpp"
#include "piola/mechanics/resultants.hpp"
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace piola {

/// Whether a slot is local; `own` empty: all are.
inline bool is_local(std::optional<Range> const& own, Index slot) {
  return !own || (slot >= own->first && slot < own->last);
}

/// Supports and loads of one body, for schemes that prescribe velocities and add accelerations at the ends of a step.
/// Computes the held directions and their speeds, the loads at both ends, releases, and the impulses and work of all.
/// The passes of boundary_passes.hpp apply them. Theory: docs/theory/boundaries.md.
class BodyBoundary {
 public:
  using Point = std::array<double, 3>;
  struct PrescribedParticle {
    Index slot;
    Point X;
    double mass;
    Point position;  ///< at t = 0 [m]
  };
  struct LoadedPlace {
    Index slot;
    double mass;
    double factor;  ///< as Load::factor
    Point X;
    std::optional<Direction> normal;  ///< of a pressure
  };

  /// `multiplied`: Lagrange multipliers enforce the supports.
  BodyBoundary(int dimension, std::vector<Support> const& supports, std::vector<Load> const& loads, bool multiplied);

  // Set-up.
  /// A particle that supports hold; its number.
  std::size_t add_particle(PrescribedParticle const& particle);
  /// Adds a direction in which a support holds the particle. If two prescribe different velocities, the last one added
  /// applies.
  void add_row(std::size_t particle, std::size_t support, Direction const& direction);
  /// Adds particles and directions of `supports`, those of the constructor, for the ids that takes(id) accepts.
  /// Supports of the surface itself hold no particle.
  void add_supports(std::vector<Support> const& supports, std::function<bool(std::int64_t id)> const& takes,
                    std::function<PrescribedParticle(std::int64_t id)> const& particle_of);
  void add_load(std::size_t load, LoadedPlace const& place);
  /// Sets the velocities of t = 0 of held particles, after the first begin_step.
  void start(FieldRef const& v) const;
  /// Sets the local slots of a distributed body. Work and impulses are then sums over ranks, and end_step (see
  /// DeferredGlobalSum) and add_resultants_to are collective.
  void share(Range own) { own_ = own; }
  /// As share(), but also discards supports and loads of other ranks. Call before the first begin_step(). Not allowed
  /// with multipliers, which need the supports of all ranks.
  void keep(Range own);

  /// Before a step from `time` to time + dt: evaluates held directions, speeds, and the loads at both ends. Returns
  /// whether the held directions have changed.
  bool begin_step(FieldRef const& x, double time, double dt);
  /// After the step: adds the work [J] and the impulses, applied half at the start and half at the end position of the
  /// step as in the scheme, so that the angular momentum changes by exactly their moments.
  void end_step(FieldRef const& x, DeferredGlobalSum& work);
  /// Verlet: removes loads that end now from the acceleration of the next step.
  void remove_ended(FieldRef const& rate) const;
  /// Adds the impulses of supports and loads since reset_impulses().
  void add_resultants_to(Resultants& actions) const;
  void reset_impulses();
  /// Adds an impulse [N s] of a support or particle that the body treats itself.
  void add_impulse(std::size_t support, Point const& x, Point const& impulse) { of_supports_[support].add(x, impulse); }
  /// Multiplies the velocities in slots before `last` by `factor`, except along the directions held in the last step.
  void damp(FieldRef const& v, Index last, double factor) const;
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_end_time(double time) const { return piola::next_end_time(time, supports_, loads_); }

  std::vector<PrescribedDirection>& held() { return held_; }
  std::vector<LoadedParticle>& loaded() { return loaded_; }
  bool follows() const;  ///< whether some active load is a follower load

 private:
  /// One prescribed velocity of one particle, as given. A particle may have several, in any directions.
  struct Row {
    std::size_t support;
    Direction direction;
    double speed;  ///< at the time of the last evaluation [m/s]
    bool at_rest;
  };
  struct Particle {
    PrescribedParticle of;
    std::vector<Row> rows;  ///< the last ones added come first
  };
  /// Particle and rows that a held direction is computed from.
  struct Origin {
    std::size_t particle;
    PrescribedAxis along;  ///< of the particle's rows
  };
  struct LoadItem {
    std::size_t place;  ///< index in loaded_
    double factor;
    Point X;
    std::optional<Direction> normal;
    Direction steady;  ///< acceleration, if independent of time
  };
  struct LoadOnBody : Load {
    bool steady = true;
    std::vector<LoadItem> items = {};
  };

  void choose_directions(double time);
  void add_direction(std::size_t particle, PrescribedAxis const& along);
  void evaluate_rows(double time);
  void evaluate_speeds(bool continues);
  static Direction acceleration(LoadOnBody const& load, LoadItem const& item, double time);
  Direction acting(LoadOnBody const& load, LoadItem const& item, bool at_end) const;
  void add_loads(int side);
  void evaluate_loads(bool continues);
  void note_places(FieldRef const& x);

  int D_;
  bool multiplied_;
  std::vector<Support> supports_;  ///< without their particles
  std::vector<LoadOnBody> loads_;  ///< without their particles
  bool steady_supports_ = true, steady_loads_ = true, named_loads_ = false;
  std::vector<Particle> particles_;
  std::vector<PrescribedDirection> held_;
  std::vector<Origin> origins_;
  std::vector<LoadedParticle> loaded_;
  std::vector<Index> place_of_slot_;              ///< slot -> index in loaded_
  std::vector<Point> held_start_, loaded_start_;  ///< at the start of the step [m]
  std::vector<ImpulseSum> of_supports_, of_loads_;
  double begun_ = 0, ended_ = 0;  ///< start and end of the step of `held_` and `loaded_`
  std::optional<Range> own_;      ///< empty: all slots
  Index first_kept_ = 0;          ///< first slot whose supports and loads this rank keeps
  int released_ = -1;             ///< supports and loads that had ended at the start of the step
};

}  // namespace piola
