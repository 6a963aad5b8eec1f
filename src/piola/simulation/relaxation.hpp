// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/observers.hpp"
#include <string>

namespace piola {

/// How far a dynamic relaxation is.
struct Rest {
  bool reached = false;
  double residual = 0;   ///< sqrt(sum m |a|^2) at the last start from rest, beside the largest of the run
  double left = 0;       ///< estimate of the displacement that is still missing, beside the one reached; see Relaxation
  long stops = 0;        ///< how often the bodies were brought to rest
  long short_stops = 0;  ///< in the last 1000 steps: stops at a peak one step after the stop before
};

/// Takes motion out of a run: damping with a rate, and dynamic relaxation by kinetic damping (Cundall 1976; Barnes
/// 1999). Once the kinetic energy falls, velocities that nothing prescribes are reversed for one step, which brings the
/// bodies back to the peak of the kinetic energy, and are set to zero there. In a linear motion each stop then takes
/// the kinetic energy of the peak out of a quantity that steps keep, so that no vibration survives stops at any length
/// of the step; stops after the peak leave one with omega dt = sqrt(2) as it is.
///
/// After the first step from rest sqrt(2 E_kin) / dt is the norm |a| = sqrt(sum m |a|^2) of the forces that are out of
/// balance. With T the longest time from a stop to its peak, a quarter of the period of the slowest motion, what is
/// left of the displacement is about |a| (2 T / pi)^2, in the norm sqrt(sum m |u|^2). The bodies are at rest when |a|
/// is below `rest` of the largest so far at two stops in a row, and what is left below 2 % of the displacement reached.
/// Relaxation is an Observer only so that checkpoints hold it. On ranks rank 0 has it.
class Relaxation : public Observer {
 public:
  /// `mass` [kg] is that of all that moves. The particles outlive the relaxation.
  Relaxation(RunSpec const& run, ParticleSet const& particles, double mass);
  /// Before the first step of a run: relaxation starts from rest.
  void start(Formulation& formulation) const;
  /// After each step; true once the bodies are at rest, which then have no velocity.
  bool after_step(Formulation& formulation, double dt);
  bool active() const { return relax_; }
  Rest const& rest() const { return rest_; }
  /// Whether run.end came before the rest, although something moves.
  bool unfinished() const { return relax_ && !rest_.reached && (rest_.stops > 0 || kinetic_ > 0); }
  /// "forces out of balance are ... of the largest, what is left of the displacement about ... of it".
  std::string text() const;
  /// What is slow about the way to rest; empty: nothing.
  std::string slow_text() const;
  /// The end of a run that is unfinished(), and what to do.
  Objection objection_at_end() const;

  void see(Formulation const&, Moment const&) override {}
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, Moment const& moment) override;

 private:
  void stop(Formulation& formulation);
  void judge(Formulation const& formulation, double dt);
  double displacement(Formulation const& formulation) const;

  /// The motion since the last stop, and what is known of those before.
  struct Swing {
    double time = 0, steps = 0;        ///< up to the peak [s], number of steps
    double slowest = 0;                ///< the longest time to a peak that is not forgotten [s]
    double backwards = 0;              ///< 1: velocities are reversed for the next step
    double window = 0, in_window = 0;  ///< of 1000 steps: those done, stops whose swing had one step
    double calm = 0;                   ///< 1: the last residual was small enough for rest
  };
  double rate_;
  bool relax_;
  double limit_;
  ParticleSet const& particles_;
  double mass_;
  Rest rest_;
  Swing swing_;
  bool from_rest_ = true;
  double kinetic_ = 0;  ///< after the last step [J]
  double largest_ = 0;  ///< norm of forces out of balance so far [N/kg^0.5]
};

}  // namespace piola
