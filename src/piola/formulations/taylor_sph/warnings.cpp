// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/solver.hpp"
#include <algorithm>

namespace piola::taylor_sph {
namespace {

bool is_displaced(Assembly const& assembly, Body const& body) {
  auto const& moved = assembly.initial_displacement;
  return !moved.empty() && std::any_of(moved.begin() + body.first, moved.begin() + body.last,
                                       [](auto const& u) { return u != std::array<double, 3>{}; });
}

bool uses_kernel_sums(BodyWarnings const& warnings) {
  return warnings.has_setting("exchange", "kernel_sums") ||
         (warnings.has_setting("configuration", "fixed") && !warnings.has_setting("exchange", "adjoint"));
}

void warn_of_kernel_sums(BodyWarnings& warnings, bool line) {
  for (char const* name : {"stress_retention", "hourglass_stiffness"})
    if (warnings.has_setting(name)) warnings.ignored(name, "it belongs to exchange = \"adjoint\"");
  if (line && number_of(warnings.spec(), "hourglass_filter", 0) > 0)
    warnings.ignored("hourglass_filter", "a row of particles has no hourglass pattern");
  if (!warnings.has_setting("momentum_projection", "on")) return;
  if (warnings.has_setting("configuration", "fixed"))
    warnings.ignored("momentum_projection", "it acts in the updated configuration");
  else if (warnings.has_support())
    warnings.ignored("momentum_projection", "it acts on bodies without supports, and this one is held");
}

void warn_of_adjoint(BodyWarnings& warnings) {
  for (char const* name : {"gradient", "kernel", "smoothing_length", "hourglass_filter", "momentum_projection"})
    if (warnings.has_setting(name)) warnings.ignored(name, "it belongs to exchange = \"kernel_sums\"");
  if (warnings.has_setting("hourglass_stiffness") && !warnings.has_setting("virtual_particles", "lattice_cells"))
    warnings.ignored("hourglass_stiffness", "it acts with virtual_particles = \"lattice_cells\"");
}

}  // namespace

void add_setting_warnings(Assembly const& assembly, std::size_t body, BodyWarnings& warnings) {
  bool const line = assembly.particles.dimension == 1;
  if (line && warnings.has_setting("virtual_particles", "lattice_cells"))
    warnings.ignored("virtual_particles", "in one dimension they are the midpoints");
  if (uses_kernel_sums(warnings))
    warn_of_kernel_sums(warnings, line);
  else
    warn_of_adjoint(warnings);
  if (is_displaced(assembly, assembly.particles.bodies[body]))
    warnings.add(
        "initial_displacement",
        "initial_displacement moves the particles without any stress (the stress of this formulation starts at "
        "zero) - start from a velocity or a load, or take jst_sph, which strains the body");
}

}  // namespace piola::taylor_sph
