// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/nodal/conduction.hpp"
#include "piola/formulations/nodal/constrained_facets.hpp"
#include "piola/formulations/nodal/facet_fluxes.hpp"
#include "piola/formulations/nodal/gradient_check.hpp"
#include "piola/formulations/nodal/gradient_tables.hpp"
#include "piola/formulations/nodal/lattice_masses.hpp"
#include "piola/formulations/nodal/load_integrals.hpp"
#include "piola/formulations/nodal/masses.hpp"
#include "piola/formulations/nodal/refits.hpp"
#include "piola/formulations/nodal/scaled_body.hpp"
#include "piola/formulations/nodal/slits.hpp"
#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace piola::nodal {
namespace {

/// Smallest volume of a cell, relative to a spacing's volume.
constexpr double least_cell = 1e-3;

double since(std::chrono::steady_clock::time_point& start) {
  auto const now = std::chrono::steady_clock::now();
  double const seconds = std::chrono::duration<double>(now - start).count();
  start = now;
  return seconds;
}

[[noreturn]] void refuse(SetUp const& from, Index slot, char const* what) {
  auto const id = from.order.id[static_cast<std::size_t>(slot)];
  auto const& X = from.set.X[static_cast<std::size_t>(id)];
  throw InputError(fmt::format("body '{}': particle {} at ({:.4g}, {:.4g}, {:.4g}) m {}", from.body.name, id, X[0],
                               X[1], X[2], what));
}

/// Cells with volumes in proportion to their masses, in units of the body's own density: transfers between cells are
/// masses, with the moments of all materials together. Empty for a single material.
LazyZeroArray<ScaledCell> heavy_cells(SetUp const& from, LazyZeroArray<ScaledCell> const& light) {
  if (from.rho0.size() == 1) return {};
  LazyZeroArray<ScaledCell> cells = light;
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i].volume *= from.rho0[part_of(from.set, static_cast<std::size_t>(from.order.id[static_cast<std::size_t>(
                                                       from.source_of(static_cast<Index>(i)))]))] /
                       from.rho0.front();
  return cells;
}

/// The lattice of a body for loops, if possible. Lists are needed by follower pressures, which use gradients particle
/// by particle, by images, which are not on the lattice, by axisymmetric bodies, whose cells differ, and where cells
/// may fail.
std::optional<LatticeShape> shape_for_loops(SetUp const& from) {
  bool const follows = std::any_of(from.loads.begin(), from.loads.end(), [](Load const& load) { return load.follows; });
  if (follows || from.failure || from.images != nullptr || from.set.axisymmetric) return std::nullopt;
  return lattice_shape(from.set, from.body, from.order);
}

void refuse_without_cell(SetUp const& from, ScaledBody const& scaled) {
  for (std::size_t i = 0; i < scaled.particles; ++i)
    if (!(scaled.cells[i].volume > least_cell))
      refuse(from, static_cast<Index>(i),
             "has no part of the body to itself - move it into the body, or apart from its neighbours");
}

struct MassOptions {
  std::optional<DistributedSlots> const& shared;
  bool endless;  ///< between two mirror planes
};

/// Exact volume of a packed body over that of its cells, whose curved faces are chords.
double volume_of_chords(SetUp const& from, ScaledBody const& scaled) {
  if (!from.body.off_lattice || !from.body.outline.patches) return 1;
  double exact = 0, cells = 0;
  for (auto id = from.body.first; id < from.body.last; ++id) exact += from.set.volume[static_cast<std::size_t>(id)];
  for (std::size_t a = 0; a < scaled.particles; ++a) cells += scaled.cells[a].volume * scaled.h_volume;
  return exact / cells;
}

template <int D>
LazyZeroArray<double> masses(SetUp const& from, ScaledBody const& scaled, std::optional<LatticeShape> const& shape,
                             MassOptions const& options) {
  auto const heavy = heavy_cells(from, scaled.cells);
  if (heavy.empty() && has_lattice_cells(from.body) && !from.set.axisymmetric)
    if (auto mass = lattice_masses(scaled, D, from.least_mass)) return std::move(*mass);
  auto mass =
      exact_masses<D>(scaled.X, heavy.empty() ? scaled.cells : heavy,
                      {from.least_mass, shape, !has_lattice_cells(from.body) && !options.endless, options.shared});
  double const factor = volume_of_chords(from, scaled);
  for (double& m : mass) m *= factor;
  return mass;
}

template <int D>
void refuse_unsolvable(SetUp const& from, LocalFits<D> const& fits) {
  if (fits.unsolvable() >= 0)
    refuse(from, from.source_of(fits.unsolvable()),
           "has neighbours that determine no quadratic field - use at least three particles across the body in every "
           "direction");
}

/// Whether the body goes on between two planes.
template <int D>
bool is_endless(MirrorImages const* images) {
  bool any = false;
  for (std::size_t axis = 0; images != nullptr && axis < D; ++axis) any = any || images->endless(axis);
  return any;
}

/// Checks, loads, supports and halo from the fits and fluxes of a body.
template <int D>
void use_fits(SetUp const& from, ScaledBody& scaled, LocalFits<D> const& fits, FacetFluxes<D> const& fluxes,
              std::optional<DistributedSlots> const& shared, Reference& r) {
  if (shared) keep_cells(scaled, fits.rows());
  if (shared) r.halo = std::make_unique<HaloPlan>(shared->slots, ghost_neighbours(fits.pairs(), fits.own()));
  SurfaceIntegrals<D> const surface(fits, scaled.patches);
  check_gradients(from, fluxes.measure(surface), r.checks);
  check_surface(from, scaled, r.checks);
  r.parts = load_integrals<D>(from, fits, surface, {scaled.h, r.checks});
  for (auto& parts : r.parts) parts.resize(std::min(parts.size(), scaled.particles));
  bool const is_box = !from.body.outline.inside;
  if (from.contact && is_box) r.face_areas = face_areas<D>(from, surface, scaled.h);
  r.held = constrained_facets<D>(from, fits, scaled.patches, scaled.h);
  r.absorbing = absorbing_facets<D>(from, fits, scaled.patches, scaled.h);
}

template <int D>
void make(SetUp const& from, Reference& r) {
  auto clock = std::chrono::steady_clock::now();
  auto const shape = shape_for_loops(from);
  ScaledBody scaled = body_with_slits(from, from.conducts ? std::nullopt : shape);
  if (from.conducts) r.facets = conducting_facets(from, scaled);
  r.costs.cells = since(clock);
  refuse_without_cell(from, scaled);
  std::optional<DistributedSlots> shared;
  if (from.is_shared()) shared = DistributedSlots{from.order.slots(), from.order.particles};
  // First, because its pairs reach farther than those that are kept.
  auto const mass = masses<D>(from, scaled, shape, {shared, is_endless<D>(from.images)});
  r.costs.masses = since(clock);
  if (from.failure) {
    auto refits = std::make_shared<RefitsOf<D>>(from, std::move(scaled), shared, &lines_across_slits);
    r.refits = refits;
    r.costs.fits = since(clock);
    refuse_unsolvable(from, refits->fits());
    use_fits<D>(from, refits->scaled(), refits->fits(), refits->fluxes(), shared, r);
    r.costs.gradients = since(clock);
    refits->tables(r)(mass, std::nullopt);
    r.costs.tables = since(clock);
    return;
  }
  LocalFits<D> fits(scaled.X, shape, shared, lines_across_slits(from, scaled));
  refuse_unsolvable(from, fits);
  if (shape && !fits.usual()) {
    ScaledBody whole = body_with_slits(from, std::nullopt);
    scaled.facets = std::move(whole.facets);
    scaled.patches = std::move(whole.patches);
  }
  r.costs.fits = since(clock);
  FacetFluxes<D> const fluxes(fits, scaled);
  refuse_unsolvable(from, fits);
  std::vector<CellFacet>().swap(scaled.facets);
  use_fits<D>(from, scaled, fits, fluxes, shared, r);
  r.costs.gradients = since(clock);
  GradientTables<D>(from, scaled, fits, fluxes, r)(mass, fits.usual() ? shape : std::nullopt);
  r.costs.tables = since(clock);
}

}  // namespace

bool SetUp::is_shared() const {
  auto const on_body = [&](auto const& of) {
    return std::any_of(of.particles.begin(), of.particles.end(),
                       [&](auto id) { return id >= body.first && id < body.last; });
  };
  auto const holds = [&](Support const& support) { return support.on_surface() && on_body(support); };
  auto const absorbs = [&](Load const& load) { return load.absorbs && on_body(load); };
  return own && images == nullptr && std::none_of(supports.begin(), supports.end(), holds) &&
         std::none_of(loads.begin(), loads.end(), absorbs);
}

void make_reference(SetUp const& from, Reference& to) {
  if (from.set.dimension == 1) return make<1>(from, to);
  return from.set.dimension == 2 ? make<2>(from, to) : make<3>(from, to);
}

}  // namespace piola::nodal
