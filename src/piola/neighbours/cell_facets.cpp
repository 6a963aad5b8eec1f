// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_facets.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <limits>

namespace piola {
namespace {

constexpr std::array<std::array<int, 4>, 2> ends{{{0}, {1}}};
constexpr std::array<std::array<int, 4>, 3> of_triangle{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::array<int, 4>, 4> of_rectangle{{{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
constexpr std::array<std::array<int, 4>, 4> of_tetrahedron{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
constexpr std::array<std::array<int, 4>, 6> of_box{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// Fills up the corners of facets that have fewer than four; after all others in rising order.
constexpr Index none = std::numeric_limits<Index>::max();

/// A facet as its cell sees it, known to its neighbour by its corners in rising order.
struct SeenFacet {
  std::array<Index, 4> key;
  Index place;  ///< in the list of all facets of all cells
};

std::vector<SeenFacet> all_facets(Cells const& cells, FacetTable const& table) {
  std::vector<SeenFacet> all;
  all.reserve(static_cast<std::size_t>(cells.count()) * table.facet.size());
  for (Index cell = 0; cell < cells.count(); ++cell)
    for (auto const& facet : table.facet) {
      SeenFacet seen{{none, none, none, none}, static_cast<Index>(all.size())};
      for (int c = 0; c < table.corners; ++c)
        seen.key[static_cast<std::size_t>(c)] = cells.of(cell)[static_cast<std::size_t>(facet[c])];
      std::sort(seen.key.begin(), seen.key.end());
      all.push_back(seen);
    }
  return all;
}

/// Facets sorted by their first corner, by counting: few share one, so that sorting each group is quick.
std::vector<SeenFacet> grouped(std::vector<SeenFacet> const& all, std::vector<std::size_t>& begin) {
  Index points = 0;
  for (SeenFacet const& f : all) points = std::max(points, f.key[0] + 1);
  begin.assign(static_cast<std::size_t>(points) + 1, 0);
  for (SeenFacet const& f : all) ++begin[static_cast<std::size_t>(f.key[0]) + 1];
  for (std::size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
  std::vector<SeenFacet> sorted(all.size());
  std::vector<std::size_t> next = begin;
  for (SeenFacet const& f : all) sorted[next[static_cast<std::size_t>(f.key[0])]++] = f;
  return sorted;
}

}  // namespace

FacetTable facets_of(Cells const& cells) {
  PIOLA_EXPECTS(cells.corners == cells.dimension + 1 || cells.corners == 1 << cells.dimension);
  PIOLA_EXPECTS(cells.dimension >= 1 && cells.dimension <= 3);
  if (cells.dimension == 1) return {1, ends};
  if (cells.dimension == 2) return cells.corners == 3 ? FacetTable{2, of_triangle} : FacetTable{2, of_rectangle};
  return cells.corners == 4 ? FacetTable{3, of_tetrahedron} : FacetTable{4, of_box};
}

std::vector<Index> cells_across(Cells const& cells) {
  FacetTable const table = facets_of(cells);
  std::vector<std::size_t> begin;
  std::vector<SeenFacet> facets = grouped(all_facets(cells, table), begin);
  std::vector<Index> across(facets.size(), -1);
  auto const per_cell = static_cast<Index>(table.facet.size());
  for (std::size_t group = 0; group + 1 < begin.size(); ++group) {
    auto const first = facets.begin() + static_cast<std::ptrdiff_t>(begin[group]);
    auto const last = facets.begin() + static_cast<std::ptrdiff_t>(begin[group + 1]);
    std::sort(first, last, [](auto const& a, auto const& b) { return a.key < b.key; });
    for (auto f = first; f != last && f + 1 != last; ++f) {
      if (f->key != (f + 1)->key) continue;
      across[static_cast<std::size_t>(f->place)] = (f + 1)->place / per_cell;
      across[static_cast<std::size_t>((f + 1)->place)] = f->place / per_cell;
      ++f;
      if (f + 1 == last) break;
    }
  }
  PIOLA_ENSURES(across.size() == static_cast<std::size_t>(cells.count()) * table.facet.size());
  return across;
}

}  // namespace piola
