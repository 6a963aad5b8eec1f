// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/delaunay_peel.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_facets.hpp"
#include "piola/neighbours/simplex.hpp"
#include <algorithm>

namespace piola {
namespace {

constexpr double flat = 1e-3;  // height over longest edge

class Peeler {
 public:
  Peeler(Cells& cells, Points const& points, std::vector<Index> slivers, double largest_radius)
      : cells_(cells),
        points_(points),
        largest_radius_(largest_radius),
        table_(facets_of(cells)),
        across_(cells_across(cells)),
        on_surface_(points.size(), false),
        gone_(static_cast<std::size_t>(cells.count()), false),
        todo_(std::move(slivers)) {
    std::reverse(todo_.begin(), todo_.end());
    for (Index cell = 0; cell < cells_.count(); ++cell)
      for (std::size_t f = 0; f < table_.facet.size(); ++f)
        if (across(cell, f) < 0) mark(cell, f);
  }

  void peel() {
    while (!todo_.empty()) {
      Index const cell = todo_.back();
      todo_.pop_back();
      if (!gone_[static_cast<std::size_t>(cell)] && can_go(cell)) remove(cell);
    }
    std::vector<Index> kept;
    for (Index cell = 0; cell < cells_.count(); ++cell)
      if (!gone_[static_cast<std::size_t>(cell)])
        kept.insert(kept.end(), cells_.of(cell).begin(), cells_.of(cell).end());
    cells_.corner = std::move(kept);
  }

 private:
  Index& across(Index cell, std::size_t facet) {
    return across_[static_cast<std::size_t>(cell) * table_.facet.size() + facet];
  }
  std::array<Index, 3> facet_of(Index cell, std::size_t facet) const {
    std::array<Index, 3> out{-1, -1, -1};
    for (std::size_t c = 0; c < static_cast<std::size_t>(table_.corners); ++c)
      out[c] = cells_.of(cell)[static_cast<std::size_t>(table_.facet[facet][c])];
    return out;
  }
  void mark(Index cell, std::size_t facet) {
    for (Index const p : facet_of(cell, facet))
      if (p >= 0) on_surface_[static_cast<std::size_t>(p)] = true;
  }
  Index opposite(Index cell, std::size_t facet) const {
    auto const own = facet_of(cell, facet);
    auto const corners = cells_.of(cell);
    return *std::find_if(corners.begin(), corners.end(),
                         [&](Index p) { return std::find(own.begin(), own.end(), p) == own.end(); });
  }
  double height_over(Index cell, std::size_t facet) const {
    auto const own = facet_of(cell, facet);
    double const volume = simplex_volume(points_, cells_.of(cell).data(), cells_.dimension);
    Vec<3> const a = edge_between(points_, own[0], own[1], cells_.dimension);
    if (cells_.dimension == 2) return 2 * volume / std::sqrt(dot(a, a));
    Vec<3> const n = cross(a, edge_between(points_, own[0], own[2], cells_.dimension));
    return 6 * volume / std::sqrt(dot(n, n));
  }
  bool exposed(Index cell) {
    for (std::size_t f = 0; f < table_.facet.size(); ++f)
      if (across(cell, f) < 0) return true;
    return false;
  }
  bool can_go(Index cell) {
    if (circumradius(points_, cells_.of(cell).data(), cells_.dimension) > largest_radius_) return exposed(cell);
    double const low = flat * longest_edge(points_, cells_.of(cell).data(), cells_.dimension);
    int outside = 0;
    bool covered = false;
    for (std::size_t f = 0; f < table_.facet.size(); ++f) {
      if (across(cell, f) >= 0) continue;
      ++outside;
      if (height_over(cell, f) >= low) return false;
      covered = !on_surface_[static_cast<std::size_t>(opposite(cell, f))];
    }
    return (outside == 1 && covered) || (outside == 2 && cells_.dimension == 3);
  }
  void remove(Index cell) {
    gone_[static_cast<std::size_t>(cell)] = true;
    for (std::size_t f = 0; f < table_.facet.size(); ++f) {
      Index const other = across(cell, f);
      if (other < 0) continue;
      for (std::size_t g = 0; g < table_.facet.size(); ++g)
        if (across(other, g) == cell) across(other, g) = -1;
      mark(cell, f);
      if (nearly_flat(cells_, other, points_)) todo_.push_back(other);
    }
  }

  Cells& cells_;
  Points const& points_;
  double largest_radius_;
  FacetTable table_;
  std::vector<Index> across_;
  std::vector<bool> on_surface_, gone_;
  std::vector<Index> todo_;
};

}  // namespace

bool nearly_flat(Cells const& cells, Index cell, Points const& points) {
  Index const* const corner = cells.of(cell).data();
  double const longest = longest_edge(points, corner, cells.dimension);
  double const most = cells.dimension == 2 ? longest * longest / 2 : longest * longest * longest / 6;
  return simplex_volume(points, corner, cells.dimension) < flat * most;
}

void peel_slivers(Cells& cells, Points const& points, double largest_radius) {
  PIOLA_EXPECTS(cells.dimension == 2 || cells.dimension == 3);
  PIOLA_EXPECTS(cells.corners == cells.dimension + 1);
  PIOLA_EXPECTS(largest_radius > 0);
  std::vector<Index> slivers;
  for (Index cell = 0; cell < cells.count(); ++cell)
    if (nearly_flat(cells, cell, points)) slivers.push_back(cell);
  if (!slivers.empty()) Peeler(cells, points, std::move(slivers), largest_radius).peel();
}

}  // namespace piola
