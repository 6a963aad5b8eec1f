// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/raster.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/vector_math.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

constexpr int tile_edge = 64, block_edge = 8, blocks = tile_edge / block_edge;
constexpr float far_away = -std::numeric_limits<float>::infinity();

/// Half-open in samples.
struct Cut {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

int bounded(float value, int low, int high) {
  return static_cast<int>(std::clamp(value, static_cast<float>(low), static_cast<float>(high)));
}

/// The samples whose middles may lie between these coordinates.
Cut samples_between(float x0, float x1, float y0, float y1, Cut const& all) {
  return {bounded(std::floor(x0), all.x0, all.x1), bounded(std::floor(x1) + 1, all.x0, all.x1),
          bounded(std::floor(y0), all.y0, all.y1), bounded(std::floor(y1) + 1, all.y0, all.y1)};
}

Cut around(Ellipsoid const& e, Cut const& all) {
  return samples_between(e.x - e.half[0], e.x + e.half[0], e.y - e.half[1], e.y + e.half[1], all);
}

struct Corners {
  Vertex const &a, &b, &c;
};

Corners corners_of(Surfaces const& surfaces, Triangle const& t) {
  auto const at = [&](int k) -> Vertex const& {
    return surfaces.vertices[static_cast<std::size_t>(t.corner[static_cast<std::size_t>(k)])];
  };
  return {at(0), at(1), at(2)};
}

Cut around(Corners const& t, Cut const& all) {
  return samples_between(std::min({t.a.x, t.b.x, t.c.x}), std::max({t.a.x, t.b.x, t.c.x}),
                         std::min({t.a.y, t.b.y, t.c.y}), std::max({t.a.y, t.b.y, t.c.y}), all);
}

bool drawable(Ellipsoid const& e) {
  return std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.depth) && std::isfinite(e.half[0]) &&
         std::isfinite(e.half[1]) && std::isfinite(e.half[2]) && e.Q[2] > 0 && std::isfinite(e.Q[0] + e.Q[1] + e.Q[2]);
}

bool drawable(Corners const& t) {
  for (Vertex const* v : {&t.a, &t.b, &t.c})
    if (!std::isfinite(v->x) || !std::isfinite(v->y) || !std::isfinite(v->depth)) return false;
  return t.a.beyond <= 0 || t.b.beyond <= 0 || t.c.beyond <= 0;
}

/// Which items touch which tile, in the order of the items.
class TileLists {
 public:
  TileLists(int columns, int rows) : columns_(columns), begin_(static_cast<std::size_t>(columns * rows) + 1, 0) {}
  /// cut(k): the samples that item k may touch.
  template <class F>
  void fill(std::size_t items, F const& cut) {
    for (std::size_t k = 0; k < items; ++k) each_tile(cut(k), [&](std::size_t tile) { ++begin_[tile + 1]; });
    for (std::size_t t = 1; t < begin_.size(); ++t) begin_[t] += begin_[t - 1];
    item_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t k = 0; k < items; ++k)
      each_tile(cut(k), [&](std::size_t tile) { item_[next[tile]++] = static_cast<std::uint32_t>(k); });
  }
  std::span<std::uint32_t> of(std::size_t tile) {
    return std::span(item_).subspan(begin_[tile], begin_[tile + 1] - begin_[tile]);
  }

 private:
  template <class F>
  void each_tile(Cut const& cut, F const& f) const {
    if (cut.empty()) return;
    for (int j = cut.y0 / tile_edge; j <= (cut.y1 - 1) / tile_edge; ++j)
      for (int i = cut.x0 / tile_edge; i <= (cut.x1 - 1) / tile_edge; ++i)
        f(static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i));
  }
  int columns_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> item_;
};

/// One tile during drawing. Stores the largest depth of each block of samples, so that surfaces behind a full block are
/// skipped.
class Tile {
 public:
  Tile(Surfaces const& surfaces, SurfaceBuffers& buffers, Cut const& cut)
      : surfaces_(surfaces), out_(buffers), cut_(cut) {
    stale_.fill(true);
  }

  void draw(Triangle const& t) {
    Corners const corners = corners_of(surfaces_, t);
    auto const& [a, b, c] = corners;
    float const area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    Cut const box = around(corners, cut_);
    if (box.empty() || hidden(box, std::max({a.depth, b.depth, c.depth}))) return;
    for (int y = box.y0; y < box.y1; ++y) {
      float const py = static_cast<float>(y) + 0.5F;
      for (int x = box.x0; x < box.x1; ++x) {
        float const px = static_cast<float>(x) + 0.5F;
        float const u = ((c.y - a.y) * (px - a.x) - (c.x - a.x) * (py - a.y)) / area;
        float const v = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (u >= 0 && v >= 0 && u + v <= 1) put(t, corners, out_.at(x, y), {1 - u - v, u, v});
      }
    }
    spoil(box);
  }

  void draw(Ellipsoid const& e) {
    Cut const box = around(e, cut_);
    if (box.empty() || hidden(box, e.depth + e.half[2])) return;
    float const a = e.Q[2];
    for (int y = box.y0; y < box.y1; ++y) {
      float const dy = static_cast<float>(y) + 0.5F - e.y;
      for (int x = box.x0; x < box.x1; ++x) {
        float const dx = static_cast<float>(x) + 0.5F - e.x;
        float const b = e.Q[5] * dx + e.Q[4] * dy, c = e.Q[0] * dx * dx + 2 * e.Q[3] * dx * dy + e.Q[1] * dy * dy - 1;
        float const root = b * b - a * c;
        if (root < 0) continue;
        float const z = (std::sqrt(root) - b) / a, depth = e.depth + z;
        std::size_t const sample = out_.at(x, y);
        if (!(depth > out_.depth[sample])) continue;
        out_.put(sample, depth, normal_at(e, dx, dy, z), e.value, e.owner);
      }
    }
    spoil(box);
  }

 private:
  static SurfaceBuffers::Normal normal_at(Ellipsoid const& e, float x, float y, float z) {
    if (e.flat) return {0, 0};
    auto const& q = e.Q;
    float const nx = q[0] * x + q[3] * y + q[5] * z, ny = q[3] * x + q[1] * y + q[4] * z,
                nz = q[5] * x + q[4] * y + q[2] * z;
    float const size = std::sqrt(nx * nx + ny * ny + nz * nz);
    return SurfaceBuffers::packed(nx / size, ny / size);
  }

  void put(Triangle const& t, Corners const& corners, std::size_t sample, std::array<float, 3> const& w) {
    auto const& [a, b, c] = corners;
    float const depth = w[0] * a.depth + w[1] * b.depth + w[2] * c.depth;
    if (!(depth > out_.depth[sample])) return;
    if (w[0] * a.beyond + w[1] * b.beyond + w[2] * c.beyond > 0) return;
    SurfaceBuffers::Normal normal{};
    for (std::size_t k = 0; k < 2; ++k)
      normal[k] = static_cast<std::int16_t>(w[0] * static_cast<float>(t.normal[0][k]) +
                                            w[1] * static_cast<float>(t.normal[1][k]) +
                                            w[2] * static_cast<float>(t.normal[2][k]));
    float value = w[0] * a.value + w[1] * b.value + w[2] * c.value;
    if (surfaces_.nearest_value) value = w[0] >= w[1] && w[0] >= w[2] ? a.value : w[1] >= w[2] ? b.value : c.value;
    out_.put(sample, depth, normal, value, t.owner);
  }

  template <class F>
  void each_block(Cut const& box, F const& f) {
    for (int j = (box.y0 - cut_.y0) / block_edge; j <= (box.y1 - 1 - cut_.y0) / block_edge; ++j)
      for (int i = (box.x0 - cut_.x0) / block_edge; i <= (box.x1 - 1 - cut_.x0) / block_edge; ++i)
        if (f(i, j)) return;
  }
  void spoil(Cut const& box) {
    each_block(box, [&](int i, int j) {
      stale_[static_cast<std::size_t>(j * blocks + i)] = true;
      return false;
    });
  }
  /// Whether nothing that near can be seen there.
  bool hidden(Cut const& box, float nearest) {
    bool all = true;
    each_block(box, [&](int i, int j) { return !(all = farthest(i, j) >= nearest); });
    return all;
  }
  float farthest(int i, int j) {
    auto const k = static_cast<std::size_t>(j * blocks + i);
    if (!stale_[k]) return farthest_[k];
    float low = std::numeric_limits<float>::infinity();
    int const x0 = cut_.x0 + i * block_edge, x1 = std::min(x0 + block_edge, cut_.x1);
    int const y0 = cut_.y0 + j * block_edge, y1 = std::min(y0 + block_edge, cut_.y1);
    for (int y = y0; y < y1 && low > far_away; ++y)
      for (int x = x0; x < x1; ++x) low = std::min(low, out_.depth[out_.at(x, y)]);
    stale_[k] = false;
    return farthest_[k] = low;
  }

  Surfaces const& surfaces_;
  SurfaceBuffers& out_;
  Cut cut_;
  std::array<float, static_cast<std::size_t>(blocks* blocks)> farthest_{};
  std::array<bool, static_cast<std::size_t>(blocks* blocks)> stale_{};
};

/// Neighbouring tiles go to different threads, so that a body in one half of the picture keeps all of them busy.
std::size_t spread(std::size_t k, std::size_t count) {
  std::size_t const half = (count + 1) / 2;
  return k < half ? 2 * k : 2 * (k - half) + 1;
}

}  // namespace

SurfaceBuffers::SurfaceBuffers(int columns, int rows) : width(columns), height(rows) {
  PIOLA_EXPECTS(columns >= 0 && rows >= 0);
  std::size_t const samples = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  depth.assign(samples, far_away);
  normal.resize(samples);
  value.resize(samples);
  owner.assign(samples, no_owner);
}

void set_shape(Ellipsoid& ellipsoid, std::array<Point3, 3> const& S) {
  double const xx = dot(S[0], S[0]), yy = dot(S[1], S[1]), zz = dot(S[2], S[2]), xy = dot(S[0], S[1]),
               yz = dot(S[1], S[2]), xz = dot(S[0], S[2]);
  std::array const cofactor{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                            xz * yz - xy * zz, xy * xz - xx * yz, xy * yz - yy * xz};
  double const det = xx * cofactor[0] + xy * cofactor[3] + xz * cofactor[5];
  for (std::size_t k = 0; k < 6; ++k) ellipsoid.Q[k] = static_cast<float>(cofactor[k] / det);
  ellipsoid.half = {static_cast<float>(std::sqrt(xx)), static_cast<float>(std::sqrt(yy)),
                    static_cast<float>(std::sqrt(zz))};
}

void rasterise(Surfaces const& surfaces, SurfaceBuffers& buffers) {
  PIOLA_EXPECTS(buffers.depth.size() ==
                static_cast<std::size_t>(buffers.width) * static_cast<std::size_t>(buffers.height));
  Cut const all{0, buffers.width, 0, buffers.height};
  int const columns = (all.x1 + tile_edge - 1) / tile_edge, rows = (all.y1 + tile_edge - 1) / tile_edge;
  TileLists balls(columns, rows), faces(columns, rows);
  balls.fill(surfaces.ellipsoids.size(), [&](std::size_t k) {
    Ellipsoid const& e = surfaces.ellipsoids[k];
    return drawable(e) ? around(e, all) : Cut{};
  });
  faces.fill(surfaces.triangles.size(), [&](std::size_t k) {
    Corners const t = corners_of(surfaces, surfaces.triangles[k]);
    return drawable(t) ? around(t, all) : Cut{};
  });
  auto const tiles = static_cast<std::size_t>(columns * rows);
  exec_host::parallel_for_chunks(static_cast<Index>(tiles), all.x1 * all.y1, [&](Index part) {
    std::size_t const number = spread(static_cast<std::size_t>(part), tiles);
    int const x0 = static_cast<int>(number) % columns * tile_edge, y0 = static_cast<int>(number) / columns * tile_edge;
    Tile tile(surfaces, buffers, {x0, std::min(x0 + tile_edge, all.x1), y0, std::min(y0 + tile_edge, all.y1)});
    for (std::uint32_t const k : faces.of(number)) tile.draw(surfaces.triangles[k]);
    auto const own = balls.of(number);
    auto const front = [&](std::uint32_t k) { return surfaces.ellipsoids[k].depth + surfaces.ellipsoids[k].half[2]; };
    std::sort(own.begin(), own.end(),
              [&](std::uint32_t a, std::uint32_t b) { return front(a) != front(b) ? front(a) > front(b) : a < b; });
    for (std::uint32_t const k : own) tile.draw(surfaces.ellipsoids[k]);
  });
}

}  // namespace piola
