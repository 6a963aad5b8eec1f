// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/fit.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

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

Index Pairs::farthest() const {
  Index most = 0;
  for (std::size_t a = 0; a + 1 < begin.size(); ++a)
    if (first(a) < end(a))  // in increasing order
      most =
          std::max({most, static_cast<Index>(a) - neighbour[first(a)], neighbour[end(a) - 1] - static_cast<Index>(a)});
  return most;
}

Pairs find_pairs(Points const& X, std::vector<double> const& reach) {
  Pairs pairs;
  pairs.begin.push_back(0);
  if (X.empty()) return pairs;
  CellGrid const grid(X, *std::max_element(reach.begin(), reach.end()));
  auto const particles = static_cast<Index>(X.size());
  constexpr Index part_size = 4096;
  Index const parts = (particles + part_size - 1) / part_size;
  std::vector<std::vector<Index>> found(static_cast<std::size_t>(parts));
  pairs.begin.assign(X.size() + 1, 0);
  auto const each_part = [&](auto const& f) {
    exec_host::for_each_part_in_set_up(parts, particles, [&](Index part) {
      f(found[static_cast<std::size_t>(part)], static_cast<std::size_t>(part) * part_size,
        static_cast<std::size_t>(std::min((part + 1) * part_size, particles)));
    });
  };
  each_part([&](std::vector<Index>& near, std::size_t first, std::size_t end) {
    for (std::size_t a = first; a < end; ++a) {
      auto const before = std::ssize(near);
      grid.visit(X[a], [&](Index other) {
        auto const b = static_cast<std::size_t>(other);
        double const longest = edge * std::max(reach[a], reach[b]);
        if (b != a && square_of_distance(X, a, b) < longest * longest) near.push_back(other);
      });
      std::sort(near.begin() + before, near.end());
      pairs.begin[a + 1] = std::ssize(near) - before;
    }
  });
  for (std::size_t a = 0; a < X.size(); ++a) pairs.begin[a + 1] += pairs.begin[a];
  pairs.neighbour.resize(static_cast<std::size_t>(pairs.begin.back()));
  each_part([&](std::vector<Index> const& near, std::size_t first, std::size_t) {
    std::copy(near.begin(), near.end(), pairs.neighbour.begin() + pairs.begin[first]);
  });
  return pairs;
}

Pairs lattice_pairs(LatticeShape const& shape, double reach) {
  std::vector<std::array<int, 3>> offsets;  // in the order of slots
  int const steps = static_cast<int>(reach);
  for (int k = -steps; k <= steps; ++k)
    for (int j = -steps; j <= steps; ++j)
      for (int i = -steps; i <= steps; ++i) {
        int const square = i * i + j * j + k * k;
        if (square > 0 && square < edge * reach * reach) offsets.push_back({i, j, k});
      }
  Pairs pairs;
  Index const particles = shape.count[0] * shape.count[1] * shape.count[2];
  // f(neighbour) for all neighbours of a.
  auto const each_neighbour = [&](Index a, auto const& f) {
    auto const at = shape.place(a);
    for (auto const& o : offsets) {
      std::array const to{at[0] + o[0], at[1] + o[1], at[2] + o[2]};
      if (shape.has(to)) f(shape.slot(to));
    }
  };
  pairs.begin.assign(static_cast<std::size_t>(particles) + 1, 0);
  exec_host::for_each_in_set_up(
      particles, [&](Index a) { each_neighbour(a, [&](Index) { ++pairs.begin[static_cast<std::size_t>(a) + 1]; }); });
  for (std::size_t a = 0; a < static_cast<std::size_t>(particles); ++a) pairs.begin[a + 1] += pairs.begin[a];
  pairs.neighbour.resize(static_cast<std::size_t>(pairs.begin.back()));
  exec_host::for_each_in_set_up(particles, [&](Index a) {
    auto to = pairs.neighbour.begin() + pairs.begin[static_cast<std::size_t>(a)];
    each_neighbour(a, [&](Index b) { *to++ = b; });
  });
  return pairs;
}

std::vector<Index> alike_in_lattice(LatticeShape const& shape, int beyond) {
  auto const most = static_cast<std::size_t>(beyond);
  std::vector<Index> known(most * most * most * most * most * most, -1);
  std::vector<Index> alike(static_cast<std::size_t>(shape.count[0] * shape.count[1] * shape.count[2]));
  for (std::size_t a = 0; a < alike.size(); ++a) {
    auto const at = shape.place(static_cast<Index>(a));
    std::size_t kind = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (int const distance : {at[c], shape.count[c] - 1 - at[c]})
        kind = kind * most + static_cast<std::size_t>(std::min(distance, beyond - 1));
    if (known[kind] < 0) known[kind] = static_cast<Index>(a);
    alike[a] = known[kind];
  }
  return alike;
}

template <int D>
Fits<D>::Fits(Points const& X, std::optional<LatticeShape> const& lattice) : X_(X), reach_(X.size(), usual_reach) {
  if (lattice) fit_lattice(*lattice);
  if (!lattice || !usual_) fit_cloud();
}

/// Particles as far from all faces, or out of their reach, have the same neighbours.
template <int D>
void Fits<D>::fit_lattice(LatticeShape const& shape) {
  pairs_ = lattice_pairs(shape, usual_reach);
  pairs_.weight.resize(pairs_.neighbour.size());
  exec_host::for_each_in_set_up(static_cast<Index>(X_.size()), [&](Index particle) {
    auto const from = shape.place(particle);
    for (std::size_t k = pairs_.first(static_cast<std::size_t>(particle));
         k < pairs_.end(static_cast<std::size_t>(particle)); ++k) {
      auto const to = shape.place(pairs_.neighbour[k]);
      int const i = to[0] - from[0], j = to[1] - from[1], l = to[2] - from[2];
      pairs_.weight[k] = weight_of(i * i + j * j + l * l, usual_reach);
    }
  });
  alike_ = alike_in_lattice(shape, static_cast<int>(usual_reach) + 1);
  kind_.resize(X_.size());
  std::vector<std::size_t> first;  // of each kind
  for (std::size_t a = 0; a < X_.size(); ++a) {
    if (alike(a) == a) {
      kind_[a] = static_cast<std::int32_t>(first.size());
      first.push_back(a);
    } else {
      kind_[a] = kind_[alike(a)];
    }
  }
  inverse_.resize(first.size() * static_cast<std::size_t>(terms * terms));
  for (std::size_t kind = 0; kind < first.size() && usual_; ++kind) usual_ = fit(first[kind], kind);
}

template <int D>
void Fits<D>::fit_cloud() {
  usual_ = true;
  alike_.clear();
  kind_.clear();
  inverse_.assign(X_.size() * static_cast<std::size_t>(terms * terms), 0);
  auto const particles = static_cast<Index>(X_.size());
  std::vector<char> fits(X_.size(), 0);
  for (bool complete = false; !complete && hopeless_ < 0;) {
    complete = true;
    pairs_ = find_pairs(X_, reach_);
    pairs_.weight.resize(pairs_.neighbour.size());
    exec_host::for_each_in_set_up(particles, [&](Index particle) {
      auto const a = static_cast<std::size_t>(particle);
      for (std::size_t k = pairs_.first(a); k < pairs_.end(a); ++k)
        pairs_.weight[k] =
            weight_of(square_of_distance(X_, a, pairs_.at(k)), std::max(reach_[a], reach_[pairs_.at(k)]));
      fits[a] = fit(a, a) ? 1 : 0;
    });
    for (std::size_t a = 0; a < X_.size() && hopeless_ < 0; ++a) {
      if (fits[a] != 0) continue;
      complete = usual_ = false;
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
bool Fits<D>::fit(std::size_t a, std::size_t at) {
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
  std::copy(inverse, inverse + terms * terms, inverse_.begin() + static_cast<std::ptrdiff_t>(at * terms * terms));
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
