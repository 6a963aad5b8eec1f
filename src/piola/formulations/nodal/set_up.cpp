// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/base/errors.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/constrained_facets.hpp"
#include "piola/formulations/nodal/integration_check.hpp"
#include "piola/formulations/nodal/integration_constraint.hpp"
#include "piola/formulations/nodal/load_integrals.hpp"
#include "piola/formulations/nodal/masses.hpp"
#include "piola/formulations/nodal/mirror_passes.hpp"
#include "piola/formulations/nodal/scaled_body.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace piola::nodal {
namespace {

/// Smallest volume of a cell, relative to a spacing's volume.
constexpr double least_cell = 1e-3;
/// A strain out of rounding. On 501 x 5 particles it is 7e-7, and energy is kept to a thousandth.
constexpr double most_rounding = 1e-6;

double since(std::chrono::steady_clock::time_point& start) {
  auto const now = std::chrono::steady_clock::now();
  double const seconds = std::chrono::duration<double>(now - start).count();
  start = now;
  return seconds;
}

/// Columns of the Cholesky factor of a cell's spread [m], rows first.
template <int D>
std::array<double, static_cast<std::size_t>(D* D)> cholesky(ScaledCell const& cell, std::array<double, 3> const& h) {
  std::array<double, static_cast<std::size_t>(D * D)> L{};
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = cell.spread[i == j ? i : 6 - i - j] * h[i] * h[j];
      for (std::size_t k = 0; k < j; ++k) rest -= L[i * D + k] * L[j * D + k];
      if (i == j)
        L[i * D + i] = std::sqrt(std::max(rest, 0.0));
      else if (L[j * D + j] > 0)
        L[i * D + j] = rest / L[j * D + j];
    }
  return L;
}

[[noreturn]] void refuse(SetUp const& from, Index slot, char const* what) {
  auto const id = from.order.id[static_cast<std::size_t>(slot)];
  auto const& X = from.set.X[static_cast<std::size_t>(id)];
  throw InputError(fmt::format("body '{}': particle {} at ({:.4g}, {:.4g}, {:.4g}) m {}", from.body.name, id, X[0],
                               X[1], X[2], what));
}

/// Builds the data of the loops of D dimensions from the results of the fits.
template <int D>
class Tables {
 public:
  static constexpr auto terms = static_cast<std::size_t>(Quadratic<D>::terms);
  static constexpr auto values = static_cast<std::size_t>(Quadratic<D>::values);
  static constexpr auto second = static_cast<std::size_t>(Quadratic<D>::second);
  static constexpr auto dimension = static_cast<std::size_t>(D);

  Tables(SetUp const& from, ScaledBody const& scaled, LocalFits<D> const& fits, Reference& to)
      : from_(from),
        scaled_(scaled),
        fits_(fits),
        to_(to),
        slots_(static_cast<std::size_t>(from.order.slots())),
        first_(static_cast<std::size_t>(std::min(from.own_slots().first, from.order.particles))),
        last_(static_cast<std::size_t>(std::min(from.own_slots().last, from.order.particles))) {
    if (from.images != nullptr) keep_images();
  }

  void fill(IntegrationCorrection const& integration_correction, LazyZeroArray<double> const& mass) {
    using Values = LazyZeroArray<double>;
    to_.V = Values(slots_);
    to_.mass = Values(slots_);
    to_.X = Values((slots_ + to_.images.size()) * dimension);
    to_.mu = Values((slots_ + to_.images.size()) * dimension);
    to_.L = Values(slots_ * dimension * dimension);
    to_.g = Values(slots_ * values * dimension);
    share_k();
    to_.own = Values(slots_ * (values + dimension));
    to_.centroid = Values(slots_ * dimension);
    fill_seen(integration_correction);
    for (auto slot = from_.own_slots().first; slot < from_.own_slots().last; ++slot)
      to_.mass[static_cast<std::size_t>(slot)] = 1;
    for_each_local([&](std::size_t a) {
      to_.mass[a] = mass[a] * scaled_.h_volume * from_.rho0.front();
      auto const L = cholesky<D>(scaled_.cells[a], scaled_.h);
      for (std::size_t c = 0; c < L.size(); ++c) to_.L[a * L.size() + c] = parity(a) * L[c];
      for (std::size_t c = 0; c < dimension; ++c)
        to_.centroid[a * dimension + c] = scaled_.cells[a].centroid[c] * scaled_.h[c];
      fill_derivatives(a, integration_correction);
    });
    fill_images(integration_correction);
    for_each_local([this](std::size_t a) { fill_own(a); });
  }

  /// The lists of own particles.
  void fill_lists(Pairs pairs) {
    std::size_t const before = pairs.first(first_), after = pairs.first(last_) - before;
    auto const keep = [&](auto& of_pairs) {
      of_pairs.erase(of_pairs.begin(), of_pairs.begin() + static_cast<std::ptrdiff_t>(before));
      of_pairs.resize(after);
      if (from_.own) of_pairs.shrink_to_fit();
    };
    keep(pairs.neighbour);
    if (!to_.lattice) keep(pairs.weight);  // of a lattice only observers read the lists
    if (from_.images != nullptr)
      for (Index& b : pairs.neighbour) b = static_cast<Index>(place_of(static_cast<std::size_t>(b)));
    to_.begin = LazyZeroArray<std::int64_t>(slots_ + 1);
    // Slots without a particle have no neighbours.
    for (auto slot = first_; slot <= static_cast<std::size_t>(from_.own_slots().last); ++slot)
      to_.begin[slot] = pairs.begin[std::min(slot, last_)] - static_cast<std::int64_t>(before);
    to_.neighbour = std::move(pairs.neighbour);
    if (!to_.lattice) to_.weight = std::move(pairs.weight);
  }

 private:
  /// f(a) for the local particles.
  template <class F>
  void for_each_local(F const& f) const {
    exec_host::parallel_for(static_cast<Index>(last_ - first_),
                            [&](Index k) { f(first_ + static_cast<std::size_t>(k)); });
  }

  /// Fills the reference data (V, X, mu) of local particles and ghosts.
  void fill_seen(IntegrationCorrection const& integration_correction) {
    IndexSet const& rows = fits_.rows();
    exec_host::parallel_for(rows.size(), [&](Index k) {
      std::size_t const a = rows[k];
      if (a >= scaled_.particles) return;
      to_.V[a] = scaled_.cells[a].volume * scaled_.h_volume;
      for (std::size_t c = 0; c < dimension; ++c) {
        to_.X[a * dimension + c] = scaled_.X[a][c];
        to_.mu[a * dimension + c] = integration_correction.mu[a * dimension + c] / scaled_.h[c];
      }
    });
  }

  /// Slot of a particle or an image of the scaled body.
  std::size_t place_of(std::size_t b) const {
    return b < scaled_.particles ? b : slots_ + kept_[b - scaled_.particles];
  }

  /// The images that are neighbours of own particles.
  void keep_images() {
    auto const& images = *from_.images;
    std::vector<char> wanted(static_cast<std::size_t>(images.count()), 0);
    auto const& pairs = fits_.pairs();
    for (std::size_t k = pairs.first(first_); k < pairs.first(last_); ++k)
      if (pairs.at(k) >= scaled_.particles) wanted[pairs.at(k) - scaled_.particles] = 1;
    kept_.resize(wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      kept_[k] = to_.images.size();
      if (wanted[k] == 0) continue;
      to_.images.push_back(static_cast<Index>(k));
      to_.source_of_image.push_back(images.particles().source[k]);
    }
    to_.own_fractions = LazyZeroArray<double>(slots_, 1);
    for (std::size_t a = 0; a < scaled_.particles; ++a)
      to_.own_fractions[a] = 1 / images.multiplicity(static_cast<Index>(a));
  }

  void fill_images(IntegrationCorrection const& integration_correction) {
    for (std::size_t k = 0; k < to_.images.size(); ++k) {
      std::size_t const b = scaled_.particles + static_cast<std::size_t>(to_.images[k]);
      for (std::size_t c = 0; c < dimension; ++c) {
        to_.X[(slots_ + k) * dimension + c] = scaled_.X[b][c];
        to_.mu[(slots_ + k) * dimension + c] = integration_correction.mu[b * dimension + c] / scaled_.h[c];
      }
    }
  }

  /// Whether a particle is on a plane that inverts one of two components and not the other: their coupling is zero up
  /// to round-off.
  bool odd(std::size_t a, int m, int n) const {
    for (int axis = 0; axis < D && from_.images != nullptr; ++axis)
      if (from_.images->on_plane(static_cast<Index>(a), static_cast<std::size_t>(axis)) &&
          turns<D>(m, axis) != turns<D>(n, axis))
        return true;
    return false;
  }

  /// No handedness: the points of neighbouring cells are mirror images.
  double parity(std::size_t a) const {
    auto const id = from_.order.id[a];
    auto const& at = from_.set.lattice_index[static_cast<std::size_t>(id)];
    auto const sum = from_.body.off_lattice ? id : static_cast<std::int64_t>(at[0] + at[1] + at[2]);
    return sum % 2 == 0 ? 1 : -1;
  }

  /// g: the gradient at the centroid, with the correction's own quadratic.
  void fill_derivatives(std::size_t a, IntegrationCorrection const& integration_correction) {
    double* const g = &to_.g[a * values * dimension];
    auto const& cell = scaled_.cells[a];
    for (std::size_t J = 0; J < dimension; ++J) {
      for (std::size_t m = 0; m < values; ++m)
        g[m * dimension + J] =
            -integration_correction.coefficients->at(static_cast<Index>(a), static_cast<int>(m * dimension + J)) /
            scaled_.h[J];
      for (int l = 0; l < Quadratic<D>::terms; ++l) {
        typename LocalFits<D>::Monomials column;
        for (int i = 0; i < Quadratic<D>::terms; ++i) column[static_cast<std::size_t>(i)] = fits_.inverse(a, i, l);
        g[static_cast<std::size_t>(1 + l) * dimension + J] +=
            at_centroid<D>(column, cell, static_cast<int>(J)) / scaled_.h[J];
      }
      for (int m = 0; m < Quadratic<D>::values; ++m)
        if (odd(a, m, 1 + static_cast<int>(J))) g[static_cast<std::size_t>(m) * dimension + J] = 0;
    }
  }

  /// k of a particle.
  void fill_second(std::size_t a, double* k) const {
    for (int J = 0; J < D; ++J)
      for (int K = J; K < D; ++K) {
        int const n = Quadratic<D>::at(J, K);
        double const hh = scaled_.h[static_cast<std::size_t>(J)] * scaled_.h[static_cast<std::size_t>(K)];
        for (int l = 0; l < Quadratic<D>::terms; ++l)
          k[static_cast<std::size_t>(l) * second + static_cast<std::size_t>(n)] =
              odd(a, 1 + l, 1 + D + n) ? 0 : fits_.inverse(a, D + n, l) / hh;
      }
  }

  /// Makes k: one for each particle, or of a lattice for each kind of group of lanes.
  void share_k() {
    if (!to_.lattice) {
      to_.k = LazyZeroArray<double>(slots_ * terms * second);
      for_each_local([this](std::size_t a) { fill_second(a, &to_.k[a * terms * second]); });
      return;
    }
    auto groups = groups_of_fits(fits_, from_.own_slots(), static_cast<Index>(slots_), from_.backend.lanes);
    to_.k = LazyZeroArray<double>(static_cast<std::size_t>(groups.stored_slots()) * terms * second);
    groups.each(static_cast<Index>(scaled_.particles), [&](Index place, Index a) {
      fill_second(static_cast<std::size_t>(a), &to_.k[static_cast<std::size_t>(place) * terms * second]);
    });
    to_.group_of_k = std::move(groups.stored);
  }

  void fill_own(std::size_t a) {
    double* const own = &to_.own[a * (values + dimension)];
    auto const& pairs = fits_.pairs();
    for (std::size_t n = pairs.first(a); n < pairs.end(a); ++n) {
      auto const p = fits_.monomials_of(a, pairs.at(n));
      own[0] += pairs.weight[n];
      for (std::size_t m = 0; m < terms; ++m) own[1 + m] += pairs.weight[n] * p[m];
      for (std::size_t J = 0; J < dimension; ++J)
        own[values + J] += pairs.weight[n] * to_.mu[place_of(pairs.at(n)) * dimension + J];
    }
    for (int m = 0; m < Quadratic<D>::values + D; ++m)
      if (odd(a, m, 0)) own[m] = 0;
  }

  SetUp const& from_;
  ScaledBody const& scaled_;
  LocalFits<D> const& fits_;
  Reference& to_;
  std::size_t slots_, first_, last_;  ///< all slots; own particles
  std::vector<std::size_t> kept_;     ///< of each image, how many before it are neighbours
};

/// Slot of the particle that an entry of the scaled body is, or is the image of.
Index source_of(SetUp const& from, std::size_t i) {
  auto const particles = static_cast<std::size_t>(from.order.particles);
  return i < particles ? static_cast<Index>(i) : from.images->particles().source[i - particles];
}

/// Cells with volumes in proportion to their masses, in units of the body's own density: transfers between cells are
/// masses, with the moments of all materials together. Empty for a single material.
LazyZeroArray<ScaledCell> heavy_cells(SetUp const& from, LazyZeroArray<ScaledCell> const& light) {
  if (from.rho0.size() == 1) return {};
  LazyZeroArray<ScaledCell> cells = light;
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i].volume *=
        from.rho0[part_of(from.set,
                          static_cast<std::size_t>(from.order.id[static_cast<std::size_t>(source_of(from, i))]))] /
        from.rho0.front();
  return cells;
}

/// Whether a lattice is so slender that sums over it lose digits of its large multipliers: on 251 x 5 x 5 particles the
/// solve for the divergence theorem does not converge over the lattice; over lists it takes 42 iterations.
bool is_slender(SetUp const& from) {
  constexpr int longest = 60;  // times the next direction
  int most = 0, next = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(from.set.dimension); ++c) {
    int const n = from.body.lattice[c] - 1;
    next = std::max(next, std::min(n, most));
    most = std::max(most, n);
  }
  return from.set.dimension > 2 && most > longest * next;
}

/// The lattice of a body for loops, if possible. Lists are needed by follower pressures, which use gradients particle
/// by particle, and by images, which are not on the lattice.
std::optional<LatticeShape> shape_for_loops(SetUp const& from) {
  bool const follows = std::any_of(from.loads.begin(), from.loads.end(), [](Load const& load) { return load.follows; });
  if (follows || from.images != nullptr || is_slender(from)) return std::nullopt;
  return lattice_shape(from.set, from.body, from.order);
}

void refuse_without_cell(SetUp const& from, ScaledBody const& scaled) {
  for (std::size_t i = 0; i < scaled.particles; ++i)
    if (!(scaled.cells[i].volume > least_cell))
      refuse(from, static_cast<Index>(i),
             "has no part of the body to itself - move it into the body, or apart from its neighbours");
}

template <int D>
IntegrationCorrection find_integration_correction(SetUp const& from, IntegrationConstraint<D> const& divergence,
                                                  SymmetryReduction<D> const* fold, Reference& r) {
  constexpr double tolerance = 1e-3;  // of the first residual; smaller values change no result
  IntegrationCorrection integration_correction =
      divergence.solve(tolerance, from.backend, r.lattice ? &*r.lattice : nullptr, {fold, r.halo.get()});
  if (integration_correction.rounding > most_rounding) r.lattice.reset();  // lists take differences of positions first
  r.integration_iterations = integration_correction.iterations;
  check_integration(from, integration_correction, r.checks);
  return integration_correction;
}

struct MassOptions {
  std::optional<DistributedSlots> const& shared;
  bool endless;  ///< between two mirror planes
};

template <int D>
LazyZeroArray<double> masses(SetUp const& from, ScaledBody const& scaled, std::optional<LatticeShape> const& shape,
                             MassOptions const& options) {
  auto const heavy = heavy_cells(from, scaled.cells);
  return exact_masses<D>(scaled.X, heavy.empty() ? scaled.cells : heavy,
                         {from.least_mass, shape, !has_lattice_cells(from.body) && !options.endless, options.shared});
}

template <int D>
Reference make(SetUp const& from) {
  Reference r;
  auto clock = std::chrono::steady_clock::now();
  ScaledBody scaled = scaled_body(from);
  r.costs.cells = since(clock);
  refuse_without_cell(from, scaled);
  auto const shape = shape_for_loops(from);
  std::optional<DistributedSlots> shared;
  if (from.is_shared()) shared = DistributedSlots{from.order.slots(), from.order.particles};
  std::optional<SymmetryReduction<D>> fold;
  if (from.images != nullptr) fold.emplace(*from.images, scaled.particles);
  // First, because its pairs reach farther than those that are kept.
  auto const mass = masses<D>(from, scaled, shape, {shared, fold && fold->endless()});
  r.costs.masses = since(clock);
  LocalFits<D> fits(scaled.X, shape, shared);
  if (shape && fits.usual()) r.lattice.emplace(*shape, from.order.slots(), from.backend.lanes);
  if (fits.unsolvable() >= 0)
    refuse(from, source_of(from, static_cast<std::size_t>(fits.unsolvable())),
           "has neighbours that determine no quadratic field - use at least three particles across the body in every "
           "direction");
  if (shared) keep_cells(scaled, fits.rows());
  if (shared) r.halo = std::make_unique<HaloPlan>(shared->slots, ghost_neighbours(fits.pairs(), fits.own()));
  r.costs.fits = since(clock);
  IntegrationConstraint<D> const divergence(fits, scaled.cells, scaled.patches);
  IntegrationCorrection const integration_correction =
      find_integration_correction<D>(from, divergence, fold ? &*fold : nullptr, r);
  r.parts = load_integrals<D>(from, fits, divergence, {scaled.h, r.checks});
  for (auto& parts : r.parts) parts.resize(std::min(parts.size(), scaled.particles));
  r.held = constrained_facets<D>(from, fits, scaled.patches, scaled.h);
  r.costs.integration_correction = since(clock);
  Tables<D> tables(from, scaled, fits, r);
  tables.fill(integration_correction, mass);
  tables.fill_lists(fits.take_pairs());
  r.costs.tables = since(clock);
  return r;
}

}  // namespace

bool SetUp::is_shared() const {
  auto const on_body = [&](Support const& support) {
    return support.on_surface() && std::any_of(support.particles.begin(), support.particles.end(),
                                               [&](auto id) { return id >= body.first && id < body.last; });
  };
  return own && images == nullptr && std::none_of(supports.begin(), supports.end(), on_body);
}

Reference make_reference(SetUp const& from) {
  if (from.set.dimension == 1) return make<1>(from);
  return from.set.dimension == 2 ? make<2>(from) : make<3>(from);
}

}  // namespace piola::nodal
