// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/wall_time_limit.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>

namespace piola {

void WallLimit::step_took(double seconds) {
  PIOLA_EXPECTS(seconds >= 0);
  slowest_step_ = std::max(slowest_step_, seconds);
}

void WallLimit::checkpoint_took(double seconds) {
  PIOLA_EXPECTS(seconds >= 0);
  slowest_checkpoint_ = std::max(slowest_checkpoint_, seconds);
}

void WallLimit::checkpoint_has(std::int64_t bytes) {
  PIOLA_EXPECTS(bytes >= 0);
  constexpr double start = 0.1, bytes_per_second = 30e6;
  estimated_checkpoint_ = start + static_cast<double>(bytes) / bytes_per_second;
}

double WallLimit::reserve() const {
  double const checkpoint = slowest_checkpoint_ > 0 ? 2 * slowest_checkpoint_ : estimated_checkpoint_;
  return 1.5 * slowest_step_ + checkpoint + 0.005 * seconds_;
}

}  // namespace piola
