// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/guard.hpp"
#include "piola/simulation/schedule.hpp"
#include <limits>
#include <optional>

namespace piola {

/// Ends a run when its energy jumps: total energy minus external work rises by more than all energy that the run has
/// had so far, or kinetic energy exceeds by more than that what there was to turn into motion.
///
/// Looks at the length of every step and, because a sum over all particles costs 2 to 6 % of a step, at the kinetic
/// energy of every tenth one. All energies are evaluated only where kinetic energy exceeds the energy known so far four
/// times, or where the step falls to a quarter of the shortest one so far, and in the rows of the history and before
/// checkpoints. Where loads or driven supports do work, a jump must be found at five steps in a row and for two times
/// of a pressure wave across the finest spacing, because energy may be ahead of the work of a load that begins; without
/// them one step is enough.
class EnergyJumpGuard {
 public:
  /// `particles` must outlive the guard. scale: of the run, before it has begun.
  EnergyJumpGuard(CaseSpec const& spec, ParticleSet const& particles, EnergyScale const& scale);
  /// Called at the start and after each step. row: energies of this step if they have been evaluated, else null.
  /// Collective; called on rank 0.
  void see(Formulation const& formulation, Moment const& moment, Diagnostics const* row, bool last);
  /// Set once the energy has jumped or is not a number.
  std::optional<Objection> const& objection() const { return objection_; }
  void save(StateWriter& writer) const;
  void load(NamedState& reader, double time);  ///< time [s] of the checkpoint

 private:
  bool is_strange(Formulation const& formulation, Moment const& moment) const;
  void look(Formulation const& formulation, Moment const& moment, Diagnostics const& now, bool last);
  void object(Formulation const& formulation, Moment const& moment, Diagnostics const& now);

  ParticleSet const& particles_;
  EnergyScale scale_;
  Schedule checkpoints_;  ///< of the case: a state that is kept is looked at
  double limit_;          ///< of a rise, in energies that the run has had
  double stop_;           ///< run.guards.energy_rise_stop
  bool loaded_;           ///< loads, driven supports or rigid shapes may do work
  bool pressed_;          ///< a pressure of the start feeds motion
  double lasting_;        ///< how long a jump must last in a loaded run [s]
  double lowest_ = std::numeric_limits<double>::infinity(), lowest_time_ = 0, lowest_step_ = 0;
  double kinetic_ = 0;                                         ///< largest kinetic energy before any jump [J]
  double known_ = 0;                                           ///< largest energy at the last look [J]
  double shortest_ = std::numeric_limits<double>::infinity();  ///< shortest step at a look [s]
  double rises_ = 0;                                           ///< looks in a row that found a jump
  double risen_time_ = 0, risen_step_ = 0;                     ///< time and step at the first of these looks [s]
  std::optional<Objection> objection_;
};

}  // namespace piola
