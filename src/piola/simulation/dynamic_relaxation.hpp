// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/observers.hpp"
#include "piola/simulation/removed_energy.hpp"
#include <string>

namespace piola {

/// Progress of a dynamic relaxation.
struct RelaxationStatus {
  bool reached = false;
  double residual = 0;   ///< sqrt(sum m |a|^2) at the last start from rest, relative to the largest of the run
  double left = 0;       ///< estimate of the remaining displacement, relative to the present one; see Relaxation
  long stops = 0;        ///< number of stops
  long short_stops = 0;  ///< in the last 1000 steps: stops at a peak one step after the stop before
};

/// Removes motion from a run: mass-proportional damping, and dynamic relaxation by kinetic damping (Cundall 1976;
/// Barnes 1999). When the kinetic energy falls, free velocities are reversed for one step, which returns the bodies to
/// the peak of the kinetic energy, and are then set to zero. In a linear motion each stop removes the kinetic energy of
/// the peak from a quantity that steps conserve, so that no vibration survives stops at any step length; stops after
/// the peak leave one with omega dt = sqrt(2) unchanged.
///
/// Or minimises the potential energy: Formulation::descend().
///
/// After the first step from rest sqrt(2 E_kin) / dt is the norm |a| = sqrt(sum m |a|^2) of the unbalanced forces.
/// With T the longest time from a stop to its peak, a quarter of the period of the slowest motion, the remaining
/// displacement is about |a| (2 T / pi)^2, in the norm sqrt(sum m |u|^2). RemovedEnergy::left() is a second estimate,
/// which holds where fast motion causes the stops. Convergence: |a| is below `rest` of the largest so far at two
/// consecutive stops, and the larger estimate is below 1 % of the present displacement. Relaxation is an Observer only
/// for its state in checkpoints.
class Relaxation : public Observer {
 public:
  /// `mass` [kg] of all moving particles. The particles must outlive the relaxation.
  Relaxation(RunSpec const& run, ParticleSet const& particles, double mass);
  /// Before the first step of a run: relaxation starts from rest.
  void start(Formulation& formulation) const;
  /// After each step; returns true once the bodies are at rest and have zero velocity.
  bool after_step(Formulation& formulation, double dt);
  /// Instead of a step: an iteration of the minimisation of the energy. Returns true once the bodies are at rest.
  bool descend(Formulation& formulation, double time, double dt);
  bool active() const { return relax_; }
  bool minimises() const { return minimises_; }
  RelaxationStatus const& rest() const { return rest_; }
  /// Whether run.end came before convergence, although something moves.
  bool unfinished() const { return relax_ && !rest_.reached && (rest_.stops > 0 || kinetic_ > 0); }
  /// "forces out of balance are ... of the largest, what is left of the displacement about ... of it".
  std::string text() const;
  /// Reason for slow convergence; empty: none.
  std::string slow_text() const;
  /// The stop request for an unfinished() run, with advice.
  StopRequest objection_at_end() const;

  void observe(Formulation const&, TimeState const&) override {}
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, TimeState const& moment) override;

 private:
  void stop(Formulation& formulation);
  bool is_at_rest(Formulation const& formulation, double unbalanced);
  double displacement(Formulation const& formulation) const;

  /// The motion since the last stop, and a summary of the earlier ones.
  struct Swing {
    double time = 0, steps = 0;        ///< up to the peak [s], number of steps
    double slowest = 0;                ///< longest time to a peak, without outdated ones [s]
    double backwards = 0;              ///< 1: velocities are reversed for the next step
    double window = 0, in_window = 0;  ///< of 1000 steps: those done, stops whose swing had one step
    double calm = 0;                   ///< 1: the last residual was below the tolerance
  };
  double rate_;
  bool relax_, minimises_;
  double limit_;
  ParticleSet const& particles_;
  double mass_;
  RelaxationStatus rest_;
  Swing swing_;
  RemovedEnergy removed_;
  bool from_rest_ = true;
  double kinetic_ = 0;  ///< after the last step [J]
  double largest_ = 0;  ///< largest norm of unbalanced forces so far [N/kg^0.5]
};

}  // namespace piola
