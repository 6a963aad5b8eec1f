// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <limits>

namespace piola {

/// Says when a run must stop so that its last checkpoint is written before its wall time is over. It keeps back the
/// time of the slowest step so far with all its output, half as much again; twice the time of the slowest checkpoint so
/// far, or an estimate from its size; and half a per cent of the whole, for what nobody foresees.
class WallLimit {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double none = std::numeric_limits<double>::infinity();

  /// `seconds` of wall time that began at `start`; none: no limit.
  WallLimit(double seconds, Clock::time_point start) : seconds_(seconds), start_(start) {}

  bool exists() const { return seconds_ < none; }
  /// A step with its output (or the output before the first step) took so long [s].
  void step_took(double seconds);
  /// A checkpoint took so long [s].
  void checkpoint_took(double seconds);
  /// So much is in a checkpoint [bytes]; counts until one was written, at a speed that a busy network disk reaches.
  void checkpoint_has(std::int64_t bytes);

  double reserve() const;  ///< the time kept back [s]
  bool reached() const { return exists() && reached_after(seconds_since_start()); }
  bool reached_after(double elapsed) const { return elapsed + reserve() >= seconds_; }

 private:
  double seconds_since_start() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  double seconds_;
  Clock::time_point start_;
  double slowest_step_ = 0, slowest_checkpoint_ = 0, estimated_checkpoint_ = 0;
};

}  // namespace piola
