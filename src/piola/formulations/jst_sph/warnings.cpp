// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/formulations/jst_sph/solver.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

/// Warnings for the classical baseline, which has neither stabilisation nor projection, and a step limit of its own.
void doubt_displacement(Assembly const& assembly, BodyWarnings& setting_warnings) {
  for (std::string_view const name : {"eps2_momentum", "eps4_momentum"})
    if (number_of(setting_warnings.spec(), name, 0) > 0)
      setting_warnings.ignored(name, "variables = \"displacement\" have no stabilisation");
  if (setting_warnings.has_setting("integrator", "verlet"))
    setting_warnings.ignored("integrator", "variables = \"displacement\" are advanced by Runge-Kutta");
  if (setting_warnings.has_setting("angular_momentum_projection", "on"))
    setting_warnings.ignored("angular_momentum_projection", "variables = \"displacement\" have no projection");
  for (std::string_view const scheme : {"conservative", "filtered"})
    if (setting_warnings.has_setting("scheme", scheme))
      setting_warnings.ignored(
          "scheme", "variables = \"displacement\" have neither its filter nor its stabilisation nor its steps");
  if (!assembly.initial_deformation_gradient.empty())
    setting_warnings.add(
        "initial_deformation_gradient",
        "initial_deformation_gradient has no effect here (with variables = \"displacement\" the deformation is "
        "that of the positions) - give initial_displacement");
}

/// Settings of operators that are switched off.
void doubt_operators(Options const& o, BodyWarnings& setting_warnings) {
  bool const none = o.biharmonic == Biharmonic::none;
  if (none || (o.eps4 == 0 && o.eps4_J == 0))
    if (!setting_warnings.has_setting("biharmonic", "as_scheme"))
      setting_warnings.ignored("biharmonic", "there is no biharmonic stabilisation");
  if (none && !setting_warnings.has_setting("stabilisation_speed", "as_scheme"))
    setting_warnings.ignored("stabilisation_speed", "there is no stabilisation");
  if (none && !o.filter && !o.corrected_kernel())
    setting_warnings.ignored("laplacian_support", "there is no stabilisation, no filter and no corrected kernel");
  for (std::string_view const name : {"filter_passes", "local_bulk", "bulk_viscosity"})
    if (!o.filter && number_of(setting_warnings.spec(), name, 0) > 0)
      setting_warnings.ignored(
          name,
          "the volumetric energy is not filtered; volumetric_filter = \"on\" does so, or Poisson's ratios "
          "from 0.45 on with scheme = \"conservative\" or \"filtered\"");
  if (is_hypoelastic(setting_warnings.material()))
    setting_warnings.ignored("wave_speed", "solids in rate form take the speed of their current state");
  else if (o.exact_speed && setting_warnings.has_setting("wave_speed", "estimate"))
    setting_warnings.ignored("wave_speed", "for this law the speed always comes from its tangent");
}

void doubt_boundaries(Options const& o, BodyWarnings& setting_warnings) {
  if (o.multipliers && !setting_warnings.has_support()) setting_warnings.ignored("supports", "the body has no support");
  if (o.project && setting_warnings.has_mirror() && setting_warnings.has_setting("angular_momentum_projection", "on"))
    setting_warnings.ignored("angular_momentum_projection", "a body with mirror planes is not projected");
}

/// Warnings for near incompressibility: locking, growth, ringing (docs/theory/jst-sph.md, Limits; jst-sph-filtered.md,
/// 1 and 2).
void doubt_incompressible(Options const& o, BodyWarnings& setting_warnings) {
  constexpr double nearly = 0.4501;
  double const ratio = poissons_ratio_of(setting_warnings.material());
  if (!(ratio > nearly) || o.filter) return;
  std::string const has = fmt::format("poissons_ratio is {}", number_text(ratio, 4));
  if (o.variables == Variables::displacement)
    setting_warnings.add(
        "material.poissons_ratio",
        has +
            ", and with variables = \"displacement\" nothing damps the fast changes of volume, which Runge-Kutta "
            "steps amplify - leave variables out");
  else if (o.biharmonic != Biharmonic::none && !o.shear_speed)
    setting_warnings.add(
        "material.poissons_ratio",
        has +
            ", where a stabilisation with the speed of pressure waves locks and takes energy (it is meant for "
            "0.45 and less) - leave scheme out, or take stabilisation_speed = \"shear\"");
  else
    setting_warnings.add(
        "material.poissons_ratio",
        has +
            ", and the volumetric energy is not filtered, so that the pressure rings and bending is a little "
            "stiff - " +
            (setting_warnings.has_setting("volumetric_filter", "off")
                 ? "leave volumetric_filter out"
                 : "leave scheme out and take a law with an isochoric part, such as neo_hookean"));
}

/// Damage is recorded here; nothing becomes of it.
void doubt_damage(BodyWarnings& setting_warnings) {
  bool damages = false;
  with_solid(setting_warnings.material(), [&](auto const& law) { damages = law.damages; });
  if (damages)
    setting_warnings.add(
        "material.damage",
        "damage is recorded, but does not weaken the material (jst_sph lets no particle fail) - set damage = "
        "\"none\" and spall = \"limit\", or take the formulation adaptle");
}

}  // namespace

void setting_warning(Assembly const& assembly, std::size_t body, BodyWarnings& setting_warnings) {
  Options const o = read_options(assembly.formulations[body], assembly.materials[body], assembly.cfl,
                                 assembly.particles.bodies[body].regular);
  if (o.variables == Variables::displacement) doubt_displacement(assembly, setting_warnings);
  doubt_operators(o, setting_warnings);
  doubt_boundaries(o, setting_warnings);
  doubt_incompressible(o, setting_warnings);
  doubt_damage(setting_warnings);
}

}  // namespace piola::jst_sph
