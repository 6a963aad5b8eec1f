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

bool uses_estimates(BodyDoubts const& doubts) {
  return doubts.gives("exchange", "estimates") ||
         (doubts.gives("configuration", "fixed") && !doubts.gives("exchange", "adjoint"));
}

void doubt_estimates(BodyDoubts& doubts, bool line) {
  for (char const* name : {"cell_memory", "hourglass_stiffness"})
    if (doubts.gives(name)) doubts.ignored(name, "it belongs to exchange = \"adjoint\"");
  if (line && number_of(doubts.spec(), "hourglass_filter", 0) > 0)
    doubts.ignored("hourglass_filter", "a row of particles has no hourglass pattern");
  if (!doubts.gives("momentum_projection", "on")) return;
  if (doubts.gives("configuration", "fixed"))
    doubts.ignored("momentum_projection", "it acts in the updated configuration");
  else if (doubts.has_support())
    doubts.ignored("momentum_projection", "it acts on bodies without supports, and this one is held");
}

void doubt_adjoint(BodyDoubts& doubts) {
  for (char const* name : {"gradient", "kernel", "smoothing_length", "hourglass_filter", "momentum_projection"})
    if (doubts.gives(name)) doubts.ignored(name, "it belongs to exchange = \"estimates\"");
  if (doubts.gives("hourglass_stiffness") && !doubts.gives("virtual_particles", "lattice_cells"))
    doubts.ignored("hourglass_stiffness", "it acts with virtual_particles = \"lattice_cells\"");
}

}  // namespace

void doubt(Assembly const& assembly, std::size_t body, BodyDoubts& doubts) {
  bool const line = assembly.particles.dimension == 1;
  if (line && doubts.gives("virtual_particles", "lattice_cells"))
    doubts.ignored("virtual_particles", "in one dimension they are the midpoints");
  if (uses_estimates(doubts))
    doubt_estimates(doubts, line);
  else
    doubt_adjoint(doubts);
  if (is_displaced(assembly, assembly.particles.bodies[body]))
    doubts.add("initial_displacement",
               "initial_displacement moves the particles without any stress (the stress of this formulation starts at "
               "zero) - start from a velocity or a load, or take jst_sph, which strains the body");
}

}  // namespace piola::taylor_sph
