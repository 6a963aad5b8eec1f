// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_checks.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/csv.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace piola {
namespace {

constexpr double farthest_point = 1e9;     // m: nothing that moves fast is that far away; the unit is wrong
constexpr double least_median = 1e-12;     // m: far below atoms, where nothing is solid; the unit is wrong
constexpr double least_distance = 0.3;     // of the median: two closer points are one that is there twice
constexpr double least_fit = 0.25;         // median distance over spacing: 0.55 of random points
constexpr double largest_fit = 2.5;        // 1.1 of the densest packing; 2 of eight points on the corners of a cube
constexpr double singular_part = 0.02;     // of the mean eigenvalue: a corner of a lattice has 0.2
constexpr double weak_part = 0.1;          // noted
constexpr double density_tolerance = 0.2;  // of number densities

std::string cloud_unit(int dimension) { return dimension == 1 ? "m" : fmt::format("m^{}", dimension); }

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count_text(static_cast<std::int64_t>(count)), what, count == 1 ? "" : "s");
}

/// Points at the position of another point.
struct SamePlaces {
  std::size_t count = 0;
  std::size_t first = 0, second = 0;  ///< the pair whose later point comes first
};

SamePlaces same_places(PointCloud const& cloud) {
  std::vector<std::size_t> order(cloud.X.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return cloud.X[a] == cloud.X[b] ? a < b : cloud.X[a] < cloud.X[b]; });
  SamePlaces found;
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (cloud.X[order[k]] != cloud.X[order[k - 1]]) continue;
    if (found.count++ > 0 && order[k] >= found.second) continue;
    found.first = order[k - 1];
    found.second = order[k];
  }
  return found;
}

/// The median of the nearest distances, if the cloud is not refused here.
std::optional<double> check_distances(PointCloud const& cloud, CloudSource const& source,
                                      std::vector<std::string>& problems) {
  if (SamePlaces const same = same_places(cloud); same.count > 0) {
    problems.push_back(
        fmt::format("{}: {} where another one is, first {} and {} - remove the rows that are there twice", source.file,
                    counted(same.count, "point") + (same.count == 1 ? " is" : " are"), source.name(same.first),
                    source.name(same.second)));
    return std::nullopt;
  }
  auto const nearest = nearest_points(cloud.X);
  std::vector<double> distances;
  distances.reserve(nearest.size());
  for (NearestPoint const& n : nearest) distances.push_back(n.distance);
  auto const middle = distances.begin() + std::ssize(distances) / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  double const median = *middle;
  if (median < least_median) {
    problems.push_back(
        fmt::format("{}: the median distance to the nearest point is {} m (at least {} m) - is the unit "
                    "right?",
                    source.file, number_text(median), least_median));
    return std::nullopt;
  }
  std::size_t close = 0, closest = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i].distance < least_distance * median) ++close;
    if (nearest[i].distance < nearest[closest].distance) closest = i;
  }
  if (close == 0) return median;
  problems.push_back(fmt::format(
      "{}: {} nearer to another one than {} of the median distance {}, nearest {} and {} with {} between them - spread "
      "or remove them",
      source.file, counted(close, "point") + (close == 1 ? " is" : " are"), least_distance, quantity_text(median, "m"),
      source.name(closest), source.name(static_cast<std::size_t>(nearest[closest].other)),
      quantity_text(nearest[closest].distance, "m")));
  return std::nullopt;
}

void check_gradients(PointCloud& cloud, std::vector<CloudMoment> const& moments, CloudSource const& source,
                     std::vector<std::string>& problems) {
  WorstNeighbourhood const found = worst_neighbourhood(moments);
  std::size_t const worst = found.point;
  double const typical = found.typical, part = found.part();
  std::size_t singular = 0;
  for (CloudMoment const& m : moments)
    if (!(m.least_eigenvalue > singular_part * typical)) ++singular;
  if (singular == moments.size()) {
    problems.push_back(fmt::format(
        "{}: no gradient can be formed at any of the {}: in every neighbourhood they lie on one {} - {}", source.file,
        counted(moments.size(), "point"), cloud.dimension == 3 ? "plane or line" : "line",
        cloud.dimension == 3 ? "give several layers, or only the columns x and y for a case in 2D" : "spread them"));
  } else if (singular > 0) {
    problems.push_back(fmt::format(
        "{}: no gradient can be formed at {}, worst at {}: the smallest eigenvalue of its matrix is {} of the usual "
        "one "
        "(at least {}); neighbours within 2.4 spacings of {} are too few or lie on one {} - add points there or remove "
        "these",
        source.file, counted(singular, "point"), source.name(worst), number_text(part, 2), singular_part,
        quantity_text(cloud.spacing, "m"), cloud.dimension == 3 ? "plane" : "line"));
  } else if (part < weak_part) {
    cloud.notes.push_back(
        fmt::format("{}: the gradient is weak at {}: the smallest eigenvalue of its matrix is {} of "
                    "the usual one",
                    source.file, source.name(worst), number_text(part, 2)));
  }
}

void note_density(PointCloud& cloud, std::vector<CloudMoment> const& moments, CloudSource const& source) {
  std::size_t inside = 0, off = 0;
  double low = 1, high = 1;
  for (CloudMoment const& m : moments) {
    if (!m.inside) continue;
    ++inside;
    if (!(std::abs(m.density - 1) <= density_tolerance)) ++off;
    low = std::min(low, m.density);
    high = std::max(high, m.density);
  }
  if (off == 0) return;
  double const share = 100 * static_cast<double>(off) / static_cast<double>(inside);
  cloud.notes.push_back(
      fmt::format("{}: at {} % of the {} inside, the number density is more than {:.0f} % off ({} to "
                  "{} of the even one): a more even cloud is more accurate",
                  source.file, number_text(share, 3), counted(inside, "point"), 100 * density_tolerance,
                  number_text(low, 2), number_text(high, 2)));
}

}  // namespace

void check_cloud_numbers(PointCloud const& cloud, CloudSource const& source, std::vector<std::string>& problems) {
  PIOLA_EXPECTS(source.row.size() == cloud.X.size());
  CsvProblems list(source.file, problems);
  auto const check_volume = [&](std::size_t i, double volume, std::string_view name) {
    if (volume > 0 && std::isfinite(volume)) return;
    list.add(fmt::format("{}: the {} is {} {} (expected a positive number) - correct or remove the row",
                         source.place(i), name, number_text(volume), cloud_unit(cloud.dimension)));
  };
  for (std::size_t i = 0; i < cloud.X.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      double const x = cloud.X[i][c];
      if (std::abs(x) <= farthest_point) continue;
      list.add(fmt::format("{}: {} is {} ({}) - correct the row{}", source.place(i), "xyz"[c],
                           std::isnan(x) ? number_text(x) : number_text(x) + " m",
                           std::isfinite(x)
                               ? fmt::format("at most {} m away from the origin", number_text(farthest_point))
                               : "expected a finite number",
                           std::isfinite(x) ? " or the unit" : ""));
    }
    if (i < cloud.volume.size()) check_volume(i, cloud.volume[i], "volume");
    if (i < cloud.kernel_volume.size()) check_volume(i, cloud.kernel_volume[i], "kernel volume");
  }
}

void check_cloud_places(PointCloud& cloud, CloudSource const& source, std::vector<std::string>& problems) {
  PIOLA_EXPECTS(cloud.volume.size() == cloud.X.size() && source.row.size() == cloud.X.size());
  auto const distance = check_distances(cloud, source, problems);
  if (!distance) return;
  double const median = *distance;
  if (median < least_fit * cloud.spacing || median > largest_fit * cloud.spacing) {
    double const total = std::accumulate(cloud.volume.begin(), cloud.volume.end(), 0.0);
    problems.push_back(fmt::format(
        "{}: the volumes do not fit the distances: {} over {} is a spacing of {}, but the "
        "median distance is {} ({} to {} spacings) - are the units right?",
        source.file, number_text(total) + " " + cloud_unit(cloud.dimension), counted(cloud.X.size(), "point"),
        quantity_text(cloud.spacing, "m"), quantity_text(median, "m"), least_fit, largest_fit));
    return;
  }
  auto const moments = cloud_moments(cloud);
  check_gradients(cloud, moments, source, problems);
  note_density(cloud, moments, source);
}

}  // namespace piola
