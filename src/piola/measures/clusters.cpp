// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/clusters.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace piola {
namespace {

using Point = std::array<double, 3>;

double distance2(Point const& a, Point const& b) {
  double const x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

double nearest_distance(std::vector<Point> const& points, CellGrid const& grid, std::size_t i) {
  double best = std::numeric_limits<double>::infinity();
  grid.visit(points[i], [&](Index j) {
    auto const k = static_cast<std::size_t>(j);
    if (k != i) best = std::min(best, distance2(points[i], points[k]));
  });
  return std::sqrt(best);
}

double diagonal(std::vector<Point> const& points) {
  Point low = points.front(), high = low;
  for (Point const& p : points)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  return std::sqrt(distance2(low, high));
}

}  // namespace

Cloud cloud_of(FieldCache& cache, std::span<std::int64_t const> ids) {
  auto const x = cache.values("Position");
  Cloud cloud;
  for (std::int64_t const id : ids) {
    double const* const at = &x[3 * static_cast<std::size_t>(id)];
    if (!std::isfinite(at[0]) || !std::isfinite(at[1]) || !std::isfinite(at[2])) continue;
    cloud.id.push_back(id);
    cloud.x.push_back({at[0], at[1], at[2]});
  }
  return cloud;
}

Clusters find_clusters(std::vector<Point> const& points, double link) {
  PIOLA_EXPECTS(link > 0);
  std::vector<std::size_t> parent(points.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  CellGrid const grid(points, link);
  for (std::size_t i = 0; i < points.size(); ++i) {
    grid.visit(points[i], [&](Index j) {
      auto const k = static_cast<std::size_t>(j);
      if (k >= i || distance2(points[i], points[k]) >= link * link) return;
      std::size_t const a = root_of(parent, i), b = root_of(parent, k);
      parent[std::max(a, b)] = std::min(a, b);  // the root of a cluster is its first point
    });
  }
  Clusters clusters;
  clusters.of.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t const root = root_of(parent, i);
    if (root == i) clusters.size.push_back(0);
    clusters.of[i] = root == i ? clusters.size.size() - 1 : clusters.of[root];
    ++clusters.size[clusters.of[i]];
  }
  return clusters;
}

std::vector<double> nearest_distances(std::vector<Point> const& points, std::span<std::size_t const> of, double near) {
  PIOLA_EXPECTS(near > 0);
  std::vector<double> out(of.size(), std::numeric_limits<double>::infinity());
  if (points.size() < 2) return out;
  std::vector<std::size_t> open(of.size());  // those that have not found theirs for sure
  std::iota(open.begin(), open.end(), std::size_t{0});
  double const all = diagonal(points);
  for (double reach = near; !open.empty(); reach *= 2) {
    CellGrid const grid(points, reach);
    for (std::size_t const k : open) out[k] = nearest_distance(points, grid, of[k]);
    if (reach >= all) break;
    // Beyond the reach another point may be nearer than the one found.
    std::erase_if(open, [&](std::size_t k) { return out[k] <= reach; });
  }
  return out;
}

Measured::Measured(ProbeSpec const& probe, ParticleSet const& particles, Body const& body,
                   std::vector<std::int64_t> chosen)
    : spec(probe),
      axisymmetric(particles.axisymmetric),
      spacing(*std::min_element(body.spacing.begin(), body.spacing.begin() + particles.dimension)),
      ids(std::move(chosen)) {
  PIOLA_EXPECTS(particles.dimension >= 1 && particles.dimension <= 3);
  if (!spec.anchored_where) return;
  for (Point const& X : particles.X) anchor.push_back((*spec.anchored_where)(X) != 0);
}

std::vector<char> anchored(Measured const& measured, Cloud const& cloud, Clusters const& clusters) {
  PIOLA_EXPECTS(cloud.id.size() == clusters.of.size());
  std::vector<char> out(clusters.size.size(), 0);
  if (measured.anchor.empty()) return out;
  for (std::size_t k = 0; k < cloud.id.size(); ++k) {
    if (measured.anchor[static_cast<std::size_t>(cloud.id[k])] != 0) out[clusters.of[k]] = 1;
  }
  return out;
}

}  // namespace piola
