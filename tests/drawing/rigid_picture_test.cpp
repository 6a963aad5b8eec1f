// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/rigid_picture.hpp"
#include "piola/drawing/projection.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

namespace piola {
namespace {

using Point = std::array<double, 3>;
using Kind = RigidShape::Kind;

constexpr int width = 200, height = 160;
constexpr double scale = 20;  // pixels per metre; the origin is in the middle of the image

RigidShape shape(Kind kind, Point const& centre, double radius = 0, Point const& half = {},
                 Point const& axis = {0, 0, 1}) {
  RigidShape s;
  s.kind = kind;
  s.centre = centre;
  s.radius = radius;
  s.half_lengths = half;
  s.axis = axis;
  return s;
}

SurfaceBuffers drawn(RigidShape const& s, View const& view = {0, 0}, int dimension = 3) {
  Projection const project{view.right(), view.up(), view.towards_viewer(), scale, width / 2.0, height / 2.0};
  Stage const stage{{-1, -1, -1}, {1, 1, 1}};
  SurfaceBuffers image(width, height);
  RigidCanvas{project, stage, dimension, 1, 0, width}.draw(image, std::span(&s, 1));
  return image;
}

/// Samples that show something.
int area(SurfaceBuffers const& image) {
  return static_cast<int>(
      std::count_if(image.owner.begin(), image.owner.end(), [](Owner owner) { return owner != no_owner; }));
}

double depth_at(SurfaceBuffers const& image, double x, double y) {
  return image.depth[image.at(static_cast<int>(width / 2 + x * scale), static_cast<int>(height / 2 - y * scale))] /
         scale;
}

// Areas in square metres times 400; pixels at the edge are right to one ring of them.
TEST(RigidPicture, HasTheSizeOfEachShape) {
  double const pi = std::acos(-1.0), pixels = scale * scale;
  EXPECT_NEAR(area(drawn(shape(Kind::sphere, {1, 0, 0}, 1.5))), pi * 2.25 * pixels, 2 * pi * 1.5 * scale);
  EXPECT_NEAR(area(drawn(shape(Kind::box, {0, 1, 0}, 0, {2, 0.5, 1}))), 4 * pixels, 10 * scale);
  Point const up{0, 1, 0}, near{0, 0, 1};
  EXPECT_NEAR(area(drawn(shape(Kind::cylinder, {}, 1, {1.5, 0, 0}, up))), 6 * pixels, 10 * scale);
  EXPECT_NEAR(area(drawn(shape(Kind::cylinder, {}, 1, {1.5, 0, 0}, near))), pi * pixels, 2 * pi * scale);
}

TEST(RigidPicture, ShowsTheSurfaceThatIsNearestToTheViewer) {
  EXPECT_NEAR(depth_at(drawn(shape(Kind::sphere, {0, 0, 1}, 2)), 0, 0), 3, 0.01);
  EXPECT_NEAR(depth_at(drawn(shape(Kind::box, {0, 0, -1}, 0, {2, 1, 0.25})), 1, 0), -0.75, 1e-6);
  EXPECT_NEAR(depth_at(drawn(shape(Kind::cylinder, {}, 1, {1, 0, 0}, {1, 0, 0})), 0.5, 0), 1, 0.01);
  EXPECT_NEAR(depth_at(drawn(shape(Kind::cylinder, {}, 1, {1, 0, 0}, {0, 0, 1})), 0.5, 0), 1, 1e-6);
}

TEST(RigidPicture, LiesBehindTheParticlesInTwoDimensions) {
  SurfaceBuffers const image = drawn(shape(Kind::sphere, {}, 1), {0, 0}, 2);
  EXPECT_LT(depth_at(image, 0, 0), -1e20);
  EXPECT_EQ(image.normal[image.at(width / 2 + 15, height / 2)], (SurfaceBuffers::Normal{0, 0})) << "flat";
}

TEST(RigidPicture, ShowsAPlaneAsAPlateBehindItsFace) {
  // The face at y = -1.2, the plate below, as thick as 2 % of the stage: 0.02 * sqrt(12) m, 1.4 pixels.
  SurfaceBuffers const image = drawn(shape(Kind::plane, {5, -1.2, 7}, 0, {}, {0, 1, 0}), {0, 0}, 2);
  int const face = height / 2 + 24;
  EXPECT_EQ(image.owner[image.at(width / 2, face - 1)], no_owner);
  EXPECT_NE(image.owner[image.at(width / 2, face)], no_owner);
  EXPECT_EQ(image.owner[image.at(width / 2, face + 3)], no_owner);
  EXPECT_NE(image.owner[image.at(width / 2 - 40, face)], no_owner) << "opposite the bodies, wherever its point";
  // From above it is a plate in perspective, from whichever side.
  EXPECT_GT(area(drawn(shape(Kind::plane, {0, -1.2, 0}, 0, {}, {0, 1, 0}), {30, 20})), 30 * area(image) / 10);
}

TEST(RigidPicture, KeepsOutOfTheLetters) {
  RigidShape const s = shape(Kind::sphere, {}, 100);
  Projection const project{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, scale, width / 2.0, height / 2.0};
  SurfaceBuffers image(width, height);
  RigidCanvas{project, Stage{}, 3, 1, 30, 150}.draw(image, std::span(&s, 1));
  EXPECT_EQ(area(image), 150 * (height - 30));
}

TEST(RigidPicture, IsLeftOutIfItIsNowhere) {
  double const nan = std::nan("");
  EXPECT_EQ(area(drawn(shape(Kind::sphere, {nan, 0, 0}, 1))), 0);
  EXPECT_EQ(area(drawn(shape(Kind::sphere, {1e300, 0, 0}, 1))), 0);
}

TEST(ShowShapes, WidensTheWindowForWhatHasAnEnd) {
  Stage const stage{{0, 0, 0}, {1, 1, 0}};
  auto const window_with = [&](RigidShape const& s) {
    Window window;
    std::vector<Point> const points{{0, 0, 0}, {1, 1, 0}};
    window.include({0, 0}, points, 0);
    show_shapes(window, {0, 0}, std::span(&s, 1), stage);
    return window;
  };
  EXPECT_GT(window_with(shape(Kind::sphere, {3, 0.5, 0}, 0.5)).x1, 3.5);
  EXPECT_GT(window_with(shape(Kind::box, {3, 0.5, 0}, 0, {1, 0.2, 0})).x1, 4.0);
  EXPECT_LT(window_with(shape(Kind::sphere, {30, 0.5, 0}, 20)).x1, 1.5) << "too large to be shown whole";
  EXPECT_LT(window_with(shape(Kind::plane, {3, 0.5, 0}, 0, {}, {1, 0, 0})).x1, 1.5);
}

class Upwards : public ::testing::TestWithParam<std::tuple<Up, Point>> {};

TEST(RigidPicture, ShowsABoxAsItHasTurned) {
  RigidShape box = shape(RigidShape::Kind::box, {0, 0, 0}, 0, {2, 0.5, 0.5});
  int const lying = area(drawn(box));
  box.edges = {{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}};
  EXPECT_NEAR(area(drawn(box)), lying / 4.0, lying / 20.0) << "its end";
}

TEST_P(Upwards, PointsUpInAPictureThatIsNoMirrorImage) {
  auto const& [up, axis] = GetParam();
  View const level{0, 0, up};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(level.up()[c], axis[c], 1e-15);
  View const oblique{35, 25, up};
  Point const r = oblique.right(), u = oblique.up(), t = oblique.towards_viewer();
  EXPECT_NEAR(dot(r, axis), 0, 1e-15) << "the horizon is level";
  EXPECT_GT(dot(t, axis), 0) << "seen from above";
  Point const cross{r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(cross[c], t[c], 1e-15);
}

INSTANTIATE_TEST_SUITE_P(All, Upwards,
                         ::testing::Values(std::tuple{Up::x, Point{1, 0, 0}}, std::tuple{Up::y, Point{0, 1, 0}},
                                           std::tuple{Up::z, Point{0, 0, 1}}, std::tuple{Up::minus_x, Point{-1, 0, 0}},
                                           std::tuple{Up::minus_y, Point{0, -1, 0}},
                                           std::tuple{Up::minus_z, Point{0, 0, -1}}));

TEST(View, OfAPlaneIsFromZWhateverPointsUp) {
  for (Up const up : {Up::x, Up::y, Up::z, Up::minus_x, Up::minus_y, Up::minus_z}) {
    View const view = View{30, 20, up}.in(2);
    EXPECT_NEAR(view.towards_viewer()[2], 1, 1e-15);
  }
  EXPECT_NEAR((View{30, 20, Up::z}.in(2).up()[1]), 1, 1e-15);
  EXPECT_NEAR((View{30, 20, Up::x}.in(2).up()[0]), 1, 1e-15);
}

}  // namespace
}  // namespace piola
