// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/adaptle/options.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::adaptle {

/// Additions of a case to the law of each particle: an initial pressure, the burning of explosives, and a scatter of
/// the failure strength. Not saved in checkpoints: a function of the case and the time.
class PointFactors {
 public:
  /// For a time [s]: the start, or that of a resumed run. own: local slots of each body; others have none.
  void build(std::vector<BodyConstants> const& bodies, std::vector<BodyOptions> const& options,
             std::vector<Range> const& own, ParticleSet const& set, double time);
  /// Updates time-dependent factors to a time [s].
  void go_to(double time);
  /// Removes factors that act for one step only.
  void end_of_step();

  LawFactors view() const;

 private:
  void add_initial_pressure(Range own, BodyOptions const& options);
  std::array<double, 3> const& X(Index slot) const { return set_->X[static_cast<std::size_t>(slot)]; }
  void add_explosive(BodyConstants const& body, Range own, BodyOptions const& options);
  void add_scatter(BodyConstants const& body, Range own);

  /// An explosive body.
  struct Explosive {
    Range own;
    double rate;  ///< of burning [1/s]
  };

  /// The values of a factor per slot, with `otherwise` for bodies that do not have it.
  LazyZeroArray<double>& with(LazyZeroArray<double>& values, double otherwise) const;

  ParticleSet const* set_ = nullptr;
  std::vector<Range> own_;
  LazyZeroArray<double> initial_pressure_, burnt_, toughness_;  ///< per slot; empty: none
  LazyZeroArray<double> ignition_time_;                         ///< ignition time of each particle of an explosive [s]
  std::vector<Explosive> explosives_;
  std::vector<Range> impulses_;  ///< particles whose initial pressure acts for one step
};

}  // namespace piola::adaptle
