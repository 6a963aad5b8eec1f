// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/part_filled.hpp"
#include "piola/formulations/adaptle/options.hpp"
#include "piola/formulations/adaptle/particle_order.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::adaptle {

/// What a case adds to the law of each particle: a pressure at the start, the burning of explosives, and a scatter of
/// what particles bear before they fail. Nothing of it is in checkpoints: it follows from the case and the time.
class PointFactors {
 public:
  /// At a time [s]: that of the start, or of a resumed run. own: slots of this rank, of each body; others have none.
  void build(std::vector<BodyConstants> const& bodies, std::vector<BodyOptions> const& options,
             std::vector<Range> const& own, ParticleSet const& set, ParticleOrder const& order, double time);
  /// Brings what changes to a time [s].
  void go_to(double time);
  /// What acts for one step only is gone.
  void end_of_step();

  OwnFactors view() const;

 private:
  void add_initial_pressure(Range own, BodyOptions const& options);
  std::array<double, 3> const& X(Index slot) const { return set_->X[order_->id(slot)]; }
  void add_explosive(BodyConstants const& body, Range own, BodyOptions const& options);
  void add_scatter(BodyConstants const& body, Range own);

  /// An explosive body.
  struct Explosive {
    Range own;
    double rate;  ///< of burning [1/s]
  };

  /// Of a factor, per slot, that other bodies do not have.
  PartFilled<double>& with(PartFilled<double>& values, double otherwise) const;

  ParticleOrder const* order_ = nullptr;
  ParticleSet const* set_ = nullptr;
  std::vector<Range> own_;
  PartFilled<double> initial_pressure_, burnt_, toughness_;  ///< per slot; empty: none
  PartFilled<double> lit_;                                   ///< when each particle of an explosive is lit [s]
  std::vector<Explosive> explosives_;
  std::vector<Range> impulses_;  ///< particles whose initial pressure acts for one step
};

}  // namespace piola::adaptle
