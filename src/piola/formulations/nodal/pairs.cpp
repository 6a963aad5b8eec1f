// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>

namespace piola::nodal {
namespace {

/// From the neighbours that each row has, which stand behind the entry: where rows begin.
void add_up(std::vector<std::int64_t>& begin) {
  for (std::size_t a = 0; a + 1 < begin.size(); ++a) begin[a + 1] += begin[a];
}

}  // namespace

double square_of_distance(std::array<double, 3> const& a, std::array<double, 3> const& b) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) square += (b[c] - a[c]) * (b[c] - a[c]);
  return square;
}

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
        double const longest = nearly * std::max(reach[a], reach[b]);
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
        if (square > 0 && square < nearly * reach * reach) offsets.push_back({i, j, k});
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

}  // namespace piola::nodal
