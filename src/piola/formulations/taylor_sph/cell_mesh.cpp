// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/cell_mesh.hpp"
#include "piola/base/errors.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace piola::taylor_sph {
namespace {

using Point = std::array<double, 3>;

/// A lattice is triangulated with alternating diagonals: all triangulations of its squares are Delaunay's.
Cells first_cells(ParticleSet const& set, Particles const& particles, Options const& options, bool cracked,
                  double largest_radius) {
  Body const& body = particles.body();
  if (options.lattice_cells) return lattice_cells(set, body);
  if (is_whole_lattice(set, body) && (body.regular || cracked))
    // Under the adjoint exchange masses are those of the cells: as many around each particle.
    return split_alternately(lattice_cells(set, body), set, body,
                             !options.adjoint ? Diagonals::by_box
                             : !cracked       ? Diagonals::by_row
                                              : Diagonals::by_column);
  return delaunay(particles.X(), particles.dimension(), largest_radius);
}

/// Whether a point lies in a simplex, by barycentric coordinates.
bool is_inside(Point const& p, std::span<Index const> corners, Points const& x, int D) {
  double A[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, b[3] = {0, 0, 0};
  auto const corner = [&](std::size_t k) { return x[at(corners[k])]; };
  for (int i = 0; i < D; ++i) {
    auto const c = static_cast<std::size_t>(i);
    for (int k = 0; k < D; ++k) A[3 * i + k] = corner(static_cast<std::size_t>(k) + 1)[c] - corner(0)[c];
    b[i] = p[c] - corner(0)[c];
  }
  if (!(solve_in_place<3>(A, b) > 0)) return false;
  double first = 1;
  for (int k = 0; k < D; ++k) {
    if (b[k] < -1e-9) return false;
    first -= b[k];
  }
  return first > -1e-9;
}

/// The cells of `all` whose centres lie in one of `cover`, all simplices of the same points.
Cells cells_within(Cells const& all, Cells const& cover, Points const& x) {
  auto const middle = [&](Cells const& cells, Index c) {
    Point m{};
    for (Index const corner : cells.of(c))
      for (std::size_t k = 0; k < 3; ++k) m[k] += x[at(corner)][k] / cells.corners;
    return m;
  };
  Points centres;
  double widest = 0;
  for (Index c = 0; c < cover.count(); ++c) {
    centres.push_back(middle(cover, c));
    for (Index const corner : cover.of(c)) widest = std::max(widest, distance(centres.back(), x[at(corner)]));
  }
  CellGrid const grid(centres, widest);
  Cells kept = all;
  kept.corner.clear();
  for (Index c = 0; c < all.count(); ++c) {
    Point const m = middle(all, c);
    bool inside = false;
    grid.visit(m, [&](Index other) { inside = inside || is_inside(m, cover.of(other), x, all.dimension); });
    if (inside) kept.corner.insert(kept.corner.end(), all.of(c).begin(), all.of(c).end());
  }
  return kept;
}

}  // namespace

bool is_whole_lattice(ParticleSet const& set, Body const& body) {
  std::int64_t full = 1, doubled = 0;
  for (int const n : body.lattice) full *= n;
  for (std::int64_t id = body.first; id < body.last && !set.crack_side.empty(); ++id)
    doubled += set.crack_side[static_cast<std::size_t>(id)] < 0 ? 1 : 0;
  return body.last - body.first - doubled == full;
}

std::vector<Crack> cracks_of(ParticleSet const& set, std::size_t body) {
  std::vector<Crack> own;
  for (auto const& crack : set.cracks)
    if (crack.body == static_cast<int>(body)) own.push_back(crack);
  return own;
}

double distance(Point const& a, Point const& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double longest_edge(std::span<Index const> corners, Points const& x) {
  double longest = 0;
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = a + 1; b < corners.size(); ++b)
      longest = std::max(longest, distance(x[at(corners[a])], x[at(corners[b])]));
  return longest;
}

CellMesh::CellMesh(Assembly const& assembly, std::size_t body, Particles const& particles, Options const& options)
    : adjoint_(options.adjoint) {
  auto const& set = assembly.particles;
  bool const cracked = !cracks_of(set, body).empty();
  constant_ = options.lattice_cells || cracked;
  int const D = particles.dimension();
  double widest = 0;
  for (int c = 0; c < D; ++c) widest = std::max(widest, particles.body().spacing[static_cast<std::size_t>(c)]);
  // The circumradius of a simplex in a box of the lattice is 0.5 sqrt(D) spacings; jitter makes some larger.
  largest_radius_ = (0.6 + 0.35 * D) * widest;
  cells_ = first_cells(set, particles, options, cracked, largest_radius_);
}

void CellMesh::assign(std::vector<Index> corners, Points const& x) {
  x_ = x;
  cells_.corner = std::move(corners);
  Index const n = cells_.count();
  std::vector<Index> order(at(n)), first(at(n));
  std::iota(order.begin(), order.end(), 0);
  for (Index c = 0; c < n; ++c) first[at(c)] = std::ranges::min(cells_.of(c));
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return first[at(a)] < first[at(b)]; });
  Cells sorted = cells_;
  for (Index c = 0; c < n; ++c)
    std::ranges::copy(cells_.of(order[at(c)]), sorted.corner.begin() + static_cast<std::ptrdiff_t>(c) * cells_.corners);
  cells_ = sorted;
}

void CellMesh::make_tables(Particles const& particles, int lanes) {
  int const D = cells_.dimension, corners = cells_.corners;
  constexpr std::size_t most = std::numeric_limits<Index>::max();
  if (cells_.corner.size() > most)
    throw InputError(
        fmt::format("taylor_sph: body '{}' has {} corners of cells (allowed: {} in one process) - use "
                    "larger spacings, or virtual_particles = \"lattice_cells\"",
                    particles.body().name, cells_.corner.size(), most));
  Index const slots = aligned(count());
  corner_.assign(at(slots) * static_cast<std::size_t>(corners), 0);
  reference_quality_.assign(at(slots), 1);
  double factorial = 1;
  for (int c = 2; c <= D && corners == D + 1; ++c) factorial *= c;
  for (Index v = 0; v < slots; ++v) {
    Index const cell = cell_in_slot(cells_, v);
    auto const own = cells_.of(cell);
    for (std::size_t a = 0; a < own.size(); ++a)
      corner_[(at(v / lanes) * static_cast<std::size_t>(corners) + a) * static_cast<std::size_t>(lanes) +
              at(v % lanes)] = particles.slot(own[a]);
    reference_quality_[at(v)] = factorial * volume_of(cells_, cell, x_) / std::pow(longest_edge(own, x_), D);
  }
  if (adjoint_) find_cells_around(particles);
}

/// The cells around each particle, in their order.
void CellMesh::find_cells_around(Particles const& particles) {
  int const corners = cells_.corners;
  around_begin_.assign(particles.particles_in_slots().size() + 1, 0);
  for (Index const corner : cells_.corner) ++around_begin_[at(particles.slot(corner)) + 1];
  std::partial_sum(around_begin_.begin(), around_begin_.end(), around_begin_.begin());
  around_.assign(cells_.corner.size(), 0);
  std::vector<Index> next(around_begin_.begin(), around_begin_.end() - 1);
  for (Index c = 0; c < count(); ++c)
    for (int k = 0; k < corners; ++k)
      around_[at(next[at(particles.slot(cells_.of(c)[static_cast<std::size_t>(k)]))]++)] = c * corners + k;
}

void CellMesh::set_views(BodyState& state) const {
  state.virtual_count = count();
  state.virtuals = {0, aligned(count())};
  state.cells.corners = cells_.corners;
  state.cells.simplices = cells_.corners == cells_.dimension + 1;
  state.cells.corner = corner_.data();
  state.cells.reference_quality = reference_quality_.data();
  state.cells.adjoint = adjoint_;
  if (adjoint_) state.around = {around_begin_.data(), around_.data()};
}

std::optional<Cells> CellMesh::triangulate(Points const& x) const {
  if (constant_) return std::nullopt;
  Cells const all = delaunay(x, cells_.dimension, 2 * largest_radius_);
  return cells_within(all, cells_, x);
}

int CellMesh::cells_around(Index slot) const { return around_begin_[at(slot) + 1] - around_begin_[at(slot)]; }

Index CellMesh::worst_corner(Points const& x) const {
  Index worst = 0;
  for (Index c = 1; c < count(); ++c)
    if (volume_of(cells_, c, x) < volume_of(cells_, worst, x)) worst = c;
  return cells_.of(worst).front();
}

std::size_t CellMesh::bytes() const {
  return sizeof(Index) * (corner_.size() + around_begin_.size() + around_.size() + cells_.corner.size()) +
         sizeof(double) * reference_quality_.size();
}

}  // namespace piola::taylor_sph
