// SPDX-License-Identifier: Apache-2.0
#include "piola/report/page_surfaces.hpp"
#include <algorithm>
#include <cmath>

namespace piola::report {
namespace {

constexpr double most_width = 4;  // of the half spacing between outer particles and a surface, in radii of balls

/// Strays stay outside: the box grows by little.
void widen(FrameStatistics& statistics, std::array<std::array<double, 3>, 2> const& least, Point3 const& x) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (!std::isfinite(x[c])) continue;
    statistics.low[c] = std::max(least[0][c], std::min(statistics.low[c], x[c]));
    statistics.high[c] = std::min(least[1][c], std::max(statistics.high[c], x[c]));
  }
}

}  // namespace

PageSurfaces find_surfaces(RunFolder const& run, BodyShapes const& shapes, FrameStatistics& statistics) {
  double const largest =
      statistics.radius.empty() ? 0 : *std::max_element(statistics.radius.begin(), statistics.radius.end());
  std::array<std::array<double, 3>, 2> ends{statistics.low, statistics.high};
  for (std::size_t c = 0; c < 3; ++c) {
    ends[0][c] -= most_width * largest;
    ends[1][c] += most_width * largest;
  }
  PageSurfaces all;
  std::vector<std::uint8_t> seen(statistics.particles, 0);
  for (std::size_t const k : statistics.frames) {
    BodySurfaces const now = shapes.surfaces(FrameReader(run.frames[k].second));
    for (std::size_t i = 0; i < statistics.particles; ++i)
      if (now.alone[i] != 0) seen[i] = 1;
    std::vector<std::uint32_t> list;
    list.reserve(3 * now.facets.size());
    for (auto const& facet : now.facets)
      for (std::uint32_t const i : facet) {
        seen[i] = 1;
        widen(statistics, ends, now.place[i]);
        list.push_back(i);
      }
    if (all.lists.empty() || all.lists.back() != list) all.lists.push_back(std::move(list));
    all.list_of.push_back(all.lists.size() - 1);
  }
  std::vector<std::uint32_t> place(statistics.particles, 0);
  for (std::size_t i = 0; i < statistics.particles; ++i) {
    if (seen[i] == 0) continue;
    place[i] = static_cast<std::uint32_t>(all.particles.size());
    all.particles.push_back(static_cast<std::uint32_t>(i));
  }
  for (auto& list : all.lists)
    for (std::uint32_t& i : list) i = place[i];
  return all;
}

std::vector<std::uint8_t> encode_large_numbers(std::vector<std::uint32_t> const& numbers) {
  std::vector<std::uint16_t> half(numbers.size());
  std::vector<std::uint8_t> bytes;
  for (int const shift : {0, 16}) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      half[i] = static_cast<std::uint16_t>((numbers[i] >> shift) & 0xFFFF);
    auto const part = encode_numbers(half);
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  return bytes;
}

}  // namespace piola::report
