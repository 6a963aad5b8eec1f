// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/formulations/jst_sph/solver.hpp"
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

/// Warnings for the classical baseline, which has neither scheme nor stabilisation nor projection.
void warn_of_displacement(Assembly const& assembly, BodyWarnings& warnings) {
  for (std::string_view const name : {"eps2_momentum", "eps4_momentum"})
    if (number_of(warnings.spec(), name, 0) > 0)
      warnings.ignored(name, "variables = \"displacement\" have no stabilisation");
  warnings.ignored("laplacian_support", "variables = \"displacement\" have no stabilisation");
  if (warnings.has_setting("angular_momentum_projection", "on"))
    warnings.ignored("angular_momentum_projection", "variables = \"displacement\" have no projection");
  if (warnings.has_setting("scheme", "filtered"))
    warnings.ignored("scheme",
                     "variables = \"displacement\" have neither its filter nor its stabilisation nor its steps");
  if (!assembly.initial_deformation_gradient.empty())
    warnings.add(
        "initial_deformation_gradient",
        "initial_deformation_gradient has no effect here (with variables = \"displacement\" the deformation is "
        "that of the positions) - give initial_displacement");
}

void warn_of_boundaries(Options const& o, BodyWarnings& warnings) {
  if (o.multipliers && !warnings.has_support()) warnings.ignored("supports", "the body has no support");
  if (o.project && warnings.has_mirror() && warnings.has_setting("angular_momentum_projection", "on"))
    warnings.ignored("angular_momentum_projection", "a body with mirror planes is not projected");
}

/// Warnings for near incompressibility: locking, growth, ringing (docs/theory/jst-sph.md, Limits; jst-sph-filtered.md,
/// 1 and 2).
void warn_of_incompressible(Options const& o, BodyWarnings& warnings) {
  constexpr double nearly = 0.4501;
  double const ratio = poissons_ratio_of(warnings.material());
  if (!(ratio > nearly) || o.filter) return;
  std::string const has = fmt::format("poissons_ratio is {}", number_text(ratio, 4));
  if (o.variables == Variables::displacement)
    warnings.add(
        "material.poissons_ratio",
        has +
            ", and with variables = \"displacement\" nothing damps the fast changes of volume, which Runge-Kutta "
            "steps amplify - leave variables out");
  else if (o.integrator == Integrator::tvd_rk2)
    warnings.add("material.poissons_ratio",
                 has +
                     ", where a stabilisation with the speed of pressure waves locks and takes energy (it is meant for "
                     "0.45 and less) - leave scheme out");
  else
    warnings.add("material.poissons_ratio",
                 has +
                     ", and the volumetric energy is not filtered, so that the pressure rings and bending is a little "
                     "stiff - take a law with an isochoric part, such as neo_hookean");
}

}  // namespace

void add_setting_warnings(Assembly const& assembly, std::size_t body, BodyWarnings& warnings) {
  Options const o = read_options(assembly.formulations[body], assembly.materials[body], assembly.cfl);
  if (o.variables == Variables::displacement) warn_of_displacement(assembly, warnings);
  warn_of_boundaries(o, warnings);
  warn_of_incompressible(o, warnings);
}

}  // namespace piola::jst_sph
