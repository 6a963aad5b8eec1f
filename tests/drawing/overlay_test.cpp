// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/overlay.hpp"
#include "piola/drawing/canvas.hpp"
#include "piola/drawing/ticks.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace piola {
namespace {

constexpr Colour white{255, 255, 255}, black{0, 0, 0};

int inked(Image const& image, int x0 = 0, int y0 = 0, int x1 = 1 << 20, int y1 = 1 << 20) {
  int count = 0;
  for (int y = y0; y < std::min(y1, image.height); ++y)
    for (int x = x0; x < std::min(x1, image.width); ++x) count += image.at(x, y)[1] < 150;
  return count;
}

Image written(std::string_view text) {
  Canvas canvas(Image(60, 60, white));
  canvas.write(15, 40, text, {20, black});
  return canvas.image();
}

TEST(Canvas, WritesLettersOfManyLanguages) {
  for (char c = '!'; c <= '~'; ++c) EXPECT_GT(inked(written(std::string(1, c))), 3) << c;
  Image const unknown = written("?");
  for (char const* letter : {"\u00b5", "\u03c3", "\u03bd", "\u00b2", "\u00fc", "\u2212", "\u2076", "\u207b"}) {
    EXPECT_GT(inked(written(letter)), 3) << letter;
    EXPECT_NE(written(letter).rgb, unknown.rgb) << letter;
  }
  EXPECT_EQ(text_width("", 20), 0);
  EXPECT_GT(text_width("mm", 20), text_width("ii", 20));
}

TEST(Canvas, ShowsWhatIsNoTextAsQuestionMarks) {
  for (std::string_view const bad : {"\xff", "\n", "\xe2\x88", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80"})
    EXPECT_EQ(written(std::string(bad) + "a").rgb, written(std::string(bad.size(), '?') + "a").rgb);
}

TEST(Canvas, KeepsWhatItDoesNotTouch) {
  Image below(9, 7, white);
  for (std::size_t i = 0; i < below.rgb.size(); ++i) below.rgb[i] = static_cast<std::uint8_t>(37 * i);
  EXPECT_EQ(Canvas(below).image().rgb, below.rgb);
  EXPECT_TRUE(Canvas(below).image().alpha.empty());
  Image clear(9, 7, {200, 100, 50});
  clear.alpha.assign(63, 128);
  Image const same = Canvas(clear).image();
  EXPECT_EQ(same.alpha, clear.alpha);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(same.rgb[c], clear.rgb[c], 1) << "colours times opacity have 8 bits";
}

TEST(Canvas, ShortensAtWholeCharacters) {
  std::string const title = "\u03bd\u03c3\u00fc\u03bd\u03c3\u00fc\u03bd\u03c3\u00fc";
  EXPECT_EQ(shortened(title, 16, 1e4), title);
  double const room = 0.6 * text_width(title, 16);
  std::string const less = shortened(title, 16, room);
  EXPECT_LE(text_width(less, 16), room);
  EXPECT_TRUE(less.ends_with("\u2026"));
  EXPECT_EQ(less.find('?'), std::string::npos);
  EXPECT_EQ(written(less).rgb, written(less).rgb);
  EXPECT_EQ(shortened(title, 16, 0), "\u2026");
}

Overlay example(ColourMap const& map) {
  return {.title = "A beam",
          .at_right = "t = 1 s",
          .map = &map,
          .label = "pressure",
          .unit = "Pa",
          .extremes = {map.low(), map.high()},
          .axes = {{1, 0}, {0, 1}},
          .pixels_per_metre = 300};
}

Image drawn(Overlay const& overlay) {
  Image image(1000, 800, white);
  draw_overlay(image, layout_of(1000, 800, overlay.title, true), overlay, colours_of(Theme::light));
  return image;
}

/// Rows of the picture in which the bar has a colour.
std::array<int, 2> bar_rows(Image const& image, int x) {
  std::array<int, 2> rows{10000, -1};
  for (int y = 60; y < 725; ++y) {
    Colour const c = image.at(x, y);
    if (*std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()) < 60) continue;
    rows = {std::min(rows[0], y), std::max(rows[1], y)};
  }
  return rows;
}

TEST(Overlay, PointsTheEndsOfTheBarBeyondWhichValuesLie) {
  ColourMap const map(1, 9, Palette::viridis);
  Overlay overlay = example(map);
  int const middle = 882;
  auto const plain = bar_rows(drawn(overlay), middle);
  overlay.extremes[1] = 20;
  auto const above = bar_rows(drawn(overlay), middle);
  EXPECT_LT(above[0], plain[0] - 10);
  EXPECT_EQ(above[1], plain[1]);
  EXPECT_EQ(bar_rows(drawn(overlay), 874)[0] < plain[0] - 10, false) << "it is a tip";
  overlay.extremes = {-20, 9};
  EXPECT_GT(bar_rows(drawn(overlay), middle)[1], plain[1] + 10);
}

TEST(Overlay, NamesTheColourOfWhatIsNoNumber) {
  ColourMap const map(1, 9);
  Overlay overlay = example(map);
  auto const magenta = [&] {
    Image const image = drawn(overlay);
    int count = 0;
    for (int y = 0; y < 800; ++y)
      for (int x = 0; x < 1000; ++x) count += image.at(x, y) == Colour{255, 0, 255};
    return count;
  };
  EXPECT_EQ(magenta(), 0);
  overlay.not_a_number = true;
  EXPECT_GT(magenta(), 50);
}

TEST(Overlay, DrawsAScaleBarOfARoundLength) {
  ColourMap const map(1, 9);
  Overlay overlay = example(map);
  for (double const scale : {1e-7, 0.3, 300.0, 12345.0, 1e12}) {
    overlay.pixels_per_metre = scale;
    Image const image = drawn(overlay);
    int longest = 0;
    for (int y = 760; y < 800; ++y) {
      int run = 0;
      for (int x = 500; x < 850; ++x) {
        run = image.at(x, y)[1] < 200 ? run + 1 : 0;
        longest = std::max(longest, run);
      }
    }
    // 1, 2 or 5 times a power of ten, at most 22 % of the free width and more than two fifths of that.
    EXPECT_LE(longest, 0.22 * 826 + 3) << scale;
    EXPECT_GE(longest, 0.4 * 0.22 * 826 - 3) << scale;
    double const digits = std::log10(longest / scale), digit = std::pow(10, digits - std::floor(digits));
    double const nearest =
        std::min({std::abs(digit - 1), std::abs(digit - 2) / 2, std::abs(digit - 5) / 5, std::abs(digit - 10) / 10});
    EXPECT_LT(nearest, 3.0 / longest) << scale;
  }
  overlay.pixels_per_metre = 0;
  EXPECT_EQ(inked(drawn(overlay), 500, 740, 850, 800), 0);
}

TEST(Overlay, PutsTheTimeBelowATitleThatNeedsTheRow) {
  EXPECT_FALSE(layout_of(1000, 800, "Short", true).two_rows);
  EXPECT_TRUE(layout_of(500, 1000, "A title of more than forty characters, at least", true).two_rows);
  Layout const bare = layout_of(500, 1000, "Any", false);
  EXPECT_LT(bare.left, 20);
  EXPECT_GT(bare.right, 480);
}

TEST(TimeFormat, HasOneUnitAndTheDecimalsThatStepsNeed) {
  EXPECT_EQ(time_format(0.1, 0.0025).text(0.0125), "12.5 ms");
  EXPECT_EQ(time_format(0.1, 0.0025).text(0), "0.0 ms");
  EXPECT_EQ(time_format(2e-5, 1e-6).text(2e-5), "20 \u00b5s");
  EXPECT_EQ(time_format(3, 0.25).text(1.5), "1.50 s");
  EXPECT_EQ(time_format(3, 1).text(2), "2 s");
  EXPECT_EQ(time_format(1, 1e-12).decimals, 6);
  EXPECT_EQ(time_format(0, 0).text(0), "0.000 s");
  EXPECT_FALSE(time_format(std::nan(""), 1).text(std::nan("")).empty());
}

TEST(Ticks, AreFewRoundAndApartForAnyRange) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> power(-12, 12), share(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    double const size = std::pow(10, power(random)), a = size * share(random), b = size * share(random);
    double const low = std::min(a, b), high = std::max(a, b);
    if (high - low < 1e-3 * size) continue;
    auto const unit = shown_unit(std::max(std::abs(low), std::abs(high)), "Pa");
    auto const ticks = linear_ticks(low / unit.factor, high / unit.factor);
    EXPECT_GE(ticks.size(), 2u) << low << " " << high;
    EXPECT_LE(ticks.size(), 9u) << low << " " << high;
    auto const decimals = [](std::string const& text) {
      return text.find('.') == std::string::npos ? 0 : text.size() - text.find('.') - 1;
    };
    for (Tick const& tick : ticks) EXPECT_EQ(decimals(tick.text), decimals(ticks[0].text)) << tick.text;
    // On a bar of 500 pixels, labels of 16 pixels do not touch.
    for (std::size_t i = 1; i < ticks.size(); ++i)
      EXPECT_GT((ticks[i].value - ticks[i - 1].value) * unit.factor / (high - low) * 500, 16 * 1.2);
  }
}

}  // namespace
}  // namespace piola
