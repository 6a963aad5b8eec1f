// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/fit.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr double usual_reach = 2.4;  ///< 56 neighbours inside a cubic lattice
constexpr double longest_reach = 5;  ///< beyond it a body has too few particles across
constexpr double growth = 1.2;
/// Largest admissible entry on the diagonal of A^-1: 72 in a lattice, 180 with a jitter of 0.2.
constexpr double worst_condition = 1e4;
/// Neighbours of a lattice at exactly the reach do not count, whatever the round-off of their positions.
constexpr double edge = 1 - 1e-9;

double square_of_distance(Points const& X, std::size_t a, std::size_t b) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) square += (X[b][c] - X[a][c]) * (X[b][c] - X[a][c]);
  return square;
}

double weight_of(double square, double reach) {
  double const inside = 1 - square / (reach * reach);
  return inside * inside / (square * std::sqrt(square));
}

}  // namespace

Pairs find_pairs(Points const& X, std::vector<double> const& reach) {
  Pairs pairs;
  pairs.begin.push_back(0);
  if (X.empty()) return pairs;
  CellGrid const grid(X, *std::max_element(reach.begin(), reach.end()));
  std::vector<Index> near;
  for (std::size_t a = 0; a < X.size(); ++a) {
    near.clear();
    grid.visit(X[a], [&](Index other) {
      auto const b = static_cast<std::size_t>(other);
      double const longest = edge * std::max(reach[a], reach[b]);
      if (b != a && square_of_distance(X, a, b) < longest * longest) near.push_back(other);
    });
    std::sort(near.begin(), near.end());
    pairs.neighbour.insert(pairs.neighbour.end(), near.begin(), near.end());
    pairs.begin.push_back(static_cast<std::int64_t>(pairs.neighbour.size()));
  }
  return pairs;
}

template <int D>
Fits<D>::Fits(Points const& X) : X_(X), reach_(X.size(), usual_reach) {
  inverse_.resize(X.size() * static_cast<std::size_t>(terms * terms));
  for (bool complete = false; !complete && hopeless_ < 0;) {
    complete = true;
    pairs_ = find_pairs(X_, reach_);
    pairs_.weight.resize(pairs_.neighbour.size());
    for (std::size_t a = 0; a < X_.size(); ++a)
      for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k)
        pairs_.weight[k] =
            weight_of(square_of_distance(X_, a, pairs_.at(k)), std::max(reach_[a], reach_[pairs_.at(k)]));
    for (std::size_t a = 0; a < X_.size() && hopeless_ < 0; ++a) {
      if (fit(a)) continue;
      complete = false;
      reach_[a] *= growth;
      if (reach_[a] > longest_reach) hopeless_ = static_cast<Index>(a);
    }
  }
}

template <int D>
typename Fits<D>::Monomials Fits<D>::monomials_of(std::size_t a, std::size_t b) const {
  Vec<D> r;
  for (int c = 0; c < D; ++c) r[c] = X_[b][static_cast<std::size_t>(c)] - X_[a][static_cast<std::size_t>(c)];
  double p[Quadratic<D>::values];
  monomials<D>(r, p);
  Monomials result;
  std::copy(p + 1, p + 1 + terms, result.begin());
  return result;
}

template <int D>
bool Fits<D>::fit(std::size_t a) {
  double A[terms * terms]{}, inverse[terms * terms];
  for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k) {
    auto const p = monomials_of(a, pairs_.at(k));
    for (int i = 0; i < terms; ++i)
      for (int j = 0; j < terms; ++j)
        A[i * terms + j] += pairs_.weight[k] * p[static_cast<std::size_t>(i)] * p[static_cast<std::size_t>(j)];
  }
  if (!(invert<terms>(A, inverse) > 1e-12)) return false;
  double worst = 0;
  for (int i = 0; i < terms; ++i) worst = std::max(worst, inverse[i * terms + i]);
  std::copy(inverse, inverse + terms * terms, inverse_.begin() + static_cast<std::ptrdiff_t>(a * terms * terms));
  return worst < worst_condition;
}

template <int D>
typename Fits<D>::Monomials Fits<D>::derivatives(std::size_t a, std::size_t pair) const {
  auto const p = monomials_of(a, pairs_.at(pair));
  Monomials e{};
  for (int k = 0; k < terms; ++k) {
    for (int l = 0; l < terms; ++l) e[static_cast<std::size_t>(k)] += inverse(a, k, l) * p[static_cast<std::size_t>(l)];
    e[static_cast<std::size_t>(k)] *= pairs_.weight[pair];
  }
  return e;
}

template <int D>
double Fits<D>::own_weight(std::size_t a) const {
  return weight_of(1, reach_[a]);
}

template class Fits<1>;
template class Fits<2>;
template class Fits<3>;

}  // namespace piola::nodal
