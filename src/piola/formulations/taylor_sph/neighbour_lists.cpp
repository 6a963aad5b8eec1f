// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/neighbour_lists.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace piola::taylor_sph {
namespace {

using Point = std::array<double, 3>;

/// A place with the side of a crack's face that it is on, if it is on one.
struct Place {
  Point X;
  int side;
};

/// Whether the segment from p to q passes through the crack.
bool is_blocked(Place const& p, Place const& q, Crack const& crack) {
  double const tx = crack.to[0] - crack.from[0], ty = crack.to[1] - crack.from[1], l2 = tx * tx + ty * ty;
  auto const along = [&](Point const& X) { return ((X[0] - crack.from[0]) * tx + (X[1] - crack.from[1]) * ty) / l2; };
  auto const height = [&](Place const& a) {
    double const h = (tx * (a.X[1] - crack.from[1]) - ty * (a.X[0] - crack.from[0])) / l2;
    bool const on_line = std::abs(h) < 1e-9;
    return on_line ? (a.side != 0 && along(a.X) > -1e-9 && along(a.X) < 1 + 1e-9 ? 1e-9 * a.side : 0.0) : h;
  };
  double const hp = height(p), hq = height(q);
  if (hp * hq >= 0) return false;
  double const share = hp / (hp - hq), s = along(p.X) + share * (along(q.X) - along(p.X));
  return s > (crack.tip_at_from ? 1e-9 : -1e-9) && s < 1 - (crack.tip_at_to ? 1e-9 : -1e-9);
}

Points centres_of(Cells const& cells, Points const& x) {
  Points r(at(cells.count()));
  for (Index c = 0; c < cells.count(); ++c) {
    for (Index const corner : cells.of(c))
      for (std::size_t k = 0; k < 3; ++k) r[at(c)][k] += x[at(corner)][k];
    for (double& k : r[at(c)]) k /= cells.corners;
  }
  return r;
}

/// Spacing that each cell stands for: its longest diagonal over that of a unit box.
std::vector<double> spacings_of_cells(Cells const& cells, Points const& x) {
  std::vector<double> r(at(cells.count()));
  int const D = cells.dimension;
  double const unit = std::sqrt(D == 1 ? 1.0 : cells.corners > D + 1 ? D : 2.0);
  for (Index c = 0; c < cells.count(); ++c) r[at(c)] = longest_edge(cells.of(c), x) / unit;
  return r;
}

/// Per particle, the largest spacing of its cells.
std::vector<double> spacings_of_particles(Cells const& cells, std::vector<double> const& of_cells, std::size_t count) {
  std::vector<double> r(count, 0);
  for (Index c = 0; c < cells.count(); ++c)
    for (Index const corner : cells.of(c)) r[at(corner)] = std::max(r[at(corner)], of_cells[at(c)]);
  return r;
}

}  // namespace

NeighbourLists::NeighbourLists(Assembly const& assembly, std::size_t body, Options const& options)
    : adjoint_(options.adjoint),
      smoothing_length_(options.smoothing_length),
      // Lists reach further than the kernels, so that they serve until distances have changed by half of it.
      skin_(options.moving ? 0.2 : 0),
      cracks_(cracks_of(assembly.particles, body)) {
  auto const& side = assembly.particles.crack_side;
  Body const& own = assembly.particles.bodies[body];
  if (!side.empty()) crack_side_.assign(side.begin() + own.first, side.begin() + own.last);
}

bool NeighbourLists::is_visible(Index particle, Index cell, Points const& X, Cells const& cells) const {
  Point middle{};
  for (Index const corner : cells.of(cell))
    for (std::size_t k = 0; k < 3; ++k) middle[k] += X[at(corner)][k] / cells.corners;
  Place const p{X[at(particle)], crack_side_[at(particle)]};
  return std::none_of(cracks_.begin(), cracks_.end(), [&](Crack const& crack) {
    return is_blocked(p, {middle, 0}, crack);
  });
}

void NeighbourLists::build(Points const& x, Particles const& particles, CellMesh const& mesh, Boundary const& boundary,
                           int lanes) {
  x_ = x;
  if (!adjoint_) build_pairs(particles, mesh, boundary, lanes);
  record_distances(mesh.cells(), lanes);
}

void NeighbourLists::build_pairs(Particles const& particles, CellMesh const& mesh, Boundary const& boundary,
                                 int lanes) {
  Cells const& cells = mesh.cells();
  auto cell_h = spacings_of_cells(cells, x_), real_h = spacings_of_particles(cells, cell_h, x_.size());
  for (auto* all : {&cell_h, &real_h})
    for (double& h : *all) h *= smoothing_length_;
  int const D = particles.dimension();
  Points const middle = centres_of(cells, x_);
  std::vector<int> const corners(middle.size(), D + 1);
  // On a plain side two sources (in 3D three) give the derivatives that are needed there; edges and corners need more.
  std::vector<int> least(x_.size(), D + 1);
  for (Index i = 0; i < particles.count(); ++i)
    if (boundary.sides(i) == 1) least[at(i)] = D;
  std::vector<Index> slot_of_cell(at(cells.count()));
  std::iota(slot_of_cell.begin(), slot_of_cell.end(), 0);
  std::vector<Index> in_slot = slot_of_cell;
  in_slot.resize(at(aligned(cells.count())), -1);
  std::function<bool(Index, Index)> from_particle, from_cell;
  if (!cracks_.empty()) {
    from_particle = [&](Index particle, Index cell) { return is_visible(particle, cell, particles.X(), cells); };
    from_cell = [&](Index cell, Index particle) { return is_visible(particle, cell, particles.X(), cells); };
  }
  to_virtual_.build({middle, x_, cell_h, 2, skin_, corners, in_slot, particles.slots(), from_cell}, lanes,
                    static_cast<Index>(particles.particles_in_slots().size()));
  to_real_.build({x_, middle, real_h, 2, skin_, least, particles.particles_in_slots(), slot_of_cell, from_particle},
                 lanes, static_cast<Index>(in_slot.size()));
}

/// Squared distances between the corners of each cell.
void NeighbourLists::record_distances(Cells const& cells, int lanes) {
  std::size_t const pairs = at(cells.corners * (cells.corners - 1) / 2);
  Index const slots = aligned(cells.count());
  reference_square_.assign(at(slots) * pairs, 0);
  for (Index v = 0; v < slots; ++v) {
    auto const corners = cells.of(cell_in_slot(cells, v));
    std::size_t pair = 0;
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = a + 1; b < corners.size(); ++b, ++pair) {
        double const d = distance(x_[at(corners[a])], x_[at(corners[b])]);
        reference_square_[(at(v / lanes) * pairs + pair) * at(lanes) + at(v % lanes)] = d * d;
      }
  }
}

void NeighbourLists::set_views(BodyState& state) const {
  state.cells.reference_square = reference_square_.data();
  if (adjoint_) return;
  state.to_virtual = to_virtual_.table();
  state.to_real = to_real_.table();
}

std::size_t NeighbourLists::bytes() const {
  return to_virtual_.bytes() + to_real_.bytes() + sizeof(double) * reference_square_.size();
}

}  // namespace piola::taylor_sph
