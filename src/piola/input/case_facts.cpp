// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_facts.hpp"
#include "piola/base/text.hpp"
#include "piola/materials/solids.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

double volume_of(ParticleSet const& particles, Body const& body) {
  double volume = 0;
  for (std::int64_t id = body.first; id < body.last; ++id) volume += particles.volume[static_cast<std::size_t>(id)];
  return volume;
}

double largest_speed(BodySpec const& spec, ParticleSet const& particles, Body const& body) {
  double largest = 0;
  for (std::int64_t id = body.first; id < body.last; ++id) {
    auto const& X = particles.X[static_cast<std::size_t>(id)];
    auto const& v = spec.initial_velocity;
    largest = std::max(largest, std::hypot(v[0](X), v[1](X), v[2](X)));
  }
  return largest;
}

double smallest_spacing(BodyFacts const& body, int dimension) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) smallest = std::min(smallest, body.spacing[d]);
  return smallest;
}

std::string body_words(BodyFacts const& body) { return "body " + in_quotes(body.name) + ": "; }

void check_parameters(BodySpec const& spec, BodyFacts const& body, std::vector<std::string>& found) {
  auto const law = find_law(spec.law);
  for (std::size_t i = 0; law && i < law->parameters.size(); ++i) {
    Parameter const& parameter = law->parameters[i];
    double const value = spec.material.value[i];
    std::string const shown = std::string(parameter.name) + " is " + quantity_text(value, parameter.unit);
    if (parameter.unit == "kg/m^3" && value < 10) {
      found.push_back(body_words(body) + shown +
                      ", lighter than foam (solids have 100 to 20000 kg/m^3) - was g/cm^3 meant?");
    } else if (parameter.unit == "kg/m^3" && value > 25000) {
      found.push_back(body_words(body) + shown +
                      ", heavier than any metal (solids have 100 to 20000 kg/m^3) - check the unit");
    } else if (parameter.name == "youngs_modulus" && value < 100) {
      found.push_back(body_words(body) + shown +
                      ", softer than any jelly (1 kPa to 1 TPa is usual) - was MPa or GPa meant?");
    } else if (parameter.name == "youngs_modulus" && value > 2e12) {
      found.push_back(body_words(body) + shown + ", stiffer than diamond (1 kPa to 1 TPa is usual) - check the unit");
    }
  }
}

void check_fineness(BodyFacts const& body, int dimension, std::vector<std::string>& found) {
  double widest = 0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    widest = std::max(widest, body.spacing[d]);
    if (body.lattice[d] >= 3) continue;
    found.push_back(body_words(body) + "only " + std::to_string(body.lattice[d]) +
                    (body.lattice[d] == 1 ? " particle" : " particles") + " across in " + "xyz"[d] +
                    " (3 or more are needed to bend) - make the spacing smaller");
  }
  double const ratio = widest / smallest_spacing(body, dimension);
  if (ratio > 2) {
    found.push_back(body_words(body) + "the spacings differ by a factor of " + number_text(ratio, 3) +
                    " (SPH wants them alike, at most 1.5) - change particles");
  }
}

void check_motion(CaseSpec const& spec, std::vector<BodyFacts> const& facts, std::vector<std::string>& found) {
  bool moves = !spec.loads.empty() || std::any_of(spec.supports.begin(), spec.supports.end(),
                                                  [](SupportSpec const& support) { return support.velocity; });
  // The formula that is left out is the constant 0.
  for (RigidSpec const& rigid : spec.rigids)
    moves = moves || std::any_of(rigid.velocity.begin(), rigid.velocity.end(),
                                 [](Expression const& component) { return component.text() != "0"; });
  for (std::size_t b = 0; b < facts.size(); ++b) {
    BodyFacts const& body = facts[b];
    if (body.largest_speed > body.p_wave) {
      found.push_back(body_words(body) + "the initial velocity reaches " + number_text(body.largest_speed, 4) +
                      " m/s, above the speed of pressure waves, " + number_text(body.p_wave, 4) +
                      " m/s - check both units");
    }
    moves = moves || body.largest_speed > 0 || spec.bodies[b].initial_displacement ||
            spec.bodies[b].initial_deformation_gradient;
  }
  if (!moves)
    found.emplace_back(
        "nothing moves: no initial velocity, displacement or deformation, no load and no driven support - "
        "add one");
}

}  // namespace

std::vector<BodyFacts> body_facts(CaseSpec const& spec, ParticleSet const& particles) {
  std::vector<BodyFacts> all;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    Body const& body = particles.bodies[b];
    BodyFacts facts{
        .name = body.name, .particles = body.last - body.first, .spacing = body.spacing, .lattice = body.lattice};
    facts.largest_speed = largest_speed(spec.bodies[b], particles, body);
    auto const read = [&](auto const& law) {
      facts.mass = volume_of(particles, body) * law.rho0;
      facts.p_wave = law.p_wave_speed();
      if constexpr (requires { law.s_wave_speed(); }) facts.s_wave = law.s_wave_speed();
    };
    with_any_law(spec.bodies[b].material, read);
    all.push_back(facts);
  }
  return all;
}

double step_estimate(CaseSpec const& spec, std::vector<BodyFacts> const& facts, double default_cfl) {
  double const cfl = std::isnan(spec.run.cfl) ? default_cfl : spec.run.cfl;
  double step = spec.run.max_step;
  for (std::size_t b = 0; b < facts.size(); ++b) {
    step = std::min(step, cfl * smallest_spacing(facts[b], spec.bodies[b].shape.dimension) / facts[b].p_wave);
  }
  return step;
}

std::vector<std::string> implausible(CaseSpec const& spec, std::vector<BodyFacts> const& facts, double step) {
  std::vector<std::string> found;
  for (std::size_t b = 0; b < facts.size(); ++b) {
    check_parameters(spec.bodies[b], facts[b], found);
    check_fineness(facts[b], spec.bodies[b].shape.dimension, found);
  }
  check_motion(spec, facts, found);
  if (spec.run.end < step) {
    found.push_back("run.end is " + quantity_text(spec.run.end, "s") + ", shorter than one step of about " +
                    quantity_text(step, "s") + " - check the unit");
  }
  if (spec.run.end / step > 1e7) {
    found.push_back("about " + number_text(spec.run.end / step, 2) +
                    " steps are needed (more than 10 million take days) - "
                    "check run.end and the stiffness");
  }
  return found;
}

}  // namespace piola
