// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/math/hash.hpp"
#include "piola/neighbours/delaunay_checks.hpp"
#include "piola/neighbours/delaunay_hull.hpp"
#include "piola/neighbours/delaunay_peel.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include "piola/neighbours/simplex.hpp"
#include <algorithm>
#include <limits>
#include <numeric>

namespace piola {
namespace {

/// The points, moved and scaled into a ball, and behind them the corners of a simplex far around it (at distance 1). No
/// sphere of the radius asked for that passes through a point reaches a far corner: cells of at most this radius are
/// those of the points alone. But all points lie inside, so that sides with many points on a line need no care.
struct Enclosed {
  Points points;
  double spacing = 0;  ///< about the distance between points, scaled
};

/// Hash of a point number in [0, 1), equal on every machine (multiplications and shifts).
double hash(std::uint64_t number) {
  return static_cast<double>(hash_mix((number + 1) * 0x9E3779B97F4A7C15U) >> 11) * 0x1p-53;
}

void add_far_corners(Points& points, int dimension) {
  // Turned, so that they are not symmetric to a lattice.
  constexpr double r = 0.8660254037844386, s = 0.06415002990995841;  // sqrt(3) / 2, 1 / sqrt(243)
  if (dimension == 2)
    points.insert(points.end(), {{0.8, 0.6}, {-0.4 - 0.6 * r, 0.8 * r - 0.3}, {0.6 * r - 0.4, -0.3 - 0.8 * r}});
  if (dimension == 3)
    points.insert(points.end(),
                  {{13 * s, 5 * s, -7 * s}, {-11 * s, 11 * s, -s}, {3 * s, -3 * s, 15 * s}, {-5 * s, -13 * s, -7 * s}});
}

Enclosed enclose(Points const& points, int dimension, double radius) {
  Extent const extent = extent_of(points, dimension);
  double const far = 1.01 * dimension * (extent.half_diagonal + radius);
  Enclosed all;
  all.points.reserve(points.size() + 4);
  for (auto const& p : points) {
    std::array<double, 3> x{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) x[d] = (p[d] - extent.centre[d]) / far;
    all.points.push_back(x);
  }
  add_far_corners(all.points, dimension);
  double box = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) box *= extent.size[d] / far;
  all.spacing = std::min(std::pow(box / static_cast<double>(points.size()), 1.0 / dimension), radius / far);
  return all;
}

/// Lifts the points onto the paraboloid above which their Delaunay triangulation is the lower side of the hull. Up to
/// `shift` less or more decides between the diagonals of four points on a circle, as on every lattice.
std::vector<double> lifted(Points const& points, double shift) {
  std::vector<double> height(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    auto const& x = points[p];
    height[p] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + shift * hash(p);
  }
  return height;
}

/// Whether the simplices fill the far simplex once, and none between points of the body is flat.
bool sound(std::vector<Index> const& corner, Enclosed const& all, Index body, int dimension) {
  std::array<Index, 4> far{};
  std::iota(far.begin(), far.end(), body);
  double sum = 0;
  auto const corners = static_cast<std::size_t>(dimension) + 1;
  for (std::size_t k = 0; k < corner.size(); k += corners) {
    double const volume = std::fabs(simplex_volume(all.points, &corner[k], dimension));
    sum += volume;
    if (std::any_of(&corner[k], &corner[k] + corners, [&](Index c) { return c >= body; })) continue;
    if (volume < 1e-12 * std::pow(longest_edge(all.points, &corner[k], dimension), dimension)) return false;
  }
  double const whole = std::fabs(simplex_volume(all.points, far.data(), dimension));
  return std::fabs(sum - whole) < 1e-10 * whole;
}

/// All simplices, those with far corners included. The shift is about 1e-6 of the spacing; where that is lost in
/// rounding, more.
std::vector<Index> triangulate(Enclosed const& all, Index body, int dimension) {
  std::string trouble = "the cells do not fit together";
  for (double const share : {1e-6, 1e-5, 1e-4, 1e-3}) {
    LowerHull const hull = lower_hull(all.points, lifted(all.points, share * all.spacing * all.spacing), dimension);
    if (hull.trouble.empty() && sound(hull.corner, all, body, dimension)) return hull.corner;
    if (!hull.trouble.empty()) trouble = hull.trouble;
  }
  throw InputError("cells between points: the " + std::to_string(body) + " points cannot be triangulated (" + trouble +
                   ") - look for points that nearly coincide");
}

/// The simplices between points of the body alone, each with its corners in rising order, but for the last two, which
/// are exchanged where the volume would be negative; sorted by their corners.
Cells between_points(std::vector<Index> const& all, Points const& points, int dimension) {
  Cells cells{dimension, dimension + 1, {}};
  auto const corners = static_cast<std::size_t>(cells.corners);
  std::vector<std::array<Index, 4>> inside;
  inside.reserve(all.size() / corners);
  for (std::size_t k = 0; k < all.size(); k += corners) {
    constexpr Index unused = std::numeric_limits<Index>::max();
    std::array<Index, 4> corner{unused, unused, unused, unused};
    std::copy_n(&all[k], corners, corner.begin());
    std::sort(corner.begin(), corner.end());
    if (corner[corners - 1] < std::ssize(points)) inside.push_back(corner);
  }
  std::sort(inside.begin(), inside.end());
  cells.corner.reserve(inside.size() * corners);
  for (auto& s : inside) {
    if (simplex_volume(points, s.data(), dimension) < 0) std::swap(s[corners - 1], s[corners - 2]);
    cells.corner.insert(cells.corner.end(), s.begin(), s.begin() + cells.corners);
  }
  return cells;
}

/// Removes simplices that span gaps and bays. The radius of nearly flat simplices is not informative; they are checked
/// later.
void drop_wide(Cells& cells, Points const& points, double largest_radius) {
  std::vector<Index> kept;
  kept.reserve(cells.corner.size());
  for (Index cell = 0; cell < cells.count(); ++cell) {
    auto const corner = cells.of(cell);
    if (circumradius(points, corner.data(), cells.dimension) <= largest_radius || nearly_flat(cells, cell, points))
      kept.insert(kept.end(), corner.begin(), corner.end());
  }
  cells.corner = std::move(kept);
}

Cells intervals(Points const& points, double longest) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  auto const x = [&](Index p) { return points[static_cast<std::size_t>(p)][0]; };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return x(a) < x(b); });
  Cells cells{1, 2, {}};
  for (std::size_t k = 0; k + 1 < order.size(); ++k)
    if (x(order[k + 1]) - x(order[k]) <= longest) cells.corner.insert(cells.corner.end(), {order[k], order[k + 1]});
  return cells;
}

}  // namespace

Cells delaunay(Points const& points, int dimension, double largest_radius) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3 && largest_radius > 0);
  check_points(points, dimension);
  if (dimension == 1) return intervals(points, 2 * largest_radius);
  double const radius = std::min(largest_radius, 8 * extent_of(points, dimension).half_diagonal);
  auto const body = static_cast<Index>(points.size());
  Cells cells = between_points(triangulate(enclose(points, dimension, radius), body, dimension), points, dimension);
  drop_wide(cells, points, radius);
  peel_slivers(cells, points, radius);
  PIOLA_ENSURES(cells.corner.size() % static_cast<std::size_t>(cells.corners) == 0);
  return cells;
}

}  // namespace piola
