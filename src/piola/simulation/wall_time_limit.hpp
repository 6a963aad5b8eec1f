// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <limits>

namespace piola {

/// Decides when a run must stop so that its last checkpoint is written before its wall-time limit. Reserves 1.5 times
/// the time of the slowest step so far with all its output; twice the time of the slowest checkpoint so far, or an
/// estimate from its size; and a safety margin of 0.5 % of the limit.
class WallLimit {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double none = std::numeric_limits<double>::infinity();

  /// `seconds` of wall time from `start` on; none: no limit.
  WallLimit(double seconds, Clock::time_point start) : seconds_(seconds), start_(start) {}

  bool exists() const { return seconds_ < none; }
  /// Registers the wall time [s] of a step with its output (or of the output before the first step).
  void step_took(double seconds);
  /// Registers the wall time [s] of a checkpoint.
  void checkpoint_took(double seconds);
  /// Sets the size of a checkpoint [bytes]; used until one is written, at the speed of a busy network disk.
  void checkpoint_has(std::int64_t bytes);

  double reserve() const;  ///< the reserved time [s]
  /// steps: taken before the run can end, beside the one in the reserve.
  bool reached(int steps = 0) const { return exists() && reached_after(seconds_since_start() + steps * slowest_step_); }
  bool reached_after(double elapsed) const { return elapsed + reserve() >= seconds_; }

 private:
  double seconds_since_start() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  double seconds_;
  Clock::time_point start_;
  double slowest_step_ = 0, slowest_checkpoint_ = 0, estimated_checkpoint_ = 0;
};

}  // namespace piola
