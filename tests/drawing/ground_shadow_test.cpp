// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/ground_shadow.hpp"
#include "piola/drawing/vector_math.hpp"
#include "piola/setup/shapes.hpp"
#include "drawing/drawn_shapes.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

constexpr int side = 200;
constexpr double scale = 40;  // pixels per metre

/// A box of 2 x 1 x 0.5 seen from above, and the ground below it: y is upwards.
struct Standing {
  ParticleSet set;
  std::vector<ReferenceMesh> meshes;
  std::vector<Point3> x;
  std::vector<double> radius, values;
  Standing() {
    fill(testing::drawn_box(6, ShapeSpec::Placement::cell_centred, 3), "b", set);
    meshes = reference_meshes(set);
    x.assign(set.X.begin(), set.X.end());
    radius = ball_radii(set.volume, set.body, 3);
    values.assign(x.size(), 0);
  }
  std::vector<GroundLight> ground(View const& view, double lifted = 0, std::optional<Point3> up = Point3{0, 1, 0}) {
    std::vector<Point3> now = x;
    for (Point3& p : now) p[1] += lifted;
    PictureData data{.points = now, .radius = radius, .values = values, .label = {}, .unit = {}, .title = {}};
    data.body = set.body;
    data.ground = up;
    data.meshes = meshes;
    data.stage_low = {0, 0, 0};
    data.stage_high = {2, 1, 0.5};
    Projection const project{view.right(), view.up(), view.towards_viewer(), scale, 60, 110};
    return ground_below(data, {}, project, {side, side, 0, side});
  }
  /// The pixel of a place of the ground, from above.
  static GroundLight at(std::vector<GroundLight> const& ground, double x, double z) {
    auto const column = static_cast<std::size_t>(60 + scale * x), row = static_cast<std::size_t>(110 + scale * z);
    return ground[row * side + column];
  }
};

View const from_above{0, 90};

TEST(Ground, IsThereInSpaceWhenAskedForAndSeenFromAbove) {
  Standing stand;
  EXPECT_TRUE(stand.ground(from_above, 0, {}).empty());
  auto const above = stand.ground(from_above);
  ASSERT_EQ(above.size(), static_cast<std::size_t>(side * side));
  EXPECT_GT(Standing::at(above, 1, 0.25).share, 0.4F);
  for (GroundLight const& light : stand.ground({0, -30})) ASSERT_EQ(light.share, 0) << "seen from below";
}

TEST(Ground, IsDarkBelowWhatTouchesItAndLightFarAway) {
  Standing stand;
  auto const ground = stand.ground(from_above);
  EXPECT_LT(Standing::at(ground, 1, 0.25).light, 0.25F);
  EXPECT_GT(Standing::at(ground, 1, 1.5).light, 0.8F);
  EXPECT_EQ(Standing::at(ground, -1.4, 0.25).light, 1);
}

TEST(Ground, HidesTheSkyAsTheFormFactorOfARectangleSays) {
  Standing stand;
  double const height = 0.8, a = 1 / height, b = 0.25 / height;
  // From the middle below a parallel rectangle, four quarters of it (any table of view factors).
  double const A = std::sqrt(1 + a * a), B = std::sqrt(1 + b * b);
  double const hidden = 4 / (2 * std::acos(-1.0)) * (a / A * std::atan(b / A) + b / B * std::atan(a / B));
  double const light = Standing::at(stand.ground(from_above, height), 1, 0.25).light;
  EXPECT_NEAR((1 - light) / 0.85, hidden, 0.03);
}

}  // namespace
}  // namespace piola
