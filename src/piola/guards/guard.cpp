// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/guard.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/guards/failure_text.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

/// Rounding lets a body at rest wobble at about 1e-11 of its wave speed: positions lose 1e-16 of the body's size in
/// each step, over a hundred spacings, and a thousand of such errors add up at random.
constexpr double stillness = 1e-9;
/// Multiple of moduli times volume times machine precision. The sum over many particles rounds far less.
constexpr double above_rounding = 100;

}  // namespace

void EnergyScale::observe(Diagnostics const& now, TimeState const& moment) {
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

double EnergyScale::without_motion() const { return std::max({std::abs(initial_), work_, floor_, rounding_}); }
double EnergyScale::value() const { return std::max(without_motion(), kinetic_); }

double roundoff_energy(CaseSpec const& spec, ParticleSet const& particles) {
  PIOLA_EXPECTS(spec.bodies.size() <= particles.bodies.size());
  double sum = 0;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    exec::ReproducibleSum volume;
    for (auto id = particles.bodies[b].first; id < particles.bodies[b].last; ++id)
      volume += particles.volume[static_cast<std::size_t>(id)];
    double modulus = 0;
    with_any_law(spec.bodies[b].material, [&](auto const& law) { modulus = law.kappa + 4.0 / 3 * law.mu; });
    if (std::isfinite(modulus)) sum += modulus * volume.value();
  }
  return above_rounding * std::numeric_limits<double>::epsilon() * sum;
}

void EnergyScale::save(StateWriter& writer, std::string_view name) const {
  writer.put(name, std::array{begun_, initial_, work_, last_work_, kinetic_, floor_});
}

void EnergyScale::load(NamedState& reader, std::string_view name) {
  std::array<double, 6> v{};
  reader.get(name, v);
  begun_ = v[0];
  initial_ = v[1];
  work_ = v[2];
  last_work_ = v[3];
  kinetic_ = v[4];
  floor_ = v[5];
}

std::string Suspect::text(ParticleSet const& particles) const {
  PIOLA_EXPECTS(known() && id < static_cast<double>(particles.X.size()));
  auto const k = static_cast<std::size_t>(id);
  return fmt::format("particle {} of body '{}' (X = {}, x = {})", k,
                     particles.bodies[static_cast<std::size_t>(particles.body[k])].name, point_text(particles.X[k]),
                     point_text(x));
}

Suspect suspect(FieldCache& fields, std::size_t id, double time) {
  PIOLA_EXPECTS(id < static_cast<std::size_t>(fields.particles().size()));
  Suspect s{static_cast<double>(id), time, {}};
  if (!fields.knows("Position")) return s;
  auto const x = fields.values("Position");
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(3 * id), 3, s.x.begin());
  return s;
}

std::vector<double> kinetic_per_mass(FieldCache& fields, ParticleSet const& particles) {
  std::vector<double> out(particles.X.size(), 0);
  if (!fields.knows("Velocity")) return out;
  auto const v = fields.values("Velocity");
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = 0.5 * (v[3 * i] * v[3 * i] + v[3 * i + 1] * v[3 * i + 1] + v[3 * i + 2] * v[3 * i + 2]);
  return out;
}

std::optional<Suspect> most_moved(FieldCache& fields, ParticleSet const& particles, std::vector<double> const& before,
                                  double time) {
  PIOLA_EXPECTS(before.empty() || before.size() == particles.X.size());
  auto const now = kinetic_per_mass(fields, particles);
  if (now.empty() || !fields.knows("Velocity")) return std::nullopt;
  std::size_t most = 0;
  auto const growth = [&](std::size_t i) {
    double const grown = particles.volume[i] * (now[i] - (before.empty() ? 0.0 : before[i]));
    return std::isnan(grown) ? std::numeric_limits<double>::infinity() : grown;
  };
  for (std::size_t i = 1; i < now.size(); ++i)
    if (growth(i) > growth(most)) most = i;
  return suspect(fields, most, time);
}

void take_particle(Failure& failure, Suspect const& suspect, ParticleSet const& particles) {
  PIOLA_EXPECTS(suspect.known() && suspect.id < static_cast<double>(particles.X.size()));
  auto const id = static_cast<std::size_t>(suspect.id);
  failure.particle = static_cast<std::int64_t>(id);
  failure.body = particles.bodies[static_cast<std::size_t>(particles.body[id])].name;
  failure.X = particles.X[id];
  failure.x = suspect.x;
}

double energy_without_work(Diagnostics const& diagnostics) {
  return column_of(diagnostics, "centred_energy").value_or(diagnostics.total_energy()) - diagnostics.external_work;
}

std::optional<double> column_of(Diagnostics const& diagnostics, std::string_view name) {
  for (auto const& [key, value] : diagnostics.more)
    if (key == name) return value;
  return std::nullopt;
}

bool starts_under_pressure(CaseSpec const& spec) {
  return std::any_of(spec.bodies.begin(), spec.bodies.end(),
                     [](BodySpec const& body) { return body.formulation.formulas.contains("initial_pressure"); });
}

bool has_driven_support(CaseSpec const& spec) {
  return std::any_of(spec.supports.begin(), spec.supports.end(),
                     [](SupportSpec const& support) { return support.velocity.has_value(); });
}

double crossing_time(CaseSpec const& spec, ParticleSet const& particles, std::vector<double> const& speed) {
  PIOLA_EXPECTS(spec.bodies.size() <= particles.bodies.size());
  PIOLA_EXPECTS(speed.empty() || speed.size() == spec.bodies.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    auto const& spacing = particles.bodies[b].spacing;
    double const finest = *std::min_element(spacing.begin(), spacing.begin() + particles.dimension);
    double const motion = speed.empty() ? 0 : speed[b];
    auto const consider = [&](MaterialParameters const& material) {
      with_any_law(material, [&](auto const& law) {
        if (double const time = finest / (law.p_wave_speed() + motion); time > 0) least = std::min(least, time);
      });
    };
    consider(spec.bodies[b].material);
    for (PartSpec const& part : spec.bodies[b].parts) consider(part.material);
  }
  return least;
}

Guards make_guards(CaseSpec const& spec, ParticleSet const& particles) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  GuardLimits const& limits = spec.run.guards;
  Guards guards;
  guards.push_back(make_energy_guard(limits, particles));
  guards.push_back(make_dissipation_guard(limits));
  guards.push_back(make_jacobian_guard(spec, particles));
  guards.push_back(make_overlap_guard(limits));
  guards.push_back(make_strain_drift_guard(limits, particles));
  guards.push_back(make_proximity_guard(spec, particles));
  guards.push_back(make_step_guard(spec, particles));
  guards.push_back(make_small_strain_guard(spec, particles));
  guards.push_back(make_following_load_guard(spec, particles));
  return guards;
}

}  // namespace piola
