// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/masses.hpp"
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

/// phi_ab = w p . A^-1 T_a: what gives the cell's moments up to the second, for fields that are exact at a itself.
template <int D>
Exchange<D> hand_over(Points const& X, std::vector<ScaledCell> const& cells) {
  constexpr int terms = Quadratic<D>::terms;
  Exchange<D> x{find_pairs(X, std::vector<double>(X.size(), reach)), {}};
  x.handed.assign(x.pairs.neighbour.size(), 0);
  std::vector<std::array<double, static_cast<std::size_t>(terms)>> of_pair;
  for (std::size_t a = 0; a < X.size(); ++a) {
    double A[terms * terms]{}, T[terms]{};
    of_pair.clear();
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
        for (int j = 0; j < terms; ++j) A[i * terms + j] += x.handed[k] * p[1 + i] * p[1 + j];
      }
    }
    auto const& cell = cells[a];
    for (int i = 0; i < D; ++i) {
      T[i] = cell.centroid[static_cast<std::size_t>(i)];
      for (int j = i; j < D; ++j) {
        auto const moment = static_cast<std::size_t>(i == j ? i : 6 - i - j);
        double const whole = cell.spread[moment] +
                             cell.centroid[static_cast<std::size_t>(i)] * cell.centroid[static_cast<std::size_t>(j)];
        T[D + Quadratic<D>::at(i, j)] = i == j ? 0.5 * whole : whole;
      }
    }
    bool const good = solve_in_place<terms>(A, T) > smallest_pivot;
    for (std::size_t k = 0; k < of_pair.size(); ++k) {
      double sum = 0;
      for (int i = 0; i < terms; ++i) sum += of_pair[k][static_cast<std::size_t>(i)] * T[i];
      x.handed[x.pairs.first(a) + k] *= good ? cell.volume * sum : 0;
    }
  }
  return x;
}

}  // namespace

template <int D>
std::vector<double> exact_masses(Points const& X, std::vector<ScaledCell> const& cells, double least) {
  auto const x = hand_over<D>(X, cells);
  std::vector<double> theta(X.size(), 1), mass(X.size());
  for (int round = 0; round < most_rounds; ++round) {
    for (std::size_t a = 0; a < X.size(); ++a) mass[a] = cells[a].volume;
    for (std::size_t a = 0; a < X.size(); ++a)
      for (std::size_t k = x.pairs.first(a); k < x.pairs.end(a); ++k) {
        mass[x.pairs.at(k)] += theta[a] * x.handed[k];
        mass[a] -= theta[a] * x.handed[k];
      }
    auto const light = [&](std::size_t b) { return mass[b] < least * cells[b].volume; };
    bool done = true;
    for (std::size_t a = 0; a < X.size(); ++a) {
      bool restrain = light(a);
      for (std::size_t k = x.pairs.first(a); k < x.pairs.end(a) && !restrain; ++k)
        restrain = x.handed[k] < 0 && light(x.pairs.at(k));
      if (!restrain) continue;
      theta[a] *= restraint;
      done = false;
    }
    if (done) break;
  }
  return mass;
}

template std::vector<double> exact_masses<1>(Points const&, std::vector<ScaledCell> const&, double);
template std::vector<double> exact_masses<2>(Points const&, std::vector<ScaledCell> const&, double);
template std::vector<double> exact_masses<3>(Points const&, std::vector<ScaledCell> const&, double);

}  // namespace piola::nodal
