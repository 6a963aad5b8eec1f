// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <limits>

namespace piola {

/// [run] guards: limits above which a run warns or stops. Infinity disables a limit.
struct GuardLimits {
  static constexpr double never = std::numeric_limits<double>::infinity();

  bool on = true;
  double energy_rise_warn = 0.01, energy_rise_stop = 0.1;      ///< shares of the energy that the run has to do with
  double dissipation = 0.1;                                    ///< the same
  std::array<double, 2> jacobian{0.3, 3};                      ///< det F of what is no metal
  double overlap = 1;                                          ///< of contact, in spacings
  double proximity = 0.5;                                      ///< distance, in spacings
  double strain_drift_warn = 0.05, strain_drift_stop = 0.2;    ///< strain of the cells that their stress does not have
  double step_warn = 1e-3, step_stop = 0;                      ///< step / step of waves at rest; 0: never below
  double small_strain_warn = 0.02, small_strain_stop = never;  ///< of linear_elastic: principal Green strain
  double small_rotation_warn = 0.05, small_rotation_stop = never;  ///< the same: angle of rotation [rad]
};

}  // namespace piola
