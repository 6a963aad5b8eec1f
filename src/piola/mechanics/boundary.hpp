// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/mechanics/actions.hpp"
#include "piola/mechanics/held.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/parallel/shared_total.hpp"
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace piola {

/// Whether a slot is one of those that a rank answers for; nothing: it answers for all.
inline bool is_own(std::optional<Range> const& own, Index slot) {
  return !own || (slot >= own->first && slot < own->last);
}

/// Supports and loads of one body, for schemes that prescribe velocities and add accelerations at the ends of a step:
/// which directions of which particles are held at a time and how fast, the loads at both ends, releases, and what all
/// of them did. The passes of boundary_passes.hpp apply them. Theory: docs/theory/boundaries.md.
class BodyBoundary {
 public:
  using Point = std::array<double, 3>;
  struct HeldParticle {
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

  /// `multiplied`: multipliers hold what supports prescribe.
  BodyBoundary(int dimension, std::vector<Support> const& supports, std::vector<Load> const& loads, bool multiplied);

  // Set-up.
  /// A particle that supports hold; its number.
  std::size_t add_particle(HeldParticle const& particle);
  /// A direction in which a support holds it. Where two ask for different velocities the one added last has its way.
  void add_row(std::size_t particle, std::size_t support, Direction const& direction);
  /// Both for the particles of these supports that are taken; supports are those of the constructor. Those that hold
  /// the surface hold no particle.
  void add_supports(std::vector<Support> const& supports, std::function<bool(std::int64_t id)> const& takes,
                    std::function<HeldParticle(std::int64_t id)> const& particle_of);
  void add_load(std::size_t load, LoadedPlace const& place);
  /// Gives the particles that supports hold the velocities of t = 0, after a first begin_step.
  void start(FieldRef const& v) const;
  /// Ranks share the body: this one answers for the particles in these slots. Work and impulses are then sums over all
  /// ranks, and end_step (see SharedTotal) and hand_over collective.
  void share(Range own) { own_ = own; }
  /// The same before a first begin_step: forgets what concerns others. Not where multipliers hold, for which ranks tell
  /// each other all.
  void keep(Range own);

  /// Before a step from `time` to time + dt: what is held and how fast, the loads at both ends. Whether the directions
  /// that are held are others than before.
  bool begin_step(FieldRef const& x, double time, double dt);
  /// After it: adds the work [J], and the impulses, at the places of the start and of the end of the step, as
  /// the step itself divides them: the angular momentum then changes by just their moments.
  void end_step(FieldRef const& x, SharedTotal& work);
  /// Verlet: takes loads that end now out of the acceleration with which the next step begins.
  void take_out_ended(FieldRef const& rate) const;
  /// Adds what supports and loads gave since forget_impulses().
  void hand_over(Actions& actions) const;
  void forget_impulses();
  /// Of one more support or particle that the body deals with itself [N s].
  void add_impulse(std::size_t support, Point const& x, Point const& impulse) { of_supports_[support].add(x, impulse); }
  /// Multiplies the velocities in slots before `last` by `factor`, but not along the directions that were held in the
  /// last step.
  void damp(FieldRef const& v, Index last, double factor) const;
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_release(double time) const { return piola::next_release(time, supports_, loads_); }

  std::vector<HeldDirection>& held() { return held_; }
  std::vector<LoadedParticle>& loaded() { return loaded_; }
  bool follows() const;  ///< whether some load that acts turns with the deformed face

 private:
  /// One prescribed velocity of one particle, as given: several may hold a particle, in any directions.
  struct Row {
    std::size_t support;
    Direction direction;
    double speed;  ///< at the time of the last evaluation [m/s]
    bool at_rest;
  };
  struct Particle {
    HeldParticle of;
    std::vector<Row> rows;  ///< those named last come first
  };
  /// What a held direction is made of.
  struct Origin {
    std::size_t particle;
    HeldAlong along;  ///< of the particle's rows
  };
  struct LoadItem {
    std::size_t place;  ///< in loaded_
    double factor;
    Point X;
    std::optional<Direction> normal;
    Direction steady;  ///< acceleration, if that does not depend on time
  };
  struct LoadOnBody : Load {
    bool steady = true;
    std::vector<LoadItem> items = {};
  };

  void choose_directions(double time);
  void add_direction(std::size_t particle, HeldAlong const& along);
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
  std::vector<LoadOnBody> loads_;  ///< likewise
  bool steady_supports_ = true, steady_loads_ = true, named_loads_ = false;
  std::vector<Particle> particles_;
  std::vector<HeldDirection> held_;
  std::vector<Origin> origins_;
  std::vector<LoadedParticle> loaded_;
  std::vector<Index> place_of_slot_;              ///< in loaded_
  std::vector<Point> held_start_, loaded_start_;  ///< at the start of the step [m]
  std::vector<ImpulseSum> of_supports_, of_loads_;
  double begun_ = 0, ended_ = 0;  ///< start and end of the step that `held_` and `loaded_` are for
  std::optional<Range> own_;      ///< nothing: all slots
  Index first_kept_ = 0;          ///< slots before it do not concern this rank
  int released_ = -1;             ///< supports and loads that had ended when it began
};

}  // namespace piola
