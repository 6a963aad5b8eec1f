// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/prescribed_data.hpp"
#include "piola/mechanics/resultants.hpp"
#include <array>
#include <optional>
#include <vector>

namespace piola {

/// Loads of one body: the particles on which they act, their accelerations at both ends of a step, and the impulses of
/// the loads that have names.
class BodyLoads {
 public:
  using Point = std::array<double, 3>;
  struct LoadedPlace {
    Index slot;
    double mass;
    double factor;  ///< as Load::factor
    Point X;
    std::optional<Direction> normal;  ///< of a pressure
  };
  BodyLoads(int dimension, std::vector<Load> const& loads);

  void add(std::size_t load, LoadedPlace const& place);
  /// Discards places in other slots.
  void keep(Range own);

  int ended(double time) const;  ///< number of loads that have ended
  double next_end_time(double time) const { return piola::next_end_time(time, loads_); }
  bool follows() const;  ///< whether some active load is a follower load
  /// Before a step from `time` to end_time: `changed`: other loads act than in the last step; `continues`: the step
  /// starts where the last one ended.
  void begin_step(FieldRef const& x, double time, double end_time, bool changed, bool continues);
  /// After the step: adds the impulses on local particles.
  void end_step(FieldRef const& x, std::optional<Range> const& own);
  void remove_ended(FieldRef const& rate) const;

  std::vector<LoadedParticle>& loaded() { return loaded_; }
  std::vector<LoadedParticle> const& loaded() const { return loaded_; }
  /// Impulses by load; the reader resets them.
  std::vector<ImpulseSum>& impulses() { return impulses_; }
  std::vector<ImpulseSum> const& impulses() const { return impulses_; }

 private:
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
  static Direction acceleration(LoadOnBody const& load, LoadItem const& item, double time);
  Direction acting(LoadOnBody const& load, LoadItem const& item, bool at_end) const;
  void add_loads(int side);
  void evaluate(bool continues);

  int D_;
  std::vector<LoadOnBody> loads_;  ///< without their particles
  bool steady_ = true, named_ = false;
  std::vector<LoadedParticle> loaded_;
  std::vector<Index> place_of_slot_;  ///< slot -> index in loaded_
  std::vector<Point> loaded_start_;   ///< positions at the start of the step [m]
  std::vector<ImpulseSum> impulses_;  ///< by load
  double begun_ = 0, ended_ = 0;      ///< start and end of the step of `loaded_`
};

}  // namespace piola
