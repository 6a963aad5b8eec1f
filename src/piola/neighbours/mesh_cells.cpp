// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/mesh_cells.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_facets.hpp"
#include "piola/neighbours/simplex.hpp"
#include "piola/particles/body_range.hpp"
#include <algorithm>

namespace piola {
namespace {

// Corners of the simplices of a box, for a box whose lattice position has an even sum; the odd ones are its mirror
// images, so that the diagonals on the facet between two boxes coincide.
constexpr std::array<std::array<int, 4>, 2> triangles[2]{{{{0, 1, 3}, {0, 3, 2}}}, {{{0, 1, 2}, {1, 3, 2}}}};
constexpr std::array<std::array<int, 4>, 5> tetrahedra[2]{
    {{{0, 3, 6, 5}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 0, 6, 5}, {7, 3, 5, 6}}},
    {{{1, 4, 7, 2}, {0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}}}};
constexpr std::array<std::array<int, 4>, 1> interval{{{0, 1}}};

std::span<std::array<int, 4> const> simplices_of_box(int dimension, bool odd) {
  if (dimension == 1) return interval;
  if (dimension == 2) return triangles[odd ? 1 : 0];
  return tetrahedra[odd ? 1 : 0];
}

/// The particles of a body by their position in its lattice.
class LatticeMap {
 public:
  LatticeMap(ParticleSet const& set, Body const& body) : count_(body.lattice) {
    auto const size = static_cast<std::size_t>(body.last - body.first);
    at_.assign(
        static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]),
        -1);
    twin_.assign(size, -1);
    for (std::size_t k = 0; k < size; ++k) {
      Index& here = at_[place(set.lattice_index[static_cast<std::size_t>(body.first) + k])];
      if (here >= 0) {
        twin_[k] = here;
        twin_[static_cast<std::size_t>(here)] = static_cast<Index>(k);
      } else {
        here = static_cast<Index>(k);
      }
    }
  }
  /// The first particle there, counted from the body's first one; -1 if there is none.
  Index operator()(std::array<int, 3> const& at) const { return at_[place(at)]; }
  std::vector<Index> const& twin() const { return twin_; }

 private:
  std::size_t place(std::array<int, 3> const& at) const {
    return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(at[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(at[0]);
  }
  std::array<int, 3> count_;
  std::vector<Index> at_, twin_;
};

std::array<int, 3> corner_of_box(std::array<int, 3> const& box, int corner) {
  return {box[0] + (corner & 1), box[1] + ((corner >> 1) & 1), box[2] + (corner >> 2)};
}

void add_box(LatticeMap const& particle, std::array<int, 3> const& box, Cells& cells) {
  std::array<Index, 8> corner{};
  for (int c = 0; c < cells.corners; ++c) {
    corner[static_cast<std::size_t>(c)] = particle(corner_of_box(box, c));
    if (corner[static_cast<std::size_t>(c)] < 0) return;
  }
  cells.corner.insert(cells.corner.end(), corner.begin(), corner.begin() + cells.corners);
}

double squared_distance(std::array<double, 3> const& x, Crack const& crack) {
  double const ux = crack.to[0] - crack.from[0], uy = crack.to[1] - crack.from[1];
  double const rx = x[0] - crack.from[0], ry = x[1] - crack.from[1];
  double const along = std::clamp((rx * ux + ry * uy) / (ux * ux + uy * uy), 0.0, 1.0);
  double const dx = rx - along * ux, dy = ry - along * uy;
  return dx * dx + dy * dy;
}

Crack const& crack_through(std::array<double, 3> const& x, std::vector<Crack> const& cracks) {
  return *std::min_element(cracks.begin(), cracks.end(), [&](Crack const& a, Crack const& b) {
    return squared_distance(x, a) < squared_distance(x, b);
  });
}

bool on_the_left(std::array<double, 3> const& x, Crack const& crack) {
  return (crack.to[0] - crack.from[0]) * (x[1] - crack.from[1]) >
         (crack.to[1] - crack.from[1]) * (x[0] - crack.from[0]);
}

std::array<double, 3> centroid(std::span<Index const> corners, Points const& X) {
  std::array<double, 3> sum{};
  for (Index const c : corners)
    for (std::size_t d = 0; d < 3; ++d)
      sum[d] += X[static_cast<std::size_t>(c)][d] / static_cast<double>(corners.size());
  return sum;
}

void add_facet(Cells const& cells, Index cell, FacetTable const& table, std::size_t facet, Surface& surface) {
  std::array<Index, 4> corner{};
  for (int c = 0; c < table.corners; ++c)
    corner[static_cast<std::size_t>(c)] =
        cells.of(cell)[static_cast<std::size_t>(table.facet[facet][static_cast<std::size_t>(c)])];
  if (table.corners < 4) {
    surface.corner.insert(surface.corner.end(), corner.begin(), corner.begin() + table.corners);
    return;
  }
  // From its smallest corner: the cut does not depend on the cell from which the facet is seen.
  std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
  for (std::size_t const c : {0U, 1U, 2U, 0U, 2U, 3U}) surface.corner.push_back(corner[c]);
}

}  // namespace

Cells lattice_cells(ParticleSet const& set, Body const& body) {
  PIOLA_EXPECTS(set.dimension >= 1 && set.dimension <= 3);
  PIOLA_EXPECTS(is_range_in(body, set));
  PIOLA_EXPECTS(set.lattice_index.size() == set.X.size());
  PIOLA_EXPECTS(set.crack_side.empty() || set.crack_side.size() == set.X.size());
  LatticeMap const particle(set, body);
  int const dimension = set.dimension;
  Cells cells{dimension, 1 << dimension, {}};
  std::array<int, 3> boxes{1, 1, 1};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) boxes[d] = body.lattice[d] - 1;
  for (int k = 0; k < boxes[2]; ++k)
    for (int j = 0; j < boxes[1]; ++j)
      for (int i = 0; i < boxes[0]; ++i) add_box(particle, {i, j, k}, cells);
  if (set.crack_side.empty()) return cells;
  std::vector<Crack> own;
  for (Crack const& crack : set.cracks)
    if (set.bodies[static_cast<std::size_t>(crack.body)].first == body.first) own.push_back(crack);
  open_cracks(cells, {set.X.begin() + body.first, set.X.begin() + body.last},
              {set.crack_side.begin() + body.first, set.crack_side.begin() + body.last}, particle.twin(), own);
  return cells;
}

Cells split_alternately(Cells const& boxes, ParticleSet const& set, Body const& body, Diagonals diagonals) {
  PIOLA_EXPECTS(boxes.dimension >= 1 && boxes.dimension <= 3);
  PIOLA_EXPECTS(boxes.corners == 1 << boxes.dimension);
  Cells cells{boxes.dimension, boxes.dimension + 1, {}};
  for (Index box = 0; box < boxes.count(); ++box) {
    auto const corner = boxes.of(box);
    auto const& at = set.lattice_index[static_cast<std::size_t>(body.first + corner[0])];
    bool const all = diagonals == Diagonals::by_box || boxes.dimension != 2;
    int const number = all ? at[0] + at[1] + at[2] : diagonals == Diagonals::by_row ? at[1] : at[0];
    bool const odd = number % 2 != 0;
    for (auto const& simplex : simplices_of_box(boxes.dimension, odd))
      for (int c = 0; c < cells.corners; ++c)
        cells.corner.push_back(corner[static_cast<std::size_t>(simplex[static_cast<std::size_t>(c)])]);
  }
  return cells;
}

void open_cracks(Cells& cells, Points const& X, std::vector<std::int8_t> const& side, std::vector<Index> const& twin,
                 std::vector<Crack> const& cracks) {
  PIOLA_EXPECTS(cells.corners > 0);
  PIOLA_EXPECTS(side.size() == X.size() && twin.size() == X.size());
  if (cracks.empty()) return;
  for (Index cell = 0; cell < cells.count(); ++cell) {
    std::array<double, 3> const middle = centroid(cells.of(cell), X);
    for (int c = 0; c < cells.corners; ++c) {
      Index& corner = cells.corner[static_cast<std::size_t>(cell) * cells.corners + c];
      auto const k = static_cast<std::size_t>(corner);
      if (twin[k] < 0) continue;
      bool const left = on_the_left(middle, crack_through(X[k], cracks));
      if (left != (side[k] > 0)) corner = twin[k];
    }
  }
}

Surface surface_of(Cells const& cells, Points const& points) {
  PIOLA_EXPECTS(cells.corners > 0 && cells.corner.size() % static_cast<std::size_t>(cells.corners) == 0);
  FacetTable const table = facets_of(cells);
  std::vector<Index> const across = cells_across(cells);
  Surface surface;
  surface.dimension = cells.dimension;
  std::size_t const facets = table.facet.size();
  for (std::size_t f = 0; f < across.size(); ++f) {
    if (across[f] >= 0) continue;
    auto const cell = static_cast<Index>(f / facets);
    add_facet(cells, cell, table, f % facets, surface);
    if (cells.dimension > 1) continue;
    bool const forward = volume_of(cells, cell, points) > 0;
    surface.outward.push_back(forward == (f % facets == 1) ? 1 : -1);
  }
  return surface;
}

double volume_of(Cells const& cells, Index cell, Points const& points) {
  auto const corner = cells.of(cell);
  if (cells.corners == cells.dimension + 1) return simplex_volume(points, corner.data(), cells.dimension);
  double sum = 0;
  for (bool const odd : {false, true})
    for (auto const& simplex : simplices_of_box(cells.dimension, odd)) {
      std::array<Index, 4> own{};
      for (int c = 0; c <= cells.dimension; ++c)
        own[static_cast<std::size_t>(c)] = corner[static_cast<std::size_t>(simplex[static_cast<std::size_t>(c)])];
      sum += simplex_volume(points, own.data(), cells.dimension) / 2;
    }
  return sum;
}

}  // namespace piola
