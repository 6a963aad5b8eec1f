// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/guards/guard.hpp"
#include "piola/observers/output_schedule.hpp"
#include <limits>
#include <optional>

namespace piola {

/// Ends a run when its energy jumps: total energy minus external work rises by more than all energy that the run has
/// had so far, or the kinetic energy exceeds the available energy by more than that.
///
/// Checks the length of every step and, because a sum over all particles costs 2 to 6 % of a step, the kinetic energy
/// of every tenth one. All energies are evaluated only if the kinetic energy exceeds the known energy four times, if
/// the step falls to a quarter of the shortest one so far, in the rows of the history, and before checkpoints. If loads
/// or driven supports do work, a jump must persist for five steps and for two transit times of a pressure wave across
/// the finest spacing, because energy may precede the work of a load that begins. Otherwise one step is enough.
class EnergyJumpGuard {
 public:
  /// `particles` must outlive the guard. scale: of the run, before its first step.
  EnergyJumpGuard(CaseSpec const& spec, ParticleSet const& particles, EnergyScale const& scale);
  /// Called at the start and after each step. row: energies of this step if already evaluated, else null. Collective.
  void observe(Formulation const& formulation, TimeState const& moment, Diagnostics const* row, bool last);
  /// Set once the energy has jumped or is not a number.
  std::optional<StopRequest> const& stop_request() const { return stop_request_; }
  void save(StateWriter& writer) const;
  void load(NamedState& reader, double time);  ///< time [s] of the checkpoint

 private:
  bool is_strange(Formulation const& formulation, TimeState const& moment) const;
  void look(Formulation const& formulation, TimeState const& moment, Diagnostics const& now, bool last);
  void object(Formulation const& formulation, TimeState const& moment, Diagnostics const& now);

  ParticleSet const& particles_;
  EnergyScale scale_;
  Schedule checkpoints_;  ///< of the case: the energy is checked before each checkpoint
  double limit_;          ///< of a rise, relative to the energy of the run
  double stop_;           ///< run.guards.energy_rise_stop
  bool loaded_;           ///< loads, driven supports or rigid shapes may do work
  bool pressed_;          ///< an initial pressure supplies kinetic energy
  double lasting_ = 0;    ///< minimum duration of a jump in a loaded run [s]
  double lowest_ = std::numeric_limits<double>::infinity(), lowest_time_ = 0, lowest_step_ = 0;
  double kinetic_ = 0;                                         ///< largest kinetic energy before any jump [J]
  double known_ = 0;                                           ///< largest energy at the last check [J]
  double shortest_ = std::numeric_limits<double>::infinity();  ///< shortest step at a check [s]
  double rises_ = 0;                                           ///< consecutive checks that found a jump
  double risen_time_ = 0, risen_step_ = 0;                     ///< time and step at the first of these checks [s]
  std::optional<StopRequest> stop_request_;
};

}  // namespace piola
