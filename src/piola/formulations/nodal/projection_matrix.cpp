// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/projection_matrix.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/halo_fields.hpp"
#include "piola/math/solve.hpp"
#include <algorithm>

namespace piola::nodal {
namespace {

Index padded(std::size_t particles) {
  auto const n = static_cast<Index>(particles);
  return (n + SlotOrder::alignment - 1) / SlotOrder::alignment * SlotOrder::alignment;
}

}  // namespace

template <int D>
ProjectionMatrix<D>::ProjectionMatrix(LocalFits<D> const& fits, LazyZeroArray<ScaledCell> const& cells,
                                      Backend const& backend, LatticeLayout const* lattice, HaloPlan const* halo)
    : backend_(backend),
      particles_(static_cast<Index>(cells.size())),
      slots_(padded(cells.size())),
      own_(fits.own()),
      inverse_("InverseOfNormalEquations", "1", triangle, Role::reference),
      weights_("OwnWeights", "1", 2, Role::reference),
      coefficients_(std::make_unique<Field>("LeastSquaresQuadratic", "1", values * D, Role::derived)) {
  allocate(lattice);
  if (halo != nullptr) distribute(*halo);
  fill(fits, cells);
  auto const& pairs = fits.pairs();
  begin_ = LazyZeroArray<std::int64_t>(static_cast<std::size_t>(slots_) + 1);
  // Slots without a particle have no neighbours.
  for (Index i = state_.slots.first; i <= state_.slots.last; ++i)
    begin_[static_cast<std::size_t>(i)] = pairs.begin[static_cast<std::size_t>(std::min(i, particles_))];
  state_.list = {begin_.data(), nullptr, pairs.neighbour.data(), pairs.weight.data()};
}

template <int D>
void ProjectionMatrix<D>::distribute(HaloPlan const& halo) {
  state_.slots = even_local_range({0, slots_});
  // Neither sent nor read at neighbours.
  if (state_.motion_for_neighbours.data == nullptr) state_.motion_for_neighbours = weights_.ref();
  halo_ = halo;
  add_halo_fields<D>(*halo_, state_);
  state_.halo = &*halo_;
}

template <int D>
void ProjectionMatrix<D>::allocate(LatticeLayout const* lattice) {
  auto& s = state_;
  if (lattice != nullptr)
    NeighbourRecords::place_lattice(fields_, s, slots_, lattice->guard());
  else
    records_.place_records(fields_, s, slots_);
  for (FieldRef const* field : {&s.V, &s.mass, &s.own, &s.a}) fields_[*field].allocate_tiled(slots_);
  for (Field* field : {&weights_, coefficients_.get()}) field->allocate_tiled(slots_);
  fields_.bind();
  s.mu = {};  // plain sums
  s.stress_for_neighbours = s.stress;
  s.slots = {0, slots_};
  s.all_slots = slots_;
  state_.failure = &failure_;
  if (lattice != nullptr)
    state_.lattice = lattice->table();
  else
    state_.motion_for_neighbours = state_.X;
}

template <int D>
void ProjectionMatrix<D>::fill(LocalFits<D> const& fits, LazyZeroArray<ScaledCell> const& cells) {
  LazyZeroArray<double> explained(fits.pairs().neighbour.size());  // of the first one of each kind
  for (Index i = state_.slots.first; i < state_.slots.last; ++i) value_at(state_.mass, i) = 1;
  fill_sums_and_inverses(fits, explained);
  exec_host::parallel_for(fits.rows().size(), [&](Index k) {
    std::size_t const a = fits.rows()[k];
    auto const i = static_cast<Index>(a);
    for (int m = 0; m < values && fits.representative(a) != a; ++m)
      value_at(state_.own, i, m) = value_at(state_.own, static_cast<Index>(fits.representative(a)), m);
    value_at(state_.V, i) = cells[a].volume;
    weights_.at(i, 0) = cells[a].volume * fits.own_weight(a);
    if (state_.lattice.present != nullptr) return;
    for (int c = 0; c < D; ++c) value_at(state_.X, i, c) = fits.X()[a][static_cast<std::size_t>(c)];
    records_.complete_record(D, i);
  });
  diagonal_ = LazyZeroArray<double>(cells.size());
  auto const& pairs = fits.pairs();
  scatter_in_order(own_, fits.rows(), pairs.farthest(), [&](std::size_t a, auto const& mine) {
    auto const i = static_cast<Index>(a);
    double const own = fits.own_weight(a);
    bool const here = mine(a);
    if (here) diagonal_[a] += weights_.at(i, 0) * (1 - own * inverse(i, 0, 0));
    double all = weights_.at(i, 0);
    double const* of_pair = explained.data() + pairs.first(fits.representative(a));
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k, ++of_pair) {
      if (mine(pairs.at(k)))
        diagonal_[pairs.at(k)] += cells[a].volume * pairs.weight[k] * (1 - pairs.weight[k] * *of_pair);
      all += cells[pairs.at(k)].volume * pairs.weight[k];
    }
    if (here) weights_.at(i, 1) = all;
  });
}

/// For each particle; on a lattice once per kind.
template <int D>
void ProjectionMatrix<D>::fill_sums_and_inverses(LocalFits<D> const& fits, LazyZeroArray<double>& explained) {
  bool const lattice = state_.lattice.present != nullptr;
  if (lattice) groups_ = groups_of_fits(fits, state_.slots, slots_, backend_.lanes);
  inverse_.allocate_tiled(lattice ? groups_->stored_slots() : slots_);
  LazyZeroArray<Inverse> of_kind(lattice ? fits.X().size() : 0);
  auto const put = [this](Index place, Inverse const& inverse) {
    for (int m = 0; m < triangle; ++m) inverse_.at(place, m) = inverse[static_cast<std::size_t>(m)];
  };
  exec_host::parallel_for(fits.rows().size(), [&](Index k) {
    std::size_t const a = fits.rows()[k];
    if (fits.representative(a) != a) return;
    Inverse const inverse = fill_sums(fits, a, explained);
    if (lattice)
      of_kind[a] = inverse;
    else
      put(static_cast<Index>(a), inverse);
  });
  if (!lattice) return;
  inverse_.share(groups_->stored.data());
  groups_->each(static_cast<Index>(fits.X().size()),
                [&](Index place, Index a) { put(place, of_kind[fits.representative(static_cast<std::size_t>(a))]); });
}

/// A particle's sums of weights and, per pair, p(X_b).inverse.p(X_b); returns the inverse of its normal equations.
template <int D>
typename ProjectionMatrix<D>::Inverse ProjectionMatrix<D>::fill_sums(LocalFits<D> const& fits, std::size_t a,
                                                                     LazyZeroArray<double>& explained) {
  auto const& pairs = fits.pairs();
  auto const i = static_cast<Index>(a);
  double A[values * values]{}, inverse[values * values], p[values]{1};
  A[0] = fits.own_weight(a);
  auto const monomials_of = [&](std::size_t k) {
    auto const q = fits.monomials_of(a, pairs.at(k));
    std::copy(q.begin(), q.end(), p + 1);
  };
  for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
    monomials_of(k);
    for (int m = 0; m < values; ++m) {
      double const weighted = pairs.weight[k] * p[m];
      value_at(state_.own, i, m) += weighted;
      for (int n = m; n < values; ++n) A[m * values + n] += weighted * p[n];
    }
  }
  for (int m = 0; m < values; ++m)
    for (int n = 0; n < m; ++n) A[m * values + n] = A[n * values + m];
  invert<values>(A, inverse);
  Inverse upper{};
  std::size_t at = 0;
  for (int m = 0; m < values; ++m)
    for (int n = m; n < values; ++n) upper[at++] = inverse[m * values + n];
  for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
    monomials_of(k);
    explained[k] = 0;
    for (int m = 0; m < values; ++m) {
      double row = 0;
      for (int n = 0; n < values; ++n) row += inverse[m * values + n] * p[n];
      explained[k] += p[m] * row;
    }
  }
  return upper;
}

template <int D>
void ProjectionMatrix<D>::apply(LazyZeroArray<double> const& x, LazyZeroArray<double>& image) {
  exec_host::parallel_for(own_, [&](Index i) {
    for (int c = 0; c < D; ++c)
      value_at(state_.x, i, c) = x[static_cast<std::size_t>(i) * D + static_cast<std::size_t>(c)];
  });
  backend_.project(state_, {inverse_.ref(), weights_.ref(), coefficients_->ref()});
  exec_host::parallel_for(own_, [&](Index i) {
    for (int c = 0; c < D; ++c)
      image[static_cast<std::size_t>(i) * D + static_cast<std::size_t>(c)] = value_at(state_.a, i, c);
  });
}

template class ProjectionMatrix<1>;
template class ProjectionMatrix<2>;
template class ProjectionMatrix<3>;

}  // namespace piola::nodal
