// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/raster.hpp"
#include "piola/drawing/shade.hpp"
#include "piola/exec/threads.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace piola {
namespace {

constexpr int edge = 200;
constexpr float middle = 100;

Ellipsoid ellipsoid(std::array<Point3, 3> const& S, float x = middle, float y = middle, float depth = 0) {
  Ellipsoid e;
  e.x = x;
  e.y = y;
  e.depth = depth;
  set_shape(e, S);
  return e;
}

Ellipsoid ball(float radius, float x = middle, float y = middle, float depth = 0) {
  return ellipsoid({Point3{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}, x, y, depth);
}

SurfaceBuffers drawn(Surfaces const& surfaces, int width = edge, int height = edge) {
  SurfaceBuffers buffers(width, height);
  rasterise(surfaces, buffers);
  return buffers;
}

/// The place of a sample's middle about the centre of the buffers.
std::array<double, 2> place(std::size_t sample) {
  return {static_cast<double>(sample % edge) + 0.5 - middle, static_cast<double>(sample / edge) + 0.5 - middle};
}

TEST(Raster, HasDepthAndNormalOfABall) {
  constexpr double radius = 80;
  Surfaces surfaces;
  surfaces.ellipsoids.push_back(ball(radius));
  auto const out = drawn(surfaces);
  for (std::size_t k = 0; k < out.depth.size(); ++k) {
    auto const [x, y] = place(k);
    double const square = radius * radius - x * x - y * y;
    ASSERT_EQ(out.owner[k] != no_owner, square >= 0) << x << " " << y;
    if (square < 0) continue;
    double const z = std::sqrt(square);
    ASSERT_NEAR(out.depth[k], z, 1e-3 * radius) << x << " " << y;
    auto const n = SurfaceBuffers::unpacked(out.normal[k]);
    ASSERT_NEAR(n[0], x / radius, 1e-3);
    ASSERT_NEAR(n[1], y / radius, 1e-3);
    if (z > 0.1 * radius) {
      ASSERT_NEAR(n[2], z / radius, 1e-3);
    }
  }
}

TEST(Raster, StretchesBallsByTheirDeformation) {
  // A shear and a stretch: the surface is x = S u with |u| = 1, and its normal is along S^-T u.
  std::array<Point3, 3> const S{Point3{60, 20, 0}, {0, 30, 0}, {10, 0, 45}};
  Surfaces surfaces;
  surfaces.ellipsoids.push_back(ellipsoid(S));
  auto const out = drawn(surfaces);
  int seen = 0;
  for (std::size_t k = 0; k < out.depth.size(); ++k) {
    if (out.owner[k] == no_owner) continue;
    auto const [x, y] = place(k);
    double const u1 = y / 30, u0 = (x - 20 * u1) / 60, u2 = (out.depth[k] - 10 * u0) / 45;
    ASSERT_NEAR(u0 * u0 + u1 * u1 + u2 * u2, 1, 1e-3);
    ++seen;
    // S^-T u, by forward substitution of S^T n = u.
    double const n2 = u2 / 45, n0 = (u0 - 10 * n2) / 60, n1 = (u1 - 20 * n0) / 30;
    double const size = std::sqrt(n0 * n0 + n1 * n1 + n2 * n2);
    auto const n = SurfaceBuffers::unpacked(out.normal[k]);
    ASSERT_NEAR(n[0], n0 / size, 1e-3);
    ASSERT_NEAR(n[1], n1 / size, 1e-3);
  }
  EXPECT_NEAR(seen, std::acos(-1.0) * 60 * 30, 200) << "the shadow of an ellipse with the area pi a b";
}

TEST(Raster, DrawsTrianglesWithTheirValuesAndWithoutGaps) {
  Surfaces surfaces;
  std::mt19937 random(1);  // NOLINT: the same triangles each time
  std::uniform_real_distribution<float> shift(-3, 3);
  constexpr int n = 12;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      Vertex v;
      bool const inner = i > 0 && j > 0 && i < n && j < n;
      v.x = 16.0F * static_cast<float>(i) + (inner ? shift(random) : 0);
      v.y = 16.0F * static_cast<float>(j) + (inner ? shift(random) : 0);
      v.depth = 0.5F * v.x - 0.25F * v.y;
      v.value = 2 * v.x + v.y;
      surfaces.vertices.push_back(v);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      int const a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      surfaces.triangles.push_back({{a, b, d}, {}, 3});
      surfaces.triangles.push_back({{a, c, d}, {}, 3});  // opposite orientation
    }
  auto const out = drawn(surfaces);
  for (int y = 0; y < 16 * n; ++y)
    for (int x = 0; x < 16 * n; ++x) {
      std::size_t const k = out.at(x, y);
      ASSERT_EQ(out.owner[k], 3) << x << " " << y;
      ASSERT_NEAR(out.depth[k], 0.5 * (x + 0.5) - 0.25 * (y + 0.5), 1e-3);
      ASSERT_NEAR(out.value[k], 2 * (x + 0.5) + y + 0.5, 1e-2);
    }
}

TEST(Raster, CutsTrianglesAwayBeyondAPlane) {
  Surfaces surfaces;
  for (auto const& [x, y] : {std::array{0.0F, 0.0F}, {200.0F, 0.0F}, {0.0F, 200.0F}}) {
    Vertex v;
    v.x = x;
    v.y = y;
    v.beyond = x - 60;
    surfaces.vertices.push_back(v);
  }
  surfaces.triangles.push_back({{0, 1, 2}, {}, 0});
  auto const out = drawn(surfaces);
  EXPECT_NE(out.owner[out.at(58, 20)], no_owner);
  EXPECT_EQ(out.owner[out.at(62, 20)], no_owner);
}

/// Many balls and triangles, some of them nowhere.
Surfaces crowd() {
  Surfaces surfaces;
  std::mt19937 random(7);  // NOLINT: the same crowd each time
  std::uniform_real_distribution<float> at(-20, 320), size(1, 15);
  for (int i = 0; i < 4000; ++i) {
    surfaces.ellipsoids.push_back(ball(size(random), at(random), at(random), at(random)));
    surfaces.ellipsoids.back().value = static_cast<float>(i);
  }
  for (int i = 0; i < 900; ++i) {
    Vertex v;
    v.x = at(random);
    v.y = at(random);
    v.depth = at(random);
    surfaces.vertices.push_back(v);
    if (i % 3 == 2) surfaces.triangles.push_back({{i - 2, i - 1, i}, {}, 1});
  }
  surfaces.ellipsoids[3].x = std::numeric_limits<float>::quiet_NaN();
  surfaces.ellipsoids[4].depth = std::numeric_limits<float>::infinity();
  surfaces.ellipsoids[5] = ball(0);
  surfaces.vertices[7].y = std::numeric_limits<float>::quiet_NaN();
  return surfaces;
}

TEST(Raster, DoesNotDependOnTheNumberOfThreads) {
  int const before = exec_host::threads(), share = exec_host::set_min_grain_size(1);
  exec_host::set_threads(1);
  auto const surfaces = crowd();
  auto const one = drawn(surfaces, 300, 260);
  exec_host::set_threads(4);
  auto const four = drawn(surfaces, 300, 260);
  exec_host::set_threads(before);
  exec_host::set_min_grain_size(share);
  EXPECT_EQ(one.depth, four.depth);
  EXPECT_EQ(one.normal, four.normal);
  EXPECT_EQ(one.value, four.value);
  EXPECT_EQ(one.owner, four.owner);
}

TEST(Raster, ShowsTheNearestOfACrowd) {
  auto const surfaces = crowd();
  auto const out = drawn(surfaces, 300, 260);
  for (int y = 1; y < 260; y += 29)
    for (int x = 2; x < 300; x += 31) {
      float nearest = -std::numeric_limits<float>::infinity();
      Surfaces alone;
      for (auto const& e : surfaces.ellipsoids) {
        float const dx = static_cast<float>(x) + 0.5F - e.x, dy = static_cast<float>(y) + 0.5F - e.y;
        float const square = e.half[0] * e.half[0] - dx * dx - dy * dy;
        if (square > 0 && std::isfinite(e.depth)) nearest = std::max(nearest, e.depth + std::sqrt(square));
      }
      EXPECT_GE(out.depth[out.at(x, y)], nearest - 0.05F) << x << " " << y;
    }
}

/// Surfaces given by their depth over (x, y), seen pixel by pixel.
template <class Depth, class Normal>
PixelSurface relief(Depth const& depth, Normal const& normal) {
  PixelSurface surface(SurfaceBuffers(edge, edge), 1);
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      auto const k = static_cast<std::size_t>(y * edge + x);
      float const px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
      surface.depth[k] = depth(px, py);
      surface.normal[k] = normal(px);
    }
  return surface;
}

TEST(Occlusion, LeavesPlanesOpenWhateverTheirSlope) {
  for (float const slope : {0.0F, 0.5F, 2.0F}) {
    float const size = std::sqrt(1 + slope * slope);
    auto const plane = relief([&](float x, float) { return slope * x; },
                              [&](float) {
                                return std::array{-slope / size, 0.0F, 1 / size};
                              });
    auto const open = openness(plane, plane.depth, 8);
    EXPECT_EQ(*std::min_element(open.begin(), open.end()), 1) << slope;
  }
}

TEST(Occlusion, DarkensAnInnerCorner) {
  float const s = std::sqrt(0.5F);
  auto const corner = relief([](float x, float) { return std::abs(x - middle); },
                             [&](float x) {
                               return std::array{x < middle ? s : -s, 0.0F, s};
                             });
  for (float const radius : {3.0F, 8.0F, 15.0F}) {
    auto const open = openness(corner, corner.depth, radius);
    float const inner = open[static_cast<std::size_t>(100 * edge + 100)];
    EXPECT_GT(inner, 0.5) << radius;
    EXPECT_LT(inner, 0.8) << radius;
    EXPECT_EQ(open[static_cast<std::size_t>(100 * edge + 5)], 1) << "far from it";
  }
}

TEST(Occlusion, LeavesAnOuterCornerOpen) {
  float const s = std::sqrt(0.5F);
  auto const corner = relief([](float x, float) { return -std::abs(x - middle); },
                             [&](float x) {
                               return std::array{x < middle ? -s : s, 0.0F, s};
                             });
  auto const open = openness(corner, corner.depth, 8);
  EXPECT_EQ(*std::min_element(open.begin(), open.end()), 1);
}

TEST(Shade, KeepsTheColoursOfFlatSurfaces) {
  for (int c = 0; c < 256; ++c) {
    auto const step = static_cast<std::uint8_t>(c);
    EXPECT_EQ(encoded(linear({step, 0, 255})), (Colour{step, 0, 255}));
  }
  Surfaces surfaces;
  for (auto const& [x, y] : {std::array{-500.0F, -500.0F}, {900.0F, -500.0F}, {-500.0F, 900.0F}}) {
    Vertex v;
    v.x = x;
    v.y = y;
    surfaces.vertices.push_back(v);
  }
  surfaces.triangles.push_back({{0, 1, 2}, {}, 0});
  auto const out = drawn(surfaces);
  Shading shading;
  shading.radius = 10;
  SurfaceFinish finish;
  finish.colour = {90, 160, 20};
  finish.flat = true;
  shading.bodies = {&out, {finish}};
  Image const image = shade(shading);
  EXPECT_EQ(image.width, edge / 2);
  EXPECT_EQ(image.at(50, 50), (Colour{90, 160, 20}));
}

TEST(Shade, ShowsBodiesThroughToolsAndHidesToolsBehindBodies) {
  Surfaces body;
  body.ellipsoids.push_back(ball(40));
  auto const bodies = drawn(body);
  auto const colour_with_tool_at = [&](float depth) {
    Surfaces tool;
    tool.ellipsoids.push_back(ball(80, middle, middle, depth));
    auto const tools = drawn(tool);
    SurfaceFinish red, grey;
    red.colour = {200, 0, 0};
    grey.colour = {128, 128, 128};
    Shading shading;
    shading.bodies = {&bodies, {red}};
    shading.tools = {&tools, {grey}};
    return shade(shading).at(50, 50);
  };
  Colour const behind = colour_with_tool_at(-300), before = colour_with_tool_at(300);
  EXPECT_GT(behind[0], 5 * behind[1] + 20);
  EXPECT_GT(before[0], before[1] + 20) << "red through the grey";
  EXPECT_GT(before[1], behind[1] + 30) << "and grey over the red";
}

}  // namespace
}  // namespace piola
