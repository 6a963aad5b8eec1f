// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/panels.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace piola {
namespace {

struct Row {
  std::vector<std::array<double, 3>> points;
  std::vector<double> radius, values;
  PictureData data;
  explicit Row(double first) {
    for (int i = 0; i < 20; ++i) {
      points.push_back({0.1 * i, 0.3 * (i % 3), 0});
      radius.push_back(0.06);
      values.push_back(first + i);
    }
    data = {.points = points, .radius = radius, .values = values, .label = "pressure", .unit = "Pa", .title = "A row"};
  }
};

Window window_of(Row const& row) {
  Window window;
  window.include({}, row.points, 0.06);
  return window;
}

PictureStyle style(bool labels) {
  return {.width = 640, .height = 300, .view = {}, .range = {{0, 40}}, .labels = labels};
}

TEST(Panels, AreThePicturesThatTheyAreAlone) {
  Row const first(0), second(15);
  Window const window = window_of(first);
  std::vector<Panel> const panels{{first.data, window, ""}, {second.data, window, ""}};
  Image const sheet = draw_panels(panels, {.title = "", .at_right = "", .columns = 2}, style(false));
  ASSERT_EQ(sheet.width, 640);
  PictureStyle alone = style(false);
  int const edge = 6;  // 2 % of the shorter side
  alone.width = (640 - 2 * edge) / 2;
  alone.height = 300 - 2 * edge;
  for (std::size_t k = 0; k < 2; ++k) {
    Image const one = draw_picture(panels[k].data, alone, window);
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < one.width; ++x)
        ASSERT_EQ(sheet.at(edge + static_cast<int>(k) * one.width + x, edge + y), one.at(x, y)) << k;
  }
}

TEST(Panels, HaveCaptionsAndOneBar) {
  Row const first(0), second(15);
  Window const window = window_of(first);
  auto const dark_below = [&](std::string const& caption) {
    std::vector<Panel> const panels{{first.data, window, caption}, {second.data, window, caption}};
    Image const sheet = draw_panels(panels, {.title = "Two", .at_right = "now", .columns = 2}, style(true));
    int count = 0;
    for (int x = 0; x < 500; ++x)
      for (int y = 200; y < 262; ++y) count += sheet.at(x, y)[0] < 200;
    return count;
  };
  EXPECT_GT(dark_below("a caption"), dark_below("") + 50);
}

TEST(Panels, KeepTransparencyAndTakeNothing) {
  Row const row(0);
  PictureStyle clear = style(true);
  clear.theme = Theme::transparent;
  std::vector<Panel> const panels{
      {row.data, window_of(row), "one"}, {row.data, window_of(row), "two"}, {row.data, window_of(row), "three"}};
  Image const sheet = draw_panels(panels, {.title = "", .at_right = "", .columns = 2}, clear);
  EXPECT_EQ(sheet.alpha[0], 0);
  EXPECT_GT(std::count(sheet.alpha.begin(), sheet.alpha.end(), 255), 500);
  EXPECT_EQ(draw_panels({}, {}, style(true)).width, 640);
}

TEST(Panels, StandSoThatTheWholeHasAnAgreeableShape) {
  Window const column{true, 0, 1, 0, 6}, beam{true, 0, 6, 0, 1};
  EXPECT_EQ(fitting_columns(column, 3), 3);
  EXPECT_EQ(fitting_columns(beam, 3), 1);
  EXPECT_EQ(fitting_columns({true, 0, 1, 0, 1}, 4), 2);
  for (Window const& window : {column, beam})
    for (std::size_t n : {1, 2, 9, 40}) {
      auto const size = fitting_size(window, n, fitting_columns(window, n));
      for (int const side : size) EXPECT_TRUE(side >= 200 && side <= 2402 && side % 2 == 0) << n << " " << side;
    }
}

}  // namespace
}  // namespace piola
