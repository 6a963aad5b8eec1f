// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/nodal/body_materials.hpp"
#include "piola/formulations/nodal/solver.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::nodal {
namespace {

/// Spacings too coarse for the strength of a crack, and runs in which nothing fails.
void warn_of_failure(Assembly const& assembly, std::size_t body, BodyWarnings& warnings) {
  auto const& materials = materials_of(assembly, body);
  if (assembly.minimises && std::any_of(materials.begin(), materials.end(), &fails)) {
    warnings.add("material",
                 "nothing fails in a run that relaxes by conjugate gradients - leave damage, spall and "
                 "tensile_strength out, or give run.relax_method = \"kinetic_damping\"");
    return;
  }
  ParticleSet const& set = assembly.particles;
  double const width = width_of_crack(set.bodies[body], set.dimension);
  for (MaterialParameters const& material : materials)
    with_solid(material, [&](auto const& law) {
      if (law.scatter.modulus < unbounded && !fails(material))
        warnings.add("material.weibull_modulus",
                     "weibull_modulus has no effect here (nothing of this material fails: it has no tensile_strength, "
                     "damage or spall) - remove it, or give one of these");
      if (!(law.fracture.strength < unbounded)) return;
      double const modulus = modulus_across_crack(set.dimension, law.kappa, law.mu);
      CrackBand const band = crack_band(law.fracture.strength, law.fracture.energy, modulus, width);
      if (!band.weakened) return;
      double const enough =
          law.fracture.energy * modulus / (least_ratio_of_band * law.fracture.strength * law.fracture.strength);
      warnings.add(
          "material.tensile_strength",
          fmt::format("the particles are too coarse for tensile_strength: cracks take fracture_energy, but open "
                      "at {} MPa instead of {} MPa - use spacings of {} mm or less, or mind that the strength "
                      "is lower",
                      number_text(band.strength / 1e6, 3), number_text(law.fracture.strength / 1e6, 3),
                      number_text(enough * 1e3, 3)));
    });
}

/// Whether a pressure differs along its face at any of a few times.
bool varies(Load const& load, ParticleSet const& particles) {
  constexpr std::array times{0.0, 1e-6, 1e-3, 1.0, 1e3};  // s
  return std::any_of(times.begin(), times.end(),
                     [&](double t) { return varies_between(load.particles, load.value[0], particles, t); });
}

/// A pressure that follows its face and varies along it is no conservative load: it can feed short waves of the face
/// without end (docs/theory/nodal.md, section 6), of which nodal takes nothing.
void warn_of_following_pressures(Assembly const& assembly, std::size_t body, BodyWarnings& warnings) {
  Body const& own = assembly.particles.bodies[body];
  if (warnings.has_setting("fluctuation_viscosity") && !assembly.minimises) return;
  for (Load const& load : assembly.loads) {
    bool const here = !load.particles.empty() && load.particles[0] >= own.first && load.particles[0] < own.last;
    if (!here || !load.follows || !varies(load, assembly.particles)) continue;
    warnings.add(
        "formulation",
        fmt::format("load '{}' is a pressure that follows the face and varies along it: it is not conservative "
                    "and {}",
                    load.name,
                    assembly.minimises
                        ? "has no energy for conjugate gradients, which then hardly get on - give "
                          "run.relax_method = \"kinetic_damping\""
                        : "may feed short waves, which nodal does not damp - give fluctuation_viscosity = 0.05"));
  }
}

}  // namespace

/// Three particles across are a little stiff in bending near incompressibility (docs/theory/nodal.md, section 8).
void add_setting_warnings(Assembly const& assembly, std::size_t body, BodyWarnings& warnings) {
  constexpr double nearly = 0.4901;
  constexpr int few = 3;
  auto const& lattice = assembly.particles.bodies[body].lattice;
  int const across = *std::min_element(lattice.begin(), lattice.begin() + assembly.particles.dimension);
  warn_of_failure(assembly, body, warnings);
  warn_of_following_pressures(assembly, body, warnings);
  if (warnings.has_setting("conversion", "eulerian")) warn_of_tension(warnings);
  double ratio = 0;
  for (MaterialParameters const& material : materials_of(assembly, body))
    ratio = std::max(ratio, poissons_ratio_of(material));
  if (across > few || !(ratio > nearly) || assembly.particles.dimension == 1) return;
  warnings.add(
      "material.poissons_ratio",
      fmt::format("poissons_ratio is {}, and {} particles across are some percent too stiff in bending there - use "
                  "more particles across",
                  number_text(ratio, 4), across));
}

}  // namespace piola::nodal
