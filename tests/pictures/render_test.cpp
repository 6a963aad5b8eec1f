// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/render.hpp"
#include "piola/base/errors.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/fake_formulation.hpp"
#include "support/key_words.hpp"
#include "support/read_png.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;

PictureOverrides small_pictures() {
  return {[](PictureSpec& picture) {
    picture.width = 300;
    picture.height = 250;
  }};
}

TEST(Render, DrawsOnePictureForEachFrame) {
  testing::TemporaryFolder const folder;
  Simulation s = testing::make_springs();
  Listener listener;
  std::atomic<int> const none{0};
  run_case(s, {.folder = folder / "r"}, listener, none);
  auto const paths = render_frames(folder / "r", {.field = "Velocity", .look = small_pictures()});
  ASSERT_EQ(paths.size(), 5U);
  EXPECT_EQ(paths[4].filename(), "Velocity-000004.png");
  Image const image = testing::read_png(paths[4]);
  EXPECT_EQ(image.width, 300);
  EXPECT_EQ(image.height, 250);
  EXPECT_THROW(render_frames(folder / "r", {.field = "Colour"}), InputError);
}

struct Drawn {
  testing::TemporaryFolder folder;
  RenderOptions options{.field = "Velocity", .look = small_pictures()};
  Drawn() {
    Simulation s = testing::make_springs();
    Listener listener;
    std::atomic<int> const none{0};
    run_case(s, {.folder = folder / "r"}, listener, none);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> r;
    for (auto const& path : render_frames(folder / "r", options)) r.push_back(path.filename().string());
    return r;
  }
  std::string refusal() const {
    try {
      names();
    } catch (InputError const& error) {
      return error.what();
    }
    return "";
  }
};

TEST(Render, DrawsTheFramesAskedForInTheFolderAskedFor) {
  using Names = std::vector<std::string>;
  Drawn d;
  d.options.out = d.folder / "elsewhere/deep";
  d.options.last = true;
  EXPECT_EQ(d.names(), Names{"Velocity-000004.png"});
  EXPECT_TRUE(std::filesystem::exists(d.folder / "elsewhere/deep/Velocity-000004.png"));
  EXPECT_FALSE(std::filesystem::exists(d.folder / "r/pictures"));
  d.options.last = false;
  d.options.only = {3, 1};
  EXPECT_EQ(d.names(), (Names{"Velocity-000003.png", "Velocity-000001.png"}));
  d.options.only = {5};
  EXPECT_EQ(d.refusal(), "--frame: there is no frame 5 (allowed: 0 to 4) - choose one of these");
  d.options.only = {};
  d.options.every = 3;
  EXPECT_EQ(d.names(), (Names{"Velocity-000000.png", "Velocity-000003.png"}));
}

TEST(Render, DrawsComponentsWithTheRangeOfAllFrames) {
  Drawn d;
  d.options.component = "y";
  auto const all = d.names();
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(all[2], "Velocity-y-000002.png");
  Image const together = testing::read_png(d.folder / "r/pictures/Velocity-y-000002.png");
  d.options.only = {2};
  d.options.out = d.folder / "alone";
  d.names();
  EXPECT_EQ(testing::read_png(d.folder / "alone/Velocity-y-000002.png").rgb, together.rgb);
  d.options.component = "xy";
  EXPECT_NE(d.refusal().find("Velocity has no component 'xy' (allowed: x, y, z)"), std::string::npos) << d.refusal();
}

TEST(Render, TurnsThePictureSoThatTheAxisAskedForPointsUp) {
  Drawn d;
  d.options.only = {0};
  d.names();
  Image const upright = testing::read_png(d.folder / "r/pictures/Velocity-000000.png");
  d.options.look.emplace_back([](PictureSpec& p) { p.up = "-y"; });
  d.names();
  EXPECT_NE(testing::read_png(d.folder / "r/pictures/Velocity-000000.png").rgb, upright.rgb);
}

TEST(Render, DrawsMomentsIntoOnePicture) {
  Drawn d;
  auto const path = render_times(d.folder / "r", d.options, {0.3, 0.6, 10});
  EXPECT_EQ(path, d.folder / "r/pictures/Velocity-times.png");
  Image const image = testing::read_png(path);
  EXPECT_EQ(image.width, 300);
  EXPECT_EQ(image.height, 250);
  Image const other = testing::read_png(render_times(d.folder / "r", d.options, {0.25, 0.5, 1}));
  EXPECT_EQ(other.rgb, image.rgb) << "the same frames are the nearest";
  EXPECT_NE(testing::read_png(render_times(d.folder / "r", d.options, {0, 0.5, 1})).rgb, image.rgb);
}

TEST(Render, DrawsRunsSideBySideAtEqualTimes) {
  Drawn d;
  std::filesystem::copy(d.folder / "r", d.folder / "twin", std::filesystem::copy_options::recursive);
  d.options.out = d.folder / "both";
  d.options.beside = {d.folder / "twin"};
  d.options.look.emplace_back([](PictureSpec& p) { p.labels = false; });
  EXPECT_EQ(d.names().size(), 5u);
  Image const image = testing::read_png(d.folder / "both/Velocity-000004.png");
  ASSERT_EQ(image.width, 300);
  d.options.only = {0};
  d.names();
  EXPECT_NE(testing::read_png(d.folder / "both/Velocity-000000.png").rgb, image.rgb);
  d.options.beside = {d.folder / "none"};
  EXPECT_NE(d.refusal().find("none: has no frames to draw"), std::string::npos) << d.refusal();
}

TEST(Render, DrawsSeveralFieldsBesideEachOther) {
  Drawn d;
  d.options.only = {3};
  EXPECT_EQ(d.names(), std::vector<std::string>{"Velocity-000003.png"});
  Image const alone = testing::read_png(d.folder / "r/pictures/Velocity-000003.png");
  d.options.more_fields = {"Displacement"};
  EXPECT_EQ(d.names(), std::vector<std::string>{"Velocity-Displacement-000003.png"});
  Image const both = testing::read_png(d.folder / "r/pictures/Velocity-Displacement-000003.png");
  EXPECT_EQ(both.width * both.height, 2 * alone.width * alone.height);
  int other = 0;
  for (int y = 0; y < 250; ++y)
    for (int x = 0; x < 300; ++x) {
      ASSERT_EQ(both.at(x, y), alone.at(x, y));
      other += both.at(both.width - 300 + x, both.height - 250 + y) != alone.at(x, y);
    }
  EXPECT_GT(other, 100) << "another field";
  d.options.more_fields = {"Colour"};
  EXPECT_NE(d.refusal().find("has no field 'Colour'"), std::string::npos) << d.refusal();
}

TEST(Render, DrawsAFilmOfAllFrames) {
  Drawn d;
  EXPECT_EQ(render_film(d.folder / "r", d.options, {.file = d.folder / "a.webp"}), 5u);
  EXPECT_GT(std::filesystem::file_size(d.folder / "a.webp"), 1000u);
  EXPECT_EQ(
      render_film(d.folder / "r", d.options, {.file = d.folder / "b.webp", .pictures_per_second = 4, .seconds = 3}),
      12u);
  d.options.every = 2;
  EXPECT_EQ(render_film(d.folder / "r", d.options, {.file = d.folder / "c.webp", .seconds = 3}), 3u);
  EXPECT_THROW(render_film(d.folder / "r", d.options, {.file = d.folder / "c.png"}), InputError);
}

TEST(Render, TakesTheLookAskedFor) {
  Drawn d;
  d.options.only = {4};
  auto const picture = [&] {
    d.names();
    return testing::read_png(d.folder / "r/pictures/Velocity-000004.png").rgb;
  };
  auto const before = picture();
  PictureOverrides const looks{[](PictureSpec& p) { p.zoom = 2; },
                               [](PictureSpec& p) {
                                 p.look_at = {{0, 0, 0}};
                               },
                               [](PictureSpec& p) { p.theme = Theme::dark; },
                               [](PictureSpec& p) { p.map = Palette::grey; },
                               [](PictureSpec& p) { p.labels = false; },
                               [](PictureSpec& p) { p.roll = 90; }};
  PictureOverrides const plain = d.options.look;
  for (std::size_t k = 0; k < looks.size(); ++k) {
    d.options.look = plain;
    d.options.look.push_back(looks[k]);
    EXPECT_NE(picture(), before) << k;
  }
  d.options.look = plain;
  EXPECT_EQ(picture(), before);
  d.options.look.emplace_back([](PictureSpec& p) { p.named_view = "above"; });
  EXPECT_NE(d.refusal().find("view: 'above' is not known (allowed: x, y, z, -x"), std::string::npos) << d.refusal();
  d.options.look = plain;
  d.options.look.emplace_back([](PictureSpec& p) { p.followed_body = "missing"; });
  EXPECT_NE(d.refusal().find("follow: there is no body 'missing'"), std::string::npos) << d.refusal();
}

TEST(Render, RefusesWaysToDrawThatThereAreNot) {
  Drawn d;
  d.options.as = {"marbles"};
  EXPECT_TRUE(mentions(d.refusal(), {"--as:", "marbles", "auto, skin, balls, points, none", "choose"}));
  d.options.as = {"missing=skin"};
  EXPECT_NE(d.refusal().find("--as: there is no body 'missing'"), std::string::npos) << d.refusal();
}

TEST(Render, SaysWhenThereAreNoFrames) {
  testing::TemporaryFolder const folder;
  EXPECT_THROW(render_frames(folder.path(), {}), InputError);
}

}  // namespace
}  // namespace piola
