// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/particle_cells.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/neighbours/nearest_particle.hpp"
#include "piola/neighbours/surface_fit.hpp"
#include "piola/particles/body_range.hpp"
#include <algorithm>
#include <cstdint>

namespace piola {
namespace {

using Point = std::array<double, 3>;

/// Particles of a body by their positions in its lattice.
class LatticePlaces {
 public:
  LatticePlaces(ParticleSet const& set, Body const& body) : count_(body.lattice) {
    at_.resize(index({count_[0] - 1, count_[1] - 1, count_[2] - 1}) + 1);
    for (auto id = body.first; id < body.last; ++id)
      at_[index(set.lattice_index[static_cast<std::size_t>(id)])] = static_cast<std::size_t>(id - body.first);
  }
  std::size_t operator()(std::array<int, 3> const& at) const { return at_[index(at)]; }

 private:
  std::size_t index(std::array<int, 3> const& at) const {
    return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(at[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(at[0]);
  }
  std::array<int, 3> count_;
  std::vector<std::size_t> at_;
};

/// The side of a block towards the upper or lower end of an axis.
BlockSide side_of(Point const& low, Point const& high, std::size_t axis, bool upper, std::size_t D) {
  BlockSide side{axis, {}, true};
  Point X = low;
  X[axis] = upper ? high[axis] : low[axis];
  side.corner.fill(X);
  if (D == 2) side.corner[1][1 - axis] = high[1 - axis];
  if (D < 3) return side;
  std::size_t const u = (axis + 1) % 3, v = (axis + 2) % 3;
  side.corner[1][u] = side.corner[2][u] = high[u];
  side.corner[2][v] = side.corner[3][v] = high[v];
  return side;
}

/// A lattice in a box: each cell is one block.
BodyCells moments_of_lattice(ParticleSet const& set, Body const& body, CellSums& sums) {
  auto const D = static_cast<std::size_t>(set.dimension);
  LatticePlaces const particle_at(set, body);
  for (auto id = body.first; id < body.last; ++id) {
    auto const& X = set.X[static_cast<std::size_t>(id)];
    auto const& at = set.lattice_index[static_cast<std::size_t>(id)];
    auto const a = static_cast<std::size_t>(id - body.first);
    Point low{}, high{};
    for (std::size_t c = 0; c < D; ++c) {
      low[c] = at[c] == 0 ? body.outline.min[c] : X[c] - 0.5 * body.spacing[c];
      high[c] = at[c] + 1 == body.lattice[c] ? body.outline.max[c] : X[c] + 0.5 * body.spacing[c];
    }
    for (std::size_t c = 0; c < D; ++c)
      for (bool const upper : {false, true}) {
        BlockSide const side = side_of(low, high, c, upper, D);
        bool const outside = upper ? at[c] + 1 == body.lattice[c] : at[c] == 0;
        if (outside) {
          sums.add_surface({static_cast<Index>(a), -1, static_cast<int>(c), upper, true}, side);
        } else if (upper) {
          std::array<int, 3> next = at;
          ++next[c];
          sums.add_facet(a, particle_at(next), side);
        }
      }
  }
  return sums.finish();
}

/// Cells from blocks. Threads find the particles that blocks belong to, some planes at a time; sums are added up in one
/// order.
BodyCells sample_cells(ParticleSet const& set, Body const& body, CellSums& sums) {
  constexpr long rows_at_once = 4096;
  BlockGrid const grid(body, set.dimension);
  NearestParticle const nearest(set, body);
  SurfaceFit const surface(grid, body.outline, body.spacing[0]);
  long const plane = grid.rows_in_plane(), planes = std::max(1L, rows_at_once / plane);
  std::vector<std::uint32_t> owner(
      static_cast<std::size_t>(std::min(grid.rows(), (planes + 1) * plane) * grid.in_row()));
  for (long first = 0; first < grid.rows(); first += planes * plane) {
    long const last = std::min(grid.rows(), first + planes * plane), known = std::min(grid.rows(), last + plane);
    std::size_t const before = grid.index(grid.place_of(first, 0));
    exec_host::parallel_for(static_cast<Index>(known - first), [&](Index row) {
      for (long i = 0; i < grid.in_row(); ++i)
        if (auto const place = grid.place_of(first + row, i); grid.is_inside(place))
          owner[grid.index(place) - before] = static_cast<std::uint32_t>(nearest(grid.middle(place)));
    });
    grid.each_inside(first, last, [&](BlockGrid::Place const& at) {
      auto const a = owner[grid.index(at) - before];
      for (std::size_t c = 0; c < grid.dimension(); ++c)
        for (bool const upper : {false, true}) {
          auto const next = BlockGrid::beside(at, c, upper);
          if (!grid.is_inside(next)) {
            sums.add_surface(
                {static_cast<Index>(a), surface.patch(at, c, upper), static_cast<int>(c), upper, grid.is_beyond(next)},
                surface.side(at, c, upper));
          } else if (upper) {
            if (auto const b = owner[grid.index(next) - before]; b != a)
              sums.add_facet(a, b, surface.side(at, c, upper));
          }
        }
    });
  }
  BodyCells cells = sums.finish();
  cells.farthest_move = surface.farthest_move();
  cells.unmoved = surface.unmoved();
  return cells;
}

}  // namespace

BodyCells measure_cells(ParticleSet const& set, Body const& body,
                        std::function<bool(std::size_t)> const& wants_facets) {
  PIOLA_EXPECTS(set.dimension >= 1 && set.dimension <= 3);
  PIOLA_EXPECTS(is_range_in(body, set));
  PIOLA_EXPECTS(body.spacing[0] > 0 && body.spacing[1] > 0 && body.spacing[2] > 0);
  CellSums sums(set.dimension, set.axisymmetric,
                {set.X.data() + body.first, static_cast<std::size_t>(body.last - body.first)}, wants_facets);
  return has_lattice_cells(body) ? moments_of_lattice(set, body, sums) : sample_cells(set, body, sums);
}

void take_cell_volumes(ParticleSet& set, Body const& body) {
  PIOLA_EXPECTS(set.volume.size() == set.X.size());
  BodyCells const cells = measure_cells(set, body);
  PIOLA_ENSURES(cells.cell.size() == static_cast<std::size_t>(body.last - body.first));
  for (auto id = body.first; id < body.last; ++id)
    set.volume[static_cast<std::size_t>(id)] = cells.cell[static_cast<std::size_t>(id - body.first)].volume;
}

}  // namespace piola
