// SPDX-License-Identifier: Apache-2.0
#include "piola/model/body_properties.hpp"
#include "piola/base/contracts.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/particles/part_properties.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

double largest_speed(BodySpec const& spec, ParticleSet const& particles, Body const& body) {
  double largest = 0;
  for (std::int64_t id = body.first; id < body.last; ++id) {
    auto const& X = particles.X[static_cast<std::size_t>(id)];
    auto const& v = spec.initial_velocity;
    largest = std::max(largest, std::hypot(v[0](X), v[1](X), v[2](X)));
  }
  return largest;
}

/// Edges of the box around the particles, each with the spacing that its outer particles fill [m].
std::array<double, 3> box_size(ParticleSet const& particles, Body const& body) {
  std::array<double, 3> size{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(particles.dimension); ++d) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::int64_t id = body.first; id < body.last; ++id) {
      double const at = particles.X[static_cast<std::size_t>(id)][d];
      low = std::min(low, at);
      high = std::max(high, at);
    }
    size[d] = std::max(high - low, body.spacing[d]);
  }
  return size;
}

}  // namespace

double yield_at_start(MaterialParameters const& material) {
  double yield = std::numeric_limits<double>::infinity();
  with_solid(material, [&](auto const& law) {
    SolidHistory fresh;
    fresh.temperature = law.initial_temperature();
    yield = law.yield_stress(fresh, 0);
  });
  return yield;
}

double smallest_spacing(BodyProperties const& body, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  return *std::min_element(body.spacing.begin(), body.spacing.begin() + dimension);
}

std::vector<BodyProperties> body_properties(CaseSpec const& spec, ParticleSet const& particles) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  std::vector<BodyProperties> all;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    Body const& body = particles.bodies[b];
    BodyProperties facts{
        .name = body.name, .particles = body.last - body.first, .spacing = body.spacing, .lattice = body.lattice};
    facts.largest_speed = largest_speed(spec.bodies[b], particles, body);
    facts.size = box_size(particles, body);
    auto const add = [&](MaterialParameters const& material, double volume) {
      facts.yield = std::min(facts.yield, yield_at_start(material));
      with_any_law(material, [&](auto const& law) {
        facts.mass += volume * law.rho0;
        facts.p_wave = std::max(facts.p_wave, law.p_wave_speed());
        facts.modulus = std::max(facts.modulus, law.rho0 * law.p_wave_speed() * law.p_wave_speed());
        if constexpr (requires { law.s_wave_speed(); }) facts.s_wave = std::max(facts.s_wave, law.s_wave_speed());
      });
    };
    auto const& parts = spec.bodies[b].parts;
    auto const shares = part_properties(particles, body, parts.size());
    add(spec.bodies[b].material, shares[0].volume);
    for (std::size_t k = 0; k < parts.size(); ++k) add(parts[k].material, shares[k + 1].volume);
    all.push_back(facts);
  }
  return all;
}

double step_estimate(CaseSpec const& spec, std::vector<BodyProperties> const& facts) {
  PIOLA_EXPECTS(facts.size() <= spec.bodies.size());
  double const cfl = std::isnan(spec.run.cfl) ? 0.3 : spec.run.cfl;
  double step = spec.run.max_step;
  for (std::size_t b = 0; b < facts.size(); ++b) {
    step = std::min(step, cfl * smallest_spacing(facts[b], spec.bodies[b].shape.dimension) / facts[b].p_wave);
  }
  return step;
}

}  // namespace piola
