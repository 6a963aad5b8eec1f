// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/particle_cells.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/neighbours/nearest_particle.hpp"
#include "piola/particles/body_range.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace piola {
namespace {

using Point = std::array<double, 3>;

constexpr std::array<std::size_t, 3> mixed_first{1, 0, 0}, mixed_second{2, 2, 1};  // YZ XZ XY

/// Adds up blocks, patches and facets, all with edges along the axes.
class Sums {
 public:
  Sums(int dimension, std::size_t particles) : D_(static_cast<std::size_t>(dimension)), place_(12 * particles, -1) {
    cells.cell.resize(particles);
    facets_.resize(particles);
  }

  /// The side between a block of the cell of `lower` and the next block along `axis`, of the cell of `upper`. middle:
  /// of the side, from the middle between the two particles.
  void add_facet(std::size_t lower, std::size_t upper, std::size_t axis, Point const& middle, Point const& edge) {
    double area = lower < upper ? 1 : -1;
    for (std::size_t c = 0; c < D_; ++c)
      if (c != axis) area *= edge[c];
    auto& m = facet(std::min(lower, upper), std::max(lower, upper)).moments[axis];
    m[0] += area;
    for (std::size_t c = 0; c < D_; ++c) {
      m[1 + c] += area * middle[c];
      double const own = c == axis ? 0 : edge[c] * edge[c] / 12;
      m[4 + c] += 0.5 * area * (middle[c] * middle[c] + own);
    }
    for (std::size_t k = 0; k < 3; ++k) m[7 + k] += area * middle[mixed_first[k]] * middle[mixed_second[k]];
  }

  /// A block of the cell of particle a: its middle relative to the particle and its edges.
  void add_block(std::size_t a, Point const& middle, Point const& edge) {
    double volume = 1;
    for (std::size_t c = 0; c < D_; ++c) volume *= edge[c];
    auto& cell = cells.cell[a];
    cell.volume += volume;
    for (std::size_t c = 0; c < D_; ++c) {
      cell.centroid[c] += volume * middle[c];
      cell.spread[c] += volume * (middle[c] * middle[c] + edge[c] * edge[c] / 12);
    }
    for (std::size_t m = 0; m < 3; ++m) cell.spread[3 + m] += volume * middle[mixed_first[m]] * middle[mixed_second[m]];
  }

  /// The side of such a block towards `axis`.
  void add_side(std::size_t a, std::size_t axis, bool upper, bool outermost, Point middle, Point const& edge) {
    double area = 1;
    for (std::size_t c = 0; c < D_; ++c)
      if (c != axis) area *= edge[c];
    middle[axis] += (upper ? 0.5 : -0.5) * edge[axis];
    auto& at = place_[12 * a + 4 * axis + (upper ? 2 : 0) + (outermost ? 1 : 0)];
    if (at < 0) {
      at = static_cast<Index>(cells.patch.size());
      cells.patch.push_back({static_cast<Index>(a), static_cast<int>(axis), upper, outermost});
    }
    auto& patch = cells.patch[static_cast<std::size_t>(at)];
    patch.area += area;
    for (std::size_t c = 0; c < D_; ++c) {
      patch.first[c] += area * middle[c];
      double const own = c == axis ? 0 : edge[c] * edge[c] / 12;
      patch.second[c] += 0.5 * area * (middle[c] * middle[c] + own);
    }
    for (std::size_t m = 0; m < 3; ++m) patch.second[3 + m] += area * middle[mixed_first[m]] * middle[mixed_second[m]];
  }

  /// From integrals to centroids and central moments.
  void finish() {
    for (auto& cell : cells.cell) {
      if (!(cell.volume > 0)) continue;
      for (double& c : cell.centroid) c /= cell.volume;
      for (double& m : cell.spread) m /= cell.volume;
      for (std::size_t c = 0; c < 3; ++c) cell.spread[c] -= cell.centroid[c] * cell.centroid[c];
      for (std::size_t m = 0; m < 3; ++m)
        cell.spread[3 + m] -= cell.centroid[mixed_first[m]] * cell.centroid[mixed_second[m]];
    }
  }

  BodyCells cells;

 private:
  CellFacet& facet(std::size_t a, std::size_t b) {
    for (Index const known : facets_[a])
      if (auto& f = cells.facet[static_cast<std::size_t>(known)]; f.b == static_cast<Index>(b)) return f;
    facets_[a].push_back(static_cast<Index>(cells.facet.size()));
    return cells.facet.emplace_back(CellFacet{static_cast<Index>(a), static_cast<Index>(b), {}});
  }

  std::size_t D_;
  std::vector<Index> place_;                ///< of the patch of a particle, an axis, a sense
  std::vector<std::vector<Index>> facets_;  ///< of a particle, towards particles with a higher number
};

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

/// A lattice in a box: each cell is one block.
BodyCells moments_of_lattice(ParticleSet const& set, Body const& body, CellParts parts) {
  auto const D = static_cast<std::size_t>(set.dimension);
  Sums sums(set.dimension, static_cast<std::size_t>(body.last - body.first));
  LatticePlaces const particle_at(set, body);
  for (auto id = body.first; id < body.last; ++id) {
    auto const& X = set.X[static_cast<std::size_t>(id)];
    auto const& at = set.lattice_index[static_cast<std::size_t>(id)];
    auto const a = static_cast<std::size_t>(id - body.first);
    Point middle{}, edge{};
    for (std::size_t c = 0; c < D; ++c) {
      double const low = at[c] == 0 ? body.outline.min[c] : X[c] - 0.5 * body.spacing[c];
      double const high = at[c] + 1 == body.lattice[c] ? body.outline.max[c] : X[c] + 0.5 * body.spacing[c];
      middle[c] = 0.5 * (low + high) - X[c];
      edge[c] = high - low;
    }
    sums.add_block(a, middle, edge);
    for (std::size_t c = 0; c < D; ++c) {
      if (at[c] == 0) sums.add_side(a, c, false, true, middle, edge);
      if (at[c] + 1 == body.lattice[c]) {
        sums.add_side(a, c, true, true, middle, edge);
      } else if (parts == CellParts::facets_too) {
        std::array<int, 3> next = at;
        ++next[c];
        Point of_side = middle;  // from the middle between the two particles, half a spacing along the axis
        of_side[c] = 0;
        sums.add_facet(a, particle_at(next), c, of_side, edge);
      }
    }
  }
  sums.finish();
  return std::move(sums.cells);
}

/// A body of blocks becomes larger or smaller as a whole: along each axis X -> fixed + factor (X - fixed). Blocks stay
/// blocks, and their sides stay together.
struct Stretch {
  Point fixed{}, factor{1, 1, 1};
};

/// Blocks of a sixth of the spacing.
class Sampling {
 public:
  Sampling(ParticleSet const& set, Body const& body, CellParts parts)
      : parts_(parts),
        outline_(body.outline),
        D_(static_cast<std::size_t>(set.dimension)),
        X_(set.X.data() + body.first),
        nearest_(set, body),
        sums_(set.dimension, static_cast<std::size_t>(body.last - body.first)) {
    // Particles of a packing get the exact volume. Rings, which have no distance function, only approximate it.
    if (body.off_lattice && outline_.distance)
      volume_ = std::accumulate(set.volume.begin() + body.first, set.volume.begin() + body.last, 0.0);
    constexpr double per_spacing = 6;
    for (std::size_t c = 0; c < D_; ++c) {
      double const length = outline_.max[c] - outline_.min[c];
      count_[c] = std::max(1L, std::lround(per_spacing * length / body.spacing[c]));
      edge_[c] = length / static_cast<double>(count_[c]);
    }
  }

  /// Row by row in threads: which blocks are inside, and whose they are; their sums follow in one order.
  BodyCells operator()() {
    fill_inside();
    if (volume_ > 0) find_stretch();
    long const rows = count_[1] * count_[2];
    owner_.resize(at(rows, 0));
    exec_host::parallel_for(static_cast<Index>(rows), [&](Index row) { find_owners(row); });
    for (long row = 0; row < rows; ++row)
      for (long i = 0; i < count_[0]; ++i)
        if (Place const place = place_of(row, i); is_inside(place)) take(place);
    sums_.finish();
    return std::move(sums_.cells);
  }

 private:
  using Place = std::array<long, 3>;
  Point middle(Place const& at) const {
    Point X{};
    for (std::size_t c = 0; c < D_; ++c) X[c] = outline_.min[c] + (static_cast<double>(at[c]) + 0.5) * edge_[c];
    return X;
  }
  std::size_t at(long row, long i) const { return static_cast<std::size_t>(row * count_[0] + i); }
  Place place_of(long row, long i) const { return {i, row % count_[1], row / count_[1]}; }

  void fill_inside() {
    if (!outline_.inside) return;
    long const rows = count_[1] * count_[2];
    inside_.resize(at(rows, 0));
    exec_host::parallel_for(static_cast<Index>(rows), [&](Index row) {
      long known = 0;  // up to here all is as the block before
      for (long i = 0; i < count_[0]; ++i) {
        if (i < known) {
          inside_[at(row, i)] = inside_[at(row, i - 1)];
          continue;
        }
        Point const X = middle(place_of(row, i));
        double const distance = outline_.distance ? outline_.distance(X) : 0;
        inside_[at(row, i)] = outline_.distance ? distance <= 0 : outline_.inside(X);
        known = i + std::max(1L, static_cast<long>(std::abs(distance) / edge_[0]));
      }
    });
  }
  /// Stretch of the blocks that gives them the exact volume. Each axis is weighted by how far the sides of the body
  /// along it are steps: flat faces on the bounding box are exact already.
  void find_stretch() {
    double blocks = 0;
    Point rough{}, lower{}, upper{};  // sides: steps, and on both ends of the box
    for (long row = 0; row < count_[1] * count_[2]; ++row)
      for (long i = 0; i < count_[0]; ++i) {
        Place const place = place_of(row, i);
        if (!is_inside(place)) continue;
        ++blocks;
        for (std::size_t c = 0; c < D_; ++c) {
          if (Place const below = beside(place, c, -1); !is_inside(below)) ++(below[c] < 0 ? lower : rough)[c];
          if (Place const above = beside(place, c, 1); !is_inside(above)) ++(above[c] >= count_[c] ? upper : rough)[c];
        }
      }
    double sampled = blocks, parts = 0;
    Point part{};
    for (std::size_t c = 0; c < D_; ++c) {
      sampled *= edge_[c];
      double const flat = lower[c] + upper[c];
      part[c] = rough[c] > 0 ? rough[c] / (rough[c] + flat) : 0;
      parts += part[c];
      double const at_upper = flat > 0 ? upper[c] / flat : 0.5;
      stretch_.fixed[c] = outline_.min[c] + at_upper * (outline_.max[c] - outline_.min[c]);
    }
    if (!(sampled > 0 && parts > 0)) return;
    for (std::size_t c = 0; c < D_; ++c) stretch_.factor[c] = std::pow(volume_ / sampled, part[c] / parts);
  }
  void find_owners(long row) {
    for (long i = 0; i < count_[0]; ++i)
      if (Place const place = place_of(row, i); is_inside(place))
        owner_[at(row, i)] = static_cast<std::uint32_t>(nearest_(middle(place)));
  }
  std::size_t owner(Place const& at) const { return owner_[this->at(at[2] * count_[1] + at[1], at[0])]; }
  bool is_inside(Place const& at) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (at[c] < 0 || at[c] >= count_[c]) return false;
    return inside_.empty() || inside_[this->at(at[2] * count_[1] + at[1], at[0])] != 0;
  }
  static Place beside(Place at, std::size_t axis, long step) {
    at[axis] += step;
    return at;
  }
  void take(Place const& at) {
    std::size_t const a = owner(at);
    Point X = middle(at), edge = edge_, r{};
    for (std::size_t c = 0; c < D_; ++c) {
      X[c] = stretch_.fixed[c] + stretch_.factor[c] * (X[c] - stretch_.fixed[c]);
      edge[c] *= stretch_.factor[c];
      r[c] = X[c] - X_[a][c];
    }
    sums_.add_block(a, r, edge);
    for (std::size_t c = 0; c < D_; ++c)
      for (bool const upper : {false, true}) {
        Place const next = beside(at, c, upper ? 1 : -1);
        if (!is_inside(next)) {
          sums_.add_side(a, c, upper, next[c] < 0 || next[c] >= count_[c], r, edge);
        } else if (std::size_t const b = owner(next); upper && b != a && parts_ == CellParts::facets_too) {
          Point of_side{};
          for (std::size_t k = 0; k < D_; ++k) of_side[k] = X[k] - 0.5 * (X_[a][k] + X_[b][k]);
          of_side[c] += 0.5 * edge[c];
          sums_.add_facet(a, b, c, of_side, edge);
        }
      }
  }

  CellParts parts_;
  Outline const& outline_;
  std::size_t D_;
  Point const* X_;
  NearestParticle nearest_;
  Sums sums_;
  Place count_{1, 1, 1};
  Point edge_{};
  std::vector<char> inside_;          ///< empty: all
  std::vector<std::uint32_t> owner_;  ///< of blocks inside
  double volume_ = 0;                 ///< exact; 0: not known
  Stretch stretch_;
};

}  // namespace

BodyCells measure_cells(ParticleSet const& set, Body const& body, CellParts parts) {
  PIOLA_EXPECTS(set.dimension >= 1 && set.dimension <= 3);
  PIOLA_EXPECTS(is_range_in(body, set));
  PIOLA_EXPECTS(body.spacing[0] > 0 && body.spacing[1] > 0 && body.spacing[2] > 0);
  if (has_lattice_cells(body)) return moments_of_lattice(set, body, parts);
  return Sampling(set, body, parts)();
}

void take_cell_volumes(ParticleSet& set, Body const& body) {
  PIOLA_EXPECTS(set.volume.size() == set.X.size());
  BodyCells const cells = measure_cells(set, body);
  PIOLA_ENSURES(cells.cell.size() == static_cast<std::size_t>(body.last - body.first));
  for (auto id = body.first; id < body.last; ++id)
    set.volume[static_cast<std::size_t>(id)] = cells.cell[static_cast<std::size_t>(id - body.first)].volume;
}

}  // namespace piola
