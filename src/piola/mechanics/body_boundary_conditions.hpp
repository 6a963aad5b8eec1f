// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/deferred_global_sum.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include "piola/mechanics/body_loads.hpp"
#include "piola/mechanics/body_supports.hpp"
#include "piola/mechanics/resultants.hpp"
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace piola {

/// Supports and loads of one body, for schemes that prescribe velocities and add accelerations at the ends of a step.
/// Computes the held directions and their speeds, the loads at both ends, releases, and the impulses and work of all.
/// The passes of boundary_passes.hpp apply them. Theory: docs/theory/boundaries.md.
class BodyBoundary {
 public:
  using Point = std::array<double, 3>;
  using PrescribedParticle = BodySupports::PrescribedParticle;
  using LoadedPlace = BodyLoads::LoadedPlace;

  /// `multiplied`: Lagrange multipliers enforce the supports.
  BodyBoundary(int dimension, std::vector<Support> const& supports, std::vector<Load> const& loads, bool multiplied);

  // Set-up.
  /// A particle that supports hold; its number.
  std::size_t add_particle(PrescribedParticle const& particle) { return supports_.add_particle(particle); }
  /// Adds a direction in which a support holds the particle. If two prescribe different velocities, the last one added
  /// applies.
  void add_row(std::size_t particle, std::size_t support, Direction const& direction) {
    supports_.add_row(particle, support, direction);
  }
  /// Adds particles and directions of `supports`, those of the constructor, for the ids that takes(id) accepts.
  /// Supports of the surface itself hold no particle.
  void add_supports(std::vector<Support> const& supports, std::function<bool(std::int64_t id)> const& takes,
                    std::function<PrescribedParticle(std::int64_t id)> const& particle_of) {
    supports_.add_supports(supports, takes, particle_of);
  }
  void add_load(std::size_t load, LoadedPlace const& place) { loads_.add(load, place); }
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
  void remove_ended(FieldRef const& rate) const { loads_.remove_ended(rate); }
  /// Adds the impulses of supports and loads since reset_impulses().
  void add_resultants_to(Resultants& actions) const;
  void reset_impulses();
  /// Adds an impulse [N s] of a support or particle that the body treats itself.
  void add_impulse(std::size_t support, Point const& x, Point const& impulse) {
    supports_.impulses()[support].add(x, impulse);
  }
  /// Adds an impulse [N s] of a load that the body treats itself.
  void add_load_impulse(std::size_t load, Point const& x, Point const& impulse) {
    loads_.impulses()[load].add(x, impulse);
  }
  /// Multiplies the velocities in slots before `last` by `factor`, except along the directions held in the last step.
  void damp(FieldRef const& v, Index last, double factor) const { supports_.damp(v, first_kept_, last, factor); }
  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_end_time(double time) const {
    return std::min(supports_.next_end_time(time), loads_.next_end_time(time));
  }

  std::vector<PrescribedDirection>& held() { return supports_.held(); }
  std::vector<LoadedParticle>& loaded() { return loads_.loaded(); }
  bool follows() const { return loads_.follows(); }  ///< whether some active load is a follower load

 private:
  BodySupports supports_;
  BodyLoads loads_;
  double ended_ = 0;          ///< end of the last step [s]
  std::optional<Range> own_;  ///< empty: all slots
  Index first_kept_ = 0;      ///< first slot whose supports and loads this rank keeps
  int released_ = -1;         ///< supports and loads that had ended at the start of the step
};

}  // namespace piola
