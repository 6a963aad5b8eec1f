// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/base/errors.hpp"
#include "piola/kernels/list.hpp"
#include "piola/materials/laws.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::jst_sph {
namespace {

/// Hyperelastic laws.
std::span<std::string_view const> usable_laws() {
  static auto const usable = laws_that([](LawInfo const& law) { return !law.hypoelastic && law.block == nullptr; });
  return usable;
}

constexpr std::array<std::string_view, 4> variable_words{"pF", "pFJ", "pFHJ", "displacement"};
constexpr std::array<std::string_view, 2> scheme_words{"filtered", "paper"};
constexpr std::array<std::string_view, 2> switch_words{"on", "off"};
constexpr std::array<std::string_view, 2> support_words{"direct", "multipliers"};

constexpr std::array choices{
    Choice{"scheme",
           "filtered: stabilisation with the speed of shear waves, filtered volumetric energy from Poisson's ratio "
           "0.45 on, velocity Verlet; paper: operators and Runge-Kutta steps as published, with a kernel and supports "
           "that the paper does not print",
           scheme_words},
    Choice{"variables",
           "pF: momentum and deformation gradient; with scheme = \"paper\" also pFJ: and the volume ratio, pFHJ: and "
           "the area map; displacement: classical total-Lagrangian SPH, no stabilisation",
           variable_words},
    Choice{"kernel", "smoothing kernel; support 2h, quartic_spline 2.5h, quintic_spline 3h", Kernels::names},
    Choice{"supports",
           "direct: supported particles get the prescribed velocity; multipliers: the velocity that the kernel "
           "interpolates there gets it, too, by Lagrange multipliers (Appendix B)",
           support_words},
    Choice{"angular_momentum_projection", "projection of internal force and stabilisation, eqs. 45-49", switch_words}};

constexpr std::array parameters{
    Parameter{"eps2_momentum", "1", "harmonic stabilisation of the momentum, eq. 36", not_negative, 0.0},
    Parameter{"eps4_momentum", "1", "biharmonic stabilisation of the momentum, eq. 37", not_negative, 0.125},
    Parameter{"eps2_volume", "1", "harmonic stabilisation of the volume ratio (pFJ, pFHJ)", not_negative, 0.0},
    Parameter{"eps4_volume", "1", "biharmonic stabilisation of the volume ratio (pFJ, pFHJ), eq. 38", not_negative,
              0.0},
    Parameter{"gradient_support", "1", "smoothing length of the gradient in particle spacings",
              Interval{0.5, 3, true, false}, no_default, "0.8; scheme = \"paper\" 1.2"},
    Parameter{"laplacian_support", "1", "smoothing length of the Laplacian in particle spacings",
              Interval{0.5, 3, true, false}, 1.2}};

constexpr std::string_view take_nodal = "take the formulation nodal", of_scheme = "leave it out, the scheme sets it",
                           no_hourglass = "leave it out; the formulation nodal has no hourglass modes";

/// Keys and words of earlier versions.
constexpr std::array removed{
    RemovedSetting{"scheme", "conservative", take_nodal},
    RemovedSetting{"scheme", "robust", "take scheme = \"filtered\", or the formulation nodal"},
    RemovedSetting{"hourglass_stiffness", "", no_hourglass},
    RemovedSetting{"hourglass_stiffening", "", no_hourglass},
    RemovedSetting{"hourglass_viscosity", "", no_hourglass},
    RemovedSetting{"bulk_viscosity", "", no_hourglass},
    RemovedSetting{"biharmonic", "", of_scheme},
    RemovedSetting{"integrator", "", of_scheme},
    RemovedSetting{"stabilisation_speed", "", of_scheme},
    RemovedSetting{"volumetric_filter", "", of_scheme},
    RemovedSetting{"filter_passes", "", of_scheme},
    RemovedSetting{"local_bulk", "", of_scheme},
    RemovedSetting{"wave_speed", "", "leave it out, the law sets it"},
    RemovedSetting{"gradient", "", "leave it out, gradients are corrected (eq. 21)"},
    RemovedSetting{"internal_force", "", "leave it out, the internal force is that of eq. 29c"}};

/// Columns of Diagnostics::more (observe.cpp): det F minus the volume ratio of the volumetric energy.
constexpr std::array diagnostics{DiagnosticInfo{"volume_mismatch_rms", "1"},
                                 DiagnosticInfo{"volume_mismatch_max", "1"}};

std::string_view word(FormulationSpec const& spec, std::string_view name) { return word_of(spec, choices, name); }

}  // namespace

FormulationInfo info() {
  FormulationInfo info{
      "jst_sph",
      "total-Lagrangian SPH of first-order conservation laws with Jameson-Schmidt-Turkel stabilisation "
      "(Lee, Gil, Greto, Kulasegaram, Bonet 2016)",
      parameters,
      choices,
      usable_laws(),
      diagnostics};
  info.cell_volumes = true;
  info.can_be_coupled = true;
  info.removed = removed;
  return info;
}

namespace {

void check(Options const& o, bool paper) {
  if (o.kernel == nullptr) throw InputError("formulation: the kernel is not known");
  if (o.biharmonic != Biharmonic::none && o.laplacian_support < o.gradient_support)
    throw InputError(
        fmt::format("formulation: laplacian_support = {} is smaller than gradient_support = {} (the Laplacian must "
                    "reach at least as far as the gradient) - raise laplacian_support or lower gradient_support",
                    o.laplacian_support, o.gradient_support));
  bool const volume = evolves_volume(o.variables);
  if (volume && !paper)
    throw InputError(
        "formulation: variables = \"pFJ\" and \"pFHJ\" need scheme = \"paper\" (with \"filtered\" they would give the "
        "motion of \"pF\") - leave variables out or take that scheme");
  if (o.smoothed_volume() && !volume)
    throw InputError(
        "formulation: eps2_volume and eps4_volume stabilise an evolved volume ratio (variables = \"pFJ\" or \"pFHJ\") "
        "- set them to 0 or choose these variables");
}

}  // namespace

Options read_options(FormulationSpec const& spec, MaterialParameters const& material, double cfl) {
  Options o;
  bool const paper = word(spec, "scheme") == "paper";
  o.variables = choice_of<Variables>(spec, choices, "variables");
  bool const displacement = o.variables == Variables::displacement;
  o.kernel = find_kernel(word(spec, "kernel"));
  o.eps2 = displacement ? 0 : number_of(spec, "eps2_momentum", 0);
  o.eps4 = displacement ? 0 : number_of(spec, "eps4_momentum", 0.125);
  o.eps2_J = number_of(spec, "eps2_volume", 0);
  o.eps4_J = number_of(spec, "eps4_volume", 0);
  o.gradient_support = number_of(spec, "gradient_support", paper ? 1.2 : 0.8);
  o.laplacian_support = number_of(spec, "laplacian_support", 1.2);
  o.multipliers = word(spec, "supports") == "multipliers";
  o.project = word(spec, "angular_momentum_projection") == "on" && !displacement;
  bool const verlet = !displacement && !paper;
  o.integrator = verlet ? Integrator::verlet : Integrator::tvd_rk2;
  o.biharmonic = displacement ? Biharmonic::none : paper ? Biharmonic::literal : Biharmonic::adjoint;
  bool known = false;
  with_law(material, [&](auto const& law) {
    known = true;
    // From Poisson's ratio 0.45 on: kappa / mu = 2 (1 + nu) / (3 (1 - 2 nu)).
    constexpr double nearly_incompressible = 9.666;
    o.filter = verlet && law.volumetric_split && law.kappa / law.mu > nearly_incompressible;
    // The estimate c_p0 / lambda_min is a bound for nearly incompressible solids, not for laws that stiffen in tension.
    o.exact_speed = !law.volumetric_split;
  });
  if (!known) throw InputError("material: jst_sph has hyperelastic laws alone - take the formulation nodal");
  o.cfl = !std::isnan(cfl) ? cfl : verlet ? 0 : 0.3;
  check(o, paper);
  return o;
}

}  // namespace piola::jst_sph
