// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/ground_shadow.hpp"
#include "piola/drawing/scene.hpp"
#include "piola/drawing/vector_math.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola {
namespace {

constexpr int patches_across = 96;  // patches of the ground along each side

/// A plane across `up` with its own axes.
struct Ground {
  Point3 up{}, e1{}, e2{};
  double height = 0;  ///< [m]

  Ground(Point3 const& upwards, double at) : up(upwards), height(at) {
    Point3 const other = std::abs(up[0]) < 0.5 ? Point3{1, 0, 0} : Point3{0, 1, 0};
    e1 = unit(cross(other, up));
    e2 = cross(up, e1);
  }
  std::array<double, 2> place(Point3 const& p) const { return {dot(p, e1), dot(p, e2)}; }
};

struct Square {
  std::array<double, 2> middle{};
  double side = 0;
};

/// The lowest place of the shapes at the start [m]; of particles without a mesh, of their balls.
double lowest(PictureData const& data, Point3 const& up) {
  double low = std::numeric_limits<double>::infinity();
  for (ReferenceMesh const& mesh : data.meshes)
    for (std::size_t i = 0; i < mesh.count; ++i) low = std::min(low, dot(plus(mesh.X[i], 1, mesh.outward[i]), up));
  for (std::size_t i = 0; data.meshes.empty() && i < data.points.size(); ++i)
    low = std::min(low, dot(data.points[i], up) - data.radius[i]);
  return low;
}

/// A square of the ground around points, twice as large as they need.
template <class Places>
Square around(Ground const& ground, Places const& points) {
  std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
  for (Point3 const& p : points) {
    auto const at = ground.place(p);
    for (std::size_t c = 0; c < 2; ++c) {
      if (!std::isfinite(at[c])) continue;
      low[c] = std::min(low[c], at[c]);
      high[c] = std::max(high[c], at[c]);
    }
  }
  if (!(high[0] >= low[0]) || !(high[1] >= low[1])) return {};
  return {{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2}, 2 * std::max(high[0] - low[0], high[1] - low[1])};
}

/// Heights of the lowest surfaces above the patches of a square [m]; infinite: nothing.
std::vector<double> heights(PictureData const& data, Appearance const& appearance, Ground const& ground,
                            Square const& square) {
  double const scale = patches_across / square.side;
  Point3 const down{-ground.up[0], -ground.up[1], -ground.up[2]};
  Projection const from_below{ground.e1,
                              ground.e2,
                              down,
                              scale,
                              patches_across / 2.0 - scale * square.middle[0],
                              patches_across / 2.0 + scale * square.middle[1]};
  Scene const scene = make_scene(data, {.as = appearance.as, .cut = appearance.cut}, from_below, 1);
  SurfaceBuffers below(patches_across, patches_across);
  rasterise(scene.bodies, below);
  std::vector<double> out(below.depth.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (below.owner[k] != no_owner)
      out[k] = std::max(-static_cast<double>(below.depth[k]) / scale - ground.height, 0.0);
  return out;
}

/// Fraction of the sky that is hidden from each patch.
std::vector<float> hidden_sky(std::vector<double> const& height, double side) {
  double const patch = side / patches_across, area = patch * patch, least = 0.6 * patch;
  struct OccludingPatch {
    double x, y, h2;
  };
  std::vector<OccludingPatch> above;
  for (std::size_t k = 0; k < height.size(); ++k) {
    if (!std::isfinite(height[k])) continue;
    double const h = std::max(height[k], least);
    above.push_back(
        {patch * static_cast<double>(k % patches_across), patch * static_cast<double>(k / patches_across), h * h});
  }
  std::vector<float> hidden(height.size(), 0);
  auto const work = static_cast<Index>(above.size() * patches_across);
  exec_host::parallel_for_chunks(patches_across, work, [&](Index row) {
    for (int column = 0; column < patches_across; ++column) {
      double const x = patch * column, y = patch * static_cast<double>(row);
      double sum = 0;
      for (OccludingPatch const& a : above) {
        double const r2 = (a.x - x) * (a.x - x) + (a.y - y) * (a.y - y) + a.h2;
        sum += a.h2 / (r2 * r2);
      }
      hidden[static_cast<std::size_t>(row) * patches_across + static_cast<std::size_t>(column)] =
          static_cast<float>(std::min(1.0, area * sum / std::numbers::pi));
    }
  });
  return hidden;
}

/// Between the patches, and nothing beyond them.
float interpolated(std::vector<float> const& hidden, double x, double y) {
  double const i = std::floor(x - 0.5), j = std::floor(y - 0.5);
  auto const at = [&](double a, double b) {
    if (a < 0 || b < 0 || a >= patches_across || b >= patches_across) return 0.0F;
    return hidden[static_cast<std::size_t>(b) * patches_across + static_cast<std::size_t>(a)];
  };
  auto const u = static_cast<float>(x - 0.5 - i), v = static_cast<float>(y - 0.5 - j);
  return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) + v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
}

/// Fades what comes near to letters, so that the ground does not end in a line.
float fade_at_letters(SceneArea const& area, int x, int y) {
  int const bottom = area.bottom > 0 ? area.bottom : 2 * area.height,
            right = area.right < area.width ? area.right : 2 * area.width;
  float const room = 0.15F * static_cast<float>(std::min(area.width, area.height));
  float const t = std::clamp(static_cast<float>(std::min(right - x, bottom - y)) / room, 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

}  // namespace

std::vector<GroundLight> ground_below(PictureData const& data, Appearance const& appearance, Projection const& project,
                                      SceneArea const& area) {
  if (!data.ground || data.dimension < 3 || data.points.empty()) return {};
  Ground const ground(*data.ground, lowest(data, *data.ground));
  Square const stage = around(ground, std::array{data.stage_low, data.stage_high});
  Square const square = data.swept ? stage : around(ground, data.points);
  if (!(square.side > 0) || !std::isfinite(ground.height)) return {};
  auto const hidden = hidden_sky(heights(data, appearance, ground, square), square.side);
  Square const& disc = stage.side > 0 ? stage : square;
  double const reach = 0.9 * disc.side, patches = patches_across / square.side;
  std::vector<GroundLight> out(static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height));
  exec_host::parallel_for_chunks(area.height, static_cast<Index>(out.size()), [&](Index row) {
    for (int x = 0; x < area.width; ++x) {
      ViewRay const sight = project.sight(x + 0.5, static_cast<double>(row) + 0.5);
      double const steep = dot(sight.towards, ground.up);
      if (steep < 0.02) continue;  // seen from below, or as a line
      Point3 const p = plus(sight.from, (ground.height - dot(sight.from, ground.up)) / steep, sight.towards);
      auto const at = ground.place(p);
      double const far = std::hypot(at[0] - disc.middle[0], at[1] - disc.middle[1]) / reach;
      float const sky = interpolated(hidden, patches_across / 2.0 + patches * (at[0] - square.middle[0]),
                                     patches_across / 2.0 - patches * (at[1] - square.middle[1]));
      auto const fade = static_cast<float>(far < 1 ? (1 - far * far) * (1 - far * far) : 0);
      auto& light =
          out[static_cast<std::size_t>(row) * static_cast<std::size_t>(area.width) + static_cast<std::size_t>(x)];
      float const own = 0.5F * fade;
      float const share = own + (1 - own) * 0.9F * sky;
      light = {share * fade_at_letters(area, x, static_cast<int>(row)), 1 - 0.85F * sky};
    }
  });
  return out;
}

}  // namespace piola
