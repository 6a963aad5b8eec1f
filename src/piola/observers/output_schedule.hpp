// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include <cmath>

namespace piola {

/// Due times of an output: the first step at or after each multiple of an interval; 0 means never.
class Schedule {
 public:
  explicit Schedule(double every) : every_(every) { PIOLA_EXPECTS(every >= 0); }
  bool ever() const { return every_ > 0; }
  /// Whether an output is due at this time [s]; if so, the next one is due after it.
  bool due(double time) {
    PIOLA_EXPECTS(std::isfinite(time));
    if (!ever()) return false;
    double const multiple =
        std::floor(time / every_ * (1 + 1e-12));  // a multiple missed only by round-off counts as reached
    if (multiple < next_) return false;
    next_ = multiple + 1;
    return true;
  }
  /// Marks all outputs up to this time [s] as done, for instance before a checkpoint: later outputs then do not depend
  /// on earlier ones, even with another interval.
  void start_after(double time) { due(time); }

 private:
  double every_;
  double next_ = 0;  ///< number of the next multiple; a whole number
};

}  // namespace piola
