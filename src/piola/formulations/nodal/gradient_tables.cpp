// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/gradient_tables.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/hoop_stretch.hpp"
#include "piola/formulations/nodal/mirror_passes.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

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

}  // namespace

template <int D>
GradientTables<D>::GradientTables(SetUp const& from, ScaledBody const& scaled, LocalFits<D>& fits,
                                  FacetFluxes<D> const& fluxes, Reference& to)
    : from_(from),
      scaled_(scaled),
      fits_(fits),
      fluxes_(fluxes),
      to_(to),
      slots_(static_cast<std::size_t>(from.order.slots())),
      first_(static_cast<std::size_t>(std::min(from.own_slots().first, from.order.particles))),
      last_(static_cast<std::size_t>(std::min(from.own_slots().last, from.order.particles))) {}

template <int D>
void GradientTables<D>::operator()(LazyZeroArray<double> const& mass, std::optional<LatticeShape> const& lattice) {
  using Values = LazyZeroArray<double>;
  if (from_.images != nullptr) fill_images();
  to_.V = Values(slots_);
  to_.mass = Values(slots_);
  to_.X = Values((slots_ + to_.images.size()) * dimension);
  to_.L = Values(slots_ * dimension * dimension);
  to_.own = Values(slots_ * numbers);
  to_.centroid = Values(slots_ * dimension);
  fill_seen();
  for (auto slot = from_.own_slots().first; slot < from_.own_slots().last; ++slot)
    to_.mass[static_cast<std::size_t>(slot)] = 1;
  for_each_local([&](std::size_t a) { fill_cell(a, mass[a] * scaled_.h_volume * from_.rho0.front()); });
  if (lattice) {
    fill_lattice(*lattice);
  } else {
    to_.k = Values(slots_ * terms * second);
    for_each_local([this](std::size_t a) { fill_second(a, &to_.k[a * terms * second]); });
    if (!scaled_.sections.empty()) {
      to_.hoop = Values(slots_ * HoopSums::size);
      for_each_local([this](std::size_t a) { fill_hoop(a); });
    }
    fill_pairs();
  }
  take_lists();
}

/// f(a) for the local particles.
template <int D>
template <class F>
void GradientTables<D>::for_each_local(F const& f) const {
  exec_host::parallel_for(static_cast<Index>(last_ - first_),
                          [&](Index k) { f(first_ + static_cast<std::size_t>(k)); });
}

/// Fills V and X of local particles and ghosts, and X of images.
template <int D>
void GradientTables<D>::fill_seen() {
  IndexSet const& rows = fits_.rows();
  auto const put = [&](std::size_t to, std::size_t a) {
    for (std::size_t c = 0; c < dimension; ++c) to_.X[to * dimension + c] = scaled_.X[a][c];
  };
  exec_host::parallel_for(rows.size(), [&](Index k) {
    std::size_t const a = rows[k];
    if (a >= scaled_.particles) return;
    to_.V[a] = scaled_.cells[a].volume * scaled_.h_volume;
    put(a, a);
  });
  for (std::size_t k = 0; k < to_.images.size(); ++k)
    put(slots_ + k, scaled_.particles + static_cast<std::size_t>(to_.images[k]));
}

/// The images that are neighbours of own particles.
template <int D>
void GradientTables<D>::fill_images() {
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

/// Mass and cell of a particle.
template <int D>
void GradientTables<D>::fill_cell(std::size_t a, double mass) {
  auto const& cell = scaled_.cells[a];
  to_.mass[a] = mass;
  auto const L = cholesky<D>(cell, scaled_.h);
  for (std::size_t c = 0; c < L.size(); ++c) to_.L[a * L.size() + c] = parity(a) * L[c];
  for (std::size_t c = 0; c < dimension; ++c) to_.centroid[a * dimension + c] = cell.centroid[c] * scaled_.h[c];
  fill_own(a);
}

/// Sums of the gradients of a cell over its neighbours.
template <int D>
void GradientTables<D>::fill_own(std::size_t a) {
  auto const& pairs = fits_.pairs();
  double* const own = &to_.own[a * numbers];
  typename LocalFits<D>::Monomials sum{};  // of s p
  for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
    auto const p = fits_.monomials_of(a, pairs.at(k));
    for (std::size_t l = 0; l < terms; ++l) sum[l] += pairs.weight[k] * p[l];
    for (std::size_t J = 0; J < dimension; ++J) own[J] += first_derivative(a, k, J);
  }
  double second_of[terms * second];
  fill_second(a, second_of);
  for (std::size_t n = 0; n < second; ++n)
    for (std::size_t l = 0; l < terms; ++l) own[dimension + n] += sum[l] * second_of[l * second + n];
}

/// No handedness: the points of neighbouring cells are mirror images.
template <int D>
double GradientTables<D>::parity(std::size_t a) const {
  auto const id = from_.order.id[a];
  auto const& at = from_.set.lattice_index[static_cast<std::size_t>(id)];
  auto const sum = from_.body.off_lattice ? id : static_cast<std::int64_t>(at[0] + at[1] + at[2]);
  return sum % 2 == 0 ? 1 : -1;
}

/// Whether a particle is on a plane that inverts one of two monomials and not the other: their coupling is zero up to
/// round-off.
template <int D>
bool GradientTables<D>::odd(std::size_t a, int m, int n) const {
  for (int axis = 0; axis < D && from_.images != nullptr; ++axis)
    if (a < scaled_.particles && from_.images->on_plane(static_cast<Index>(a), static_cast<std::size_t>(axis)) &&
        turns<D>(m, axis) != turns<D>(n, axis))
      return true;
  return false;
}

/// k of a particle: K_ab = s k^T p(r).
template <int D>
void GradientTables<D>::fill_second(std::size_t a, double* k) const {
  for (int J = 0; J < D; ++J)
    for (int K = J; K < D; ++K) {
      int const n = Quadratic<D>::at(J, K);
      double const hh = scaled_.h[static_cast<std::size_t>(J)] * scaled_.h[static_cast<std::size_t>(K)];
      for (int l = 0; l < Quadratic<D>::terms; ++l)
        k[static_cast<std::size_t>(l) * second + static_cast<std::size_t>(n)] =
            odd(a, l, D + n) ? 0 : fits_.inverse(a, D + n, l) / hh;
    }
}

/// The hoop stretch of a cell from the sums T of the radial motion, and its derivatives by the particle's own radius.
template <int D>
void GradientTables<D>::fill_hoop([[maybe_unused]] std::size_t a) {
  if constexpr (D == 2) {
    auto const L = cholesky<2>(scaled_.cells[a], {1, 1, 1});
    auto eta = hoop_functionals(scaled_.cells[a], scaled_.sections[a], L);
    for (std::size_t n = 0; n < eta.size(); ++n)
      for (double& value : eta[n]) value *= (n == 0 ? 1 : parity(a)) / scaled_.h[0];
    double* const to = &to_.hoop[a * HoopSums::size];
    for (std::size_t n = 0; n < eta.size(); ++n)
      for (std::size_t l = 0; l < terms; ++l)
        for (std::size_t m = 0; m < terms; ++m)
          if (!odd(a, static_cast<int>(l), static_cast<int>(m)))
            to[HoopSums::of_sum(l, n)] += eta[n][1 + m] * fits_.inverse(a, static_cast<int>(m), static_cast<int>(l));
    auto const& pairs = fits_.pairs();
    for (std::size_t n = 0; n < eta.size(); ++n) {
      to[HoopSums::of_radius + n] = eta[n][0];
      to[HoopSums::own + n] = -eta[n][0];
    }
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const p = fits_.monomials_of(a, pairs.at(k));
      for (std::size_t n = 0; n < eta.size(); ++n)
        for (std::size_t l = 0; l < terms; ++l)
          to[HoopSums::own + n] += pairs.weight[k] * p[l] * to[HoopSums::of_sum(l, n)];
    }
  }
}

/// Volume of a cell in spacings; on a lattice that of the first particle of its kind, so that gradients are those of
/// the kind to the last bit.
template <int D>
double GradientTables<D>::volume(std::size_t a) const {
  return scaled_.cells[fits_.representative(a)].volume;
}

/// Component J of G_ab of pair k of a.
template <int D>
double GradientTables<D>::first_derivative(std::size_t a, std::size_t k, std::size_t J) const {
  return fluxes_.flux(a, k, static_cast<int>(J)) / (volume(a) * scaled_.h[J]);
}

/// Component J of V_a G_ab of pair k of a, which enters the force of a on b.
template <int D>
double GradientTables<D>::reaction(std::size_t a, std::size_t k, std::size_t J) const {
  return fluxes_.flux(a, k, static_cast<int>(J)) * scaled_.h_volume / scaled_.h[J];
}

template <int D>
typename GradientTables<D>::Gradient GradientTables<D>::gradient(std::size_t a, std::size_t k,
                                                                 double const* second_of) const {
  Gradient g{};
  for (std::size_t J = 0; J < dimension; ++J) g[J] = first_derivative(a, k, J);
  auto const p = fits_.monomials_of(a, fits_.pairs().at(k));
  double const weight = fits_.pairs().weight[k];
  for (std::size_t n = 0; n < second; ++n)
    for (std::size_t l = 0; l < terms; ++l) g[dimension + n] += weight * p[l] * second_of[l * second + n];
  return g;
}

template <int D>
std::size_t GradientTables<D>::opposite(std::size_t a, std::size_t b) const {
  auto const& pairs = fits_.pairs();
  auto const first = pairs.neighbour.begin() + static_cast<std::ptrdiff_t>(pairs.first(b));
  auto const last = pairs.neighbour.begin() + static_cast<std::ptrdiff_t>(pairs.end(b));
  auto const found = std::lower_bound(first, last, static_cast<Index>(a));
  PIOLA_ENSURES(found != last && *found == static_cast<Index>(a));
  return static_cast<std::size_t>(found - pairs.neighbour.begin());
}

/// G_ab and V_b G_ba of the pairs of own particles.
template <int D>
void GradientTables<D>::fill_pairs() {
  auto const& pairs = fits_.pairs();
  std::size_t const before = pairs.first(first_), count = pairs.first(last_) - before;
  // Loops over lists read one value more than they use.
  to_.gradient.assign(count * dimension + 1, 0);
  to_.reaction.assign(count * dimension + 1, 0);
  for_each_local([&](std::size_t a) {
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      std::size_t const b = pairs.at(k), back = opposite(a, b);
      for (std::size_t J = 0; J < dimension; ++J) {
        to_.gradient[(k - before) * dimension + J] = first_derivative(a, k, J);
        to_.reaction[(k - before) * dimension + J] = reaction(b, back, J);
      }
    }
  });
}

template <int D>
void GradientTables<D>::refill(std::vector<std::size_t> const& particles) {
  auto const& pairs = fits_.pairs();
  std::size_t const before = pairs.first(first_);
  bool const has_hoop = !scaled_.sections.empty();
  if (to_.own.empty()) {
    to_.own = LazyZeroArray<double>(slots_ * numbers);
    to_.k = LazyZeroArray<double>(slots_ * terms * second);
    if (has_hoop) to_.hoop = LazyZeroArray<double>(slots_ * HoopSums::size);
  }
  for (std::size_t const a : particles) {
    if (is_local(a)) {
      std::fill_n(&to_.own[a * numbers], numbers, 0.0);
      fill_own(a);
      fill_second(a, &to_.k[a * terms * second]);
      if (has_hoop) {
        std::fill_n(&to_.hoop[a * HoopSums::size], HoopSums::size, 0.0);
        fill_hoop(a);
      }
    }
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      std::size_t const b = pairs.at(k);
      if (is_local(a)) {
        to_.weight[k - before] = pairs.weight[k];
        for (std::size_t J = 0; J < dimension; ++J)
          to_.gradient[(k - before) * dimension + J] = first_derivative(a, k, J);
      }
      if (!is_local(b)) continue;
      std::size_t const back = opposite(a, b) - before;
      to_.back_weight[back] = pairs.weight[k];
      for (std::size_t J = 0; J < dimension; ++J) to_.reaction[back * dimension + J] = reaction(a, k, J);
    }
  }
}

/// Slot of a particle or an image of the scaled body.
template <int D>
std::size_t GradientTables<D>::place_of(std::size_t b) const {
  return b < scaled_.particles ? b : slots_ + kept_[b - scaled_.particles];
}

/// The lists of own particles.
template <int D>
void GradientTables<D>::take_lists() {
  Pairs pairs = from_.failure ? fits_.pairs() : fits_.take_pairs();
  std::size_t const before = pairs.first(first_), after = pairs.first(last_) - before;
  auto const keep = [&](auto& of_pairs) {
    of_pairs.erase(of_pairs.begin(), of_pairs.begin() + static_cast<std::ptrdiff_t>(before));
    of_pairs.resize(after);
    if (from_.own) of_pairs.shrink_to_fit();
  };
  keep(pairs.neighbour);
  if (to_.lattice.empty()) keep(pairs.weight);  // of a lattice only observers read the lists
  if (from_.images != nullptr)
    for (Index& b : pairs.neighbour) b = static_cast<Index>(place_of(static_cast<std::size_t>(b)));
  to_.begin = LazyZeroArray<std::int64_t>(slots_ + 1);
  // Slots without a particle have no neighbours.
  for (auto slot = first_; slot <= static_cast<std::size_t>(from_.own_slots().last); ++slot)
    to_.begin[slot] = pairs.begin[std::min(slot, last_)] - static_cast<std::int64_t>(before);
  to_.neighbour = std::move(pairs.neighbour);
  if (to_.lattice.empty()) to_.weight = std::move(pairs.weight);
  if (from_.failure) to_.back_weight = to_.weight;
}

/// One set of gradients for each distinct group of lanes. What a particle gets from its neighbours depends on their
/// distances from the faces of the lattice, and so on its own up to four spacings.
template <int D>
void GradientTables<D>::fill_lattice(LatticeShape const& shape) {
  constexpr int beyond = 5;
  auto const offsets = offsets_in_reach(D, usual_reach);
  auto& lattice = to_.lattice;
  std::ptrdiff_t farthest = 0;
  for (auto const& o : offsets) {
    lattice.offset.push_back((static_cast<std::ptrdiff_t>(o[2]) * shape.count[1] + o[1]) * shape.count[0] + o[0]);
    farthest = std::max(farthest, std::abs(lattice.offset.back()));
  }
  constexpr std::ptrdiff_t widest_lanes = 8;
  lattice.guard = static_cast<Index>(farthest + widest_lanes);
  auto const kinds = representatives_in_lattice(shape, beyond);
  int const lanes = from_.backend.lanes;
  UniqueLaneGroups groups(from_.own_slots(), static_cast<Index>(slots_), lanes,
                          [&](Index first, std::vector<double>& key) {
                            auto const end = std::min(static_cast<std::size_t>(first + lanes), scaled_.particles);
                            for (auto a = static_cast<std::size_t>(first); a < end; ++a) key.push_back(kinds[a]);
                          });
  LazyZeroArray<double> second_of(slots_ * terms * second);  // of the first particle of each kind
  for (Index row = 0; row < fits_.rows().size(); ++row)
    if (std::size_t const a = fits_.rows()[row]; fits_.representative(a) == a)
      fill_second(a, &second_of[a * terms * second]);
  std::size_t const size = static_cast<std::size_t>(groups.stored_slots()) * offsets.size() * numbers;
  lattice.motion.assign(size, 0);
  lattice.force.assign(size, 0);
  groups.each(static_cast<Index>(scaled_.particles), [&](Index place, Index a) {
    fill_group({shape, offsets, second_of}, place, a);
  });
  lattice.group = std::move(groups.stored);
}

/// `place`: of a lane among the stored groups.
template <int D>
void GradientTables<D>::fill_group(LatticeRow const& row, Index place, Index a) {
  auto const& [shape, offsets, second_of] = row;
  auto const k_of = [&, &second = second_of](std::size_t particle) {
    return &second[fits_.representative(particle) * terms * GradientTables::second];
  };
  auto const lanes = static_cast<std::size_t>(from_.backend.lanes), at = static_cast<std::size_t>(place);
  std::size_t const group = at / lanes, lane = at % lanes, slot = static_cast<std::size_t>(a);
  auto const from = shape.place(a);
  for (std::size_t o = 0; o < offsets.size(); ++o) {
    std::array const to{from[0] + offsets[o][0], from[1] + offsets[o][1], from[2] + offsets[o][2]};
    if (!shape.has(to)) continue;
    auto const b = static_cast<std::size_t>(shape.slot(to));
    Gradient const forth = gradient(slot, opposite(b, slot), k_of(slot)),
                   back = gradient(b, opposite(slot, b), k_of(b));
    double const V = volume(b) * scaled_.h_volume;
    for (std::size_t n = 0; n < numbers; ++n) {
      std::size_t const index = ((group * offsets.size() + o) * numbers + n) * lanes + lane;
      to_.lattice.motion[index] = forth[n];
      to_.lattice.force[index] = V * back[n];
    }
  }
}

template class GradientTables<1>;
template class GradientTables<2>;
template class GradientTables<3>;

}  // namespace piola::nodal
