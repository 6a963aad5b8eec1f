// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/plausibility.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/model/body_properties.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

std::string body_words(BodyProperties const& body) { return "body " + in_quotes(body.name) + ": "; }

/// A material of a body or of one of its parts, and the places of its numbers in the file.
struct MaterialLooked {
  MaterialParameters const& material;
  LawInfo law;
  Places const& places;
  std::string subject;  ///< "body "plate": "

  double value(std::string_view name) const {
    for (std::size_t i = 0; i < law.parameters.size(); ++i)
      if (law.parameters[i].name == name) return material.value[i];
    return std::numeric_limits<double>::quiet_NaN();
  }
  void note(Problems& slips, std::string_view key, std::string const& sentence) const {
    if (!sentence.empty()) slips.add(place_in_table(places, "material", key), subject + sentence);
  }
};

/// Compares the parameters that have a rule of their name. Defaults are not judged.
void check_parameters(MaterialLooked const& of, Problems& slips) {
  for (std::size_t i = 0; i < of.law.parameters.size(); ++i) {
    Parameter const& parameter = of.law.parameters[i];
    double const value = of.material.value[i];
    auto const* range = find_plausible_range(parameter.name);
    if (range == nullptr || !range->reference.empty() || value == parameter.default_value) continue;
    if (applies(of.law, parameter, of.material)) of.note(slips, parameter.name, implausible(*range, value));
  }
}

/// Checks strengths against moduli.
void check_strength(MaterialLooked const& of, Problems& slips) {
  double const youngs = of.value("youngs_modulus"), yield = yield_at_start(of.material);
  of.note(slips, "yield_stress", implausible(plausible_range("yield_stress"), yield, youngs, "Pa"));
  double modulus = 0;
  with_any_law(of.material, [&](auto const& law) { modulus = law.rho0 * law.p_wave_speed() * law.p_wave_speed(); });
  of.note(slips, "spall_pressure",
          implausible(plausible_range("spall_pressure"), of.value("spall_pressure"), modulus, "Pa"));
  for (char const* key : {"hardening_coefficient", "hardening_modulus", "thermal_hardening", "voce_q"}) {
    double const value = of.value(key);
    if (value > 0) of.note(slips, key, implausible(plausible_range("hardening"), value, youngs, "Pa"));
  }
}

/// Temperatures and damage by Johnson and Cook.
void check_heat_and_damage(MaterialLooked const& of, Problems& slips) {
  with_solid(of.material, [&](auto const& law) {
    of.note(slips, "initial_temperature",
            implausible(plausible_range("heat"), law.initial_temperature(), of.value("melting_temperature"), "K"));
  });
  for (Parameter const& parameter : of.law.parameters) {
    if (parameter.name != "d1" || !applies(of.law, parameter, of.material)) continue;
    double const strain = of.value("d1") + of.value("d2") * std::exp(of.value("d3") / 3);
    of.note(slips, "d1", implausible(plausible_range("fracture_strain"), strain));
  }
}

/// Whether a number of the law looks odd.
bool check_material(MaterialLooked const& of, Problems& slips) {
  std::size_t const before = slips.count();
  check_parameters(of, slips);
  check_strength(of, slips);
  check_heat_and_damage(of, slips);
  return slips.count() > before;
}

/// Checks the wave speed, which depends on the numbers of any law.
void check_waves(MaterialLooked const& of, Problems& slips) {
  constexpr double dense = 2500;  // kg/m^3
  with_any_law(of.material, [&](auto const& law) {
    std::string sentence = implausible(plausible_range("wave_speed"), law.p_wave_speed());
    if (sentence.empty() && law.rho0 > dense)
      sentence = implausible(plausible_range("dense_wave_speed"), law.p_wave_speed());
    of.note(slips, "", sentence);
  });
}

void check_materials(BodySpec const& spec, BodyProperties const& body, Problems& slips) {
  auto const check = [&](MaterialParameters const& material, Places const& places, std::string const& subject) {
    MaterialLooked const of{material, law_of(material), places, subject};
    if (!check_material(of, slips)) check_waves(of, slips);
  };
  check(spec.material, spec.places, body_words(body));
  for (PartSpec const& part : spec.parts)
    check(part.material, part.places, body_words(body) + "part " + in_quotes(part.name) + ": ");
}

void check_fineness(BodySpec const& spec, BodyProperties const& body, Problems& slips) {
  PlausibleRange const &across = plausible_range("particles_across"), &ratios = plausible_range("spacing_ratio");
  double widest = 0;
  Place const place = place_of(spec.places, "shape");
  for (std::size_t d = 0; d < static_cast<std::size_t>(spec.shape.dimension); ++d) {
    widest = std::max(widest, body.spacing[d]);
    if (body.lattice[d] >= across.low) continue;
    slips.add(place, body_words(body) + "only " + std::to_string(body.lattice[d]) +
                         (body.lattice[d] == 1 ? " particle" : " particles") + " across in " + "xyz"[d] +
                         std::string(across.below));
  }
  double const ratio = widest / smallest_spacing(body, spec.shape.dimension);
  if (ratio > ratios.high)
    slips.add(place, body_words(body) + "the spacings differ by a factor of " + number_text(ratio, 3) +
                         std::string(ratios.above));
}

void check_extent(BodySpec const& spec, BodyProperties const& body, Problems& slips) {
  double const largest = *std::max_element(body.size.begin(), body.size.end());
  if (auto const sentence = implausible(plausible_range("size"), largest); !sentence.empty())
    slips.add(place_of(spec.places, "shape"), body_words(body) + sentence);
}

bool has_moving_boundary(CaseSpec const& spec) {
  bool moves = !spec.loads.empty() || std::any_of(spec.supports.begin(), spec.supports.end(),
                                                  [](SupportSpec const& support) { return support.velocity; });
  // The formula that is left out is the constant 0.
  for (RigidSpec const& rigid : spec.rigids)
    for (auto const* formulas : {&rigid.velocity, &rigid.angular_velocity, &rigid.gravity, &rigid.force, &rigid.torque})
      moves = moves || std::any_of(formulas->begin(), formulas->end(),
                                   [](Expression const& component) { return component.text() != "0"; });
  return moves;
}

void check_motion(CaseSpec const& spec, std::vector<BodyProperties> const& facts, Problems& slips) {
  bool moves = has_moving_boundary(spec);
  for (std::size_t b = 0; b < facts.size(); ++b) {
    BodyProperties const& body = facts[b];
    BodySpec const& from = spec.bodies[b];
    if (auto const fast = implausible(plausible_range("speed"), body.largest_speed, body.p_wave, "m/s"); !fast.empty())
      slips.add(place_of(from.places, "initial_velocity"), body_words(body) + fast);
    moves = moves || body.largest_speed > 0 || from.initial_displacement || from.initial_deformation_gradient ||
            from.initial_temperature || from.formulation.formulas.contains("initial_pressure") ||
            is_explosive(from.material);
  }
  if (!moves)
    slips.add({},
              "nothing moves: no initial velocity, displacement or deformation, no load and no driven support - "
              "add one");
}

/// Whether the end of the run lies within a plausible number of steps.
bool check_steps(RunSpec const& run, double step, Problems& slips) {
  PlausibleRange const& range = plausible_range("steps");
  double const steps = run.end / step;
  Place const place = place_of(run.places, "end");
  if (steps < 1) {
    slips.add(place, "run.end is " + quantity_text(run.end, "s") + ", shorter than one step of about " +
                         quantity_text(step, "s") +
                         ", so that the run is a single step - check the units of run.end "
                         "and of the moduli");
  } else if (steps < range.low) {
    slips.add(place, "run.end is " + quantity_text(run.end, "s") + ", only about " + number_text(std::ceil(steps), 2) +
                         " steps of " + quantity_text(step, "s") + std::string(range.below));
  } else if (steps > range.high) {
    slips.add(place, "about " + number_text(steps, 2) + " steps are needed" + std::string(range.above));
  }
  return steps >= range.low && steps <= range.high;
}

/// Waves, or what moves faster, should have time to cross the thinnest body, and the run should end some day.
void check_transits(CaseSpec const& spec, std::vector<BodyProperties> const& facts, Problems& slips) {
  double transit = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < facts.size(); ++b)
    for (std::size_t d = 0; d < static_cast<std::size_t>(spec.bodies[b].shape.dimension); ++d)
      transit = std::min(transit, facts[b].size[d] / std::max(facts[b].p_wave, facts[b].largest_speed));
  if (auto const odd = implausible(plausible_range("transits"), spec.run.end, transit, "s"); !odd.empty())
    slips.add(place_of(spec.run.places, "end"), odd);
}

void check_friction(CaseSpec const& spec, Problems& slips) {
  auto const check = [&](contact::FrictionLaw const& law, Places const& places) {
    auto const odd = implausible(plausible_range("friction"), std::max(law.kinetic, law.still));
    if (!odd.empty()) slips.add(place_of(places, "friction"), odd);
  };
  if (spec.contact) check(spec.contact->friction, spec.contact->places);
  for (ContactPairSpec const& pair : spec.contact_pairs) check(pair.friction, pair.places);
}

}  // namespace

void find_implausible_values(CaseSpec const& spec, ParticleSet const& particles,
                             std::vector<BodyProperties> const& facts, double step, Problems& slips) {
  PIOLA_EXPECTS(facts.size() == spec.bodies.size());
  for (std::size_t b = 0; b < facts.size(); ++b) {
    check_materials(spec.bodies[b], facts[b], slips);
    check_fineness(spec.bodies[b], facts[b], slips);
    check_extent(spec.bodies[b], facts[b], slips);
  }
  check_motion(spec, facts, slips);
  check_friction(spec, slips);
  find_implausible_loads(spec, particles, facts, slips);
  if (check_steps(spec.run, step, slips)) check_transits(spec, facts, slips);
}

}  // namespace piola
