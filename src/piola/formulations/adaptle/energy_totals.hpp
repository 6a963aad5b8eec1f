// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include <algorithm>
#include <span>
#include <tuple>
#include <vector>

namespace piola::adaptle {

/// Sums since the start of the run [J], and counts.
class EnergyTotals {
 private:
  template <class Self>
  static auto listed(Self& b) {
    return std::tie(b.contact_energy, b.viscous_loss, b.external_work, b.converted, b.by_guard, b.converted_mass,
                    b.energy_change, b.momentum_change, b.deleted, b.overlap, b.time, b.next_dt, b.damping_loss,
                    b.hourglass_energy, b.artificial_work, b.axis_crossings);
  }

 public:
  double contact_energy = 0, viscous_loss = 0, external_work = 0;
  double converted = 0, by_guard = 0, converted_mass = 0, energy_change = 0, momentum_change = 0, deleted = 0;
  double overlap = 0;
  double time = 0, next_dt = 0, damping_loss = 0, hourglass_energy = 0;
  double axis_crossings = 0;
  double artificial_work = 0;  ///< energy that artificial stress takes from motion, of either sign

  /// Adds the powers of a step of dt [s], and takes over its stable step.
  void add(StepSums const& m, double dt) {
    contact_energy += dt * m.contact_power;
    hourglass_energy += dt * m.hourglass_power;
    viscous_loss += dt * m.viscous_power;
    artificial_work += dt * m.artificial_power;
    external_work += dt * (m.held_power + m.load_power + m.rigid_power);
    overlap = std::max(overlap, m.overlap);
    axis_crossings += static_cast<double>(m.axis_crossings);
    next_dt = m.dt;
  }

  /// For a checkpoint.
  std::vector<double> state() const {
    return std::apply([](auto const&... value) { return std::vector<double>{value...}; }, listed(*this));
  }
  void restore(std::span<double const> values) {
    PIOLA_EXPECTS(values.size() == state().size());
    std::size_t k = 0;
    std::apply([&](auto&... value) { ((value = values[k++]), ...); }, listed(*this));
  }
};

}  // namespace piola::adaptle
