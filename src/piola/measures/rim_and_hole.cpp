// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/rim_and_hole.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace piola {
namespace {

using Point = std::array<double, 3>;

/// The particle of a sector that is furthest along the axis.
struct Tip {
  bool found = false;
  double height = 0, radius = 0;

  void observe(double h, double r) {
    if (found && (h < height || (h == height && r >= radius))) return;
    *this = {true, h, r};
  }
};

std::size_t sector_of(double p, double q, std::size_t sectors) {
  double const turns = std::atan2(q, p) / (2 * std::numbers::pi) + 0.5;
  return std::min(static_cast<std::size_t>(turns * static_cast<double>(sectors)), sectors - 1);
}

std::vector<Tip> tips(Measured const& measured, FieldCache& cache) {
  ProbeSpec const& spec = measured.spec;
  auto const axis = static_cast<std::size_t>(spec.axis), p = (axis + 1) % 3, q = (axis + 2) % 3;
  Cloud const cloud = cloud_of(cache, measured.ids);
  Clusters const clusters = find_clusters(cloud.x, spec.link * measured.spacing);
  std::vector<char> const held = anchored(measured, cloud, clusters);
  std::vector<Tip> list(static_cast<std::size_t>(spec.sectors));
  for (std::size_t k = 0; k < cloud.x.size(); ++k) {
    Point const& x = cloud.x[k];
    double const xp = x[p] - spec.at[p], xq = x[q] - spec.at[q], radius = std::hypot(xp, xq);
    if (held[clusters.of[k]] != 0 && radius <= spec.within)
      list[sector_of(xp, xq, list.size())].observe(x[axis], radius);
  }
  return list;
}

/// Smallest distances from the axis on its two sides.
struct Gap {
  double upper = std::numeric_limits<double>::infinity(), lower = upper;

  void see_upper(double y) { upper = y >= 0 ? std::min(upper, y) : upper; }
  void see_lower(double y) { lower = y <= 0 ? std::min(lower, -y) : lower; }
  double width(bool axisymmetric) const {
    double const sum = axisymmetric ? 2 * upper : upper + lower;
    return std::isfinite(sum) ? sum : std::numeric_limits<double>::quiet_NaN();
  }
};

/// A cloud as seen from the axis: coordinates along it and across it, from `at`.
struct Profile {
  std::vector<double> along, across;
};

Profile profile_of(ProbeSpec const& spec, Cloud const& cloud) {
  auto const axis = static_cast<std::size_t>(spec.axis), other = 1 - axis;
  Profile profile;
  for (Point const& x : cloud.x) {
    profile.along.push_back(x[axis]);
    profile.across.push_back(x[other] - spec.at[other]);
  }
  return profile;
}

/// The cluster with the most points on one side (sign 1: upper, -1: lower).
std::vector<char> largest_on_side(Profile const& profile, Clusters const& clusters, double sign) {
  std::vector<std::size_t> count(clusters.size.size(), 0);
  for (std::size_t k = 0; k < profile.across.size(); ++k)
    if (sign * profile.across[k] >= 0) ++count[clusters.of[k]];
  std::vector<char> out(count.size(), 0);
  if (!out.empty()) out[static_cast<std::size_t>(std::max_element(count.begin(), count.end()) - count.begin())] = 1;
  return out;
}

double slab(Measured const& measured, Cloud const& cloud, Profile const& profile) {
  ProbeSpec const& spec = measured.spec;
  Clusters const clusters = find_clusters(cloud.x, spec.link * measured.spacing);
  bool const held = spec.anchored_where.has_value();
  auto const upper = held ? anchored(measured, cloud, clusters) : largest_on_side(profile, clusters, 1);
  auto const lower = held ? upper : largest_on_side(profile, clusters, -1);
  Gap gap;
  for (std::size_t k = 0; k < cloud.x.size(); ++k) {
    if (profile.along[k] < spec.slab_from || profile.along[k] > spec.slab_to) continue;
    if (upper[clusters.of[k]] != 0) gap.see_upper(profile.across[k]);
    if (lower[clusters.of[k]] != 0) gap.see_lower(profile.across[k]);
  }
  return gap.width(measured.axisymmetric);
}

double cavity(Measured const& measured, Profile const& profile) {
  ProbeSpec const& spec = measured.spec;
  std::map<double, Gap> bins;
  for (std::size_t k = 0; k < profile.along.size(); ++k) {
    double const x = profile.along[k];
    if (x < spec.cavity_from || x > spec.cavity_to) continue;
    Gap& gap = bins[std::floor((x - spec.cavity_from) / (spec.bin * measured.spacing))];
    gap.see_upper(profile.across[k]);
    gap.see_lower(profile.across[k]);
  }
  double widest = std::numeric_limits<double>::quiet_NaN();
  for (auto const& [bin, gap] : bins) widest = std::fmax(widest, gap.width(measured.axisymmetric));
  return widest;
}

}  // namespace

std::vector<double> rim_values(Measured const& measured, FieldCache& cache) {
  PIOLA_EXPECTS(measured.spec.sectors >= 1);
  double radius = 0, height = 0, count = 0;
  for (Tip const& tip : tips(measured, cache)) {
    if (!tip.found) continue;
    radius += tip.radius;
    height += tip.height - measured.spec.base;
    count += 1;
  }
  if (count == 0) return {0, 0, 0};
  return {2 * radius / count, height / count, count};
}

std::vector<double> hole_values(Measured const& measured, FieldCache& cache) {
  PIOLA_EXPECTS(measured.spec.bin > 0 && measured.spacing > 0);
  Cloud const cloud = cloud_of(cache, measured.ids);
  Profile const profile = profile_of(measured.spec, cloud);
  return {slab(measured, cloud, profile), cavity(measured, profile)};
}

}  // namespace piola
