// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/stress_intensity.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include <cmath>
#include <numbers>

namespace piola {

double stress_intensity(std::span<double const> r, std::span<double const> stress) {
  PIOLA_EXPECTS(!r.empty() && r.size() == stress.size());
  auto const K = [&](std::size_t i) { return std::sqrt(2 * std::numbers::pi * r[i]) * stress[i]; };
  auto const count = static_cast<double>(r.size());
  exec::ReproducibleSums<2> sums, products;
  for (std::size_t i = 0; i < r.size(); ++i) {
    double const of_particle[]{r[i], K(i)};
    sums.add(of_particle);
  }
  double const r_mean = sums.value(0) / count, K_mean = sums.value(1) / count;
  for (std::size_t i = 0; i < r.size(); ++i) {
    double const of_particle[]{(r[i] - r_mean) * (K(i) - K_mean), (r[i] - r_mean) * (r[i] - r_mean)};
    products.add(of_particle);
  }
  double const covariance = products.value(0), variance = products.value(1);
  // Equal distances differ from their mean by rounding only.
  bool const apart = variance > 1e-24 * count * r_mean * r_mean;
  return apart ? K_mean - covariance / variance * r_mean : K_mean;
}

}  // namespace piola
