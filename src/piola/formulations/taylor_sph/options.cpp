// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/options.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/kernels/list.hpp"
#include "piola/materials/registry.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::taylor_sph {
namespace {

constexpr std::array<std::string_view, 2> configuration_words{"updated", "fixed"};
constexpr std::array<std::string_view, 3> exchange_words{"as_configuration", "adjoint", "kernel_sums"};
constexpr std::array<std::string_view, 5> assumption_words{"as_dimension", "plane_strain", "plane_stress",
                                                           "uniaxial_stress", "uniaxial_strain"};
constexpr std::array<std::string_view, 3> virtual_words{"as_configuration", "delaunay", "lattice_cells"};
constexpr std::array<std::string_view, 2> gradient_words{"linear_exact", "published"};

constexpr std::array<std::string_view, 2> switch_words{"on", "off"};

constexpr std::array choices{
    Choice{"configuration",
           "updated: updated Lagrangian, everything in the current configuration; fixed: that of the start, "
           "geometrically linear, exact transport at Courant number 1",
           configuration_words},
    Choice{"exchange",
           "between real and virtual particles; adjoint: forces by the transpose of the cells' gradients, momenta and "
           "energy balance on any set; kernel_sums: as in the paper; as_configuration: updated: adjoint, fixed: "
           "kernel_sums",
           exchange_words},
    Choice{"assumption",
           "about the directions that a body does not have; as_dimension: 1D uniaxial_stress (a bar), 2D plane_strain",
           assumption_words},
    Choice{
        "virtual_particles",
        "where values of half time live; delaunay: centroids of triangles (tetrahedra, in 1D midpoints), with "
        "alternating diagonals on a lattice; lattice_cells: the middle of each box of the lattice; as_configuration: "
        "delaunay, but with kernel_sums in the updated configuration lattice_cells where the body is a whole box of "
        "particles",
        virtual_words},
    Choice{"gradient",
           "of kernel_sums; linear_exact: about the centroid of the weights, linear fields exactly on any set; "
           "published: eqs. 19, 20",
           gradient_words},
    Choice{"kernel", "smoothing kernel of kernel_sums, support 2h", LaneKernels::names},
    Choice{"momentum_projection",
           "kernel_sums in the updated configuration, bodies without supports: linear and angular momentum change by "
           "the loads alone, by a rigid motion added after each step",
           switch_words}};

constexpr std::array parameters{
    Parameter{"smoothing_length", "1",
              "h of kernel_sums in spacings of real particles; it follows the cells as they deform",
              Interval{0.3, 3, false, false}, no_default,
              "1D 0.6; fixed: simplices 0.9, lattice cells 0.6; updated: triangles 1.1, else 0.9"},
    Parameter{"hourglass_filter", "1",
              "share of the checkerboard pattern of velocity that each step takes away, as Flanagan and Belytschko's "
              "hourglass vectors measure it; 0: none",
              Interval{0, 1, false, false}, no_default, "kernel_sums: updated 0.3, else 0; 1D 0"},
    Parameter{
        "stress_retention", "1",
        "adjoint: fraction of a cell's own stress in what acts on its corners, the rest is the mean of theirs; 0: "
        "virtual particles live half a step as in the paper; 1: none of the paper's damping, triangles of "
        "constant strain",
        Interval{0, 1, false, false}, 0.2},
    Parameter{"hourglass_stiffness", "1",
              "adjoint, lattice_cells: elastic resistance to the checkerboard pattern of the boxes, in shares of the "
              "wave modulus",
              Interval{0, 1, false, false}, 0.05}};

/// Hyperelastic laws that give their stress rate.
std::span<std::string_view const> usable_laws() {
  static auto const usable = laws_that([](LawInfo const& law) { return law.elastic_rate; });
  return usable;
}

constexpr std::array diagnostics{DiagnosticInfo{"list_updates", "1"}, DiagnosticInfo{"triangulations", "1"},
                                 DiagnosticInfo{"centred_energy", "J"}, DiagnosticInfo{"strain_drift", "1"}};

std::string_view word(FormulationSpec const& spec, std::string_view name) { return word_of(spec, choices, name); }

}  // namespace

FormulationInfo info() {
  FormulationInfo info{
      "taylor_sph",
      "updated-Lagrangian SPH of stress and velocity on two sets of particles, two-step Taylor in time "
      "(Serroukh, Mabssout 2022)",
      parameters,
      choices,
      usable_laws(),
      diagnostics};
  info.cracks = true;
  info.mirrors = false;
  info.ranks = false;  // its cells and triangulations cover whole bodies
  info.can_be_coupled = true;
  info.off_lattice = false;  // its hourglass control needs boxes of a lattice
  return info;
}

Options read_options(FormulationSpec const& spec, int dimension, double cfl, bool whole_lattice) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  Problems problems;
  Options o;
  o.moving = word(spec, "configuration") == "updated";
  o.form = choice_of<GradientForm>(spec, choices, "gradient");
  o.kernel = find_kernel(word(spec, "kernel"));
  auto const virtual_particles = word(spec, "virtual_particles");
  auto const exchange = word(spec, "exchange");
  o.adjoint = exchange == "adjoint" || (exchange == "as_configuration" && o.moving);
  bool const by_configuration = virtual_particles == "as_configuration" && o.moving && !o.adjoint && whole_lattice;
  o.lattice_cells = dimension > 1 && (virtual_particles == "lattice_cells" || by_configuration);
  o.stress_free = is_stress_free(word(spec, "assumption"), dimension, dimension == 1, problems);
  // Moving surfaces need more neighbours than small strains do.
  double const of_cells = o.moving ? 0.9 : 0.6, of_simplices = o.moving && dimension == 2 ? 1.1 : 0.9;
  o.smoothing_length = number_of(spec, "smoothing_length",
                                 dimension == 1    ? 0.6
                                 : o.lattice_cells ? of_cells
                                                   : of_simplices);
  o.conserve = word(spec, "momentum_projection") == "on" && !o.adjoint;
  o.hourglass = o.adjoint ? 0 : number_of(spec, "hourglass_filter", o.moving && dimension > 1 ? 0.3 : 0);
  o.stress_retention = number_of(spec, "stress_retention", 0.2);
  o.hourglass_stiffness = o.lattice_cells ? number_of(spec, "hourglass_stiffness", 0.05) : 0;
  o.cfl = std::isnan(cfl) ? (o.adjoint || o.moving || (dimension > 1 && !o.lattice_cells) ? 0.9 : 1.0) : cfl;
  if (o.cfl > 1)
    problems.add({},
                 fmt::format("run.cfl = {} is above 1: two-step Taylor amplifies short waves then and blows up within "
                             "some hundred steps (allowed: up to 1, where waves along a lattice travel exactly one "
                             "spacing per step) - set run.cfl to 1 or less",
                             o.cfl));
  problems.raise_if_any();
  return o;
}

}  // namespace piola::taylor_sph
