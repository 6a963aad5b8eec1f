// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include <vector>

namespace piola::jst_sph {

/// Largest step of velocity Verlet with velocity-proportional damping: the roots of the amplification stay in the unit
/// circle while  dt^2 frequency^2 + 2 dt damping <= 4.  Both in 1/s; infinity if both are zero.
double largest_step(double frequency, double damping);

/// Largest step [s] for the largest eigenvalue of K + (2 / dt) D of internal forces K and viscous ones D [1/s2]: the
/// same rule where the two have different modes.
double largest_step(double eigenvalue);

/// Follows the step limit of one body: the largest frequency of its internal forces about the current state, by power
/// iterations that start from the mode found last, and the largest rate of its stabilisation. Between measurements both
/// grow with the largest wave speed, which at the start gives a bound that the measured frequency is also held against.
/// With hourglass forces, whose viscous part is not small and grows as the elastic part does, one eigenvalue of both is
/// followed, which never counts as less than that of the undeformed body.
/// The state is left as it was.
class StabilityMonitor {
 public:
  /// Right-hand sides that the later measurements cost per step.
  static constexpr double stages_per_step = 4.0 / 50;
  /// And what all ranks say for them: the mode, motions of right-hand sides, three largest numbers, two sums.
  static constexpr double collectives_per_step = 9.0 / 50;
  /// And the first ones in all, with what is around them.
  double setup_stages() const;

  /// Measures both from a random start.
  StabilityMonitor(JstBody& body, Machine const& machine);

  /// Counts a step that led to a state with this largest wave speed, and measures the frequency again if that is due.
  void update(double wave_speed);
  /// Largest stable step for a state with this largest wave speed [s].
  double step(double wave_speed) const;

  std::size_t bytes() const { return mode_.size() * sizeof(double); }

  /// Everything that the next step limit depends on. On ranks that share the body both are collective, and rank 0 has,
  /// or gives, what there is of particles.
  std::vector<double> state() const;
  void restore(std::vector<double> const& state);

 private:
  bool is_large_lattice() const;
  bool is_undeformed() const;
  void measure(int rounds, double wave_speed);
  void measure_at_rest();
  void measure_all_forces(int rounds, double wave_speed);

  JstBody& body_;
  Machine const& machine_;
  std::vector<double> mode_;        ///< of the particles of this rank, by slot
  double frequency_ = 0;            ///< 1/s, at the last measurement
  double frequency_per_speed_ = 0;  ///< 1/m, at the start
  double wave_speed_ = 0;           ///< m/s, largest one at the last measurement
  double damping_ = 0;              ///< 1/m: rate of the stabilisation per wave speed
  double steps_ = 0;                ///< since the last measurement
  // With hourglass forces, in place of frequencies and damping.
  double limit_ = 0;          ///< s, at the last measurement
  double limit_at_rest_ = 0;  ///< s, of the undeformed body
  double speed_at_rest_ = 0;  ///< m/s
};

}  // namespace piola::jst_sph
