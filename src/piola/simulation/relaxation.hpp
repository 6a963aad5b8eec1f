// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/observers.hpp"

namespace piola {

/// How far a dynamic relaxation is.
struct Rest {
  bool reached = false;
  double residual = 0;  ///< sqrt(sum m |a|^2) at the last start from rest, beside the largest of the run
  long stops = 0;       ///< how often the bodies were brought to rest
};

/// Takes motion out of a run: damping with a rate, and dynamic relaxation by kinetic damping. Whenever the kinetic
/// energy has passed a maximum, where the bodies swing through the middle of their motion, all velocities that nothing
/// prescribes are set to zero (Cundall 1976; Barnes 1999). After the first step from rest sqrt(2 E_kin) / dt is the
/// norm sqrt(sum m |a|^2) of the forces that are out of balance: the bodies are at rest when it is below a share of the
/// largest so far, which under loads on a free body is that of the loads.
/// It is an Observer only so that checkpoints hold it.
class Relaxation : public Observer {
 public:
  explicit Relaxation(RunSpec const& run);
  /// Before the first step of a run: relaxation starts from rest.
  void start(Formulation& formulation) const;
  /// After each step; true once the bodies are at rest, which then have no velocity.
  bool after_step(Formulation& formulation, double dt);
  bool active() const { return relax_; }
  Rest const& rest() const { return rest_; }

  void see(Formulation const&, Moment const&) override {}
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, Moment const& moment) override;

 private:
  void stop(Formulation& formulation);
  double rate_;
  bool relax_;
  double limit_;
  Rest rest_;
  bool from_rest_ = true;
  double kinetic_ = 0;  ///< after the last step [J]
  double largest_ = 0;  ///< norm of forces out of balance so far [N/kg^0.5]
};

}  // namespace piola
