// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/options.hpp"
#include "piola/formulations/adaptle/solver.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <initializer_list>

namespace piola::adaptle {
namespace {

using Keys = std::initializer_list<std::string_view>;

void ignore(BodyWarnings& warnings, Keys keys, std::string_view why) {
  for (std::string_view const key : keys) warnings.ignored(key, why);
}

/// Which descriptions particles of the case may have.
struct Mixture {
  bool lagrangian = false, eulerian = false;
};

Mixture mixture_of(Options const& options) {
  Mixture m;
  for (BodyOptions const& o : options.bodies) {
    m.lagrangian = m.lagrangian || o.description != Description::eulerian;
    m.eulerian = m.eulerian || o.description != Description::total_lagrangian;
  }
  return m;
}

void warn_of_description(BodyOptions const& o, Options const& all, BodyWarnings& warnings) {
  bool const adaptive = o.description == Description::adaptive, patch = o.description == Description::patch;
  if (!adaptive && !o.deletes)
    ignore(warnings, {"convert_strain"}, "particles convert with description = \"adaptive\"");
  if (!adaptive && !o.deletes)
    ignore(warnings, {"convert_damage"}, "particles convert with description = \"adaptive\", or fail with \"delete\"");
  if (!adaptive)
    ignore(warnings, {"conversion_radius", "conversion_separation"},
           "particles convert with description = \"adaptive\"");
  if (!adaptive && !o.deletes && !patch)
    ignore(warnings, {"jacobian_min", "jacobian_max"}, "particles convert with description = \"adaptive\"");
  if (!patch) ignore(warnings, {"blend"}, "it belongs to description = \"patch\"");
  if (patch && !all.settings.equations.blends()) ignore(warnings, {"blend"}, "interface = \"published\" is sharp");
  if (o.description == Description::eulerian)
    ignore(warnings, {"hourglass", "hourglass_stiffness", "material_smoothing_length"},
           "it is for total-Lagrangian particles, and all are Eulerian");
}

void warn_of_mixture(Options const& all, BodyWarnings& warnings) {
  Mixture const m = mixture_of(all);
  if (!m.lagrangian || !m.eulerian)
    ignore(warnings, {"interface", "artificial_stress_interface"},
           "no particles of both descriptions can be neighbours");
  if (!m.eulerian) {
    if (number_of(warnings.spec(), "artificial_stress", 0) > 0)
      ignore(warnings, {"artificial_stress"}, "it acts on Eulerian particles, and none can become so");
    ignore(warnings, {"artificial_stress_exponent"}, "no particle can become Eulerian");
  }
  if (!m.lagrangian && warnings.has_setting("correction", "material"))
    ignore(warnings, {"correction"}, "it corrects total-Lagrangian sums, and all particles are Eulerian");
  if (!all.settings.corrected) ignore(warnings, {"correction_limit"}, "it belongs to correction = \"mixed\"");
}

void warn_of_forces(BodyOptions const& o, Options const& all, int dimension, BodyWarnings& warnings) {
  bool const riemann = all.settings.viscosity == Viscosity::riemann;
  if (riemann)
    ignore(warnings, {"alpha", "beta", "viscosity_speed", "artificial_stress", "artificial_stress_exponent"},
           "viscosity = \"riemann\" takes its place");
  else if (o.alpha == 0 && o.beta == 0)
    ignore(warnings, {"viscosity", "viscosity_speed"}, "alpha and beta are zero");
  if (!riemann && o.artificial_stress == 0 && mixture_of(all).eulerian)
    ignore(warnings, {"artificial_stress_exponent"}, "artificial_stress is zero");
  if (o.artificial_stress == 0 && mixture_of(all).lagrangian && mixture_of(all).eulerian)
    ignore(warnings, {"artificial_stress_interface"}, "artificial_stress is zero");
  if (!mixture_of(all).lagrangian) ignore(warnings, {"viscosity_form"}, "no particle is total-Lagrangian");
  if (warnings.has_setting("viscosity_form", "central") && !all.settings.equations.has_central_viscosity())
    ignore(warnings, {"viscosity_form"},
           "correction = \"mixed\" and interface = \"published\" have the published form");
  if (!all.settings.equations.has_hourglass_stiffness())
    ignore(warnings, {"hourglass_stiffness"}, "it needs viscosity_form = \"central\" and correction = \"material\"");
  if (o.ignition && !is_explosive(warnings.material()))
    ignore(warnings, {"ignition"}, "the material is no explosive (eos = \"jwl\")");
  if (!o.initial_pressure) ignore(warnings, {"initial_pressure_duration"}, "there is no initial_pressure");
  if (dimension == 3 && warnings.has_setting("assumption", "plane_strain"))
    ignore(warnings, {"assumption"}, "the body has three dimensions");
}

/// Criteria of damage for a law without it, and damage from which nothing follows.
void warn_of_damage(BodyOptions const& o, BodyWarnings& warnings) {
  bool damages = false, scatters = false;
  with_solid(warnings.material(), [&](auto const& law) {
    damages = law.damages;
    scatters = law.scatter.modulus < unbounded;
  });
  std::string_view const cannot =
      "the law has no damage that grows and no spall, so that no particle fails; damage = \"johnson_cook\" or spall";
  bool const converts = o.description == Description::adaptive || o.deletes;
  if (!damages) {
    if (scatters)
      warnings.add("material.weibull_modulus",
                   fmt::format("weibull_modulus has no effect here ({}) - remove it", cannot));
    if (converts) ignore(warnings, {"convert_damage"}, cannot);
    if (o.releases || (o.deletes && o.convert_strain == unbounded)) ignore(warnings, {"failed"}, cannot);
    if (!o.convert_when) return;
    auto const words = expression_words(o.convert_when->text());
    if (std::find(words.begin(), words.end(), "damage") != words.end())
      warnings.add("formulation.convert_when",
                   "convert_when asks for damage, which stays zero (the law has none that grows) - set damage = "
                   "\"johnson_cook\" or change the formula");
  } else if (!converts && !o.releases) {
    warnings.add(
        "material.damage",
        "damage grows, but nothing follows from it (failed particles keep their stress and stay as they are) - "
        "choose failed or description = \"adaptive\"");
  }
}

/// Slender elastic bodies that are held bend: the period is wrong and the energy may rise (docs/user/formulations.md).
void warn_of_bending(Assembly const& assembly, std::size_t body, BodyOptions const& o, BodyWarnings& warnings) {
  constexpr int few = 6, slender = 3;
  auto const& lattice = assembly.particles.bodies[body].lattice;
  auto const [least, most] = std::minmax_element(lattice.begin(), lattice.begin() + assembly.particles.dimension);
  bool yields = false;
  with_solid(warnings.material(), [&](auto const& law) { yields = law.yield_stress({}, 0) < unbounded; });
  bool const bends = *least > 0 && *least <= few && *most >= slender * *least && warnings.has_support();
  if (!bends || yields || o.description != Description::total_lagrangian || assembly.particles.dimension == 1) return;
  warnings.add("formulation",
               fmt::format("an elastic body that is held and {} particles across may bend: the energy of "
                           "a cantilever of 5 rises by 12 % in half a period - take nodal, or more "
                           "particles across",
                           *least));
}

/// Options of a group of bodies. Only these bodies must have settings in common.
Options options_of(Assembly const& whole, std::vector<std::size_t> const& group) {
  Assembly own;
  own.particles.dimension = whole.particles.dimension;
  own.particles.axisymmetric = whole.particles.axisymmetric;
  own.cfl = whole.cfl;
  own.contact = whole.contact;
  for (std::size_t const b : group) {
    own.formulations.push_back(whole.formulations[b]);
    own.materials.push_back(whole.materials[b]);
    own.particles.bodies.push_back(whole.particles.bodies[b]);
  }
  return read_options(own);
}

}  // namespace

void add_setting_warnings(Assembly const& assembly, std::size_t body, BodyWarnings& warnings) {
  std::vector<std::size_t> const& group = warnings.group();
  Options const all = options_of(assembly, group);
  auto const place = std::find(group.begin(), group.end(), body) - group.begin();
  BodyOptions const& o = all.bodies[static_cast<std::size_t>(place)];
  warn_of_description(o, all, warnings);
  warn_of_mixture(all, warnings);
  warn_of_forces(o, all, assembly.particles.dimension, warnings);
  if (o.description == Description::eulerian ||
      (o.description == Description::adaptive && (o.convert_strain < unbounded || o.convert_when)))
    warn_of_tension(warnings);
  warn_of_damage(o, warnings);
  warn_of_bending(assembly, body, o, warnings);
}

}  // namespace piola::adaptle
