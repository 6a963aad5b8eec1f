// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/base/problems.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

constexpr std::array<std::string_view, 2> variable_words{"pF", "displacement"};
constexpr std::array<std::string_view, 2> scheme_words{"robust", "paper"};
constexpr std::array<std::string_view, 1> kernel_words{"cubic_spline"};
constexpr std::array<std::string_view, 3> biharmonic_words{"as_scheme", "adjoint", "literal"};
constexpr std::array<std::string_view, 2> switch_words{"on", "off"};

constexpr std::array choices{
    Choice{"variables", "pF: momentum and deformation gradient; displacement: classical total-Lagrangian SPH, no stabilisation",
           variable_words},
    Choice{"scheme", "robust: compact gradient, dissipative biharmonic; paper: the supports and operators as printed",
           scheme_words},
    Choice{"kernel", "smoothing kernel", kernel_words},
    Choice{"biharmonic", "adjoint: -L*(eps4 c h^3 L p), never feeds energy; literal: -eps4 c h^3 L(L p), eq. 37b",
           biharmonic_words},
    Choice{"angular_momentum_projection", "projection of internal force and stabilisation, eqs. 45-49", switch_words}};

constexpr std::array parameters{
    Parameter{"eps2_momentum", "1", "harmonic stabilisation of the momentum, eq. 36", not_negative, 0.0},
    Parameter{"eps4_momentum", "1", "biharmonic stabilisation of the momentum, eq. 37; 0 for displacement variables",
              not_negative, 0.125},
    Parameter{"gradient_support", "1", "smoothing length of the gradient in particle spacings (robust 0.8, paper 1.2)",
              Interval{0.5, 3, true, false}, no_default},
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

Options read_options(FormulationSpec const& spec, double cfl) {
  Options o;
  bool const paper = word(spec, "scheme") == "paper";
  bool const displacement = word(spec, "variables") == "displacement";
  o.variables = displacement ? Variables::displacement : Variables::momentum_and_deformation;
  o.kernel = find_kernel(word(spec, "kernel"));
  o.eps2 = displacement ? 0 : number(spec, "eps2_momentum", 0);
  o.eps4 = displacement ? 0 : number(spec, "eps4_momentum", 0.125);
  o.gradient_support = number(spec, "gradient_support", paper ? 1.2 : 0.8);
  o.laplacian_support = number(spec, "laplacian_support", 1.2);
  o.project = word(spec, "angular_momentum_projection") == "on" && !displacement;
  auto const form = word(spec, "biharmonic");
  bool const literal = form == "literal" || (form == "as_scheme" && paper);
  bool const stabilised = o.eps2 > 0 || o.eps4 > 0;
  o.biharmonic = !stabilised ? Biharmonic::none : literal ? Biharmonic::literal : Biharmonic::adjoint;
  o.cfl = std::isnan(cfl) ? 0.3 : cfl;
  if (o.kernel == nullptr) throw InputError(fmt::format("formulation: no kernel is named '{}'", word(spec, "kernel")));
  if (stabilised && o.laplacian_support < o.gradient_support)
    throw InputError(fmt::format(
        "formulation: laplacian_support = {} is smaller than gradient_support = {} (the Laplacian must reach at least as "
        "far as the gradient) - raise laplacian_support or lower gradient_support",
        o.laplacian_support, o.gradient_support));
  return o;
}

}  // namespace piola::jst_sph
