// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/fragments.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace piola {
namespace {

using Point = std::array<double, 3>;

/// Linear between the sorted values; q in [0, 1].
double percentile(std::vector<double> const& sorted, double q) {
  double const position = q * static_cast<double>(sorted.size() - 1);
  auto const below = static_cast<std::size_t>(position);
  std::size_t const above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double share_below(std::vector<double> const& sorted, double limit) {
  auto const count = std::lower_bound(sorted.begin(), sorted.end(), limit) - sorted.begin();
  return static_cast<double>(count) / static_cast<double>(sorted.size());
}

double mean_of(std::vector<double> const& values) {
  exec::ReproducibleSum sum;
  for (double const v : values) sum += v;
  return sum.value() / static_cast<double>(values.size());
}

double deviation(std::vector<double> const& values) {
  double const mean = mean_of(values);
  exec::ReproducibleSum sum;
  for (double const v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum.value() / static_cast<double>(values.size()));
}

std::optional<std::size_t> chosen(Measured const& measured, Cloud const& cloud, Clusters const& clusters) {
  bool const free = measured.spec.fragment == ProbeSpec::Fragment::largest_free;
  std::vector<char> const held = anchored(measured, cloud, clusters);
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < clusters.size.size(); ++k) {
    if (free && held[k] != 0) continue;
    if (!best || clusters.size[k] > clusters.size[*best]) best = k;
  }
  return best;
}

bool near_axis(ProbeSpec const& spec, Point const& x) {
  auto const axis = static_cast<std::size_t>(spec.axis), p = (axis + 1) % 3, q = (axis + 2) % 3;
  return std::isinf(spec.near_axis) || std::hypot(x[p] - spec.at[p], x[q] - spec.at[q]) < spec.near_axis;
}

/// Volume and mean velocity of the particles.
std::array<double, 4> motion(FieldCache& cache, std::vector<std::int64_t> const& ids) {
  bool const known = cache.knows("Velocity");
  auto const v = known ? cache.values("Velocity") : std::span<double const>();
  exec::ReproducibleSums<4> sums;
  for (std::int64_t const id : ids) {
    auto const i = static_cast<std::size_t>(id);
    double const volume = cache.particles().volume[i];
    double of_particle[]{volume, 0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c)
      of_particle[c + 1] = known ? volume * v[3 * i + c] : std::numeric_limits<double>::quiet_NaN();
    sums.add(of_particle);
  }
  double const all = sums.value(0);
  return {all, sums.value(1) / all, sums.value(2) / all, sums.value(3) / all};
}

/// Number, mean volume and relative spread of the pieces.
std::array<double, 3> pieces(Measured const& measured, FieldCache& cache, Cloud const& cloud,
                             Clusters const& clusters) {
  std::vector<exec::ReproducibleSum> volume(clusters.size.size());
  for (std::size_t k = 0; k < cloud.id.size(); ++k)
    volume[clusters.of[k]] += cache.particles().volume[static_cast<std::size_t>(cloud.id[k])];
  std::vector<double> big;
  for (std::size_t k = 0; k < volume.size(); ++k)
    if (clusters.size[k] >= static_cast<std::size_t>(measured.spec.min_particles)) big.push_back(volume[k].value());
  if (big.empty()) return {};
  auto const n = static_cast<double>(big.size());
  double const mean = mean_of(big);
  return {n, mean, deviation(big) / mean};
}

Point extents(std::vector<Point> const& points) {
  if (points.empty()) return {};
  Point low = points.front(), high = low;
  for (Point const& p : points)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

}  // namespace

std::vector<double> spacing_values(Measured const& measured, FieldCache& cache) {
  PIOLA_EXPECTS(measured.spacing > 0);
  std::vector<std::int64_t> everyone(static_cast<std::size_t>(cache.particles().size()));
  std::iota(everyone.begin(), everyone.end(), std::int64_t{0});
  Cloud const cloud = cloud_of(cache, everyone);
  std::vector<char> counts(everyone.size(), 0);
  for (std::int64_t const id : measured.ids) counts[static_cast<std::size_t>(id)] = 1;
  std::vector<std::size_t> of;
  for (std::size_t k = 0; k < cloud.id.size(); ++k)
    if (counts[static_cast<std::size_t>(cloud.id[k])] != 0) of.push_back(k);
  std::vector<double> d = nearest_distances(cloud.x, of, 1.25 * measured.spacing);
  std::erase_if(d, [](double value) { return !std::isfinite(value); });
  // NOLINTNEXTLINE(modernize-return-braced-init-list): braces would make two values of "seven times not known"
  if (d.empty()) return std::vector<double>(7, std::numeric_limits<double>::quiet_NaN());
  for (double& value : d) value /= measured.spacing;
  std::sort(d.begin(), d.end());
  return {d.front(),    percentile(d, 0.01),  percentile(d, 0.05), percentile(d, 0.5),
          deviation(d), share_below(d, 0.75), share_below(d, 0.5)};
}

std::vector<double> fragment_values(Measured const& measured, FieldCache& cache) {
  PIOLA_EXPECTS(measured.spacing > 0 && measured.spec.link > 0);
  Cloud const cloud = cloud_of(cache, measured.ids);
  Clusters const clusters = find_clusters(cloud.x, measured.spec.link * measured.spacing);
  std::vector<double> out(12, 0);
  out[0] = static_cast<double>(clusters.size.size());
  auto const of_pieces = pieces(measured, cache, cloud, clusters);
  std::copy(of_pieces.begin(), of_pieces.end(), out.begin() + 9);
  auto const fragment = chosen(measured, cloud, clusters);
  if (!fragment) return out;
  std::vector<std::int64_t> ids;
  std::vector<Point> near;
  for (std::size_t k = 0; k < cloud.id.size(); ++k) {
    if (clusters.of[k] != *fragment) continue;
    ids.push_back(cloud.id[k]);
    if (near_axis(measured.spec, cloud.x[k])) near.push_back(cloud.x[k]);
  }
  out[1] = static_cast<double>(ids.size());
  auto const moves = motion(cache, ids);
  std::copy(moves.begin(), moves.end(), out.begin() + 2);
  Point const size = extents(near);
  std::copy(size.begin(), size.end(), out.begin() + 6);
  return out;
}

}  // namespace piola
