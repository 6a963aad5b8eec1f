// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/base/problems.hpp"
#include "piola/materials/laws.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

constexpr std::array<std::string_view, 2> variable_words{"pF", "displacement"};
constexpr std::array<std::string_view, 3> scheme_words{"filtered", "robust", "paper"};
constexpr std::array<std::string_view, 1> kernel_words{"cubic_spline"};
constexpr std::array<std::string_view, 3> biharmonic_words{"as_scheme", "adjoint", "literal"};
constexpr std::array<std::string_view, 2> switch_words{"on", "off"};
constexpr std::array<std::string_view, 3> integrator_words{"as_scheme", "verlet", "tvd_rk2"};
constexpr std::array<std::string_view, 3> speed_words{"as_scheme", "shear", "pressure"};
constexpr std::array<std::string_view, 3> filter_words{"as_scheme", "on", "off"};
constexpr std::array<std::string_view, 2> support_words{"direct", "multipliers"};

constexpr std::array choices{
    Choice{"variables",
           "pF: momentum and deformation gradient; displacement: classical total-Lagrangian SPH, no stabilisation",
           variable_words},
    Choice{"scheme",
           "filtered: no locking, smooth pressure, one right-hand side per step; robust: compact gradient, dissipative "
           "biharmonic, Runge-Kutta; paper: the supports and operators as printed",
           scheme_words},
    Choice{"kernel", "smoothing kernel", kernel_words},
    Choice{"biharmonic", "adjoint: -L*(eps4 c h^3 L p), never feeds energy; literal: -eps4 c h^3 L(L p), eq. 37b",
           biharmonic_words},
    Choice{"integrator", "verlet: kick, drift, kick; tvd_rk2: two stages, eq. 43", integrator_words},
    Choice{"stabilisation_speed",
           "wave speed in the stabilisation: shear: that of shear-type modes; pressure: c_p, eqs. 36-37", speed_words},
    Choice{"volumetric_filter", "filter the volumetric energy: as_scheme: for Poisson's ratios from 0.45 on",
           filter_words},
    Choice{"supports",
           "direct: supported particles get the prescribed velocity; multipliers: the velocity that the kernel "
           "interpolates there gets it, too, by Lagrange multipliers (Appendix B)",
           support_words},
    Choice{"angular_momentum_projection", "projection of internal force and stabilisation, eqs. 45-49", switch_words}};

constexpr std::array parameters{
    Parameter{"eps2_momentum", "1", "harmonic stabilisation of the momentum, eq. 36", not_negative, 0.0},
    Parameter{"eps4_momentum", "1", "biharmonic stabilisation of the momentum, eq. 37; 0 for displacement variables",
              not_negative, 0.125},
    Parameter{"gradient_support", "1", "smoothing length of the gradient in particle spacings (robust 0.8, paper 1.2)",
              Interval{0.5, 3, true, false}, no_default},
    Parameter{"filter_passes", "1", "passes of the volumetric filter and of its adjoint: 2, or 3 for smoother pressure",
              Interval{1, 8, false, false}, 2.0},
    Parameter{"laplacian_support", "1", "smoothing length of the Laplacian in particle spacings (1.2)",
              Interval{0.5, 3, true, false}, no_default}};

constexpr std::array<std::string_view, 2> usable_laws{"linear_elastic", "neo_hookean"};

std::string_view word(FormulationSpec const& spec, std::string_view name) {
  auto const given = spec.words.find(name);
  if (given != spec.words.end()) return given->second;
  for (auto const& choice : choices)
    if (choice.name == name) return choice.allowed.front();
  return {};
}

double number(FormulationSpec const& spec, std::string_view name, double otherwise) {
  auto const given = spec.numbers.find(name);
  return given != spec.numbers.end() ? given->second : otherwise;
}

}  // namespace

FormulationInfo info() {
  return {"jst_sph",
          "total-Lagrangian SPH of first-order conservation laws with Jameson-Schmidt-Turkel stabilisation "
          "(Lee, Gil, Greto, Kulasegaram, Bonet 2016)",
          parameters, choices, usable_laws};
}

namespace {

/// The word given for `name`, or what the scheme takes.
std::string_view chosen(FormulationSpec const& spec, std::string_view name, std::string_view by_scheme) {
  auto const given = word(spec, name);
  return given == "as_scheme" ? by_scheme : given;
}

void check(Options const& o) {
  if (o.kernel == nullptr) throw InputError("formulation: the kernel is not known");
  if (o.biharmonic != Biharmonic::none && o.laplacian_support < o.gradient_support)
    throw InputError(
        fmt::format("formulation: laplacian_support = {} is smaller than gradient_support = {} (the Laplacian must "
                    "reach at least as "
                    "far as the gradient) - raise laplacian_support or lower gradient_support",
                    o.laplacian_support, o.gradient_support));
  if (o.filter && o.integrator != Integrator::verlet)
    throw InputError(
        "formulation: volumetric_filter = \"on\" needs integrator = \"verlet\" - switch the filter off or take the "
        "other integrator");
}

}  // namespace

Options read_options(FormulationSpec const& spec, MaterialParameters const& material, double cfl) {
  Options o;
  auto const scheme = word(spec, "scheme");
  bool const paper = scheme == "paper", filtered = scheme == "filtered";
  bool const displacement = word(spec, "variables") == "displacement";
  o.variables = displacement ? Variables::displacement : Variables::momentum_and_deformation;
  o.kernel = find_kernel(word(spec, "kernel"));
  o.eps2 = displacement ? 0 : number(spec, "eps2_momentum", 0);
  o.eps4 = displacement ? 0 : number(spec, "eps4_momentum", 0.125);
  o.gradient_support = number(spec, "gradient_support", paper ? 1.2 : 0.8);
  o.laplacian_support = number(spec, "laplacian_support", 1.2);
  o.multipliers = word(spec, "supports") == "multipliers";
  o.project = word(spec, "angular_momentum_projection") == "on" && !displacement;
  bool const verlet = !displacement && chosen(spec, "integrator", filtered ? "verlet" : "tvd_rk2") == "verlet";
  o.integrator = verlet ? Integrator::verlet : Integrator::tvd_rk2;
  o.shear_speed = chosen(spec, "stabilisation_speed", filtered ? "shear" : "pressure") == "shear";
  bool literal = chosen(spec, "biharmonic", paper ? "literal" : "adjoint") == "literal";
  bool const stabilised = o.eps2 > 0 || o.eps4 > 0;
  o.biharmonic = !stabilised ? Biharmonic::none : literal ? Biharmonic::literal : Biharmonic::adjoint;
  // From Poisson's ratio 0.45 on: kappa / mu = 2 (1 + nu) / (3 (1 - 2 nu)).
  constexpr double nearly_incompressible = 9.666;
  double ratio = 0;
  with_law(material, [&](auto const& law) { ratio = law.kappa / law.mu; });
  bool const by_scheme = filtered && verlet && ratio > nearly_incompressible;
  o.filter = chosen(spec, "volumetric_filter", by_scheme ? "on" : "off") == "on";
  o.filter_passes = static_cast<int>(number(spec, "filter_passes", 2));
  o.cfl = !std::isnan(cfl) ? cfl : verlet ? 0 : 0.3;
  check(o);
  return o;
}

}  // namespace piola::jst_sph
