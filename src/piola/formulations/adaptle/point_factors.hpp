// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/options.hpp"
#include "piola/formulations/adaptle/particle_order.hpp"
#include <array>
#include <vector>

namespace piola::adaptle {

/// What a case adds to the law of each particle: a pressure at the start, the burning of explosives, and a scatter of
/// what particles bear before they fail. Nothing of it is in checkpoints: it follows from the case and the time.
class PointFactors {
 public:
  /// At a time [s]: that of the start, or of a resumed run. X: reference positions, per id [m].
  void build(std::vector<BodyConstants> const& bodies, std::vector<BodyOptions> const& options, FieldRef const& volume,
             Index particles, ParticleOrder const& order, std::span<std::array<double, 3> const> X, double time);
  /// Brings what changes to a time [s].
  void go_to(double time);
  /// What acts for one step only is gone.
  void end_of_step();

  OwnFactors view() const;

 private:
  void add_initial_pressure(BodyConstants const& body, BodyOptions const& options);
  std::array<double, 3> const& X(Index slot) const { return X_[order_->id(slot)]; }
  void add_explosive(BodyConstants const& body, BodyOptions const& options);
  void add_scatter(BodyConstants const& body);

  /// An explosive body.
  struct Explosive {
    Index first, last;
    double rate;  ///< of burning [1/s]
  };

  FieldRef volume_;
  std::size_t room_ = 0;
  ParticleOrder const* order_ = nullptr;
  std::span<std::array<double, 3> const> X_;
  std::vector<double> initial_pressure_, burnt_, toughness_;  ///< per slot; empty: none
  std::vector<double> lit_;                                   ///< when each particle of an explosive is lit [s]
  std::vector<Explosive> explosives_;
  std::vector<std::array<Index, 2>> impulses_;  ///< bodies whose initial pressure acts for one step
};

}  // namespace piola::adaptle
