// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/picture.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/read_png.hpp"
#include "support/temporary_folder.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace piola {
namespace {

struct Scene {
  std::vector<std::array<double, 3>> points;
  std::vector<double> radius, values;
  Scene() {
    for (int i = 0; i < 1000; ++i) {
      points.push_back({0.1 * (i % 10), 0.1 * (i / 10 % 10), 0.1 * (i / 100)});
      radius.push_back(0.058);
      values.push_back(i);
    }
  }
  PictureData data() const { return {points, radius, values, "pressure", "Pa", "A cube", 0.5, 3}; }
};

int dark_pixels(Image const& image, int x0, int x1, int y0, int y1) {
  int count = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) count += image.at(x, y)[1] < 150;
  }
  return count;
}

Image draw(Scene const& scene, PictureStyle const& style) {
  Window window;
  window.include(style.view, scene.points, 0.058);
  return draw_picture(scene.data(), style, window);
}

TEST(Picture, HasTheSizeAskedForAndIsReadBackFromPng) {
  testing::TemporaryFolder const folder;
  Image const image = draw(Scene(), {400, 300, {}, {}});
  write_png(folder / "a.png", image);
  Image const back = testing::read_png(folder / "a.png");
  EXPECT_EQ(back.width, 400);
  EXPECT_EQ(back.height, 300);
  EXPECT_EQ(back.rgb, image.rgb);
}

TEST(Picture, ShowsBodyColourBarTitleAndTime) {
  Image const image = draw(Scene(), {1000, 800, {}, {}});
  EXPECT_EQ(image.at(3, 400), (Colour{255, 255, 255}));
  EXPECT_NE(image.at(430, 420), (Colour{255, 255, 255}));  // the body in the middle
  EXPECT_GT(dark_pixels(image, 20, 200, 10, 60), 50);      // title
  EXPECT_GT(dark_pixels(image, 800, 1000, 10, 60), 50);    // time
  EXPECT_GT(dark_pixels(image, 900, 1000, 120, 700), 50);  // numbers beside the bar
  std::set<Colour> bar;
  for (int y = 120; y < 660; ++y) bar.insert(image.at(882, y));
  EXPECT_GT(bar.size(), 100U);
}

TEST(Picture, WithoutLabelsIsTheBodyAlone) {
  PictureStyle style{600, 500, {}, {}};
  style.labels = false;
  Image const image = draw(Scene(), style);
  std::vector<double> xs;
  int in_corners = 0;
  for (int y = 0; y < 500; ++y)
    for (int x = 0; x < 600; ++x) {
      bool const body = image.at(x, y) != Colour{255, 255, 255};
      if (body) xs.push_back(y);
      in_corners += body && (x < 60 || x >= 540) && (y < 60 || y >= 440);
    }
  EXPECT_EQ(in_corners, 0);
  auto const [low, high] = std::minmax_element(xs.begin(), xs.end());
  EXPECT_GT(*high - *low, 0.7 * 500) << "it fills most of the picture";
}

TEST(Picture, HasTheBackgroundOfItsTheme) {
  PictureStyle style{400, 300, {}, {}};
  style.theme = Theme::dark;
  Image const dark = draw(Scene(), style);
  EXPECT_EQ(dark.at(2, 150), colours_of(Theme::dark).background);
  EXPECT_TRUE(dark.alpha.empty());
  style.theme = Theme::transparent;
  Image const clear = draw(Scene(), style);
  ASSERT_EQ(clear.alpha.size(), 400u * 300u);
  EXPECT_EQ(clear.alpha[150 * 400 + 2], 0);
  std::size_t const middle = 140 * 400 + 170;
  EXPECT_EQ(clear.alpha[middle], 255);
  style.theme = Theme::light;
  Image const light = draw(Scene(), style);
  EXPECT_EQ(clear.at(170, 140), light.at(170, 140)) << "where the body is, nothing shines through";
  testing::TemporaryFolder const folder;
  write_png(folder / "clear.png", clear);
  Image const back = testing::read_png(folder / "clear.png");
  EXPECT_EQ(back.alpha, clear.alpha);
  EXPECT_EQ(back.rgb, clear.rgb);
}

TEST(Picture, ShowsNearThingsLargerInPerspective) {
  std::vector<std::array<double, 3>> const points{{-1, 0, -1}, {1, 0, 1}};
  std::vector<double> const radius{0.4, 0.4}, values{0, 1};
  PictureData data{points, radius, values, "", "1", "", 0, 3};
  PictureStyle style{600, 500, {0, 0}, {}};
  style.labels = false;
  Window const window{true, -2, 2, -2, 2};
  auto const sizes = [&] {
    Image const image = draw_picture(data, style, window);
    std::array<int, 2> count{};
    for (int y = 0; y < 500; ++y)
      for (int x = 0; x < 600; ++x) count[x < 300 ? 0 : 1] += image.at(x, y) != Colour{255, 255, 255};
    return count;
  };
  auto const parallel = sizes();
  EXPECT_NEAR(parallel[0], parallel[1], 0.02 * parallel[0]);
  data.eye = eye_before({.view = style.view}, 40, {-1, 0, -1}, {1, 0, 1});
  auto const seen = sizes();
  // The eye is sqrt(2) m / tan 20 degree away; areas go with the square of the distances.
  double const eye = std::sqrt(2.0) / std::tan(20 * std::acos(-1.0) / 180), ratio = (eye + 1) / (eye - 1);
  EXPECT_NEAR(seen[1] / static_cast<double>(seen[0]), ratio * ratio, 0.05 * ratio * ratio);

  data.points = std::span(points).first(1);  // a rigid ball in place of the near one has the same image
  RigidShape ball;
  ball.kind = RigidShape::Kind::sphere;
  ball.centre = points[1];
  ball.radius = 0.4;
  data.rigid_shapes = std::span(&ball, 1);
  auto const rigid = sizes();
  EXPECT_EQ(rigid[0], seen[0]);
  EXPECT_NEAR(rigid[1], seen[1], 0.1 * seen[1]) << "a true ball in perspective is a little long";
  data.points = {};
  ball.centre = {0, 0, 100};  // behind the eye
  EXPECT_EQ(sizes()[1], 0);
}

TEST(Picture, CarriesWhereItComesFrom) {
  testing::TemporaryFolder const folder;
  Scene const scene;
  PictureData data = scene.data();
  data.title = "\u03bd = 0.3";
  data.case_text = "123456789";
  PictureStyle const style{300, 200, {}, std::array{0.0, 5e6}};
  Window window;
  window.include(style.view, scene.points, 0.058);
  write_png(folder / "a.png", draw_picture(data, style, window));
  std::string const bytes = read_text_file(folder / "a.png");
  auto const chunk = [&](std::string const& key, std::string const& text) {
    return bytes.find("iTXt" + key + std::string(5, '\0') + text) != std::string::npos;
  };
  EXPECT_TRUE(chunk("Title", "\u03bd = 0.3"));
  EXPECT_TRUE(chunk("Time", "0.5 s"));
  EXPECT_TRUE(chunk("Field", "pressure"));
  EXPECT_TRUE(chunk("Range", "0 to 5000000 Pa"));
  EXPECT_TRUE(chunk("Software", "Piola "));
  EXPECT_TRUE(chunk("Case", "CRC-32 cbf43926")) << "the check value of CRC-32";
  EXPECT_EQ(testing::read_png(folder / "a.png").width, 300) << "libpng checks the sums of chunks";
}

TEST(Picture, IsCutWhereLettersStand) {
  Scene const scene;
  PictureStyle const style{1000, 800, {0, 0}, {}};
  Window const near{true, 0.45, 0.55, 0.45, 0.55};
  Image const image = draw_picture(scene.data(), style, near);
  EXPECT_NE(image.at(430, 400), (Colour{255, 255, 255}));
  for (auto const& [x, y] : {std::array{860, 30}, {700, 10}, {995, 400}, {862, 400}, {500, 798}, {120, 760}})
    EXPECT_EQ(image.at(x, y), (Colour{255, 255, 255})) << x << " " << y;
}

TEST(Picture, TakesWhatIsOddWithoutFailing) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<std::array<double, 3>>> const clouds{
      {}, {{1, 2, 3}}, {{nan, 0, 0}, {0, 0, 0}}, {{1, 1, 1}, {1, 1, 1}}};
  for (auto const& points : clouds) {
    std::vector<double> const radius(points.size(), 0.0), values(points.size(), nan);
    Window window;
    window.include({}, points, 0);
    PictureStyle style{200, 200, {}, {}};
    EXPECT_EQ(draw_picture({points, radius, values, "p", "Pa", "\xff\n\xe2", nan, 3}, style, window).width, 200);
    auto const size = fitting_size(window);
    EXPECT_TRUE(size[0] > 200 && size[0] < 2000 && size[1] > 200 && size[1] < 2000);
  }
}

TEST(Picture, HidesWhatLiesBehind) {
  std::vector<std::array<double, 3>> const points{{0, 0, 0}, {0, 0, 1}};
  std::vector<double> const radius{0.5, 0.5}, values{0, 1};
  PictureStyle const style{600, 500, {0, 0}, {}};
  Window window;
  window.include(style.view, points, 0.5);
  Image const image = draw_picture({points, radius, values, "", "1", "", 0, 3}, style, window);
  Colour const seen = image.at((20 + 490) / 2, 250);
  EXPECT_GT(seen[0], seen[2]);  // the yellow of 1, not the violet of 0
}

TEST(Picture, DrawsLinesAndPlanes) {
  for (int dimension : {1, 2}) {
    std::vector<std::array<double, 3>> points;
    for (int i = 0; i < 20; ++i) points.push_back({0.1 * i, dimension == 2 ? 0.1 * (i % 4) : 0, 0});
    std::vector<double> const radius(20, 0.05), values(20, 1.0);
    PictureStyle const style{500, 400, {}, {}};
    Window window;
    window.include({0, 0}, points, 0.05);
    Image const image = draw_picture({points, radius, values, "pressure", "Pa", "", 0, dimension}, style, window);
    int coloured = 0;
    for (int x = 40; x < 400; ++x) {
      for (int y = 60; y < 330; ++y) coloured += image.at(x, y) != Colour{255, 255, 255};
    }
    EXPECT_GT(coloured, 500) << dimension;
  }
}

TEST(PictureValues, LeaveExtremesOutOfTheTypicalRange) {
  std::vector<double> values;
  for (int i = 0; i < 300; ++i) values.push_back(i % 100);
  values[7] = 1e9;
  values[8] = std::numeric_limits<double>::quiet_NaN();
  auto const range = typical_range(values);
  EXPECT_GE(range[0], 0);
  EXPECT_LE(range[1], 99);
  EXPECT_EQ(typical_range(std::array{3.0, 1.0, 2.0}), (std::array{1.0, 3.0}));
  EXPECT_EQ(typical_range({}), (std::array{0.0, 0.0}));
}

TEST(PictureValues, AreTheComponentAskedFor) {
  std::array const two{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  EXPECT_EQ(picture_values(two, 3, *find_component("y", 3)), (std::vector<double>{2, 5}));
  EXPECT_EQ(picture_values(two, 6, *find_component("XY", 6)), std::vector<double>{4});
  EXPECT_EQ(find_component("magnitude", 3), whole_field);
  EXPECT_EQ(find_component("zy", 9), 7);
  EXPECT_EQ(find_component("", 1), whole_field);
  for (char const* word : {"w", "xx", "xy z", "X ", "-x"}) EXPECT_FALSE(find_component(word, 3)) << word;
  EXPECT_FALSE(find_component("yx", 6)) << "symmetric tensors have xy alone";
  EXPECT_FALSE(find_component("x", 1));
  EXPECT_FALSE(find_component("magnitude", 6));
  EXPECT_EQ(picture_label("CauchyStress", 6, 0), "Cauchy stress xx, tension positive");
  EXPECT_EQ(picture_label("CauchyStress", 6, 3), "Cauchy stress xy");
  EXPECT_EQ(picture_label("CauchyStress", 6), "von Mises of Cauchy stress");
  EXPECT_EQ(picture_label("Pressure", 1), "pressure, tension positive");
  EXPECT_EQ(picture_label("CompressivePressure", 1), "compressive pressure, compression positive");
  EXPECT_EQ(picture_label("ContactPressure", 1), "contact pressure, compression positive");
  EXPECT_EQ(picture_name("Velocity", 3, 2, 7), "Velocity-z-000007.png");
  EXPECT_EQ(picture_name("PrincipalStress", 3, *find_component("1", 3), 7), "PrincipalStress-1-000007.png");
}

TEST(Picture, ShowsParticlesThroughARigidShapeAndHidesTheShapeBehindParticles) {
  std::array<int, 2> yellow{};
  std::vector<std::array<double, 3>> const points{{0, 0, 0}};
  std::vector<double> const radius{0.5}, values{1};
  for (double const z : {-2.0, 2.0}) {
    RigidShape ball;
    ball.kind = RigidShape::Kind::sphere;
    ball.centre = {0, 0, z};
    ball.radius = 1;
    PictureStyle const style{600, 500, {0, 0}, std::array{0.0, 1.0}};
    Window window;
    window.include(style.view, points, 1.2);
    PictureData data{points, radius, values, "", "1", "", 0, 3};
    data.rigid_shapes = std::span(&ball, 1);
    Image const image = draw_picture(data, style, window);
    auto const grey = [&](int x) {
      Colour const c = image.at(x, 250);
      return std::abs(c[0] - c[2]) < 15 && c[0] < 240;
    };
    Colour const seen = image.at((20 + 490) / 2, 250);
    yellow[z > 0 ? 1 : 0] = seen[0] - seen[2];
    EXPECT_FALSE(grey((20 + 490) / 2)) << z;
    EXPECT_TRUE(grey((20 + 490) / 2 + 130)) << "beside the particle";
  }
  EXPECT_LT(yellow[1], 0.8 * yellow[0]) << "through the shape";
}

TEST(PictureValues, ReduceVectorsAndStressesToOneNumber) {
  EXPECT_EQ(picture_values(std::array{3.0, 4.0, 0.0}, 3), std::vector<double>{5});
  EXPECT_DOUBLE_EQ(picture_values(std::array{0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, 6)[0], std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(picture_values(std::array{2.0, 2.0, 2.0, 0.0, 0.0, 0.0}, 6)[0], 0);
}

}  // namespace
}  // namespace piola
