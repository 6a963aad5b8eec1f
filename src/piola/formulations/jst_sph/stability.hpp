// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include <vector>

namespace piola::jst_sph {

/// Largest step of velocity Verlet with velocity-proportional damping: the roots of the amplification stay in the unit
/// circle while  dt^2 frequency^2 + 2 dt damping <= 4.  Both in 1/s; infinity if both are zero.
double largest_step(double frequency, double damping);

/// Monitors the step limit of one body: the largest frequency of its internal forces about the current state, by power
/// iterations from the last mode, and the largest rate of its stabilisation. Between measurements both scale with the
/// largest wave speed, which at the start also gives a lower bound of the frequency. The state is left unchanged.
class StabilityMonitor {
 public:
  /// Power iterations from a random start.
  static constexpr int first_rounds = 40;

  /// Measures both from a random start.
  StabilityMonitor(JstBody& body, Backend const& backend);

  /// Registers a step to a state with this largest wave speed, and repeats the measurement of the frequency if due.
  void update(double wave_speed);
  /// Largest stable step for a state with this largest wave speed [s].
  double step(double wave_speed) const;

  std::size_t bytes() const { return mode_.size() * sizeof(double); }

  /// State that determines the next step limit. Collective on a distributed body; particle data are gathered on or
  /// scattered from root.
  std::vector<double> state() const;
  void restore(std::vector<double> const& state);

 private:
  void measure(int rounds, double wave_speed);

  JstBody& body_;
  Backend const& backend_;
  std::vector<double> mode_;        ///< of local particles, by slot
  double frequency_ = 0;            ///< 1/s, at the last measurement
  double frequency_per_speed_ = 0;  ///< 1/m, at the start
  double wave_speed_ = 0;           ///< m/s, largest one at the last measurement
  double damping_ = 0;              ///< 1/m: rate of the stabilisation per wave speed
  double steps_ = 0;                ///< since the last measurement
};

}  // namespace piola::jst_sph
