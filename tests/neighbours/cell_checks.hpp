// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/mesh_cells.hpp"
#include "math/random.hpp"
#include "particles/lattices.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <set>

/// Measures and checks of mesh cells and their surfaces.
namespace piola::testing {

inline Vec<3> vector(std::array<double, 3> const& x) { return {{x[0], x[1], x[2]}}; }

inline std::array<double, 3> const& at(Points const& points, Index p) { return points[static_cast<std::size_t>(p)]; }

inline double total_volume(Cells const& cells, Points const& points) {
  double sum = 0;
  for (Index c = 0; c < cells.count(); ++c) sum += volume_of(cells, c, points);
  return sum;
}

inline double smallest_volume(Cells const& cells, Points const& points) {
  double least = 1e300;
  for (Index c = 0; c < cells.count(); ++c) least = std::min(least, volume_of(cells, c, points));
  return least;
}

/// Outward normal of a facet; its length is the size of the facet [m^(dimension - 1)].
inline Vec<3> facet_normal(Surface const& surface, Index facet, Points const& points) {
  auto const corner = [&](Index k) {
    return vector(at(points, surface.corner[static_cast<std::size_t>(facet * surface.dimension + k)]));
  };
  if (surface.dimension == 1) return {{surface.outward[static_cast<std::size_t>(facet)], 0, 0}};
  Vec<3> const t = corner(1) - corner(0);
  if (surface.dimension == 2) return {{t[1], -t[0], 0}};
  return 0.5 * cross(t, corner(2) - corner(0));
}

/// Size of a surface: perimeter in 2D [m], area in 3D [m^2].
inline double surface_size(Surface const& surface, Points const& points) {
  double sum = 0;
  for (Index f = 0; f < surface.count(); ++f) {
    Vec<3> const n = facet_normal(surface, f, points);
    sum += std::sqrt(dot(n, n));
  }
  return sum;
}

/// Volume enclosed by a surface, by the divergence theorem. It is wrong if a normal points inwards or a facet is
/// missing.
inline double enclosed_volume(Surface const& surface, Points const& points) {
  double sum = 0;
  for (Index f = 0; f < surface.count(); ++f) {
    auto const x = vector(at(points, surface.corner[static_cast<std::size_t>(f * surface.dimension)]));
    sum += dot(x, facet_normal(surface, f, points)) / surface.dimension;
  }
  return sum;
}

/// Number of connected components of a surface; facets are connected if they share a corner.
inline int pieces(Surface const& surface, Points const& points) {
  std::vector<std::size_t> root(points.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  auto const find = [&](Index p) {
    auto r = static_cast<std::size_t>(p);
    while (root[r] != r) r = root[r];
    return r;
  };
  for (std::size_t k = 0; k < surface.corner.size(); ++k)
    root[find(surface.corner[k])] = find(surface.corner[k - k % static_cast<std::size_t>(surface.dimension)]);
  std::set<std::size_t> found;
  for (Index const p : surface.corner) found.insert(find(p));
  return static_cast<int>(found.size());
}

/// Expects positive cell volumes with the sum `volume`, which the surface also encloses, and the surface size given.
inline void expect_filled(Cells const& cells, Points const& points, double volume, double surface_measure) {
  Surface const surface = surface_of(cells, points);
  EXPECT_GT(smallest_volume(cells, points), 0);
  EXPECT_NEAR(total_volume(cells, points), volume, 1e-9 * volume);
  EXPECT_NEAR(enclosed_volume(surface, points), volume, 1e-9 * volume);
  EXPECT_NEAR(surface_size(surface, points), surface_measure, 1e-9 * surface_measure);
}

/// The particles with keep(X). They keep their lattice indices.
template <class Keep>
ParticleSet part_of(ParticleSet const& all, Keep const& keep) {
  ParticleSet set;
  set.dimension = all.dimension;
  set.bodies = all.bodies;
  for (std::size_t k = 0; k < all.X.size(); ++k) {
    if (!keep(all.X[k])) continue;
    set.X.push_back(all.X[k]);
    set.lattice_index.push_back(all.lattice_index[k]);
    set.volume.push_back(all.volume[k]);
    set.kernel_volume.push_back(all.kernel_volume[k]);
    set.body.push_back(0);
  }
  set.bodies[0].last = set.size();
  return set;
}

/// Cuts a plate along y = crack.from[1]. Each particle on the crack, except at its tips, gets a twin, appended at the
/// end. `first_side`: side of the crack of the original particles.
inline ParticleSet cut(ParticleSet set, Crack const& crack, std::int8_t first_side = 1) {
  constexpr double near = 1e-9;
  auto const [low, high] = std::minmax(crack.from[0], crack.to[0]);
  set.cracks.push_back(crack);
  set.crack_side.resize(set.X.size(), 0);
  for (std::size_t k = 0, n = set.X.size(); k < n; ++k) {
    auto const X = set.X[k];
    if (std::fabs(X[1] - crack.from[1]) > near || X[0] < low - near || X[0] > high + near) continue;
    if (crack.tip_at_from && std::fabs(X[0] - crack.from[0]) < near) continue;
    if (crack.tip_at_to && std::fabs(X[0] - crack.to[0]) < near) continue;
    set.crack_side[k] = first_side;
    set.X.push_back(X);
    set.lattice_index.push_back(set.lattice_index[k]);
    set.volume.push_back(set.volume[k] /= 2);
    set.kernel_volume.push_back(set.kernel_volume[k]);
    set.body.push_back(0);
    set.crack_side.push_back(static_cast<std::int8_t>(-first_side));
  }
  set.bodies[0].last = set.size();
  return set;
}

/// Expects that cells with a particle on a face of a horizontal crack lie on the side of that particle. Returns the
/// number of cell corners on crack faces.
inline int expect_no_cell_straddles(Cells const& cells, ParticleSet const& set, Crack const& crack) {
  double const direction = crack.to[0] > crack.from[0] ? 1 : -1;
  int corners = 0;
  for (Index cell = 0; cell < cells.count(); ++cell)
    for (Index const p : cells.of(cell)) {
      int const side = set.crack_side[static_cast<std::size_t>(p)];
      if (side == 0) continue;
      ++corners;
      for (Index const q : cells.of(cell))
        EXPECT_GE(side * direction * (at(set.X, q)[1] - crack.from[1]), 0) << "cell " << cell;
    }
  return corners;
}

}  // namespace piola::testing
