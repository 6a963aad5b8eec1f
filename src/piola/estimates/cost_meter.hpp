// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>

namespace piola {

/// Measures the wall time and the memory that a process takes since the meter was made. Making another one restarts the
/// measurement of memory of all.
class CostMeter {
 public:
  using Clock = std::chrono::steady_clock;
  CostMeter();

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Growth of the resident memory up to its maximum [bytes]; 0 where the system does not report it.
  double bytes() const;

 private:
  double before_;  ///< resident memory [bytes]
  Clock::time_point start_;
};

}  // namespace piola
