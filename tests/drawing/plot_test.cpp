// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/plot.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/ticks.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <regex>

namespace piola {
namespace {

using testing::TemporaryFolder;

std::size_t decimals(std::string const& text) {
  auto const point = text.find('.');
  return point == std::string::npos ? 0 : text.size() - point - 1;
}

TEST(Ticks, OfRandomRangesAreFewEvenlySpacedAndAlike) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-12, 12), offset(-3, 3);
  for (int k = 0; k < 1000; ++k) {
    double const width = std::pow(10, exponent(random)), low = width * offset(random);
    auto const ticks = linear_ticks(low, low + width);
    ASSERT_GE(ticks.size(), 2u) << low << " " << width;
    ASSERT_LE(ticks.size(), 9u);
    double const step = ticks[1].value - ticks[0].value;
    double const digit = step / std::pow(10, std::floor(std::log10(step) + 1e-6));
    EXPECT_LT(std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}), 1e-6) << digit;
    bool const in_powers =
        std::any_of(ticks.begin(), ticks.end(), [](Tick const& t) { return t.text.find('e') != std::string::npos; });
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_GE(ticks[i].value, low - 1e-6 * width);
      EXPECT_LE(ticks[i].value, low + width * (1 + 1e-6));
      if (i > 0) {
        EXPECT_NE(ticks[i].text, ticks[i - 1].text);
      }
      if (!in_powers) {
        EXPECT_EQ(decimals(ticks[i].text), decimals(ticks[0].text)) << ticks[i].text;
      }
    }
  }
}

TEST(Ticks, HaveTrueMinusSignsAndNoMinusZero) {
  auto const ticks = linear_ticks(-1, 1);
  ASSERT_EQ(ticks.size(), 5u);
  EXPECT_EQ(ticks[0].text, "\u22121.0");
  EXPECT_EQ(ticks[2].text, "0.0");
  auto const decades = decade_ticks(0.5, 2e20);
  EXPECT_EQ(decades.front().text, "1e0");
  EXPECT_LE(decades.size(), 9u);
  EXPECT_TRUE(decade_ticks(2, 5).empty());
}

// An energy that is kept to round-off: there are no numbers between its ends to count through.
TEST(Ticks, EndWhereARangeIsRoundOff) {
  double const low = 160199.10310115656, high = std::nextafter(low, 2e5);
  EXPECT_LE(linear_ticks(low, high).size(), 1000u);
}

TEST(Plots, ShowWhatIsConstantButForRoundOffAsConstant) {
  double const value = 160199.10310115656;
  Plot const plot{.title = "",
                  .note = {},
                  .x = {"time", "s"},
                  .y = {"energy", "J"},
                  .curves = {{.label = "energy", .x = {0, 1, 2}, .y = {value, std::nextafter(value, 2e5), value}}}};
  PlotText const text = plot_text(plot);
  std::smatch line;
  std::regex const whole("stroke-width:1.8[^>]*d=\"M \\S+ (\\S+) L \\S+ (\\S+) \"");  // one stroke, from end to end
  ASSERT_TRUE(std::regex_search(text.svg, line, whole));
  EXPECT_NEAR(std::stod(line[1]), std::stod(line[2]), 1e-3);
}

TEST(Prefixes, SuitTheNumberAndTheUnit) {
  EXPECT_EQ(prefix_for(3.2e6, "J").word, "M");
  EXPECT_EQ(prefix_for(0.02, "s").word, "m");
  EXPECT_EQ(prefix_for(5e-6, "s").word, "\u00b5");
  EXPECT_EQ(prefix_for(5000, "s").word, "");
  EXPECT_EQ(prefix_for(3.2e6, "kg").word, "");
  EXPECT_EQ(prefix_for(0, "J").factor, 1);
}

Plot waves() {
  Plot plot;
  plot.title = "Waves <& \u03bd>";
  plot.x = {"time", "s", false};
  plot.y = {"energy", "J", false};
  for (int c = 0; c < 3; ++c) {
    Curve curve{.label = "curve " + std::to_string(c), .x = {}, .y = {}, .colour = c, .dash = c};
    for (int i = 0; i < 5000; ++i) {
      curve.x.push_back(1e-5 * i);
      curve.y.push_back(2e6 + 1e6 * std::sin(0.01 * i + c));
    }
    plot.curves.push_back(curve);
  }
  plot.curves[1].y[2000] = std::numeric_limits<double>::quiet_NaN();
  return plot;
}

TEST(Plots, AreWrittenInEachFormatAndAreTheSameBytesTwice) {
  TemporaryFolder folder;
  for (auto const& [name, start] : {std::pair{"a.svg", "<?xml"}, {"a.png", "\x89PNG"}, {"a.pdf", "%PDF"}}) {
    write_plot(folder / name, waves());
    std::string const text = read_text_file(folder / name);
    EXPECT_TRUE(text.starts_with(start)) << name;
    EXPECT_EQ(text.find("nan"), std::string::npos) << name;
    if (std::string(name) == "a.pdf") continue;  // holds the time of its making
    write_plot(folder / name, waves());
    // Cairo counts the surfaces of a process in the SVG.
    std::regex const surface("surface[0-9]+");
    EXPECT_TRUE(std::regex_replace(read_text_file(folder / name), surface, "") == std::regex_replace(text, surface, ""))
        << name;
  }
  for (auto const& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename().string().find("part"), std::string::npos);
}

TEST(Plots, SayWhatCannotBeDrawn) {
  TemporaryFolder folder;
  EXPECT_THROW(write_plot(folder / "a.gif", waves()), InputError);
  EXPECT_THROW(write_plot(folder / "nowhere/a.svg", waves()), FileError);
  Plot empty = waves();
  empty.curves.clear();
  EXPECT_THROW(write_plot(folder / "a.svg", empty), InputError);
  Plot negative = waves();
  for (Curve& curve : negative.curves)
    for (double& y : curve.y) y = -1;
  write_plot(folder / "flat.svg", negative);
  negative.y.logarithmic = true;
  EXPECT_THROW(write_plot(folder / "a.svg", negative), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.svg"));
}

}  // namespace
}  // namespace piola
