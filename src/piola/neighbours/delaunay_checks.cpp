// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/delaunay_checks.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/math/tensor.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace piola {
namespace {

constexpr double closest = 1e-9;  // two points nearer than this fraction of the extent are at one place
constexpr std::string_view where = "cells between points: ";

Vec<3> place(std::array<double, 3> const& p, int dimension) {
  return {{p[0], dimension > 1 ? p[1] : 0, dimension > 2 ? p[2] : 0}};
}

double size(Vec<3> const& v) { return std::sqrt(dot(v, v)); }

std::string count_of_points(std::size_t count) {
  return count_text(static_cast<std::int64_t>(count)) + (count == 1 ? " point" : " points");
}

std::string place_text(std::array<double, 3> const& p, int dimension) {
  std::string text = "(";
  for (int d = 0; d < dimension; ++d) text += (d == 0 ? "" : ", ") + number_text(p[static_cast<std::size_t>(d)]);
  return text + ")";
}

void check_finite(Points const& points, int dimension, Problems& problems) {
  auto const bad = [&](std::array<double, 3> const& p) {
    Vec<3> const x = place(p, dimension);
    return !std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]);
  };
  auto const count = static_cast<std::size_t>(std::count_if(points.begin(), points.end(), bad));
  if (count == 0) return;
  auto const first = std::find_if(points.begin(), points.end(), bad) - points.begin();
  problems.add({}, std::string(where) + count_of_points(count) + " without a finite position, the first one number " +
                       std::to_string(first) + " (all must be finite) - look for what moved it");
}

void check_count(Points const& points, int dimension, Problems& problems) {
  auto const least = static_cast<std::size_t>(dimension) + 1;
  if (points.size() >= least) return;
  problems.add({}, std::string(where) + "only " + count_of_points(points.size()) + " (at least " +
                       std::to_string(least) + " in " + std::to_string(dimension) +
                       "D) - give the body more particles");
}

/// Points sorted along a direction in which those of a lattice have all different places: only neighbours in this order
/// can be close to each other.
void check_apart(Points const& points, int dimension, double extent, Problems& problems) {
  Vec<3> const direction{{0.8017837257372732, 0.4472135954999579, 0.3964118069999411}};
  std::vector<double> along(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) along[p] = dot(direction, place(points[p], dimension));
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(along[a], a) < std::pair(along[b], b); });
  double const least = closest * extent;
  std::size_t count = 0;
  std::pair<std::size_t, std::size_t> first{points.size(), 0};
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && along[order[j]] - along[order[i]] <= least; ++j) {
      if (size(place(points[order[j]], dimension) - place(points[order[i]], dimension)) > least) continue;
      first = std::min(first, std::pair(std::min(order[i], order[j]), std::max(order[i], order[j])));
      ++count;
      break;  // each point counts once, however many lie at one place
    }
  if (count == 0) return;
  problems.add({}, std::string(where) + count_of_points(count) + " of " + count_text(std::ssize(points)) +
                       " at the place of another one, the first ones are numbers " + std::to_string(first.first) +
                       " and " + std::to_string(first.second) + " at " + place_text(points[first.first], dimension) +
                       " (points must be 1e-9 of their extent apart) - leave one of them out");
}

/// The corners of a simplex are chosen one by one, each as far as possible from the line (plane) of those before it.
void check_spread(Points const& points, int dimension, double extent, Problems& problems) {
  std::vector<Vec<3>> axis;
  Vec<3> const origin = place(points.front(), dimension);
  for (int d = 0; d < dimension; ++d) {
    Vec<3> farthest;
    for (auto const& p : points) {
      Vec<3> r = place(p, dimension) - origin;
      for (Vec<3> const& a : axis) r = r - dot(a, r) * a;
      if (dot(r, r) > dot(farthest, farthest)) farthest = r;
    }
    if (size(farthest) <= closest * extent) {
      problems.add({}, std::string(where) + "all " + count_of_points(points.size()) + " lie " +
                           (d < 2 ? "on one line" : "in one plane") + " (cells in " + std::to_string(dimension) +
                           "D need points beside it) - use a problem in " + std::to_string(d) +
                           "D or give the body a second layer");
      return;
    }
    axis.push_back((1 / size(farthest)) * farthest);
  }
}

}  // namespace

Extent extent_of(Points const& points, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  Extent extent;
  double sum = 0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension) && !points.empty(); ++d) {
    auto const by_component = [d](auto const& a, auto const& b) { return a[d] < b[d]; };
    auto const [low, high] = std::minmax_element(points.begin(), points.end(), by_component);
    extent.centre[d] = ((*low)[d] + (*high)[d]) / 2;
    extent.size[d] = (*high)[d] - (*low)[d];
    sum += extent.size[d] * extent.size[d];
  }
  extent.half_diagonal = std::sqrt(sum) / 2;
  return extent;
}

void check_points(Points const& points, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  Problems problems;
  check_finite(points, dimension, problems);
  check_count(points, dimension, problems);
  if (problems.empty()) {
    auto const& sides = extent_of(points, dimension).size;
    double const extent = *std::max_element(sides.begin(), sides.end());
    check_apart(points, dimension, extent, problems);
    if (problems.empty()) check_spread(points, dimension, extent, problems);
  }
  problems.raise_if_any();
}

}  // namespace piola
