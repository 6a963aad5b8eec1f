// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/stress_intensity.hpp"
#include "piola/base/contracts.hpp"
#include <cmath>
#include <numbers>

namespace piola {

double stress_intensity(std::span<double const> r, std::span<double const> stress) {
  PIOLA_EXPECTS(!r.empty() && r.size() == stress.size());
  auto const K = [&](std::size_t i) { return std::sqrt(2 * std::numbers::pi * r[i]) * stress[i]; };
  auto const count = static_cast<double>(r.size());
  double r_mean = 0, K_mean = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    r_mean += r[i] / count;
    K_mean += K(i) / count;
  }
  double covariance = 0, variance = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    covariance += (r[i] - r_mean) * (K(i) - K_mean);
    variance += (r[i] - r_mean) * (r[i] - r_mean);
  }
  // Equal distances differ from their mean by rounding only.
  bool const apart = variance > 1e-24 * count * r_mean * r_mean;
  return apart ? K_mean - covariance / variance * r_mean : K_mean;
}

}  // namespace piola
