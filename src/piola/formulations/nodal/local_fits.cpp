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

/// Reduction payload of a round of fits.
struct FitReduction {
  bool complete = true;
  Index unsolvable = std::numeric_limits<Index>::max();
  void add(FitReduction const& other) {
    complete = complete && other.complete;
    unsolvable = std::min(unsolvable, other.unsolvable);
  }
};

/// From the neighbours that each row has, which stand behind the entry: where rows begin.
void add_up(std::vector<std::int64_t>& begin) {
  for (std::size_t a = 0; a + 1 < begin.size(); ++a) begin[a + 1] += begin[a];
}

/// Removes pairs of these rows for which `drop` is true. Returns whether there was one.
bool drop_pairs(Pairs& pairs, IndexSet const& rows, std::function<bool(std::size_t, std::size_t)> const& drop) {
  std::vector<char> keeps(pairs.neighbour.size(), 1);
  exec_host::parallel_for(rows.size(), [&](Index row) {
    for (std::size_t a = rows[row], k = pairs.first(a); k < pairs.end(a); ++k) keeps[k] = drop(a, pairs.at(k)) ? 0 : 1;
  });
  std::vector<std::int64_t> begin(pairs.begin.size(), 0);
  std::size_t kept = 0;
  for (std::size_t a = 0; a + 1 < pairs.begin.size(); ++a) {
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k)
      if (keeps[k] != 0) pairs.neighbour[kept++] = pairs.neighbour[k];
    begin[a + 1] = static_cast<std::int64_t>(kept);
  }
  bool const any = kept < pairs.neighbour.size();
  pairs.neighbour.resize(kept);
  pairs.begin = std::move(begin);
  return any;
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

IndexSet with_neighbours(Pairs const& pairs, Range range, std::vector<bool> marked) {
  for (auto a = static_cast<std::size_t>(range.first); a < static_cast<std::size_t>(range.last); ++a) {
    marked[a] = true;
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) marked[pairs.at(k)] = true;
  }
  return IndexSet(marked);
}

std::vector<Index> ghost_neighbours(Pairs const& pairs, Range own) {
  IndexSet const seen = with_neighbours(pairs, own, std::vector<bool>(pairs.begin.size() - 1));
  std::vector<Index> read;
  for (Index k = 0; k < seen.size(); ++k)
    if (auto const a = static_cast<Index>(seen[k]); a < own.first || a >= own.last) read.push_back(a);
  return read;
}

Pairs find_pairs(Points const& X, std::span<double const> reach, IndexSet const& rows) {
  PIOLA_EXPECTS(reach.size() == X.size());
  Pairs pairs;
  pairs.begin.push_back(0);
  if (X.empty()) return pairs;
  CellGrid const grid(X, *std::max_element(reach.begin(), reach.end()));
  constexpr Index part_size = 4096;
  Index const parts = (rows.size() + part_size - 1) / part_size;
  std::vector<std::vector<Index>> found(static_cast<std::size_t>(parts));
  pairs.begin.assign(X.size() + 1, 0);
  auto const each_part = [&](auto const& f) {
    exec_host::parallel_for_chunks(parts, rows.size(), [&](Index part) {
      f(found[static_cast<std::size_t>(part)], part * part_size, std::min((part + 1) * part_size, rows.size()));
    });
  };
  each_part([&](std::vector<Index>& near, Index first, Index end) {
    for (Index row = first; row < end; ++row) {
      std::size_t const a = rows[row];
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
  add_up(pairs.begin);
  pairs.neighbour.resize(static_cast<std::size_t>(pairs.begin.back()));
  each_part([&](std::vector<Index> const& near, Index first, Index) {
    std::copy(near.begin(), near.end(), pairs.neighbour.begin() + pairs.begin[rows[first]]);
  });
  return pairs;
}

std::vector<std::array<int, 3>> offsets_in_reach(int dimension, double reach) {
  PIOLA_EXPECTS(reach > 0 && dimension >= 1 && dimension <= 3);
  std::vector<std::array<int, 3>> offsets;
  int const steps = static_cast<int>(reach), across = dimension > 1 ? steps : 0, up = dimension > 2 ? steps : 0;
  for (int k = -up; k <= up; ++k)
    for (int j = -across; j <= across; ++j)
      for (int i = -steps; i <= steps; ++i) {
        int const square = i * i + j * j + k * k;
        if (square > 0 && square < edge * reach * reach) offsets.push_back({i, j, k});
      }
  return offsets;
}

Pairs lattice_pairs(LatticeShape const& shape, double reach, IndexSet const& rows) {
  auto const offsets = offsets_in_reach(shape.dimension, reach);
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
  exec_host::parallel_for(rows.size(), [&](Index k) {
    each_neighbour(static_cast<Index>(rows[k]), [&](Index) { ++pairs.begin[rows[k] + 1]; });
  });
  add_up(pairs.begin);
  pairs.neighbour.resize(static_cast<std::size_t>(pairs.begin.back()));
  exec_host::parallel_for(rows.size(), [&](Index k) {
    auto to = pairs.neighbour.begin() + pairs.begin[rows[k]];
    each_neighbour(static_cast<Index>(rows[k]), [&](Index b) { *to++ = b; });
  });
  return pairs;
}

IndexSet lattice_rows(LatticeShape const& shape, double reach, Range own, std::vector<std::size_t> const& first) {
  auto const particles = static_cast<std::size_t>(shape.count[0] * shape.count[1] * shape.count[2]);
  std::vector<bool> mine(particles);
  std::fill(mine.begin() + own.first, mine.begin() + own.last, true);
  Pairs const pairs = lattice_pairs(shape, reach, IndexSet(mine));
  std::vector<bool> marked(particles);
  for (std::size_t const a : first) marked[a] = true;
  return with_neighbours(pairs, own, std::move(marked));
}

std::vector<Index> representatives_in_lattice(LatticeShape const& shape, int beyond) {
  auto const most = static_cast<std::size_t>(beyond);
  std::vector<Index> known(most * most * most * most * most * most, -1);
  std::vector<Index> representative(static_cast<std::size_t>(shape.count[0] * shape.count[1] * shape.count[2]));
  for (std::size_t a = 0; a < representative.size(); ++a) {
    auto const at = shape.place(static_cast<Index>(a));
    std::size_t kind = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (int const distance : {at[c], shape.count[c] - 1 - at[c]})
        kind = kind * most + static_cast<std::size_t>(std::min(distance, beyond - 1));
    if (known[kind] < 0) known[kind] = static_cast<Index>(a);
    representative[a] = known[kind];
  }
  return representative;
}

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
  return nearness(a, b) > 1 - edge * edge && (a == b || !blocked_ || !blocked_(a, b));
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

template <int D>
bool LocalFits<D>::fit(std::size_t a, std::size_t at) {
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
