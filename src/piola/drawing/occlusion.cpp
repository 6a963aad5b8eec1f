// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/drawing/shade.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola {
namespace {

constexpr float least_openness = 0.4F;
constexpr float nothing = -std::numeric_limits<float>::infinity();

/// Offset of a sample from a pixel.
struct Tap {
  int x = 0, y = 0;
};

/// The spiral is rotated from pixel to pixel in a pattern of `pattern` x `pattern` pixels, and results are averaged
/// over one pattern. Few directions then suffice without visible artefacts.
constexpr int pattern = 4;

/// Places on a golden spiral that fill a disc evenly, without the pixel itself.
std::vector<Tap> spiral(float radius, int turn, int directions) {
  std::vector<Tap> taps;
  float const golden = std::numbers::pi_v<float> * (3 - std::sqrt(5.0F));
  float const first = 2 * std::numbers::pi_v<float> * static_cast<float>(turn) / (pattern * pattern);
  for (int k = 0; k < directions; ++k) {
    float const r = radius * std::sqrt((static_cast<float>(k) + 0.5F) / static_cast<float>(directions)),
                a = golden * static_cast<float>(k) + first;
    Tap const tap{static_cast<int>(std::lround(r * std::cos(a))), static_cast<int>(std::lround(r * std::sin(a)))};
    if (tap.x != 0 || tap.y != 0) taps.push_back(tap);
  }
  return taps;
}

/// How much two radii darken an inner corner of a right angle: measured so that it is in the middle of 0.5 to 0.8.
constexpr float strength = 2.6F;

/// Every `pattern`-th pixel of a row in a half-open range.
struct Pixels {
  int row = 0, first = 0, last = 0;
};

/// The pixels of a row between which there is something.
Pixels shown(PixelSurface const& here, int row) {
  auto const begin = here.depth.begin() + static_cast<std::ptrdiff_t>(row) * here.width, end = begin + here.width;
  auto const is_there = [](float depth) { return depth > nothing; };
  auto const first = std::find_if(begin, end, is_there);
  auto const last = std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(first), is_there).base();
  return {row, static_cast<int>(first - begin), static_cast<int>(last - begin)};
}

/// Adds the occlusion by the surfaces at one offset, for every `pattern`-th pixel of a row.
void add_row(PixelSurface const& here, std::span<float const> around, Tap const& tap, Pixels const& pixels, float reach,
             std::span<float> sum) {
  constexpr float bias = 0.12F;  // of the sine: what a rounded surface of triangles shows of itself
  int const other = pixels.row + tap.y;
  if (other < 0 || other >= here.height) return;
  int const x1 = std::min(pixels.last, here.width - tap.x);
  int x0 = pixels.first;
  while (x0 + tap.x < 0) x0 += pattern;
  auto const row = static_cast<std::size_t>(pixels.row) * static_cast<std::size_t>(here.width);
  float const* const from = &here.depth[row];
  float const* const to = &around[static_cast<std::size_t>(other) * static_cast<std::size_t>(here.width)];
  auto const dx = static_cast<float>(tap.x), dy = static_cast<float>(tap.y), flat = dx * dx + dy * dy;
  for (int x = x0; x < x1; x += pattern) {
    float const dz = to[x + tap.x] - from[x];
    if (!(dz > -reach && dz < 4 * reach)) continue;  // nothing there, or far in front: no shadow on what is behind
    auto const& n = here.normal[row + static_cast<std::size_t>(x)];
    float const distance2 = flat + dz * dz;
    float const over = (n[0] * dx + n[1] * dy + n[2] * dz) / std::sqrt(distance2) - bias;
    if (over > 0) sum[static_cast<std::size_t>(x)] += over * reach * reach / (reach * reach + distance2);
  }
}

/// The mean over one pattern in a direction, of pixels on the same surface.
std::vector<float> blurred(PixelSurface const& here, std::vector<float> const& open, bool along_rows, float reach) {
  std::vector<float> out(open.size(), 1);
  exec_host::parallel_for_chunks(here.height, static_cast<Index>(open.size()), [&](Index y) {
    for (int x = 0; x < here.width; ++x) {
      auto const at = static_cast<std::size_t>(y) * static_cast<std::size_t>(here.width) + static_cast<std::size_t>(x);
      if (here.depth[at] == nothing) continue;
      float sum = 0, weight = 0;
      for (int k = 1 - pattern / 2; k <= pattern / 2; ++k) {
        int const i = along_rows ? x + k : x, j = along_rows ? y : y + k;
        if (i < 0 || j < 0 || i >= here.width || j >= here.height) continue;
        auto const other =
            static_cast<std::size_t>(j) * static_cast<std::size_t>(here.width) + static_cast<std::size_t>(i);
        if (!(std::abs(here.depth[other] - here.depth[at]) < reach)) continue;
        sum += open[other];
        weight += 1;
      }
      out[at] = sum / weight;
    }
  });
  return out;
}

}  // namespace

PixelSurface::PixelSurface(SurfaceBuffers const& samples, int fine)
    : width(samples.width / fine), height(samples.height / fine) {
  std::size_t const pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  depth.assign(pixels, nothing);
  normal.assign(pixels, {0, 0, 1});
  exec_host::parallel_for_chunks(height, static_cast<Index>(pixels), [&](Index y) {
    for (int x = 0; x < width; ++x) {
      auto const pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      std::size_t nearest = samples.at(x * fine, y * fine);
      for (int k = 1; k < fine * fine; ++k) {
        std::size_t const at = samples.at(x * fine + k % fine, y * fine + k / fine);
        if (samples.depth[at] > samples.depth[nearest]) nearest = at;
      }
      if (samples.depth[nearest] == nothing) continue;
      depth[pixel] = samples.depth[nearest] / static_cast<float>(fine);
      normal[pixel] = SurfaceBuffers::unpacked(samples.normal[nearest]);
    }
  });
}

std::vector<float> openness(PixelSurface const& surface, std::span<float const> around, float ball_radius,
                            int directions) {
  PIOLA_EXPECTS(around.size() == surface.depth.size());
  PIOLA_EXPECTS(directions >= 1);
  auto const pixels = surface.depth.size();
  std::vector<float> open(pixels, 1);
  // Not below two pixels, where there is nothing to see, and not so far that taps are strewn.
  float const near_by = std::clamp(1.2F * ball_radius, 2.0F, 40.0F), far_off = std::clamp(5 * ball_radius, 6.0F, 90.0F);
  std::vector<std::vector<Tap>> close, wide;
  for (int turn = 0; turn < pattern * pattern; ++turn) {
    // Neighbours in the pattern differ by much: 7 has no divisor in common with 16.
    close.push_back(spiral(near_by, 7 * turn % (pattern * pattern), directions));
    wide.push_back(spiral(far_off, 7 * turn % (pattern * pattern), directions));
  }
  exec_host::parallel_for_chunks(surface.height, static_cast<Index>(pixels), [&](Index y) {
    std::vector<float> sum(static_cast<std::size_t>(surface.width), 0);
    Pixels some = shown(surface, y);
    for (int k = 0; k < pattern && some.first < some.last; ++k, ++some.first) {
      auto const turn = static_cast<std::size_t>(y % pattern * pattern + some.first % pattern);
      for (Tap const& tap : close[turn]) add_row(surface, around, tap, some, near_by, sum);
      for (Tap const& tap : wide[turn]) add_row(surface, around, tap, some, far_off, sum);
    }
    float const share = strength / static_cast<float>(2 * directions);
    float* const row = &open[static_cast<std::size_t>(y) * sum.size()];
    for (std::size_t x = 0; x < sum.size(); ++x) row[x] = std::max(least_openness, 1 - share * sum[x]);
  });
  return blurred(surface, blurred(surface, open, true, near_by), false, near_by);
}

}  // namespace piola
