// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/masses.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/halo_plan.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/solve.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr double reach = 3;  ///< range of the transfers of a cell
constexpr double smallest_pivot = 1e-10;
constexpr double restraint = 0.9;  ///< factor on the transfers of a cell that makes a particle too light
constexpr int most_rounds = 400;

template <int D>
struct MassTransfer {
  IndexSet rows;  ///< with pairs on this rank
  Pairs pairs;
  std::vector<double> handed;  ///< V_a phi_ab, per pair of a
};

/// Integrals of the monomials over the cell, over its volume.
template <int D>
void cell_monomials(ScaledCell const& cell, double (&T)[Quadratic<D>::terms]) {
  for (int i = 0; i < D; ++i) {
    T[i] = cell.centroid[static_cast<std::size_t>(i)];
    for (int j = i; j < D; ++j) {
      auto const moment = static_cast<std::size_t>(i == j ? i : 6 - i - j);
      double const whole =
          cell.spread[moment] + cell.centroid[static_cast<std::size_t>(i)] * cell.centroid[static_cast<std::size_t>(j)];
      T[D + Quadratic<D>::at(i, j)] = i == j ? 0.5 * whole : whole;
    }
  }
}

/// phi_ab = w p . A^-1 T_a: reproduces the cell's moments up to the second, for fields that are exact at a itself.
template <int D>
void transfer_masses_of_cell(Points const& X, ScaledCell const& cell, std::size_t a, MassTransfer<D>& x) {
  constexpr int terms = Quadratic<D>::terms;
  double A[terms * terms]{}, T[terms];
  std::vector<std::array<double, static_cast<std::size_t>(terms)>> of_pair;
  for (std::size_t k = x.pairs.first(a); k < x.pairs.end(a); ++k) {
    Vec<D> r;
    for (int c = 0; c < D; ++c)
      r[c] = X[x.pairs.at(k)][static_cast<std::size_t>(c)] - X[a][static_cast<std::size_t>(c)];
    double p[Quadratic<D>::values];
    monomials<D>(r, p);
    double const square = dot(r, r), inside = 1 - square / (reach * reach);
    x.handed[k] = inside * inside / (square * square);
    of_pair.emplace_back();
    for (int i = 0; i < terms; ++i) {
      of_pair.back()[static_cast<std::size_t>(i)] = p[1 + i];
      for (int j = 0; j <= i; ++j) A[i * terms + j] += x.handed[k] * p[1 + i] * p[1 + j];
    }
  }
  for (int i = 0; i < terms; ++i)
    for (int j = 0; j < i; ++j) A[j * terms + i] = A[i * terms + j];
  cell_monomials<D>(cell, T);
  bool const good = solve_in_place<terms>(A, T) > smallest_pivot;
  for (std::size_t k = 0; k < of_pair.size(); ++k) {
    double sum = 0;
    for (int i = 0; i < terms; ++i) sum += of_pair[k][static_cast<std::size_t>(i)] * T[i];
    x.handed[x.pairs.first(a) + k] *= good ? cell.volume * sum : 0;
  }
}

/// The pairs of the particles of this rank and of their neighbours.
template <int D>
MassTransfer<D> pairs_in_reach(Points const& X, std::vector<Index> const& representatives, MassInput const& of) {
  MassTransfer<D> x{IndexSet(static_cast<Index>(X.size())), {}, {}};
  if (of.lattice) {
    std::vector<std::size_t> first;
    for (std::size_t a = 0; a < representatives.size(); ++a)
      if (representatives[a] == static_cast<Index>(a)) first.push_back(a);
    if (of.shared) x.rows = lattice_rows(*of.lattice, reach, of.shared->own(), first);
    x.pairs = lattice_pairs(*of.lattice, reach, x.rows);
    return x;
  }
  std::vector<double> const same(X.size(), reach);
  if (of.shared) {
    Range const own = of.shared->own();
    std::vector<bool> mine(X.size());
    std::fill(mine.begin() + own.first, mine.begin() + own.last, true);
    x.rows = with_neighbours(find_pairs(X, same, IndexSet(mine)), own, std::vector<bool>(X.size()));
  }
  x.pairs = find_pairs(X, same, x.rows);
  return x;
}

/// Transfers between cells; on a lattice once per kind of cell.
template <int D>
MassTransfer<D> transfer_masses(Points const& X, LazyZeroArray<ScaledCell> const& cells, MassInput const& of) {
  std::vector<Index> const representatives = of.lattice
                                                 ? representatives_in_lattice(*of.lattice, static_cast<int>(reach))
                                                 : std::vector<Index>();  // at `reach` there is none
  MassTransfer<D> x = pairs_in_reach<D>(X, representatives, of);
  x.handed.assign(x.pairs.neighbour.size(), 0);
  auto const is_first = [&](std::size_t a) { return !of.lattice || representatives[a] == static_cast<Index>(a); };
  exec_host::parallel_for(x.rows.size(), [&](Index row) {
    std::size_t const a = x.rows[row];
    if (is_first(a)) transfer_masses_of_cell<D>(X, cells[a], a, x);
  });
  exec_host::parallel_for(x.rows.size(), [&](Index row) {
    std::size_t const a = x.rows[row];
    if (is_first(a)) return;
    auto const from = static_cast<std::size_t>(representatives[a]);
    std::copy(x.handed.begin() + static_cast<std::ptrdiff_t>(x.pairs.first(from)),
              x.handed.begin() + static_cast<std::ptrdiff_t>(x.pairs.end(from)),
              x.handed.begin() + static_cast<std::ptrdiff_t>(x.pairs.first(a)));
  });
  return x;
}

/// Computes particle masses from the transfers between cells and limits the transfers iteratively (factor theta per
/// cell) until no mass is below `least` times that of its cell. One halo exchange of flags per round.
class MassLimiter {
 public:
  template <int D>
  MassLimiter(MassTransfer<D> const& x, LazyZeroArray<ScaledCell> const& cells, MassInput const& of)
      : pairs_(x.pairs),
        handed_(x.handed),
        cells_(cells),
        least_(of.least),
        own_(of.shared ? of.shared->own() : Range{0, static_cast<Index>(cells.size())}),
        theta_(cells.size()),
        marked_(cells.size()),
        mass_(cells.size()) {
    if (of.shared) {
      halo_.emplace(of.shared->slots, ghost_neighbours(pairs_, own_));
      halo_->add(field_of(theta_), 0, 1);
      halo_->add(field_of(marked_), 0, 1);
    }
    for (Index row = 0; row < x.rows.size(); ++row) theta_[x.rows[row]] = 1;
    Pairs const& pairs = x.pairs;
    std::vector<double> const& handed = x.handed;
    for (auto a = own_.first; a < own_.last; ++a)
      mass_[static_cast<std::size_t>(a)] = cells[static_cast<std::size_t>(a)].volume;
    scatter_in_order(own_, x.rows, pairs.farthest(), [&](std::size_t a, auto const& mine) {
      bool const own = mine(a);
      for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
        if (mine(pairs.at(k))) mass_[pairs.at(k)] += handed[k];
        if (own) mass_[a] -= handed[k];
      }
    });
  }

  LazyZeroArray<double> operator()() {
    std::vector<std::size_t> light, next;
    for (auto b = static_cast<std::size_t>(own_.first); b < static_cast<std::size_t>(own_.last); ++b)
      if (is_light(b)) light.push_back(b);
    for (int round = 0; round < most_rounds && any_on_ranks(light); ++round) {
      std::vector<std::size_t> changed = restrain(light);
      next.clear();
      for (std::size_t const b : changed) add(b);
      for (std::size_t const b : changed)
        if (is_light(b)) next.push_back(b);
      light.swap(next);
    }
    return std::move(mass_);
  }

 private:
  static FieldRef field_of(LazyZeroArray<double>& values) { return {.data = values.data()}; }
  bool is_local(std::size_t a) const {
    return a >= static_cast<std::size_t>(own_.first) && a < static_cast<std::size_t>(own_.last);
  }
  bool any_on_ranks(std::vector<std::size_t> const& some) const {
    double any = some.empty() ? 0 : 1;
    if (halo_) comm::allreduce_max(any);
    return any > 0;
  }
  /// Extends a list of local particles by the ghosts that other ranks list.
  std::vector<std::size_t> with_ghosts(std::vector<std::size_t> all) {
    if (!halo_) return all;
    for (std::size_t const a : all) marked_[a] = 1;
    halo_->exchange(std::array{field_of(theta_), field_of(marked_)});
    for (std::size_t const a : all) marked_[a] = 0;
    for (Index const a : halo_->received())
      if (marked_[static_cast<std::size_t>(a)] != 0) all.push_back(static_cast<std::size_t>(a));
    return all;
  }
  bool is_light(std::size_t b) const { return mass_[b] < least_ * cells_[b].volume; }

  /// Recomputes m_b.
  void add(std::size_t b) {
    double sum = cells_[b].volume;
    for (std::size_t k = pairs_.first(b); k < pairs_.end(b); ++k)
      sum += theta_[pairs_.at(k)] * handed_[opposite(b, k)] - theta_[b] * handed_[k];
    mass_[b] = sum;
  }
  /// Index of the pair k of b in the list of the other particle. Neighbours are in increasing order.
  std::size_t opposite(std::size_t b, std::size_t k) const {
    auto const a = pairs_.at(k);
    auto const first = pairs_.neighbour.begin() + static_cast<std::ptrdiff_t>(pairs_.first(a));
    auto const last = pairs_.neighbour.begin() + static_cast<std::ptrdiff_t>(pairs_.end(a));
    return static_cast<std::size_t>(std::lower_bound(first, last, static_cast<Index>(b)) - pairs_.neighbour.begin());
  }
  /// Lowers theta of the cells that draw from the light particles, their own included; returns the particles whose mass
  /// changes by this, in increasing order.
  std::vector<std::size_t> restrain(std::vector<std::size_t> const& light) {
    std::vector<std::size_t> cells = light;
    for (std::size_t const b : with_ghosts(light))
      for (std::size_t k = pairs_.first(b); k < pairs_.end(b); ++k)
        if (is_local(pairs_.at(k)) && handed_[opposite(b, k)] < 0) cells.push_back(pairs_.at(k));
    make_unique(cells);
    for (std::size_t const a : cells) theta_[a] *= restraint;
    std::vector<std::size_t> changed = cells;
    for (std::size_t const a : with_ghosts(cells))
      for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k)
        if (is_local(pairs_.at(k))) changed.push_back(pairs_.at(k));
    make_unique(changed);
    return changed;
  }
  static void make_unique(std::vector<std::size_t>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
  }

  Pairs const& pairs_;
  std::vector<double> const& handed_;  ///< V_a phi_ab, per pair of a
  LazyZeroArray<ScaledCell> const& cells_;
  double least_;
  Range own_;
  LazyZeroArray<double> theta_;   ///< remaining fraction of the transfers of a cell
  LazyZeroArray<double> marked_;  ///< 1 during an exchange for light particles or restrained cells
  LazyZeroArray<double> mass_;
  std::optional<HaloPlan> halo_;
};

/// 1, x, xx of a place in units of the body, and their means over a cell.
template <int D>
class BodyMonomials {
 public:
  static constexpr int count = 1 + Quadratic<D>::terms;

  BodyMonomials(Points const& X) {
    for (std::size_t c = 0; c < D; ++c) {
      auto const [low, high] =
          std::minmax_element(X.begin(), X.end(), [c](auto const& a, auto const& b) { return a[c] < b[c]; });
      middle_[c] = 0.5 * ((*low)[c] + (*high)[c]);
      half_[c] = std::max(0.5 * ((*high)[c] - (*low)[c]), 0.5);
    }
  }
  void over(std::array<double, 3> const& X, ScaledCell const& cell, double (&p)[count]) const {
    p[0] = 1;
    for (int i = 0; i < D; ++i) {
      auto const c = static_cast<std::size_t>(i);
      p[1 + i] = (X[c] + cell.centroid[c] - middle_[c]) / half_[c];
    }
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) {
        auto const moment = static_cast<std::size_t>(i == j ? i : 6 - i - j);
        p[1 + D + Quadratic<D>::at(i, j)] =
            p[1 + i] * p[1 + j] +
            cell.spread[moment] / (half_[static_cast<std::size_t>(i)] * half_[static_cast<std::size_t>(j)]);
      }
  }

 private:
  std::array<double, 3> middle_{}, half_{1, 1, 1};
};

/// Restores the moments of the masses after cells were restrained, by a factor that is quadratic in space: m (1 +
/// c.p(X)) with the 1 + D (D + 3) / 2 coefficients that make all moments up to the second exact. Bodies too thin for
/// one are unchanged, and so are those with a mass change above a fifth. Not for lattices: their moments are less
/// inexact, and a stiffness that is too large by as much compensates them.
template <int D>
void match_moments(Points const& X, LazyZeroArray<ScaledCell> const& cells, Range own, bool shared,
                   LazyZeroArray<double>& mass) {
  constexpr int n = BodyMonomials<D>::count;
  constexpr double most = 0.2;
  BodyMonomials<D> const monomials(X);
  // The matrix, then the right-hand side of cells, then that of masses.
  auto const sums = sums_over_slots<n*(n + 2)>(shared, own, [&](Index particle, double* sum) {
    auto const b = static_cast<std::size_t>(particle);
    double p[n];
    monomials.over(X[b], cells[b], p);
    for (int i = 0; i < n; ++i) sum[n * n + i] = cells[b].volume * p[i];
    monomials.over(X[b], {}, p);
    for (int i = 0; i < n; ++i) {
      sum[n * n + n + i] = mass[b] * p[i];
      for (int j = 0; j < n; ++j) sum[i * n + j] = mass[b] * p[i] * p[j];
    }
  });
  double A[n * n], c[n];
  for (int k = 0; k < n * n; ++k) A[k] = sums.value(k);
  for (int i = 0; i < n; ++i) c[i] = sums.value(n * n + i) - sums.value(n * n + n + i);
  if (!(solve_in_place<n>(A, c) > smallest_pivot)) return;
  auto const factor = [&](std::size_t b) {
    double p[n], sum = 1;
    monomials.over(X[b], {}, p);
    for (int i = 0; i < n; ++i) sum += c[i] * p[i];
    return sum;
  };
  auto const first = static_cast<std::size_t>(own.first), last = static_cast<std::size_t>(own.last);
  double change = 0;
  for (std::size_t b = first; b < last; ++b) comm::max_or_nan(std::fabs(factor(b) - 1), change);
  if (shared) comm::allreduce_max(change);
  if (!(change < most)) return;
  for (std::size_t b = first; b < last; ++b) mass[b] *= factor(b);
}

}  // namespace

template <int D>
LazyZeroArray<double> exact_masses(Points const& X, LazyZeroArray<ScaledCell> const& cells, MassInput const& of) {
  PIOLA_EXPECTS(cells.size() == X.size());
  auto const x = transfer_masses<D>(X, cells, of);
  LazyZeroArray<double> mass = MassLimiter(x, cells, of)();
  Range const own = of.shared ? of.shared->own() : Range{0, static_cast<Index>(X.size())};
  if (of.match) match_moments<D>(X, cells, own, of.shared.has_value(), mass);
  return mass;
}

template LazyZeroArray<double> exact_masses<1>(Points const&, LazyZeroArray<ScaledCell> const&, MassInput const&);
template LazyZeroArray<double> exact_masses<2>(Points const&, LazyZeroArray<ScaledCell> const&, MassInput const&);
template LazyZeroArray<double> exact_masses<3>(Points const&, LazyZeroArray<ScaledCell> const&, MassInput const&);

}  // namespace piola::nodal
