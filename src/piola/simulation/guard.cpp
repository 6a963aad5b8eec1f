// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/guard.hpp"
#include "piola/exec/exact_sum.hpp"
#include "piola/materials/solids.hpp"
#include "piola/simulation/failure_text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

/// Rounding lets a body at rest wobble at about 1e-11 of its wave speed: positions lose 1e-16 of the body's size in
/// each step, over a hundred spacings, and a thousand of such errors add up at random.
constexpr double stillness = 1e-9;
/// Of the moduli times the volume, over the precision of numbers. The sum over many particles rounds far less.
constexpr double above_rounding = 100;

}  // namespace

void EnergyScale::see(Diagnostics const& now, Moment const& moment) {
  double const work = now.external_work, kinetic = now.kinetic_energy;
  if (begun_ == 0) {
    begun_ = 1;
    initial_ = now.total_energy();
    last_work_ = work;
  }
  if (std::isfinite(work)) {
    work_ += std::abs(work - last_work_);
    last_work_ = work;
  }
  if (std::isfinite(kinetic)) kinetic_ = std::max(kinetic_, kinetic);
  double const speed = moment.first_dt > 0 ? stillness * spacing_ / moment.first_dt : 0;
  floor_ = 0.5 * mass_ * speed * speed;
}

double EnergyScale::value() const { return std::max({std::abs(initial_), work_, kinetic_, floor_, rounding_}); }

double energy_of_rounding(CaseSpec const& spec, ParticleSet const& particles) {
  double sum = 0;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    exec::ExactSum volume;
    for (auto id = particles.bodies[b].first; id < particles.bodies[b].last; ++id)
      volume += particles.volume[static_cast<std::size_t>(id)];
    double modulus = 0;
    with_any_law(spec.bodies[b].material, [&](auto const& law) { modulus = law.kappa + 4.0 / 3 * law.mu; });
    if (std::isfinite(modulus)) sum += modulus * volume.value();
  }
  return above_rounding * std::numeric_limits<double>::epsilon() * sum;
}

void EnergyScale::save(StateWriter& writer) const {
  writer.put("guard_scale", std::array{begun_, initial_, work_, last_work_, kinetic_, floor_});
}

void EnergyScale::load(NamedState& reader) {
  std::array<double, 6> v{};
  reader.get("guard_scale", v);
  begun_ = v[0];
  initial_ = v[1];
  work_ = v[2];
  last_work_ = v[3];
  kinetic_ = v[4];
  floor_ = v[5];
}

std::string Suspect::text(ParticleSet const& particles) const {
  auto const k = static_cast<std::size_t>(id);
  return fmt::format("particle {} of body '{}' (X = {}, x = {})", k,
                     particles.bodies[static_cast<std::size_t>(particles.body[k])].name, point_text(particles.X[k]),
                     point_text(x));
}

Suspect suspect(FieldCache& fields, std::size_t id, double time) {
  Suspect s{static_cast<double>(id), time, {}};
  if (!fields.knows("Position")) return s;
  auto const x = fields.values("Position");
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(3 * id), 3, s.x.begin());
  return s;
}

std::optional<double> column_of(Diagnostics const& diagnostics, std::string_view name) {
  for (auto const& [key, value] : diagnostics.more)
    if (key == name) return value;
  return std::nullopt;
}

Guards make_guards(CaseSpec const& spec, ParticleSet const& particles) {
  GuardLimits const& limits = spec.run.guards;
  Guards guards;
  guards.push_back(make_energy_guard(limits, particles));
  guards.push_back(make_dissipation_guard(limits));
  guards.push_back(make_jacobian_guard(spec, particles));
  guards.push_back(make_overlap_guard(limits));
  guards.push_back(make_parting_guard(limits, particles));
  guards.push_back(make_stranger_guard(spec, particles));
  return guards;
}

}  // namespace piola
