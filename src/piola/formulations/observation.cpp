// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/observation.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

void Observation::add_strain_energy(double energy) {
  totals.strain_energy += energy;
  totals.bodies.back().strain_energy += energy;
}

void Observation::add_motion(std::array<double, 3> const& x, std::array<double, 3> const& v, double mass) {
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t const p = (c + 1) % 3, q = (c + 2) % 3;
    totals.linear_momentum[c] += mass * v[c];
    totals.bodies.back().linear_momentum[c] += mass * v[c];
    totals.bodies.back().kinetic_energy += 0.5 * mass * v[c] * v[c];
    totals.angular_momentum[c] += mass * (x[p] * v[q] - x[q] * v[p]);
    totals.kinetic_energy += 0.5 * mass * v[c] * v[c];
  }
}

void Observation::add_state(double jacobian, double pressure, double tributary) {
  bool const first = !(volume > 0);
  totals.jacobian_min = first ? jacobian : std::min(totals.jacobian_min, jacobian);
  totals.jacobian_max = first ? jacobian : std::max(totals.jacobian_max, jacobian);
  totals.pressure_min = first ? pressure : std::min(totals.pressure_min, pressure);
  totals.pressure_max = first ? pressure : std::max(totals.pressure_max, pressure);
  pressure_square += tributary * pressure * pressure;
  volume += tributary;
}

void Observation::add_oscillation(ParticleSet const& set, Body const& body, std::vector<double> const& p) {
  auto const index = [&](std::array<int, 3> const& at) {
    return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(body.lattice[1]) +
            static_cast<std::size_t>(at[1])) *
               static_cast<std::size_t>(body.lattice[0]) +
           static_cast<std::size_t>(at[0]);
  };
  std::vector<std::int64_t> particle(index({0, 0, body.lattice[2]}) + 1, -1);
  for (auto id = body.first; id < body.last; ++id)
    particle[index(set.lattice_index[static_cast<std::size_t>(id)])] = id;
  for (auto id = body.first; id < body.last; ++id) {
    auto const& at = set.lattice_index[static_cast<std::size_t>(id)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] == 0 || at[axis] + 1 >= body.lattice[axis]) continue;
      auto before = at, after = at;
      --before[axis];
      ++after[axis];
      std::int64_t const a = particle[index(before)], b = particle[index(after)];
      if (a < 0 || b < 0) continue;
      auto const value = [&](std::int64_t k) { return p[static_cast<std::size_t>(k - body.first)]; };
      double const second = (value(b) - 2 * value(id) + value(a)) / 4;
      second_difference_square += second * second;
      second_difference_count += 1;
    }
  }
}

Diagnostics Observation::finish() const {
  Diagnostics d = totals;
  double const level = std::sqrt(pressure_square / volume);
  if (level > 0 && second_difference_count > 0)
    d.pressure_oscillation = std::sqrt(second_difference_square / second_difference_count) / level;
  return d;
}

}  // namespace piola
