// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/camera_view.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace piola {
namespace {

using Points = std::vector<std::array<double, 3>>;

/// n x n x n points of a cube of side 1.
Points cube(int n) {
  Points points;
  for (int i = 0; i < n * n * n; ++i)
    points.push_back({(i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / n / n + 0.5) / n});
  return points;
}

TEST(Window, StaysWhileThePointsStayInsideAndGrowsOtherwise) {
  View const view{0, 0};
  Window window;
  Points points{{0, 0, 0}, {1, 1, 0}};
  window.include(view, points, 0.1);
  Window const first = window;
  points[0] = {0.5, 0.5, 0};
  window.include(view, points, 0.1);
  EXPECT_EQ(window.x0, first.x0);
  points[1] = {4, 1, 0};
  window.include(view, points, 0.1);
  EXPECT_GT(window.x1, 4.1);
  EXPECT_EQ(window.x0, first.x0);
  points[1] = {std::numeric_limits<double>::quiet_NaN(), 1, 0};
  window.include(view, points, 0.1);
  EXPECT_TRUE(std::isfinite(window.x1));
}

TEST(Window, LeavesStraysOutButNotTipsAndSmallParts) {
  View const view{0, 0};
  Points points = cube(10);
  points.push_back({50, 0.5, 0.5});
  Window window;
  window.include(view, Subject{.points = points});
  EXPECT_LT(window.x1, 1.1);
  EXPECT_GT(window.x1, 0.95);
  EXPECT_LT(window.x0, 0.05);

  std::vector<double> volume(points.size(), 1);
  volume.back() = 10;  // the same place, but one hundredth of the volume
  window = {};
  window.include(view, Subject{.points = points, .volume = volume});
  EXPECT_GT(window.x1, 50);

  Points cone;  // whose tip holds little of the volume
  for (int k = 0; k < 100; ++k)
    for (int i = 0; i < (100 - k) * (100 - k) / 20 + 1; ++i) cone.push_back({0.01 * k, 0.001 * i, 0});
  window = {};
  window.include(view, Subject{.points = cone});
  EXPECT_GT(window.x1, 0.99);
}

TEST(Window, IsFilledByTheBody) {
  Window window;
  window.include({0, 0}, cube(10), 0);
  EXPECT_GT(0.9 / (window.x1 - window.x0), 0.7);
}

TEST(View, HasNamesForTheEndsOfTheAxes) {
  for (Up const up : {Up::x, Up::y, Up::z, Up::minus_x, Up::minus_y, Up::minus_z})
    for (std::size_t k = 0; k < 6; ++k) {
      auto const angles = named_view(view_words[k], up);
      ASSERT_TRUE(angles);
      auto const towards = View{(*angles)[0], (*angles)[1], up}.towards_viewer();
      EXPECT_NEAR(towards[k % 3], k < 3 ? 1 : -1, 1e-12) << view_words[k];
    }
  EXPECT_FALSE(named_view("w", Up::y));
  EXPECT_FALSE(named_view("", Up::y));
}

TEST(View, ForeshortensAllAxesAlikeInIso) {
  for (char const* name : {"iso", "iso2"})
    for (Up const up : {Up::y, Up::z, Up::minus_x}) {
      auto const angles = named_view(name, up);
      ASSERT_TRUE(angles);
      auto const towards = View{(*angles)[0], (*angles)[1], up}.towards_viewer();
      for (double const c : towards) EXPECT_NEAR(std::abs(c), std::sqrt(1.0 / 3), 1e-12);
    }
}

TEST(View, RollsAnticlockwise) {
  View const view{0, 0, Up::y, 90};
  EXPECT_NEAR(view.up()[0], 1, 1e-12) << "what pointed to the right points up";
  EXPECT_NEAR(view.right()[1], -1, 1e-12) << "what pointed up points to the left";
  EXPECT_EQ(view.in(2).roll, 90);
}

TEST(Camera, ZoomsAndLooksAtAPoint) {
  Window const all{true, 0, 4, 0, 2};
  Camera camera{.view = {0, 0}, .zoom = 2, .look_at = {{1, 5, 9}}};
  Window const shown = shown_window(all, camera, {});
  EXPECT_DOUBLE_EQ(shown.x0, 0);
  EXPECT_DOUBLE_EQ(shown.x1, 2);
  EXPECT_DOUBLE_EQ(shown.y0, 4.5);
  EXPECT_DOUBLE_EQ(shown.y1, 5.5);
}

TEST(Camera, FollowsABody) {
  Points points = cube(5);
  std::vector<int> body(points.size(), 0);
  for (auto& p : cube(5)) {
    points.push_back({p[0] + 100, 0.1 * p[1], p[2]});
    body.push_back(1);
  }
  Camera const camera{.view = {0, 0}, .followed_body = 1};
  Window window;
  include(window, camera, {.points = points, .body = body});
  EXPECT_LT(window.x1 - window.x0, 1.2) << "the other body does not count";
  Window const first = shown_window(window, camera, {.points = points, .body = body});
  EXPECT_NEAR((first.x0 + first.x1) / 2, 100.5, 1e-9);
  for (std::size_t i = 125; i < 250; ++i) points[i][0] += 7;
  Window const grown = window;
  include(window, camera, {.points = points, .body = body});
  EXPECT_EQ(window, grown) << "what moves along does not need more room";
  Window const second = shown_window(window, camera, {.points = points, .body = body});
  EXPECT_NEAR(second.x0 - first.x0, 7, 1e-9);
}

TEST(Camera, MakesRoomForWhatIsNearInPerspective) {
  Camera camera{.view = {20, 30}};
  Points const points = cube(8);
  Window parallel, near;
  include(parallel, camera, {.points = points});
  camera.eye = eye_before(camera, 60, {0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(camera.eye.distance, std::sqrt(3.0) / 2 / std::tan(std::acos(-1.0) / 6), 1e-12);
  include(near, camera, {.points = points});
  EXPECT_GT(near.y1 - near.y0, 1.02 * (parallel.y1 - parallel.y0)) << "1.03 for this cube";
  for (auto const& p : points) {
    auto const seen = camera.eye.seen(p);
    double y = 0;
    for (std::size_t c = 0; c < 3; ++c) y += seen[c] * camera.view.up()[c];
    EXPECT_TRUE(y > near.y0 && y < near.y1);
  }
  auto const middle = camera.eye.seen({0.5, 0.5, 0.5});
  for (double const c : middle) EXPECT_NEAR(c, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(camera.eye.magnification({100, 100, 100}))) << "behind the eye";
}

TEST(FittingSize, FollowsWhatIsShown) {
  auto const column = fitting_size({true, 0, 1, 0, 5}), beam = fitting_size({true, 0, 5, 0, 1}),
             square = fitting_size({true, 0, 1, 0, 1});
  EXPECT_GT(column[1], 1.8 * column[0]);
  EXPECT_GT(beam[0], 1.8 * beam[1]);
  EXPECT_NEAR(square[0] * square[1], 800e3, 100e3);
  for (auto const& size : {column, beam, square}) {
    EXPECT_EQ(size[0] % 2, 0);
    EXPECT_EQ(size[1] % 2, 0);
  }
}

}  // namespace
}  // namespace piola
