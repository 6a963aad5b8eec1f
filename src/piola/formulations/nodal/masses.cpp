// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/masses.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/math/solve.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr double reach = 3;  ///< of what a cell hands to its neighbours
constexpr double smallest_pivot = 1e-10;
constexpr double restraint = 0.9;  ///< a cell that makes another too light hands out this share of before
constexpr int most_rounds = 400;

template <int D>
struct Exchange {
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

/// phi_ab = w p . A^-1 T_a: what gives the cell's moments up to the second, for fields that are exact at a itself.
template <int D>
void hand_over_cell(Points const& X, ScaledCell const& cell, std::size_t a, Exchange<D>& x) {
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

/// What all cells hand over; of a lattice each kind of cell once.
template <int D>
Exchange<D> hand_over(Points const& X, std::vector<ScaledCell> const& cells,
                      std::optional<LatticeShape> const& lattice) {
  Exchange<D> x{lattice ? lattice_pairs(*lattice, reach) : find_pairs(X, std::vector<double>(X.size(), reach)), {}};
  x.handed.assign(x.pairs.neighbour.size(), 0);
  std::vector<Index> const alike =
      lattice ? alike_in_lattice(*lattice, static_cast<int>(reach)) : std::vector<Index>();  // at `reach` there is none
  auto const is_first = [&](Index a) { return !lattice || alike[static_cast<std::size_t>(a)] == a; };
  auto const particles = static_cast<Index>(X.size());
  exec_host::for_each_in_set_up(particles, [&](Index a) {
    auto const k = static_cast<std::size_t>(a);
    if (is_first(a)) hand_over_cell<D>(X, cells[k], k, x);
  });
  exec_host::for_each_in_set_up(particles, [&](Index a) {
    if (is_first(a)) return;
    auto const from = static_cast<std::size_t>(alike[static_cast<std::size_t>(a)]);
    std::copy(x.handed.begin() + static_cast<std::ptrdiff_t>(x.pairs.first(from)),
              x.handed.begin() + static_cast<std::ptrdiff_t>(x.pairs.end(from)),
              x.handed.begin() + static_cast<std::ptrdiff_t>(x.pairs.first(static_cast<std::size_t>(a))));
  });
  return x;
}

/// Masses from what cells hand over, and the cells that are restrained until none of them makes a particle too light.
class Restraint {
 public:
  Restraint(Pairs const& pairs, std::vector<double> const& handed, std::vector<ScaledCell> const& cells, double least)
      : pairs_(pairs), handed_(handed), cells_(cells), least_(least), theta_(cells.size(), 1), mass_(cells.size()) {
    for (std::size_t a = 0; a < mass_.size(); ++a) mass_[a] = cells[a].volume;
    scatter_in_order(static_cast<Index>(mass_.size()), pairs.farthest(), [&](std::size_t a, auto const& mine) {
      bool const own = mine(a);
      for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
        if (mine(pairs.at(k))) mass_[pairs.at(k)] += handed[k];
        if (own) mass_[a] -= handed[k];
      }
    });
  }

  std::vector<double> operator()() {
    std::vector<std::size_t> light, next;
    for (std::size_t b = 0; b < mass_.size(); ++b)
      if (is_light(b)) light.push_back(b);
    for (int round = 0; round < most_rounds && !light.empty(); ++round) {
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
  bool is_light(std::size_t b) const { return mass_[b] < least_ * cells_[b].volume; }

  /// m_b anew.
  void add(std::size_t b) {
    double sum = cells_[b].volume;
    for (std::size_t k = pairs_.first(b); k < pairs_.end(b); ++k)
      sum += theta_[pairs_.at(k)] * handed_[opposite(b, k)] - theta_[b] * handed_[k];
    mass_[b] = sum;
  }
  /// Of the pair k of b the entry of the other particle. Neighbours are in increasing order.
  std::size_t opposite(std::size_t b, std::size_t k) const {
    auto const a = pairs_.at(k);
    auto const first = pairs_.neighbour.begin() + static_cast<std::ptrdiff_t>(pairs_.first(a));
    auto const last = pairs_.neighbour.begin() + static_cast<std::ptrdiff_t>(pairs_.end(a));
    return static_cast<std::size_t>(std::lower_bound(first, last, static_cast<Index>(b)) - pairs_.neighbour.begin());
  }
  /// Lowers theta of the cells that draw from the light particles, their own included; returns the particles whose mass
  /// that changes, in increasing order.
  std::vector<std::size_t> restrain(std::vector<std::size_t> const& light) {
    std::vector<std::size_t> cells = light;
    for (std::size_t const b : light)
      for (std::size_t k = pairs_.first(b); k < pairs_.end(b); ++k)
        if (handed_[opposite(b, k)] < 0) cells.push_back(pairs_.at(k));
    make_unique(cells);
    std::vector<std::size_t> changed = cells;
    for (std::size_t const a : cells) {
      theta_[a] *= restraint;
      for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k) changed.push_back(pairs_.at(k));
    }
    make_unique(changed);
    return changed;
  }
  static void make_unique(std::vector<std::size_t>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
  }

  Pairs const& pairs_;
  std::vector<double> const& handed_;  ///< V_a phi_ab, per pair of a
  std::vector<ScaledCell> const& cells_;
  double least_;
  std::vector<double> theta_, mass_;
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

/// Where cells were restrained the moments of the masses are no longer those of the body. A factor that is quadratic in
/// space brings them back: m (1 + c.p(X)) with the 1 + D (D + 3) / 2 coefficients that make all moments up to the
/// second exact. Bodies too thin for one are left as they are, and so are those where it would change a mass by more
/// than a fifth. Not for lattices: there the moments are off by less, and a stiffness that is too large by as much goes
/// with them.
template <int D>
void match_moments(Points const& X, std::vector<ScaledCell> const& cells, std::vector<double>& mass) {
  constexpr int n = BodyMonomials<D>::count;
  constexpr double most = 0.2;
  BodyMonomials<D> const monomials(X);
  double A[n * n]{}, c[n]{}, p[n];
  for (std::size_t b = 0; b < mass.size(); ++b) {
    monomials.over(X[b], cells[b], p);
    for (int i = 0; i < n; ++i) c[i] += cells[b].volume * p[i];
    monomials.over(X[b], {}, p);
    for (int i = 0; i < n; ++i) {
      c[i] -= mass[b] * p[i];
      for (int j = 0; j < n; ++j) A[i * n + j] += mass[b] * p[i] * p[j];
    }
  }
  if (!(solve_in_place<n>(A, c) > smallest_pivot)) return;
  std::vector<double> factor(mass.size(), 1);
  for (std::size_t b = 0; b < mass.size(); ++b) {
    monomials.over(X[b], {}, p);
    for (int i = 0; i < n; ++i) factor[b] += c[i] * p[i];
    if (!(std::fabs(factor[b] - 1) < most)) return;
  }
  for (std::size_t b = 0; b < mass.size(); ++b) mass[b] *= factor[b];
}

}  // namespace

template <int D>
std::vector<double> exact_masses(Points const& X, std::vector<ScaledCell> const& cells, double least,
                                 std::optional<LatticeShape> const& lattice, bool match) {
  auto const x = hand_over<D>(X, cells, lattice);
  std::vector<double> mass = Restraint(x.pairs, x.handed, cells, least)();
  if (match) match_moments<D>(X, cells, mass);
  return mass;
}

template std::vector<double> exact_masses<1>(Points const&, std::vector<ScaledCell> const&, double,
                                             std::optional<LatticeShape> const&, bool);
template std::vector<double> exact_masses<2>(Points const&, std::vector<ScaledCell> const&, double,
                                             std::optional<LatticeShape> const&, bool);
template std::vector<double> exact_masses<3>(Points const&, std::vector<ScaledCell> const&, double,
                                             std::optional<LatticeShape> const&, bool);

}  // namespace piola::nodal
