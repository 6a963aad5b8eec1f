// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/colour_map.hpp"
#include "piola/formulations/field_signs.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

using Triple = std::array<double, 3>;

Triple linear(Colour const& colour) {
  Triple out{};
  for (std::size_t c = 0; c < 3; ++c) {
    double const v = colour[c] / 255.0;
    out[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  return out;
}

/// CIE L*a*b* of linear sRGB, white D65.
Triple lab(Triple const& rgb) {
  auto const row = [&](double r, double g, double b) { return r * rgb[0] + g * rgb[1] + b * rgb[2]; };
  auto const f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  double const x = f(row(0.4124564, 0.3575761, 0.1804375) / 0.95047), y = f(row(0.2126729, 0.7151522, 0.0721750)),
               z = f(row(0.0193339, 0.1191920, 0.9503041) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// As seen without receptors for green (Machado, Oliveira and Fernandes 2009, complete deuteranopia).
Triple without_green(Triple const& rgb) {
  auto const seen = [&](double r, double g, double b) {
    return std::clamp(r * rgb[0] + g * rgb[1] + b * rgb[2], 0.0, 1.0);
  };
  return {seen(0.367322, 0.860646, -0.227968), seen(0.280085, 0.672501, 0.047413), seen(-0.011820, 0.042940, 0.968881)};
}

double difference(Triple const& a, Triple const& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

constexpr std::array sequential{Palette::viridis, Palette::cividis, Palette::magma, Palette::grey,
                                Palette::heat_on_grey};
constexpr std::array diverging{Palette::blue_red, Palette::blue_brown};

TEST(ColourMap, IsThePublishedTable) {
  // First, middle and last colours as their authors give them, rounded to 8 bits.
  EXPECT_EQ(palette_colours(Palette::viridis)[0], (Colour{68, 1, 84}));
  EXPECT_EQ(palette_colours(Palette::viridis)[128], (Colour{33, 145, 140}));
  EXPECT_EQ(palette_colours(Palette::viridis)[255], (Colour{253, 231, 37}));
  EXPECT_EQ(palette_colours(Palette::magma)[0], (Colour{0, 0, 4}));
  EXPECT_EQ(palette_colours(Palette::magma)[255], (Colour{252, 253, 191}));
  EXPECT_EQ(palette_colours(Palette::cividis)[0], (Colour{0, 34, 78}));
  EXPECT_EQ(palette_colours(Palette::cividis)[255], (Colour{254, 232, 56}));
}

// Eight bits do not hold a smaller rise than that of four entries: it drowns in their rounding.
TEST(ColourMap, ChangesInLightnessInOneDirectionWhenAllValuesHaveOneSign) {
  for (Palette const palette : sequential) {
    auto const colours = palette_colours(palette);
    double const sign = palette == Palette::heat_on_grey ? -1 : 1;
    for (std::size_t i = 4; i < 256; i += 4)
      EXPECT_GT(sign * (lab(linear(colours[i]))[0] - lab(linear(colours[i - 4]))[0]), 0)
          << palette_words[static_cast<std::size_t>(palette)] << " " << i;
  }
}

TEST(ColourMap, FallsInLightnessToBothSidesOfZero) {
  for (Palette const palette : diverging) {
    auto const colours = palette_colours(palette);
    for (std::size_t i = 4; i < 128; i += 4) {
      EXPECT_GT(lab(linear(colours[i]))[0], lab(linear(colours[i - 4]))[0]) << i;
      EXPECT_GT(lab(linear(colours[255 - i]))[0], lab(linear(colours[259 - i]))[0]) << i;
    }
  }
}

TEST(ColourMap, IsToldApartWithoutReceptorsForGreen) {
  for (std::size_t p = 1; p < palette_words.size(); ++p) {
    auto const colours = palette_colours(static_cast<Palette>(p));
    for (std::size_t k = 1; k < 9; ++k) {
      auto const seen = [&](std::size_t step) {
        return lab(
            without_green(linear(colours[static_cast<std::size_t>(std::lround(255 * static_cast<double>(step) / 8))])));
      };
      EXPECT_GT(difference(seen(k), seen(k - 1)), 10) << palette_words[p] << " " << k;
    }
  }
}

TEST(ColourMap, IsGreyAtZeroWhenTheRangeSpansIt) {
  for (Palette const palette : {Palette::automatic, Palette::blue_red, Palette::blue_brown}) {
    ColourMap const map(-1, 3, palette);
    Colour const zero = map(0);
    EXPECT_LT(std::abs(zero[0] - zero[2]), 10);
    EXPECT_GT(map(3)[0], map(3)[2]);
    EXPECT_LT(map(-1)[0], map(-1)[2]);
  }
}

TEST(ColourMap, IsChosenByTheFieldAndByWhoAsks) {
  EXPECT_EQ(palette_for("Damage", Palette::automatic), Palette::heat_on_grey);
  EXPECT_EQ(palette_for("EquivalentPlasticStrain", Palette::automatic), Palette::heat_on_grey);
  EXPECT_EQ(palette_for("Damage", Palette::grey), Palette::grey);
  EXPECT_EQ(palette_for("Pressure", Palette::automatic), Palette::automatic);
}

TEST(ColourMap, TakesAnyRange) {
  double const nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (auto const& range : {std::array{0.0, 0.0}, std::array{5.0, 5.0}, std::array{nan, 1.0}, std::array{-1e300, 1e300},
                            std::array{1e-300, 2e-300}, std::array{infinity, -infinity}}) {
    ColourMap const map(range[0], range[1]);
    EXPECT_LT(map.low(), map.high());
    EXPECT_EQ(map(nan), (Colour{255, 0, 255}));
    EXPECT_EQ(map(infinity), map(map.high()));
    EXPECT_EQ(map(-infinity), map(-std::max(std::abs(map.low()), std::abs(map.high()))));
  }
}

TEST(ColourMap, ShowsDamageFromWholeToFailed) {
  EXPECT_EQ(whole_range("Damage"), (std::array{0.0, 1.0}));
  EXPECT_FALSE(whole_range("EquivalentPlasticStrain"));
}

TEST(ColourMap, ShowsUnitsWithPrefix) {
  EXPECT_EQ(shown_unit(3e7, "Pa").text, "MPa");
  EXPECT_EQ(shown_unit(3e7, "Pa").factor, 1e6);
  EXPECT_EQ(shown_unit(40, "m/s").text, "m/s");
  EXPECT_EQ(shown_unit(0.002, "m").text, "mm");
  EXPECT_EQ(shown_unit(2e-6, "m").text, "\u00b5m");
  EXPECT_EQ(shown_unit(0.6, "m").text, "m");
  EXPECT_EQ(shown_unit(600, "m/s").text, "m/s");
  EXPECT_EQ(shown_unit(2, "1").text, "");
  EXPECT_EQ(shown_unit(2e-6, "1").text, "");
  EXPECT_EQ(shown_unit(0.003, "1").factor, 1) << "a damage of 0.003 does not read 3";
  EXPECT_EQ(shown_unit(7850, "kg/m^3").text, "kg/m\u00b3");
  EXPECT_EQ(shown_unit(3e9, "kg/m^3").text, "10\u2079 kg/m\u00b3");
  EXPECT_EQ(shown_unit(3, "Pa m^0.5").text, "Pa m^0.5");
  EXPECT_EQ(shown_unit(3, "s^-12").text, "s\u207b\u00b9\u00b2");
  EXPECT_EQ(field_words("VonMisesStress"), "von Mises stress");
  EXPECT_EQ(field_words("FirstPiolaStress"), "first Piola stress");
}

}  // namespace
}  // namespace piola
