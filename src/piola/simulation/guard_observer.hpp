// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/energy_jump.hpp"
#include "piola/simulation/guard.hpp"
#include "piola/simulation/observers.hpp"

namespace piola {

/// Lets the guards look at each row of the history, at least every thousand steps, and at the end, and the guard of
/// energy jumps at each step. What they have seen is in the checkpoints: a resumed run says and does the same.
class GuardObserver : public Observer {
 public:
  GuardObserver(Results results, double mass, HistoryObserver const& history);
  void see(Formulation const& formulation, Moment const& moment) override;
  void finish(Formulation const& formulation, Moment const& moment, Ending ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, Moment const& moment) override;
  std::optional<Objection> objection() const override;
  /// For the summary; nothing if the guards are off.
  std::optional<std::vector<GuardNumbers>> report() const;

 private:
  Results results_;
  HistoryObserver const& history_;
  EnergyScale scale_;
  EnergyJumpGuard jump_;
  Guards guards_;        ///< none if they are off
  bool kicked_ = false;  ///< a pressure of the case acts in the first step, and no book holds its energy
  double last_look_ = 0;
  std::vector<double> told_;  ///< by guard: whether the user has been told while the run goes on
};

}  // namespace piola
