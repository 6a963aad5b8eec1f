// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/output/field_cache.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace piola {

/// Current positions of some particles [m]. Particles with a position that is not finite are left out.
struct Cloud {
  std::vector<std::int64_t> id;
  std::vector<std::array<double, 3>> x;
};
Cloud cloud_of(FieldCache& cache, std::span<std::int64_t const> ids);

/// Connected sets of points: two points are linked if they are closer than `link` [m].
struct Clusters {
  std::vector<std::size_t> of;    ///< cluster of each point, numbered in the order of their first points
  std::vector<std::size_t> size;  ///< points of each cluster
};
Clusters find_clusters(std::vector<std::array<double, 3>> const& points, double link);

/// Distance from each of the points `of` to the nearest other point [m]; infinite if there is none. `near` [m]: search
/// distance that suffices for most points.
std::vector<double> nearest_distances(std::vector<std::array<double, 3>> const& points, std::span<std::size_t const> of,
                                      double near);

/// Selection of the probe kinds spacing, fragment, rim and hole, made once from reference positions.
struct Measured {
  Measured(ProbeSpec const& probe, ParticleSet const& particles, Body const& body, std::vector<std::int64_t> chosen);
  ProbeSpec spec;
  bool axisymmetric;              ///< half sections: both sides of the axis are alike
  double spacing;                 ///< smallest lattice spacing of the body [m]
  std::vector<std::int64_t> ids;  ///< ids of the selected particles
  std::vector<char> anchor;       ///< of every particle of the run: in the anchor region; empty if there is none
};

/// Per cluster: whether it contains a particle of the anchor region.
std::vector<char> anchored(Measured const& measured, Cloud const& cloud, Clusters const& clusters);

}  // namespace piola
