// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/options.hpp"
#include "piola/base/problems.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::nodal {
namespace {

constexpr std::array parameters{Parameter{
    "least_mass", "1",
    "smallest mass of a particle over that of its cell: more allows longer steps and makes the inertia of edges "
    "less exact",
    Interval{0.05, 1}, 0.3}};

/// What Diagnostics::more holds (observe.cpp).
constexpr std::array diagnostics{DiagnosticInfo{"least_jacobian", "1"}, DiagnosticInfo{"repeated_steps", "1"}};

constexpr std::array<std::string_view, 5> usable_laws{"linear_elastic", "neo_hookean", "mooney_rivlin",
                                                      "saint_venant_kirchhoff", "compressible_neo_hookean"};

}  // namespace

FormulationInfo info() {
  FormulationInfo info{
      "nodal",
      "conservative total-Lagrangian particles for elastic solids: quadratic fits, cells integrated at "
      "four points, exact masses; nothing is dissipated, on lattices and irregular clouds alike",
      parameters,
      {},
      usable_laws,
      diagnostics};
  info.mirrors = false;
  return info;
}

Options read_options(FormulationSpec const& spec, MaterialParameters const& material, double cfl) {
  LawInfo const& law = laws()[static_cast<std::size_t>(material.law)];
  if (law.rate_form)
    throw InputError(fmt::format(
        "formulation: nodal needs a hyperelastic law, and {} is a solid in rate form, with a history - take "
        "jst_sph, taylor_sph or adaptle for it",
        law.name));
  return {number_of(spec, "least_mass", 0.3), std::isnan(cfl) ? 0 : cfl};
}

}  // namespace piola::nodal
