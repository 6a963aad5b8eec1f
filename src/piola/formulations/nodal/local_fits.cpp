// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola::nodal {
namespace {

constexpr double growth = 1.2;
/// Least ratio of pivots of a linear fit.
constexpr double flattest = 1e-3;
/// Largest admissible entry on the diagonal of A^-1: 72 in a lattice, 180 with a jitter of 0.2.
constexpr double worst_condition = 1e4;
/// Beside cracks, where a linear fit is the alternative.
constexpr double worst_beside_cracks = 300;

double weight_of(double square, double reach) {
  double const inside = 1 - square / (reach * reach);
  return inside * inside / (square * std::sqrt(square));
}

/// Reduction payload of a round of fits.
struct FitReduction {
  bool complete = true;
  Index unsolvable = std::numeric_limits<Index>::max();
  void add(FitReduction const& other) {
    complete = complete && other.complete;
    unsolvable = std::min(unsolvable, other.unsolvable);
  }
};

}  // namespace

template <int D>
LocalFits<D>::LocalFits(Points const& X, std::optional<LatticeShape> const& lattice,
                        std::optional<DistributedSlots> const& shared, Blocked blocked)
    : X_(X),
      shared_(shared),
      blocked_(std::move(blocked)),
      rows_(static_cast<Index>(X.size())),
      reach_(X.size(), usual_reach) {
  if (lattice) fit_lattice(*lattice);
  if (!lattice || !usual_) fit_cloud();
}

/// Particles as far from all faces, or out of their reach, have the same neighbours.
template <int D>
void LocalFits<D>::fit_lattice(LatticeShape const& shape) {
  lattice_ = shape;
  representative_ = representatives_in_lattice(shape, beyond_reach);
  kind_.resize(X_.size());
  std::vector<std::size_t> first;  // of each kind
  for (std::size_t a = 0; a < X_.size(); ++a) {
    if (representative(a) == a) {
      kind_[a] = static_cast<std::int32_t>(first.size());
      first.push_back(a);
    } else {
      kind_[a] = kind_[representative(a)];
    }
  }
  if (shared_) rows_ = lattice_rows(shape, usual_reach, own(), first);
  pairs_ = lattice_pairs(shape, usual_reach, rows_);
  pairs_.weight.resize(pairs_.neighbour.size());
  exec_host::parallel_for(rows_.size(), [&](Index row) {
    std::size_t const a = rows_[row];
    auto const from = shape.place(static_cast<Index>(a));
    for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k) {
      auto const to = shape.place(pairs_.neighbour[k]);
      int const i = to[0] - from[0], j = to[1] - from[1], l = to[2] - from[2];
      pairs_.weight[k] = weight_of(i * i + j * j + l * l, usual_reach);
    }
  });
  if (blocked_) {
    double dropped = drop_pairs(pairs_, rows_, blocked_) ? 1 : 0;
    if (shared_) comm::allreduce_max(dropped);
    dropped_ = dropped > 0;
    usual_ = !dropped_;
  }
  inverse_ = LazyZeroArray<double>(first.size() * static_cast<std::size_t>(terms * terms));
  for (std::size_t kind = 0; kind < first.size() && usual_; ++kind) usual_ = fit(first[kind], kind);
}

/// The pairs of a rank's own points and of their neighbours.
template <int D>
void LocalFits<D>::find_cloud() {
  if (shared_) {
    std::vector<bool> mine(X_.size());
    std::fill(mine.begin() + own().first, mine.begin() + own().last, true);
    rows_ = with_neighbours(find_pairs(X_, reach_, IndexSet(mine)), own(), std::vector<bool>(X_.size()));
  }
  pairs_ = find_pairs(X_, reach_, rows_);
  if (blocked_) dropped_ = drop_pairs(pairs_, rows_, blocked_) || dropped_;
  pairs_.weight.resize(pairs_.neighbour.size());
}

template <int D>
bool LocalFits<D>::lengthen(std::vector<char> const& fits) {
  FitReduction said;
  for (Index i = own().first; i < own().last && said.unsolvable > i; ++i) {
    auto const a = static_cast<std::size_t>(i);
    if (fits[a] != 0) continue;
    said.complete = false;
    reach_[a] *= growth;
    if (reach_[a] > longest_reach) said.unsolvable = i;
  }
  if (shared_) {
    comm::allreduce_sum(said);
    if (!said.complete) shared_->complete(reach_, 1);
  }
  if (said.unsolvable < static_cast<Index>(X_.size())) hopeless_ = said.unsolvable;
  return said.complete;
}

template <int D>
bool LocalFits<D>::refine(std::vector<char> const& good) {
  if (lengthen(good)) return true;
  if (hopeless_ < 0) fit_cloud();
  return false;
}

template <int D>
Index LocalFits<D>::enlarged() const {
  return static_cast<Index>(std::count_if(reach_.begin() + own().first, reach_.begin() + own().last,
                                          [](double reach) { return reach > usual_reach; }));
}

template <int D>
void LocalFits<D>::fit_cloud() {
  lattice_.reset();
  representative_.clear();
  kind_.clear();
  rows_ = IndexSet(static_cast<Index>(X_.size()));
  inverse_ = LazyZeroArray<double>(X_.size() * static_cast<std::size_t>(terms * terms));
  std::vector<char> fits(X_.size(), 0);
  for (bool complete = false; !complete && hopeless_ < 0;) {
    find_cloud();
    exec_host::parallel_for(rows_.size(), [&](Index row) {
      std::size_t const a = rows_[row];
      for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k)
        pairs_.weight[k] =
            weight_of(square_of_distance(X_, a, pairs_.at(k)), std::max(reach_[a], reach_[pairs_.at(k)]));
      fits[a] = fit(a, a) ? 1 : 0;
    });
    complete = lengthen(fits);
  }
  usual_ = !dropped_ && std::all_of(reach_.begin(), reach_.end(), [](double reach) { return reach == usual_reach; });
}

template <int D>
std::array<double, 3> LocalFits<D>::difference(std::size_t a, std::size_t b) const {
  std::array<double, 3> r{};
  if (lattice_) {
    auto const from = lattice_->place(static_cast<Index>(a)), to = lattice_->place(static_cast<Index>(b));
    for (std::size_t c = 0; c < D; ++c) r[lattice_->axis[c]] = to[c] - from[c];
  } else {
    for (std::size_t c = 0; c < D; ++c) r[c] = X_[b][c] - X_[a][c];
  }
  return r;
}

template <int D>
double LocalFits<D>::nearness(std::size_t a, std::size_t b) const {
  auto const r = difference(a, b);
  double const reach = std::max(reach_[a], reach_[b]);
  return 1 - (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / (reach * reach);
}

template <int D>
bool LocalFits<D>::sees(std::size_t a, std::size_t b) const {
  if (a == b) return true;
  if (lattice_ || !has(a)) return nearness(a, b) > 1 - nearly * nearly && (!blocked_ || !blocked_(a, b));
  auto const first = pairs_.neighbour.begin() + pairs_.begin[a], end = pairs_.neighbour.begin() + pairs_.begin[a + 1];
  auto const found = std::lower_bound(first, end, static_cast<Index>(b));
  return found != end && *found == static_cast<Index>(b) &&
         pairs_.weight[static_cast<std::size_t>(found - pairs_.neighbour.begin())] > 0;
}

template <int D>
typename LocalFits<D>::Monomials LocalFits<D>::monomials_of(std::size_t a, std::size_t b) const {
  auto const difference_of = difference(a, b);
  Vec<D> r;
  for (int c = 0; c < D; ++c) r[c] = difference_of[static_cast<std::size_t>(c)];
  double p[Quadratic<D>::values];
  monomials<D>(r, p);
  Monomials result;
  std::copy(p + 1, p + 1 + terms, result.begin());
  return result;
}

/// Adds sum_b s p p^T of the first N monomials.
template <int D>
template <int N>
void LocalFits<D>::add_normal_matrix(std::size_t a, double (&A)[N * N]) const {
  for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k) {
    auto const p = monomials_of(a, pairs_.at(k));
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j)
        A[i * N + j] += pairs_.weight[k] * p[static_cast<std::size_t>(i)] * p[static_cast<std::size_t>(j)];
  }
}

template <int D>
bool LocalFits<D>::fit(std::size_t a, std::size_t at) {
  double A[terms * terms]{}, inverse[terms * terms];
  add_normal_matrix<terms>(a, A);
  if (!(invert<terms>(A, inverse) > 1e-12)) return false;
  std::copy(inverse, inverse + terms * terms, inverse_.begin() + static_cast<std::ptrdiff_t>(at * terms * terms));
  return worst_of(at) < worst_condition;
}

template <int D>
double LocalFits<D>::worst_of(std::size_t at) const {
  double worst = 0;
  for (int i = 0; i < terms; ++i)
    worst = std::max(
        worst, inverse_[at * static_cast<std::size_t>(terms * terms) + static_cast<std::size_t>(i * (terms + 1))]);
  return worst;
}

template <int D>
bool LocalFits<D>::fit_linear(std::size_t a) {
  double A[D * D]{}, inverse[D * D];
  add_normal_matrix<D>(a, A);
  double const size = invert<D>(A, inverse);
  for (int i = 0; i < terms; ++i)
    for (int j = 0; j < terms; ++j)
      inverse_[a * static_cast<std::size_t>(terms * terms) + static_cast<std::size_t>(i * terms + j)] =
          i < D && j < D && size > flattest ? inverse[i * D + j] : 0;
  return size > flattest;
}

template <int D>
typename LocalFits<D>::Refit LocalFits<D>::refit(std::size_t a, std::function<bool(std::size_t)> const& is_hidden) {
  bool any_hidden = false, any_changed = false;
  for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k) {
    std::size_t const b = pairs_.at(k);
    bool const hidden = is_hidden(b);
    any_hidden = any_hidden || hidden;
    if (hidden == !(pairs_.weight[k] > 0)) continue;
    any_changed = true;
    pairs_.weight[k] = hidden ? 0 : weight_of(square_of_distance(X_, a, b), std::max(reach_[a], reach_[b]));
  }
  if (!any_changed) return {false, true};
  return {true, (fit(a, a) && (!any_hidden || worst_of(a) < worst_beside_cracks)) || fit_linear(a)};
}

template <int D>
typename LocalFits<D>::Monomials LocalFits<D>::derivatives(std::size_t a, std::size_t pair) const {
  auto const p = monomials_of(a, pairs_.at(pair));
  Monomials e{};
  for (int k = 0; k < terms; ++k) {
    for (int l = 0; l < terms; ++l) e[static_cast<std::size_t>(k)] += inverse(a, k, l) * p[static_cast<std::size_t>(l)];
    e[static_cast<std::size_t>(k)] *= pairs_.weight[pair];
  }
  return e;
}

template class LocalFits<1>;
template class LocalFits<2>;
template class LocalFits<3>;

}  // namespace piola::nodal
