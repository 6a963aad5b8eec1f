// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/scene.hpp"
#include "piola/drawing/draw_bodies.hpp"
#include "piola/drawing/vector_math.hpp"
#include "piola/exec/threads.hpp"
#include "drawing/drawn_shapes.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <set>

namespace piola {
namespace {

constexpr int width = 400, height = 240;
constexpr Colour white{255, 255, 255};

/// A box of 2 x 1 x 0.5 and its picture.
struct Stand {
  ParticleSet set;
  std::vector<ReferenceMesh> meshes;
  std::vector<Point3> x;
  std::vector<double> radius, values;
  Appearance appearance;
  View view{0, 0};

  explicit Stand(int n = 5, int dimension = 3) {
    reset(testing::drawn_box(n, ShapeSpec::Placement::cell_centred, dimension));
  }
  void reset(ShapeSpec const& shape) {
    set = {};
    set.dimension = shape.dimension;
    fill(shape, "b", set);
    meshes = reference_meshes(set);
    x.assign(set.X.begin(), set.X.end());
    radius = ball_radii(set.volume, set.body, set.dimension);
    values.clear();
    for (std::size_t i = 0; i < x.size(); ++i) values.push_back(x[i][0]);
  }
  PictureData data() const {
    PictureData d{.points = x, .radius = radius, .values = values, .label = {}, .unit = {}, .title = {}};
    d.dimension = set.dimension;
    d.body = set.body;
    d.meshes = meshes;
    return d;
  }
  Projection project() const { return {view.right(), view.up(), view.towards_viewer(), 100, 50, 170}; }
  Scene scene() const { return make_scene(data(), appearance, project(), 2); }
  Image image() const {
    return draw_bodies(data(), appearance, project(), {width, height, 0, width}, ColourMap(0, 2), white);
  }
};

int pixels(Image const& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += image.at(x, y) != white;
  return count;
}

TEST(Scene, DrawsASkinWhereParticlesHangTogetherAndBallsElse) {
  Stand stand;
  EXPECT_TRUE(stand.scene().bodies.ellipsoids.empty());
  EXPECT_FALSE(stand.scene().bodies.triangles.empty());
  stand.appearance.as = {Representation::balls};
  EXPECT_EQ(stand.scene().bodies.ellipsoids.size(), stand.x.size());
  EXPECT_TRUE(stand.scene().bodies.triangles.empty());
  stand.appearance.as = {Representation::none};
  EXPECT_TRUE(stand.scene().bodies.ellipsoids.empty());
  stand.appearance.as = {};
  stand.meshes.clear();
  EXPECT_EQ(stand.scene().bodies.ellipsoids.size(), stand.x.size());
}

TEST(Scene, ShowsTheWholeBodyAndNothingElse) {
  // 200 x 100 pixels, and the outer halves of pixels at its edge.
  for (int const dimension : {2, 3}) {
    Stand const stand(5, dimension);
    EXPECT_NEAR(pixels(stand.image()), 200 * 100, 300) << dimension;
  }
}

TEST(Scene, HasNoHolesInAStretchedBody) {
  for (auto const as : {Representation::skin, Representation::balls}) {
    Stand stand;
    stand.appearance.as = {as};
    stand.appearance.outline = false;
    for (Point3& p : stand.x) p = {1.2 * p[0] + 0.3 * p[1], 0.4 * p[1], p[2]};
    for (Point3& p : stand.x) p[1] *= 3.2;  // 28 % longer across: plain balls would come apart along x
    Image const image = stand.image();
    Projection const project = stand.project();
    int holes = 0;
    for (std::size_t i = 0; i < stand.x.size(); ++i)
      for (double const part : {0.25, 0.5, 0.75}) {
        Point3 const& a = stand.meshes[0].X[i];
        if (a[0] > 1.85 || a[1] > 0.85) continue;
        Point3 const b = stand.x[i + 1], c = stand.x[i + 20];
        for (Point3 const& next : {b, c}) {
          auto const p = project(plus(stand.x[i], part, minus(next, stand.x[i])));
          holes += image.at(static_cast<int>(p[0]), static_cast<int>(p[1])) == white;
        }
      }
    EXPECT_EQ(holes, 0) << static_cast<int>(as);
  }
}

/// Pixels of the background that other pixels enclose, in patches smaller than `largest`.
int pixels_in_small_holes(Image const& image, int largest) {
  std::vector<bool> seen(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), false);
  auto const at = [&](int x, int y) { return static_cast<std::size_t>(y * image.width + x); };
  int sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (seen[at(x, y)] || image.at(x, y) != white) continue;
      std::vector<std::array<int, 2>> todo{{x, y}};
      seen[at(x, y)] = true;
      for (std::size_t k = 0; k < todo.size(); ++k)
        for (auto const& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          int const i = todo[k][0] + dx, j = todo[k][1] + dy;
          if (i < 0 || j < 0 || i >= image.width || j >= image.height) continue;
          if (seen[at(i, j)] || image.at(i, j) != white) continue;
          seen[at(i, j)] = true;
          todo.push_back({i, j});
        }
      if (static_cast<int>(todo.size()) < largest) sum += static_cast<int>(todo.size());
    }
  return sum;
}

/// A bar on a wall: its foot is 2.3 times as wide, and lower by as much.
Stand mushroomed_bar() {
  Stand stand;
  stand.reset(testing::drawn_cylinder(0.4, 1.6, 0.08));
  for (Point3& p : stand.x) {
    double const wide = 1 + 1.3 * std::exp(-3 * p[2]);
    p = {1 + wide * p[0], 0.4 + wide * p[1], 1.6 - (1.6 - p[2]) * 0.7};
  }
  return stand;
}

/// A shell of rings that has fallen to half its radius, with a hole that is its own.
Stand collapsed_ring() {
  Stand stand;
  stand.reset(testing::drawn_rings(0.9, 0.03, 0.6));
  for (Point3& p : stand.x) {
    double const r = std::hypot(p[0], p[1]), now = std::sqrt(r * r - 0.3);
    p = {1.5 + p[0] / r * now, 0.5 + p[1] / r * now, 0};
  }
  return stand;
}

/// A plate with a hole that an impact has torn: what was there flies off.
Stand pierced_plate() {
  Stand stand;
  ShapeSpec plate;
  plate.max = {2, 1, 0.1};
  plate.particles = {80, 40, 4};
  plate.placement = ShapeSpec::Placement::cell_centred;
  stand.reset(plate);
  for (Point3& p : stand.x) {
    double const r = std::hypot(p[0] - 1, p[1] - 0.5);
    if (r < 0.25) p[2] += 3 + 5 * (0.25 - r);
    if (r < 0.25) p[0] += 5;
  }
  return stand;
}

int holes_in(Stand stand, Representation as, View const& view) {
  stand.appearance.as = {as};
  stand.appearance.outline = false;
  stand.view = view.in(stand.set.dimension);
  double const spacing = 100 * (stand.meshes.empty() ? 0.08 : stand.meshes[0].spacing);
  return pixels_in_small_holes(stand.image(), static_cast<int>(4 * spacing * spacing));
}

TEST(Scene, HasNoHolesButThoseOfTheBody) {
  for (auto const& make : {mushroomed_bar, collapsed_ring, pierced_plate})
    for (View const& view : {View{0, 0}, View{30, 20}}) EXPECT_EQ(holes_in(make(), Representation::skin, view), 0);
  // Balls stand at the corners of the staircase of a bar seen obliquely, with the sky between them.
  for (auto const& make : {mushroomed_bar, collapsed_ring})
    EXPECT_EQ(holes_in(make(), Representation::balls, {0, 0}), 0);
  Stand plain = mushroomed_bar();
  plain.meshes.clear();
  EXPECT_GT(holes_in(plain, Representation::balls, {0, 0}), 0) << "balls that do not stretch come apart";
}

TEST(Scene, CutsABodyOpenAndColoursTheSection) {
  Stand stand;
  stand.appearance.cut = CutPlane{{1, 0, 0}, {1, 0, 0}};
  EXPECT_NEAR(pixels(stand.image()), 100 * 100, 300);
  // Seen from the end, the section shows the values at x = 1, not those of the far end.
  stand.view = {90, 0};
  Image const open = stand.image();
  auto const p = stand.project()(Point3{1, 0.5, 0.25});
  Colour const seen = open.at(static_cast<int>(p[0]), static_cast<int>(p[1]));
  Colour const wanted = ColourMap(0, 2)(1);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], wanted[c], 25);
  stand.view = {0, 0};
  stand.appearance.cut->ghost = true;
  Image const ghost = stand.image();
  EXPECT_NEAR(pixels(ghost), 200 * 100, 400);
  EXPECT_GT(ghost.at(50 + 150, 170 - 50)[1], 215) << "a shade only";
}

TEST(Scene, ShowsWhereABodyWas) {
  Stand stand;
  for (Point3& p : stand.x) p[1] += 0.5;
  Image const with = stand.image();
  stand.appearance.outline = false;
  Image const without = stand.image();
  EXPECT_GT(pixels(with), pixels(without) + 200);
}

/// How many channels of pixels differ by more than a few steps.
int different(Image const& a, Image const& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) count += std::abs(a.rgb[i] - b.rgb[i]) > 4;
  return count;
}

TEST(Scene, IsTheSameWhetherAllOrAPartOfThePictureIsDrawn) {
  for (double const turn : {0.0, 30.0}) {
    Stand stand;
    stand.view = {turn, turn / 2};
    for (Point3& p : stand.x) p[1] += 0.2 * std::sin(3 * p[0]);
    Image const part = stand.image();
    // A shape that no_owner sees may be anywhere: then all of it is drawn.
    RigidShape far;
    far.kind = RigidShape::Kind::sphere;
    far.centre = {1e3, 1e3, 0};
    far.radius = 0.1;
    PictureData data = stand.data();
    data.rigid_shapes = std::span(&far, 1);
    Image const all =
        draw_bodies(data, stand.appearance, stand.project(), {width, height, 0, width}, ColourMap(0, 2), white);
    EXPECT_GT(pixels(part), 1000);
    EXPECT_LT(different(part, all), 30) << "but for rounding at edges";
  }
}

TEST(Scene, IsTheSameForAnyNumberOfThreads) {
  int const before = exec_host::threads(), share = exec_host::set_min_grain_size(1);
  std::vector<Image> images;
  for (int const threads : {1, 4}) {
    exec_host::set_threads(threads);
    for (auto const as : {Representation::skin, Representation::balls}) {
      Stand stand;
      stand.view = {30, 20};
      stand.appearance.as = {as};
      stand.appearance.cut = CutPlane{{1.2, 0, 0}, {1, 0.3, 0}, true};
      for (Point3& p : stand.x) p[0] += 0.2 * std::sin(7 * p[1]);
      images.push_back(stand.image());
    }
  }
  exec_host::set_threads(before);
  exec_host::set_min_grain_size(share);
  EXPECT_EQ(images[0].rgb, images[2].rgb);
  EXPECT_EQ(images[1].rgb, images[3].rgb);
  EXPECT_NE(images[0].rgb, images[1].rgb);
}

TEST(Scene, TakesWhatIsNowhereAloneOrInOnePlace) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  Stand stand;
  for (auto const as : {Representation::automatic, Representation::balls, Representation::points}) {
    stand.appearance.as = {as};
    stand.x.assign(stand.x.size(), {0.5, 0.5, 0.5});
    EXPECT_NO_THROW(stand.image()) << "all in one place";
    stand.x.assign(stand.x.size(), {nan, nan, nan});
    EXPECT_EQ(pixels(stand.image()), 0);
  }
  Stand one;
  one.set = {};
  one.meshes.clear();
  one.x.resize(1);
  one.values = {nan};
  one.radius = {0.1};
  EXPECT_GT(pixels(one.image()), 100) << "magenta";
  one.x.clear();
  one.values.clear();
  one.radius.clear();
  EXPECT_EQ(pixels(one.image()), 0);
}

TEST(Scene, HatchesWhatIsHeld) {
  Stand stand;
  std::vector<std::uint8_t> held(stand.x.size(), 0);
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = stand.x[i][0] < 0.2;
  for (auto const as : {Representation::skin, Representation::balls}) {
    stand.appearance.as = {as};
    PictureData data = stand.data();
    auto const draw = [&] {
      return draw_bodies(data, stand.appearance, stand.project(), {width, height, 0, width}, ColourMap(0, 2), white);
    };
    Image const plain = draw();
    data.held = held;
    Image const hatched = draw();
    int at_held = 0, elsewhere = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (hatched.at(x, y) == plain.at(x, y)) continue;
        for (std::size_t c = 0; c < 3; ++c) ASSERT_LE(hatched.at(x, y)[c], plain.at(x, y)[c]) << "stripes are dark";
        (x < 50 + 35 ? at_held : elsewhere) += 1;
      }
    EXPECT_GT(at_held, 200);
    EXPECT_EQ(elsewhere, 0);
  }
}

TEST(Scene, HasTheOpacityThatPicturesOnBlackAndOnWhiteTell) {
  Stand stand;
  for (Point3& p : stand.x) p[0] += 1.1;  // an outline, too
  stand.appearance.cut = CutPlane{{1.9, 0, 0}, {1, 0.3, 0}, true};
  stand.view = {30, 20};
  auto const on = [&](std::optional<Colour> background) {
    return draw_bodies(stand.data(), stand.appearance, stand.project(), {width, height, 0, width}, ColourMap(0, 2),
                       background);
  };
  Image const clear = on(std::nullopt), other = without_background(on(Colour{0, 0, 0}), on(Colour{255, 255, 255}));
  EXPECT_EQ(clear.alpha, other.alpha);
  EXPECT_EQ(clear.rgb, other.rgb);
  EXPECT_GT(std::count(clear.alpha.begin(), clear.alpha.end(), 255), 1000);
  EXPECT_GT(std::count_if(clear.alpha.begin(), clear.alpha.end(), [](int a) { return a > 0 && a < 255; }), 200);
}

TEST(Scene, HasFinerEdgesInHighQuality) {
  Stand stand;
  stand.view = {30, 20};
  Image const normal = stand.image();
  stand.appearance.quality = Quality::high;
  Image const high = stand.image();
  auto const colours = [](Image const& image) {
    std::set<Colour> all;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) all.insert(image.at(x, y));
    return all.size();
  };
  EXPECT_GT(colours(high), colours(normal)) << "edges have 17 steps in place of 5";
  int differ = 0;
  for (std::size_t k = 0; k < high.rgb.size(); ++k) differ += std::abs(high.rgb[k] - normal.rgb[k]) > 40;
  EXPECT_LT(differ, static_cast<int>(high.rgb.size()) / 100) << "it is the same picture";
}

/// A half section of 1 x 2 beside the axis, in the middle of a picture.
struct SectionStand : Stand {
  std::optional<double> swept = 0;
  explicit SectionStand(double low = 0) : Stand(3, 2) {
    ShapeSpec shape = testing::drawn_box(3, ShapeSpec::Placement::cell_centred, 2);
    shape.min[0] = low;
    shape.max[0] = low + 1;
    reset(shape);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = x[i][0] + x[i][1];
  }
  Image image() const {
    PictureData d = data();
    d.swept = swept;
    d.dimension = swept == 0.0 ? 2 : 3;
    Projection const project{view.right(), view.up(), view.towards_viewer(), 60, width / 2.0, 170};
    return draw_bodies(d, appearance, project, {width, height, 0, width}, ColourMap(0, 3), white);
  }
};

TEST(Scene, OfASectionIsEqualOnBothSidesOfTheAxis) {
  for (auto const as : {Representation::skin, Representation::balls})
    for (double const low : {0.0, 0.7}) {
      SectionStand stand(low);
      stand.appearance.as = {as};
      Image const image = stand.image();
      EXPECT_GT(pixels(image), 2 * 60 * 60 * 0.9);
      int most = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2; ++x)
          for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, std::abs(image.at(x, y)[k] - image.at(width - 1 - x, y)[k]));
      EXPECT_LE(most, as == Representation::skin ? 0 : 6);  // directions of light from around are no mirror images
    }
}

TEST(Scene, OfASweptSectionShowsTheFieldOnItsCutFaces) {
  SectionStand stand;
  stand.view = {0, 0};
  stand.swept = 180;  // behind the section
  Image const half = stand.image();
  stand.swept = 360;
  Image const whole = stand.image();
  EXPECT_EQ(pixels(half), pixels(whole));
  EXPECT_NE(half.at(width / 2 + 3, 150), half.at(width / 2 + 50, 150));              // the field grows with the radius
  Colour const a = whole.at(width / 2 + 3, 150), b = whole.at(width / 2 + 20, 150);  // that of the outer face
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 12);
}

}  // namespace
}  // namespace piola
