// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/particle_cells.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include "piola/neighbours/nearest_particle.hpp"
#include "piola/particles/body_range.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

namespace piola {
namespace {

using Point = std::array<double, 3>;

constexpr std::array<std::size_t, 3> mixed_first{1, 0, 0}, mixed_second{2, 2, 1};  // YZ XZ XY

/// A side of a block: a flat or bilinear piece of surface that crosses an axis. Corners in the order (0, 0), (1, 0),
/// (1, 1), (0, 1) of the two next axes, cyclically; in 2D the first two, along the other axis.
struct Side {
  std::size_t axis = 0;
  std::array<Point, 4> corner{};
  bool flat = true;  ///< a rectangle across the axis

  Point middle(std::size_t D) const {
    std::size_t const corners = D == 3 ? 4 : D;
    Point X{};
    for (std::size_t k = 0; k < corners; ++k)
      for (std::size_t c = 0; c < D; ++c) X[c] += corner[k][c] / static_cast<double>(corners);
    return X;
  }
};

/// Gauss points of an interval [0, 1].
struct GaussPoints {
  int count;
  std::array<double, 3> at, weight;
};
GaussPoints const two_points{2, {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}, {0.5, 0.5}};
GaussPoints const three_points{
    3, {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};

/// Calls f(X, N dA) at the points of a quadrature that is exact for cubic fields, N along the axis.
template <class F>
void integrate(Side const& side, std::size_t D, F const& f) {
  auto const& P = side.corner;
  if (D == 1) return f(P[0], Point{1, 0, 0});
  // N dA of a bilinear piece is linear in both directions, so that the integrand is of fourth degree.
  GaussPoints const& points = side.flat || D == 2 ? two_points : three_points;
  if (D == 2) {
    double const sign = side.axis == 0 ? 1 : -1;
    for (std::size_t q = 0; q < 2; ++q) {
      Point X{};
      for (std::size_t c = 0; c < 2; ++c) X[c] = P[0][c] + points.at[q] * (P[1][c] - P[0][c]);
      f(X, Point{sign * points.weight[q] * (P[1][1] - P[0][1]), -sign * points.weight[q] * (P[1][0] - P[0][0]), 0});
    }
    return;
  }
  auto const n = static_cast<std::size_t>(points.count);
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t q = 0; q < n; ++q) {
      double const u = points.at[p], v = points.at[q], weight = points.weight[p] * points.weight[q];
      Point X{}, du{}, dv{};
      for (std::size_t c = 0; c < 3; ++c) {
        X[c] = (1 - v) * ((1 - u) * P[0][c] + u * P[1][c]) + v * ((1 - u) * P[3][c] + u * P[2][c]);
        du[c] = (1 - v) * (P[1][c] - P[0][c]) + v * (P[2][c] - P[3][c]);
        dv[c] = (1 - u) * (P[3][c] - P[0][c]) + u * (P[2][c] - P[1][c]);
      }
      f(X, Point{weight * (du[1] * dv[2] - du[2] * dv[1]), weight * (du[2] * dv[0] - du[0] * dv[2]),
                 weight * (du[0] * dv[1] - du[1] * dv[0])});
    }
}

/// The monomials of NormalMoments.
std::array<double, 10> monomials_of(Point const& r) {
  return {1,           r[0],        r[1],       r[2], 0.5 * r[0] * r[0], 0.5 * r[1] * r[1], 0.5 * r[2] * r[2],
          r[1] * r[2], r[0] * r[2], r[0] * r[1]};
}

/// Adds up sides for cells, patches and facets.
class Sums {
 public:
  Sums(int dimension, Point const* X, std::size_t particles)
      : D_(static_cast<std::size_t>(dimension)), X_(X), patches_(particles), facets_(particles) {
    cells.cell.resize(particles);
  }

  /// A side between the cells of two particles, N from `lower` to `upper`.
  void add_facet(std::size_t lower, std::size_t upper, Side const& side) {
    CellFacet& sum = facet(std::min(lower, upper), std::max(lower, upper));
    double const sign = lower < upper ? 1 : -1;
    Point middle{};
    for (std::size_t c = 0; c < D_; ++c) middle[c] = 0.5 * (X_[lower][c] + X_[upper][c]);
    integrate(side, D_, [&](Point const& X, Point const& N) {
      add(sum.moments, monomials_of(from(middle, X)), N, sign);
      add_to_cell(lower, X, N, 1);
      add_to_cell(upper, X, N, -1);
    });
  }
  /// A side towards the outside. `like`: its patch, or its axis and sense.
  void add_surface(SurfacePatch const& like, Side const& side, bool upper) {
    auto const a = static_cast<std::size_t>(like.particle);
    SurfacePatch& sum = patch(like);
    double const sign = upper ? 1 : -1;
    integrate(side, D_, [&](Point const& X, Point const& N) {
      auto const p = monomials_of(from(X_[a], X));
      add(sum.moments, p, N, sign);
      double const size = std::sqrt(N[0] * N[0] + N[1] * N[1] + N[2] * N[2]);
      for (std::size_t m = 0; m < p.size(); ++m) sum.extent[m] += size * p[m];
      add_to_cell(a, X, N, sign);
    });
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
  Point from(Point const& origin, Point const& X) const {
    Point r{};
    for (std::size_t c = 0; c < D_; ++c) r[c] = X[c] - origin[c];
    return r;
  }
  static void add(NormalMoments& sum, std::array<double, 10> const& p, Point const& N, double sign) {
    for (std::size_t J = 0; J < 3; ++J)
      for (std::size_t m = 0; m < p.size(); ++m) sum[J][m] += sign * N[J] * p[m];
  }
  /// Volume integrals as surface integrals, averaged over the components of the field that has the integrand as its
  /// divergence.
  void add_to_cell(std::size_t a, Point const& X, Point const& N, double sign) {
    Point const r = from(X_[a], X);
    auto& cell = cells.cell[a];
    for (std::size_t c = 0; c < D_; ++c) {
      double const flux = sign * N[c] * r[c];
      cell.volume += flux / static_cast<double>(D_);
      cell.centroid[c] += flux * r[c] / 2;
      cell.spread[c] += flux * r[c] * r[c] / 3;
    }
    for (std::size_t m = 0; m < 3; ++m) {
      std::size_t const c = mixed_first[m], d = mixed_second[m];
      cell.spread[3 + m] += sign * (N[c] * r[c] + N[d] * r[d]) * r[c] * r[d] / 4;
    }
  }
  SurfacePatch& patch(SurfacePatch const& like) {
    auto& own = patches_[static_cast<std::size_t>(like.particle)];
    for (Index const known : own) {
      auto& p = cells.patch[static_cast<std::size_t>(known)];
      if (p.patch == like.patch &&
          (p.patch >= 0 || (p.axis == like.axis && p.upper == like.upper && p.outermost == like.outermost)))
        return p;
    }
    own.push_back(static_cast<Index>(cells.patch.size()));
    return cells.patch.emplace_back(like);
  }
  CellFacet& facet(std::size_t a, std::size_t b) {
    for (Index const known : facets_[a])
      if (auto& f = cells.facet[static_cast<std::size_t>(known)]; f.b == static_cast<Index>(b)) return f;
    facets_[a].push_back(static_cast<Index>(cells.facet.size()));
    return cells.facet.emplace_back(CellFacet{static_cast<Index>(a), static_cast<Index>(b), {}});
  }

  std::size_t D_;
  Point const* X_;                           ///< of the particles of the body
  std::vector<std::vector<Index>> patches_;  ///< of a particle
  std::vector<std::vector<Index>> facets_;   ///< of a particle, towards particles with a higher number
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

/// The side of a block towards the upper or lower end of an axis.
Side side_of(Point const& low, Point const& high, std::size_t axis, bool upper, std::size_t D) {
  Side side{axis, {}, true};
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
BodyCells moments_of_lattice(ParticleSet const& set, Body const& body) {
  auto const D = static_cast<std::size_t>(set.dimension);
  Sums sums(set.dimension, set.X.data() + body.first, static_cast<std::size_t>(body.last - body.first));
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
        Side const side = side_of(low, high, c, upper, D);
        bool const outside = upper ? at[c] + 1 == body.lattice[c] : at[c] == 0;
        if (outside) {
          sums.add_surface({static_cast<Index>(a), -1, static_cast<int>(c), upper, true}, side, upper);
        } else if (upper) {
          std::array<int, 3> next = at;
          ++next[c];
          sums.add_facet(a, particle_at(next), side);
        }
      }
  }
  sums.finish();
  return std::move(sums.cells);
}

/// Blocks of a sixth of the spacing.
class Sampling {
 public:
  Sampling(ParticleSet const& set, Body const& body)
      : outline_(body.outline),
        D_(static_cast<std::size_t>(set.dimension)),
        h_(body.spacing),
        nearest_(set, body),
        sums_(set.dimension, set.X.data() + body.first, static_cast<std::size_t>(body.last - body.first)) {
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
    long const rows = count_[1] * count_[2];
    owner_.resize(at(rows, 0));
    exec_host::parallel_for(static_cast<Index>(rows), [&](Index row) { find_owners(row); });
    if (outline_.patches) fit_to_surface();
    each_inside([&](Place const& place) { take(place); });
    sums_.finish();
    return std::move(sums_.cells);
  }

 private:
  using Place = std::array<long, 3>;
  /// A corner of blocks at the surface, and the patches that meet there.
  struct Corner {
    Place at;
    std::vector<int> patches;
    Point X{};
  };

  template <class F>
  void each_inside(F const& f) const {
    for (long row = 0; row < count_[1] * count_[2]; ++row)
      for (long i = 0; i < count_[0]; ++i)
        if (Place const place = place_of(row, i); is_inside(place)) f(place);
  }
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

  // Corners of blocks are numbered like blocks, with one more in each direction.
  std::size_t corner_index(Place const& at) const {
    auto const n = [&](std::size_t c) { return static_cast<std::size_t>(count_[c]) + (c < D_ ? 1 : 0); };
    return (static_cast<std::size_t>(at[2]) * n(1) + static_cast<std::size_t>(at[1])) * n(0) +
           static_cast<std::size_t>(at[0]);
  }
  /// The corners of the side of a block, in the order of Side.
  std::array<Place, 4> corners_of(Place low, std::size_t axis, bool upper) const {
    if (upper) ++low[axis];
    std::array<Place, 4> corner{low, low, low, low};
    if (D_ == 2) ++corner[1][1 - axis];
    if (D_ < 3) return corner;
    std::size_t const u = (axis + 1) % 3, v = (axis + 2) % 3;
    ++corner[1][u];
    ++corner[2][u];
    ++corner[2][v];
    ++corner[3][v];
    return corner;
  }
  std::size_t corners_of_side() const { return D_ == 3 ? 4 : D_; }
  Side side_at(Place const& place, std::size_t axis, bool upper) const {
    Side side{axis, {}, true};
    auto const corners = corners_of(place, axis, upper);
    for (std::size_t k = 0; k < corners_of_side(); ++k) {
      std::int32_t const moved = corner_number_.empty() ? -1 : corner_number_[corner_index(corners[k])];
      side.flat = side.flat && moved < 0;
      side.corner[k] = moved < 0 ? corner_at(corners[k]) : corners_[static_cast<std::size_t>(moved)].X;
    }
    return side;
  }
  Point corner_at(Place const& at) const {
    Point X{};
    for (std::size_t c = 0; c < D_; ++c)
      X[c] = at[c] == count_[c] ? outline_.max[c] : outline_.min[c] + static_cast<double>(at[c]) * edge_[c];
    return X;
  }

  /// Gives every outer side its patch, and moves the corners of outer sides onto all patches that meet there.
  void fit_to_surface() {
    std::size_t corners = 1;
    for (std::size_t c = 0; c < D_; ++c) corners *= static_cast<std::size_t>(count_[c]) + 1;
    corner_number_.assign(corners, -1);
    each_inside([&](Place const& place) {
      for (std::size_t axis = 0; axis < D_; ++axis)
        for (bool const upper : {false, true})
          if (!is_inside(beside(place, axis, upper ? 1 : -1))) outer_.push_back({place, axis, upper, -1});
    });
    exec_host::parallel_for(static_cast<Index>(outer_.size()),
                            [&](Index k) { label(outer_[static_cast<std::size_t>(k)]); });
    for (OuterSide const& side : outer_) {
      if (side.patch < 0) continue;
      auto const all = corners_of(side.place, side.axis, side.upper);
      for (std::size_t k = 0; k < corners_of_side(); ++k) {
        auto& number = corner_number_[corner_index(all[k])];
        if (number < 0) {
          number = static_cast<std::int32_t>(corners_.size());
          corners_.push_back({all[k], {}, corner_at(all[k])});
        }
        auto& patches = corners_[static_cast<std::size_t>(number)].patches;
        if (std::find(patches.begin(), patches.end(), side.patch) == patches.end()) patches.push_back(side.patch);
      }
    }
    std::vector<double> moved(corners_.size());
    exec_host::parallel_for(static_cast<Index>(corners_.size()), [&](Index k) {
      moved[static_cast<std::size_t>(k)] = move(corners_[static_cast<std::size_t>(k)]);
    });
    for (double const move : moved) {
      sums_.cells.farthest_move = std::max(sums_.cells.farthest_move, move);
      if (move < 0) ++sums_.cells.unmoved;
    }
    std::sort(outer_.begin(), outer_.end());
  }

  struct OuterSide {
    Place place;
    std::size_t axis;
    bool upper;
    int patch;
    auto key() const { return std::tuple(place[2], place[1], place[0], axis, upper); }
    bool operator<(OuterSide const& o) const { return key() < o.key(); }
  };

  /// The patch with the least distance from the middle of the side, among those that do not face away.
  void label(OuterSide& side) const {
    Point const X = side_at(side.place, side.axis, side.upper).middle(D_);
    double least = std::numeric_limits<double>::infinity();
    for (PatchFoot const& foot : outline_.patches(X, 0.5 * h_[0])) {
      double height = 0, square = 0;
      for (std::size_t c = 0; c < D_; ++c) {
        height += (X[c] - foot.X[c]) * foot.normal[c];
        square += (X[c] - foot.X[c]) * (X[c] - foot.X[c]);
      }
      double const beyond = std::max(0.0, std::sqrt(std::max(0.0, square - height * height)) - foot.radius);
      bool const away = (side.upper ? 1 : -1) * foot.normal[side.axis] <= 1e-9;
      double const cost = std::abs(height) + beyond + (away ? h_[0] : 0);
      if (cost < least) side.patch = foot.patch;
      least = std::min(least, cost);
    }
  }

  /// Newton steps of least norm onto the planes of all patches of a corner. Returns the distance [spacings], or -1 for
  /// a corner that would move too far and stays.
  double move(Corner& corner) const {
    constexpr int steps = 4;
    constexpr double longest = 0.35, negligible = 1e-3;
    Point X = corner.X;
    for (int step = 0; step < steps; ++step) {
      SymMat<3> A;  // sum of n n^T
      Vec<3> b;     // sum of heights n
      auto const feet = outline_.patches(X, 0.5 * h_[0]);
      for (PatchFoot const& foot : feet) {
        if (std::find(corner.patches.begin(), corner.patches.end(), foot.patch) == corner.patches.end()) continue;
        double height = 0;
        for (std::size_t c = 0; c < D_; ++c) height += (X[c] - foot.X[c]) * foot.normal[c];
        if (corner.patches.size() == 1) height = exact_height(X, height);
        for (int i = 0; i < 3; ++i) {
          b[i] += height * foot.normal[static_cast<std::size_t>(i)];
          for (int j = i; j < 3; ++j)
            A(i, j) += foot.normal[static_cast<std::size_t>(i)] * foot.normal[static_cast<std::size_t>(j)];
        }
      }
      Eigen<3> const e = symmetric_eigen<3, double>(A);
      for (int k = 0; k < 3; ++k) {
        if (e.value[k] < negligible) continue;
        double const by = dot(e.vector[k], b) / e.value[k];
        for (std::size_t c = 0; c < D_; ++c) X[c] -= by * e.vector[k][static_cast<int>(c)];
      }
    }
    double square = 0;
    for (std::size_t c = 0; c < D_; ++c) square += (X[c] - corner.X[c]) * (X[c] - corner.X[c]);
    double const distance = std::sqrt(square) / h_[0];
    if (!(distance < longest)) return -1;
    corner.X = X;
    return distance;
  }
  /// Of curved patches the distance of the body, unless another patch is nearer.
  double exact_height(Point const& X, double height) const {
    if (!outline_.distance) return height;
    double const distance = outline_.distance(X);
    return std::abs(distance - height) < 0.02 * h_[0] ? distance : height;
  }

  int patch_of(Place const& place, std::size_t axis, bool upper) const {
    OuterSide const key{place, axis, upper, -1};
    auto const found = std::lower_bound(outer_.begin(), outer_.end(), key);
    return found == outer_.end() || key < *found ? -1 : found->patch;
  }
  void take(Place const& at) {
    std::size_t const a = owner(at);
    for (std::size_t c = 0; c < D_; ++c)
      for (bool const upper : {false, true}) {
        Place const next = beside(at, c, upper ? 1 : -1);
        if (!is_inside(next)) {
          bool const outermost = next[c] < 0 || next[c] >= count_[c];
          sums_.add_surface({static_cast<Index>(a), patch_of(at, c, upper), static_cast<int>(c), upper, outermost},
                            side_at(at, c, upper), upper);
        } else if (std::size_t const b = owner(next); upper && b != a) {
          sums_.add_facet(a, b, side_at(at, c, upper));
        }
      }
  }

  Outline const& outline_;
  std::size_t D_;
  Point h_;
  NearestParticle nearest_;
  Sums sums_;
  Place count_{1, 1, 1};
  Point edge_{};
  std::vector<char> inside_;          ///< empty: all
  std::vector<std::uint32_t> owner_;  ///< of blocks inside
  std::vector<OuterSide> outer_;      ///< of bodies with known patches
  std::vector<Corner> corners_;       ///< of these
  std::vector<std::int32_t> corner_number_;
};

}  // namespace

BodyCells measure_cells(ParticleSet const& set, Body const& body) {
  PIOLA_EXPECTS(set.dimension >= 1 && set.dimension <= 3);
  PIOLA_EXPECTS(is_range_in(body, set));
  PIOLA_EXPECTS(body.spacing[0] > 0 && body.spacing[1] > 0 && body.spacing[2] > 0);
  if (has_lattice_cells(body)) return moments_of_lattice(set, body);
  return Sampling(set, body)();
}

void take_cell_volumes(ParticleSet& set, Body const& body) {
  PIOLA_EXPECTS(set.volume.size() == set.X.size());
  BodyCells const cells = measure_cells(set, body);
  PIOLA_ENSURES(cells.cell.size() == static_cast<std::size_t>(body.last - body.first));
  for (auto id = body.first; id < body.last; ++id)
    set.volume[static_cast<std::size_t>(id)] = cells.cell[static_cast<std::size_t>(id - body.first)].volume;
}

}  // namespace piola
