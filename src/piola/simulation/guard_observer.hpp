// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/guards/energy_jump.hpp"
#include "piola/guards/guard.hpp"
#include "piola/simulation/observers.hpp"

namespace piola {

/// Calls the guards at each row of the history, at least every thousand steps, and at the end, and the guard of energy
/// jumps at each step. Their state is saved in checkpoints, so a resumed run behaves identically.
class GuardObserver : public Observer {
 public:
  GuardObserver(Results results, double mass, HistoryObserver const& history);
  void observe(Formulation const& formulation, TimeState const& moment) override;
  void finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, TimeState const& moment) override;
  std::optional<StopRequest> stop_request() const override;
  /// For the summary; empty if the guards are off.
  std::optional<std::vector<GuardNumbers>> report() const;

 private:
  bool is_on() const { return results_.spec.run.guards.on; }
  void evaluate_guards(GuardInput const& look);

  Results results_;
  HistoryObserver const& history_;
  EnergyScale scale_;
  EnergyJumpGuard jump_;
  Guards guards_;        ///< on rank 0; none if they are off
  bool stops_ = false;   ///< whether a guard stops the run; equal on all ranks
  bool kicked_ = false;  ///< the case has a one-step initial pressure, whose energy no column contains
  double last_look_ = 0;
  std::vector<double> told_;  ///< by guard: whether its warning has been shown during the run
};

}  // namespace piola
