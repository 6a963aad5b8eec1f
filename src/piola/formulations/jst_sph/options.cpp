// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/common/supported_laws.hpp"
#include "piola/kernels/list.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

constexpr std::array<std::string_view, 4> variable_words{"pF", "pFJ", "pFHJ", "displacement"};
constexpr std::array<std::string_view, 3> gradient_words{"corrected", "uncorrected", "corrected_kernel"};
constexpr std::array<std::string_view, 4> force_words{"as_gradient", "corrected", "uncorrected", "corrected_kernel"};
constexpr std::array<std::string_view, 2> wave_speed_words{"estimate", "exact"};
constexpr std::array<std::string_view, 4> scheme_words{"conservative", "filtered", "robust", "paper"};
constexpr std::array<std::string_view, 3> biharmonic_words{"as_scheme", "adjoint", "literal"};
constexpr std::array<std::string_view, 2> switch_words{"on", "off"};
constexpr std::array<std::string_view, 3> integrator_words{"as_scheme", "verlet", "tvd_rk2"};
constexpr std::array<std::string_view, 3> speed_words{"as_scheme", "shear", "pressure"};
constexpr std::array<std::string_view, 3> filter_words{"as_scheme", "on", "off"};
constexpr std::array<std::string_view, 2> support_words{"direct", "multipliers"};

constexpr std::array choices{
    Choice{"variables",
           "pF: momentum and deformation gradient; pFJ: and the volume ratio; pFHJ: and the area map; displacement: "
           "classical total-Lagrangian SPH, no stabilisation",
           variable_words},
    Choice{"scheme",
           "conservative: an hourglass energy in place of dissipation, no locking, one right-hand side per step; "
           "filtered: the same with biharmonic dissipation; robust: compact gradient, dissipative "
           "biharmonic, Runge-Kutta; paper: the supports and operators as printed",
           scheme_words},
    Choice{"kernel", "smoothing kernel; support 2h, quartic_spline 2.5h, quintic_spline 3h", Kernels::names},
    Choice{"biharmonic", "adjoint: -L*(eps4 c h^3 L p), never feeds energy; literal: -eps4 c h^3 L(L p), eq. 37b",
           biharmonic_words},
    Choice{"integrator", "verlet: kick, drift, kick; tvd_rk2: two stages, eq. 43", integrator_words},
    Choice{"stabilisation_speed",
           "wave speed in the stabilisation: shear: that of shear-type modes; pressure: c_p, eqs. 36-37", speed_words},
    Choice{"volumetric_filter",
           "filter the volumetric energy: as_scheme: for Poisson's ratios from 0.45 on, with laws whose energy is an "
           "isochoric part plus kappa/2 (J - 1)^2",
           filter_words},
    Choice{"gradient",
           "corrected: eq. 21; uncorrected: eq. 22; corrected_kernel: corrected gradient of the corrected kernel, eq. "
           "23; the last two need tvd_rk2",
           gradient_words},
    Choice{"internal_force",
           "the form that balances power with a gradient: corrected: eq. 29c; uncorrected: eq. 30; corrected_kernel: "
           "eq. 31",
           force_words},
    Choice{"wave_speed",
           "estimate: c_p at rest over the smallest stretch; exact: from the law's tangent in the "
           "principal directions, always so for laws without an isochoric part of their energy",
           wave_speed_words},
    Choice{"supports",
           "direct: supported particles get the prescribed velocity; multipliers: the velocity that the kernel "
           "interpolates there gets it, too, by Lagrange multipliers (Appendix B)",
           support_words},
    Choice{"angular_momentum_projection", "projection of internal force and stabilisation, eqs. 45-49", switch_words}};

constexpr std::array parameters{
    Parameter{"eps2_momentum", "1", "harmonic stabilisation of the momentum, eq. 36", not_negative, 0.0},
    Parameter{"eps4_momentum", "1", "biharmonic stabilisation of the momentum, eq. 37; 0 for displacement variables",
              not_negative, no_default, "0 with scheme = \"conservative\", else and for solids in rate form 0.125"},
    Parameter{"hourglass_stiffness", "1",
              "stiffness against motions that gradients do not see, over that of a lattice of springs; "
              "scheme = \"conservative\"",
              not_negative, no_default,
              "0.5 (jittered or random particles: 10) with scheme = \"conservative\", but for solids in rate form"},
    Parameter{"hourglass_stiffening", "1", "its growth with the energy of the change of shape over the shear modulus",
              not_negative, no_default, "3 with scheme = \"conservative\", but for solids in rate form"},
    Parameter{"hourglass_viscosity", "1",
              "damping of such motions: time in which a shear-type wave runs so many spacings",
              Interval{0, 10, false, false}, no_default, "1 where there is such a stiffness"},
    Parameter{"bulk_viscosity", "1",
              "damping of volume changes in the filter: time in which a pressure wave runs so many spacings",
              Interval{0, 1, false, false}, no_default, "0.06 with scheme = \"conservative\""},
    Parameter{"local_bulk", "1",
              "bulk modulus that the filter leaves to the local volume ratio, over the shear modulus",
              Interval{0, 100, true, false}, 1.0},
    Parameter{"eps2_volume", "1", "harmonic stabilisation of the volume ratio (pFJ, pFHJ)", not_negative, 0.0},
    Parameter{"eps4_volume", "1", "biharmonic stabilisation of the volume ratio (pFJ, pFHJ), eq. 38", not_negative,
              0.0},
    Parameter{"gradient_support", "1", "smoothing length of the gradient in particle spacings",
              Interval{0.5, 3, true, false}, no_default,
              "0.8; jittered or random particles with scheme = \"conservative\" 1; scheme = \"paper\" 1.2"},
    Parameter{"filter_passes", "1", "passes of the volumetric filter and of its adjoint: 2, or 3 for smoother pressure",
              Interval{1, 8, false, false}, 2.0},
    Parameter{"laplacian_support", "1", "smoothing length of the Laplacian in particle spacings",
              Interval{0.5, 3, true, false}, no_default, "1.2"}};

/// Columns of Diagnostics::more (observe.cpp): det F minus the volume ratio of the volumetric energy; the energy
/// balance of solids in rate form, whose internal energy is the strain energy; the hourglass energy, a part of that.
constexpr std::array diagnostics{DiagnosticInfo{"volume_mismatch_rms", "1"}, DiagnosticInfo{"volume_mismatch_max", "1"},
                                 DiagnosticInfo{"plastic_work", "J"}, DiagnosticInfo{"internal_energy", "J"},
                                 DiagnosticInfo{"hourglass_energy", "J"}};

std::string_view word(FormulationSpec const& spec, std::string_view name) { return word_of(spec, choices, name); }

}  // namespace

FormulationInfo info() {
  FormulationInfo info{
      "jst_sph",
      "total-Lagrangian SPH of first-order conservation laws with Jameson-Schmidt-Turkel stabilisation "
      "(Lee, Gil, Greto, Kulasegaram, Bonet 2016)",
      parameters,
      choices,
      total_lagrangian_laws,
      diagnostics};
  info.cell_volumes = true;
  info.can_be_coupled = true;
  info.observes_locally = true;
  return info;
}

namespace {

/// The word given for `name`, or the default of the scheme.
std::string_view chosen(FormulationSpec const& spec, std::string_view name, std::string_view by_scheme) {
  auto const given = word(spec, name);
  return given == "as_scheme" ? by_scheme : given;
}

/// Checks settings that the conservative scheme requires or excludes.
void check_hourglass(Options const& o, bool conservative) {
  if (!conservative && (o.hourglass() || o.hourglass_viscosity > 0 || o.bulk_viscosity > 0))
    throw InputError(
        "formulation: hourglass_stiffness, hourglass_stiffening, hourglass_viscosity and bulk_viscosity belong to "
        "scheme = \"conservative\" - leave them out or take that scheme");
  if (conservative && o.integrator != Integrator::verlet)
    throw InputError(
        "formulation: scheme = \"conservative\" needs integrator = \"verlet\" - leave integrator out, or take scheme = "
        "\"robust\"");
  if (o.hourglass() && o.eps2 > 0)
    throw InputError(
        "formulation: eps2_momentum does not go together with scheme = \"conservative\" - set it to 0 or take another "
        "scheme");
}

void check(Options const& o) {
  if (o.kernel == nullptr) throw InputError("formulation: the kernel is not known");
  if (o.biharmonic != Biharmonic::none && o.laplacian_support < o.gradient_support)
    throw InputError(
        fmt::format("formulation: laplacian_support = {} is smaller than gradient_support = {} (the Laplacian must "
                    "reach at least as "
                    "far as the gradient) - raise laplacian_support or lower gradient_support",
                    o.laplacian_support, o.gradient_support));
  bool const verlet = o.integrator == Integrator::verlet;
  bool const volume = evolves_volume(o.variables);
  if (o.filter && !verlet && volume)
    throw InputError(
        "formulation: volumetric_filter = \"on\" with variables = \"pFJ\" or \"pFHJ\" needs integrator = \"verlet\" - "
        "switch the filter off, take the other integrator, or variables = \"pF\"");
  if (o.smoothed_volume() && !volume)
    throw InputError(
        "formulation: eps2_volume and eps4_volume stabilise an evolved volume ratio (variables = \"pFJ\" or \"pFHJ\") "
        "- set them to 0 or choose these variables");
  if (o.smoothed_volume() && (verlet || o.filter || o.shear_speed))
    throw InputError(
        "formulation: eps2_volume and eps4_volume belong to the printed scheme (integrator = \"tvd_rk2\", "
        "stabilisation_speed = \"pressure\", no volumetric filter) - set them to 0 or choose scheme = \"paper\" or "
        "\"robust\"");
  if (o.smoothed_volume() && o.biharmonic == Biharmonic::none)
    throw InputError(
        "formulation: eps2_volume and eps4_volume need a stabilised momentum - set eps2_momentum or eps4_momentum");
  bool const usual = o.gradient == GradientForm::corrected && o.force == GradientForm::corrected;
  if (verlet && !usual)
    throw InputError(
        "formulation: gradient and internal_force other than \"corrected\" need integrator = \"tvd_rk2\" - choose "
        "scheme = \"paper\" or \"robust\", or that integrator");
  if (o.corrected_kernel() && o.gradient_support != o.laplacian_support)
    throw InputError(fmt::format(
        "formulation: \"corrected_kernel\" needs one support for gradient and Laplacian (gradient_support = {}, "
        "laplacian_support = {}) - set both to the same value",
        o.gradient_support, o.laplacian_support));
}

/// Rejects a volumetric filter for a law whose energy has no volumetric part of its own.
void check_filter(Options const& o, MaterialParameters const& material) {
  LawInfo const* law = nullptr;
  std::vector<std::string> able;
  for (auto const& known : laws()) {
    if (known.index == material.law) law = &known;
    if (known.volumetric_split) able.emplace_back(known.name);
  }
  if (!o.filter || law == nullptr || law->volumetric_split) return;
  throw InputError(fmt::format(
      "formulation: volumetric_filter = \"on\" needs a law whose energy is an isochoric part plus kappa/2 (J - 1)^2, "
      "and {} is none - leave volumetric_filter out or choose one of the laws {}",
      law->name, joined(able)));
}

/// Solids in rate form carry their stress from the last step's deformation gradient on: {p,F} alone.
void check_solid(Options const& o, MaterialParameters const& material) {
  if (is_explosive(material))
    throw InputError(
        "material: eos = \"jwl\" is an explosive (allowed here: the other words of eos) - take the "
        "formulation adaptle");
  if (!is_hypoelastic(material) || o.variables == Variables::pF) return;
  throw InputError(fmt::format(
      "formulation: variables other than \"pF\" need a hyperelastic law, and {} is a solid in rate form - leave "
      "variables out or take a hyperelastic law",
      laws()[static_cast<std::size_t>(material.law)].name));
}

}  // namespace

Options read_options(FormulationSpec const& spec, MaterialParameters const& material, double cfl, bool regular) {
  Options o;
  auto const scheme = word(spec, "scheme");
  bool const displacement = word(spec, "variables") == "displacement";
  bool const conservative = scheme == "conservative" && !displacement;
  // Solids in rate form keep the biharmonic term: an energy of the whole deformation would also resist plastic flow.
  bool const hourglass = conservative && !is_hypoelastic(material);
  bool const paper = scheme == "paper", filtered = scheme == "filtered" || scheme == "conservative";
  o.variables = choice_of<Variables>(spec, choices, "variables");
  o.gradient = choice_of<GradientForm>(spec, choices, "gradient");
  o.force = o.gradient;
  for (std::size_t k = 0; k < gradient_words.size(); ++k)
    if (word(spec, "internal_force") == gradient_words[k]) o.force = static_cast<GradientForm>(k);
  o.eps2_J = number_of(spec, "eps2_volume", 0);
  o.eps4_J = number_of(spec, "eps4_volume", 0);
  o.kernel = find_kernel(word(spec, "kernel"));
  o.eps2 = displacement ? 0 : number_of(spec, "eps2_momentum", 0);
  o.eps4 = displacement ? 0 : number_of(spec, "eps4_momentum", hourglass ? 0 : 0.125);
  o.hourglass_stiffness = number_of(spec, "hourglass_stiffness", !hourglass ? 0 : regular ? 0.5 : 10);
  o.hourglass_stiffening = number_of(spec, "hourglass_stiffening", hourglass ? 3 : 0);
  o.hourglass_viscosity = number_of(spec, "hourglass_viscosity", o.hourglass() ? 1 : 0);
  o.bulk_viscosity = number_of(spec, "bulk_viscosity", hourglass ? 0.06 : 0);
  o.local_bulk = number_of(spec, "local_bulk", 1);
  o.gradient_support = number_of(spec, "gradient_support", paper ? 1.2 : hourglass && !regular ? 1 : 0.8);
  o.laplacian_support = number_of(spec, "laplacian_support", 1.2);
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
  bool split = false;
  with_any_law(material, [&](auto const& law) { ratio = law.kappa / law.mu; });
  with_law(material, [&](auto const& law) { split = law.volumetric_split; });
  bool const by_scheme = filtered && !displacement && split && ratio > nearly_incompressible;
  // The estimate c_p0 / lambda_min is a bound for nearly incompressible solids, not for laws that stiffen in tension.
  o.exact_speed = word(spec, "wave_speed") == "exact" || !split;
  o.filter = chosen(spec, "volumetric_filter", by_scheme ? "on" : "off") == "on";
  o.filter_passes = static_cast<int>(number_of(spec, "filter_passes", 2));
  o.cfl = !std::isnan(cfl) ? cfl : verlet ? 0 : 0.3;
  check_hourglass(o, conservative);
  check(o);
  check_filter(o, material);
  check_solid(o, material);
  return o;
}

}  // namespace piola::jst_sph
