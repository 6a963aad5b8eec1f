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

bool uses_kernel_sums(BodyWarnings const& setting_warnings) {
  return setting_warnings.has_setting("exchange", "kernel_sums") ||
         (setting_warnings.has_setting("configuration", "fixed") &&
          !setting_warnings.has_setting("exchange", "adjoint"));
}

void doubt_kernel_sums(BodyWarnings& setting_warnings, bool line) {
  for (char const* name : {"stress_retention", "hourglass_stiffness"})
    if (setting_warnings.has_setting(name)) setting_warnings.ignored(name, "it belongs to exchange = \"adjoint\"");
  if (line && number_of(setting_warnings.spec(), "hourglass_filter", 0) > 0)
    setting_warnings.ignored("hourglass_filter", "a row of particles has no hourglass pattern");
  if (!setting_warnings.has_setting("momentum_projection", "on")) return;
  if (setting_warnings.has_setting("configuration", "fixed"))
    setting_warnings.ignored("momentum_projection", "it acts in the updated configuration");
  else if (setting_warnings.has_support())
    setting_warnings.ignored("momentum_projection", "it acts on bodies without supports, and this one is held");
}

void doubt_adjoint(BodyWarnings& setting_warnings) {
  for (char const* name : {"gradient", "kernel", "smoothing_length", "hourglass_filter", "momentum_projection"})
    if (setting_warnings.has_setting(name)) setting_warnings.ignored(name, "it belongs to exchange = \"kernel_sums\"");
  if (setting_warnings.has_setting("hourglass_stiffness") &&
      !setting_warnings.has_setting("virtual_particles", "lattice_cells"))
    setting_warnings.ignored("hourglass_stiffness", "it acts with virtual_particles = \"lattice_cells\"");
}

}  // namespace

void setting_warning(Assembly const& assembly, std::size_t body, BodyWarnings& setting_warnings) {
  bool const line = assembly.particles.dimension == 1;
  if (line && setting_warnings.has_setting("virtual_particles", "lattice_cells"))
    setting_warnings.ignored("virtual_particles", "in one dimension they are the midpoints");
  if (uses_kernel_sums(setting_warnings))
    doubt_kernel_sums(setting_warnings, line);
  else
    doubt_adjoint(setting_warnings);
  if (is_displaced(assembly, assembly.particles.bodies[body]))
    setting_warnings.add(
        "initial_displacement",
        "initial_displacement moves the particles without any stress (the stress of this formulation starts at "
        "zero) - start from a velocity or a load, or take jst_sph, which strains the body");
}

}  // namespace piola::taylor_sph
