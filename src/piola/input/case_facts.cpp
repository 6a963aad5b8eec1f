// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_facts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/region_checks.hpp"
#include "piola/materials/solids.hpp"
#include "piola/particles/parts.hpp"
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

double smallest_spacing(BodyFacts const& body, int dimension) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) smallest = std::min(smallest, body.spacing[d]);
  return smallest;
}

std::string body_words(BodyFacts const& body) { return "body " + in_quotes(body.name) + ": "; }

/// Whether a number of the law looks odd.
bool check_parameters(BodySpec const& spec, BodyFacts const& body, Problems& slips) {
  std::size_t const before = slips.count();
  auto const law = find_law(spec.law);
  for (std::size_t i = 0; law && i < law->parameters.size(); ++i) {
    Parameter const& parameter = law->parameters[i];
    double const value = spec.material.value[i];
    auto const note = [&](char const* what) {
      slips.add(place_in_table(spec.places, "material", parameter.name),
                body_words(body) + std::string(parameter.name) + " is " + quantity_text(value, parameter.unit) + what);
    };
    if (parameter.unit == "kg/m^3" && value < 10)
      note(", lighter than foam (solids have 100 to 20000 kg/m^3) - was g/cm^3 meant?");
    else if (parameter.unit == "kg/m^3" && value > 25000)
      note(", heavier than any metal (solids have 100 to 20000 kg/m^3) - check the unit");
    else if (parameter.name == "youngs_modulus" && value < 100)
      note(", softer than any jelly (1 kPa to 1 TPa is usual) - was MPa or GPa meant?");
    else if (parameter.name == "youngs_modulus" && value > 2e12)
      note(", stiffer than diamond (1 kPa to 1 TPa is usual) - check the unit");
  }
  return slips.count() > before;
}

/// The speed of waves tells about the numbers of any law.
void check_waves(BodySpec const& spec, BodyFacts const& body, Problems& slips) {
  constexpr double slow = 1, fast = 25000;
  if (body.p_wave >= slow && body.p_wave <= fast) return;
  slips.add(place_of(spec.places, "material"),
            body_words(body) + "pressure waves travel at " + number_text(body.p_wave, 4) + " m/s, " +
                (body.p_wave < slow ? "slower" : "faster") +
                " than in any solid (10 m/s to 18 km/s is usual) - check the units of moduli and density");
}

void check_fineness(BodySpec const& spec, BodyFacts const& body, Problems& slips) {
  double widest = 0;
  Place const place = place_of(spec.places, "shape");
  for (std::size_t d = 0; d < static_cast<std::size_t>(spec.shape.dimension); ++d) {
    widest = std::max(widest, body.spacing[d]);
    if (body.lattice[d] >= 3) continue;
    slips.add(place, body_words(body) + "only " + std::to_string(body.lattice[d]) +
                         (body.lattice[d] == 1 ? " particle" : " particles") + " across in " + "xyz"[d] +
                         " (3 or more are needed to bend) - make the spacing smaller");
  }
  double const ratio = widest / smallest_spacing(body, spec.shape.dimension);
  if (ratio > 2) {
    slips.add(place, body_words(body) + "the spacings differ by a factor of " + number_text(ratio, 3) +
                         " (SPH wants them alike, at most 1.5) - change particles");
  }
}

bool has_moving_boundary(CaseSpec const& spec) {
  bool moves = !spec.loads.empty() || std::any_of(spec.supports.begin(), spec.supports.end(),
                                                  [](SupportSpec const& support) { return support.velocity; });
  // The formula that is left out is the constant 0.
  for (RigidSpec const& rigid : spec.rigids)
    for (auto const* formulas : {&rigid.velocity, &rigid.angular_velocity, &rigid.gravity})
      moves = moves || std::any_of(formulas->begin(), formulas->end(),
                                   [](Expression const& component) { return component.text() != "0"; });
  return moves;
}

void check_motion(CaseSpec const& spec, std::vector<BodyFacts> const& facts, Problems& slips) {
  bool moves = has_moving_boundary(spec);
  for (std::size_t b = 0; b < facts.size(); ++b) {
    BodyFacts const& body = facts[b];
    BodySpec const& from = spec.bodies[b];
    if (body.largest_speed > body.p_wave) {
      slips.add(place_of(from.places, "initial_velocity"), body_words(body) + "the initial velocity reaches " +
                                                               number_text(body.largest_speed, 4) +
                                                               " m/s, above the speed of pressure waves, " +
                                                               number_text(body.p_wave, 4) + " m/s - check both units");
    }
    moves = moves || body.largest_speed > 0 || from.initial_displacement || from.initial_deformation_gradient ||
            from.formulation.formulas.contains("initial_pressure") || is_explosive(from.material);
  }
  if (!moves)
    slips.add({},
              "nothing moves: no initial velocity, displacement or deformation, no load and no driven support - "
              "add one");
}

void check_steps(RunSpec const& run, double step, Problems& slips) {
  constexpr double few = 10, many = 1e7;
  double const steps = run.end / step;
  Place const place = place_of(run.places, "end");
  if (steps < 1) {
    slips.add(place, "run.end is " + quantity_text(run.end, "s") + ", shorter than one step of about " +
                         quantity_text(step, "s") +
                         ", so that the run is a single step - check the units of run.end "
                         "and of the moduli");
  } else if (steps < few) {
    slips.add(place, "run.end is " + quantity_text(run.end, "s") + ", only about " + number_text(std::ceil(steps), 2) +
                         " steps of " + quantity_text(step, "s") +
                         " (waves need tens of steps to cross a body) - check the units of run.end and of the moduli");
  } else if (steps > many) {
    slips.add(place, "about " + number_text(steps, 2) +
                         " steps are needed (more than 10 million take days) - "
                         "check run.end and the stiffness");
  }
}

}  // namespace

std::vector<BodyFacts> body_facts(CaseSpec const& spec, ParticleSet const& particles) {
  std::vector<BodyFacts> all;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    Body const& body = particles.bodies[b];
    BodyFacts facts{
        .name = body.name, .particles = body.last - body.first, .spacing = body.spacing, .lattice = body.lattice};
    facts.largest_speed = largest_speed(spec.bodies[b], particles, body);
    auto const add = [&](MaterialParameters const& material, double volume) {
      with_any_law(material, [&](auto const& law) {
        facts.mass += volume * law.rho0;
        facts.p_wave = std::max(facts.p_wave, law.p_wave_speed());
        if constexpr (requires { law.s_wave_speed(); }) facts.s_wave = std::max(facts.s_wave, law.s_wave_speed());
      });
    };
    auto const& parts = spec.bodies[b].parts;
    auto const shares = part_facts(particles, body, parts.size());
    add(spec.bodies[b].material, shares[0].volume);
    for (std::size_t k = 0; k < parts.size(); ++k) add(parts[k].material, shares[k + 1].volume);
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

void find_slips(CaseSpec const& spec, std::vector<BodyFacts> const& facts, double step, Problems& slips) {
  for (std::size_t b = 0; b < facts.size(); ++b) {
    if (!check_parameters(spec.bodies[b], facts[b], slips)) check_waves(spec.bodies[b], facts[b], slips);
    check_fineness(spec.bodies[b], facts[b], slips);
  }
  check_motion(spec, facts, slips);
  check_steps(spec.run, step, slips);
}

}  // namespace piola
