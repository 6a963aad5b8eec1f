// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_advection/options.hpp"
#include <array>
#include <cmath>

namespace piola::jst_advection {
namespace {

constexpr std::array parameters{
    Parameter{"wave_speed", "m/s", "speed c with which the velocity is carried along", positive, 1.0},
    Parameter{"eps4_momentum", "1", "biharmonic stabilisation, eq. C.2", not_negative, 0.125}};

constexpr std::array<std::string_view, 1> usable_laws{"linear_elastic"};  // only the density is used

constexpr std::array diagnostics{DiagnosticInfo{"dispersion", "1"}, DiagnosticInfo{"diffusion", "1"},
                                 DiagnosticInfo{"amplitude", "1"}};

}  // namespace

FormulationInfo info() {
  FormulationInfo info{
      "jst_advection",
      "one velocity carried along a periodic row of particles with Jameson-Schmidt-Turkel stabilisation: the model "
      "equation of Lee, Gil, Greto, Kulasegaram, Bonet 2016, Appendix C",
      parameters,
      {},
      usable_laws,
      diagnostics};
  info.off_lattice = false;
  info.mirrors = false;  // a periodic row has no faces
  return info;
}

Options read_options(FormulationSpec const& spec, double cfl) {
  Options const usual;
  return {number_of(spec, "wave_speed", usual.wave_speed), number_of(spec, "eps4_momentum", usual.eps4),
          std::isnan(cfl) ? usual.cfl : cfl};
}

}  // namespace piola::jst_advection
