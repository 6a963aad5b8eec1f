// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/diagnostics_sum.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/common/lattice_lines.hpp"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace piola {

void DiagnosticsSum::add_strain_energy(double energy) {
  PIOLA_EXPECTS(!bodies_.empty());
  bodies_.back().strain_energy += energy;
}

void DiagnosticsSum::add_motion(std::array<double, 3> const& x, std::array<double, 3> const& v, double mass) {
  double of_particle[7]{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t const p = (c + 1) % 3, q = (c + 2) % 3;
    of_particle[0] += 0.5 * mass * v[c] * v[c];
    of_particle[1 + c] = mass * v[c];
    of_particle[4 + c] = mass * (x[p] * v[q] - x[q] * v[p]);
  }
  if (axisymmetric)
    for (std::size_t c = 1; c < 7; ++c) of_particle[c] = c == 2 ? of_particle[c] : 0;
  bodies_.back().motion.add(of_particle);
}

void DiagnosticsSum::add_state(double jacobian, double pressure, double tributary) {
  bool const first = particles_++ == 0;
  totals.jacobian_min = first ? jacobian : minimum(totals.jacobian_min, jacobian);
  totals.jacobian_max = first ? jacobian : maximum(totals.jacobian_max, jacobian);
  totals.pressure_min = first ? pressure : minimum(totals.pressure_min, pressure);
  totals.pressure_max = first ? pressure : maximum(totals.pressure_max, pressure);
  double const of_particle[]{tributary, tributary * pressure * pressure};
  pressures_.add(of_particle);
}

void DiagnosticsSum::add_oscillation(ParticleSet const& set, Body const& body, std::vector<double> const& p) {
  PIOLA_EXPECTS(static_cast<std::int64_t>(p.size()) >= body.last - body.first);
  LatticeLines lines({}, body.lattice);  // particles are counted from the body's first
  auto const place = [&](std::int64_t k) { return set.lattice_index[static_cast<std::size_t>(body.first + k)]; };
  for (std::int64_t k = 0; k < body.last - body.first; ++k) lines[place(k)] = static_cast<Index>(k);
  struct Differences {
    std::array<double, 3> value;
    std::array<bool, 3> exists;  ///< there are neighbours on both sides
  };
  auto const differences = [&](std::int64_t k) {
    Differences d{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto const [a, b] = lines.neighbours(place(k), axis);
      if (a == LatticeLines::no_slot) continue;
      auto const value = [&](std::int64_t n) { return p[static_cast<std::size_t>(n)]; };
      d.value[axis] = (value(b) - 2 * value(k) + value(a)) / 4;
      d.exists[axis] = true;
    }
    return d;
  };
  // All threads look them up, one adds them up.
  constexpr std::int64_t most = std::int64_t{1} << 16;
  std::vector<Differences> found;
  for (std::int64_t first = 0; first < body.last - body.first; first += most) {
    found.resize(static_cast<std::size_t>(std::min(most, body.last - body.first - first)));
    exec_host::parallel_for(static_cast<Index>(found.size()),
                            [&](Index k) { found[static_cast<std::size_t>(k)] = differences(first + k); });
    for (Differences const& d : found)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!d.exists[axis]) continue;
        add_second_difference(d.value[axis]);
      }
  }
}

void DiagnosticsSum::share() {
  for (BodySums& body : bodies_) comm::allreduce_sum(body.motion);
  comm::allreduce_sum(pressures_);
  comm::allreduce_sum(second_difference_square_);
  struct Seen {
    std::int64_t particles, differences;
    double jacobian_min, jacobian_max, pressure_min, pressure_max;
  };
  Diagnostics& d = totals;
  Seen seen{particles_, second_differences_, d.jacobian_min, d.jacobian_max, d.pressure_min, d.pressure_max};
  comm::allreduce(seen, [](void const* other, void* mine) {
    auto const& a = *static_cast<Seen const*>(other);
    auto& b = *static_cast<Seen*>(mine);
    Seen both = b.particles == 0 ? a : b;
    if (a.particles > 0 && b.particles > 0) {
      both.jacobian_min = minimum(a.jacobian_min, b.jacobian_min);
      both.jacobian_max = maximum(a.jacobian_max, b.jacobian_max);
      both.pressure_min = minimum(a.pressure_min, b.pressure_min);
      both.pressure_max = maximum(a.pressure_max, b.pressure_max);
    }
    both.particles = a.particles + b.particles;
    both.differences = a.differences + b.differences;
    b = both;
  });
  particles_ = seen.particles;
  second_differences_ = seen.differences;
  std::tie(d.jacobian_min, d.jacobian_max, d.pressure_min, d.pressure_max) =
      std::tie(seen.jacobian_min, seen.jacobian_max, seen.pressure_min, seen.pressure_max);
}

Diagnostics DiagnosticsSum::finish() const {
  Diagnostics d = totals;
  exec::ReproducibleSums<7> motion;
  exec::ReproducibleSum strain_energy;
  for (BodySums const& body : bodies_) {
    auto const& of = body.motion;
    d.bodies.push_back({body.name, of.value(0), body.strain_energy.value(), {of.value(1), of.value(2), of.value(3)}});
    motion.add(of);
    strain_energy += body.strain_energy;
  }
  d.kinetic_energy = motion.value(0);
  d.strain_energy = strain_energy.value();
  for (int c = 0; c < 3; ++c) {
    d.linear_momentum[static_cast<std::size_t>(c)] = motion.value(1 + c);
    d.angular_momentum[static_cast<std::size_t>(c)] = motion.value(4 + c);
  }
  // The sign of a zero depends on the order of particles; this removes it.
  d.pressure_min += 0.0;
  d.pressure_max += 0.0;
  double const level = std::sqrt(pressures_.value(1) / volume());
  if (level > 0 && second_differences_ > 0)
    d.pressure_oscillation =
        std::sqrt(second_difference_square_.value() / static_cast<double>(second_differences_)) / level;
  return d;
}

}  // namespace piola
