// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/colour_map.hpp"
#include "piola/drawing/colour_tables.hpp"
#include "piola/drawing/ticks.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace piola {
namespace {

// Control points at equal distances.
constexpr std::array<Colour, 9> even_greys{{{27, 27, 27},
                                            {50, 50, 50},
                                            {75, 75, 75},
                                            {102, 102, 102},
                                            {129, 129, 129},
                                            {158, 158, 158},
                                            {187, 187, 187},
                                            {218, 218, 218},
                                            {249, 249, 249}}};
constexpr std::array<Colour, 7> blue_to_red{
    {{28, 52, 140}, {66, 116, 190}, {150, 188, 224}, {232, 232, 230}, {238, 172, 136}, {208, 88, 72}, {142, 14, 40}}};
constexpr std::array<Colour, 9> blue_to_brown{{{4, 30, 92},
                                               {30, 90, 150},
                                               {105, 155, 195},
                                               {178, 205, 222},
                                               {240, 238, 234},
                                               {224, 200, 176},
                                               {196, 146, 104},
                                               {150, 80, 35},
                                               {85, 25, 8}}};
constexpr std::array<Colour, 6> grey_to_heat{
    {{208, 210, 213}, {236, 184, 96}, {224, 124, 44}, {192, 60, 40}, {132, 20, 42}, {50, 4, 30}}};

Colour between(std::span<Colour const> points, double share) {
  double const at = std::clamp(share, 0.0, 1.0) * static_cast<double>(points.size() - 1);
  auto const k = std::min(static_cast<std::size_t>(at), points.size() - 2);
  double const s = at - static_cast<double>(k);
  Colour mixed{};
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = static_cast<std::uint8_t>(std::lround((1 - s) * points[k][c] + s * points[k + 1][c]));
  return mixed;
}

/// From six hexadecimal digits per colour.
std::array<Colour, 256> unpacked(std::string_view digits) {
  auto const value = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::array<Colour, 256> out{};
  for (std::size_t i = 0; i < 3 * out.size(); ++i)
    out[i / 3][i % 3] = static_cast<std::uint8_t>(16 * value(digits[2 * i]) + value(digits[2 * i + 1]));
  return out;
}

std::array<Colour, 256> table_of(std::span<Colour const> points) {
  std::array<Colour, 256> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = between(points, static_cast<double>(i) / 255);
  return out;
}

/// Digits and a minus sign as superscripts.
std::string raised(std::string_view digits) {
  constexpr std::array<char const*, 10> superscripts{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                     "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string out;
  for (char const c : digits) out += c == '-' ? "\u207b" : superscripts[static_cast<std::size_t>(c - '0')];
  return out;
}

/// "kg/m^3" with a small 3 in place of "^3"; "m^0.5" stays.
std::string with_powers(std::string_view unit) {
  std::string out;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    std::size_t const end = std::min(unit.find_first_not_of("-0123456789", i + 1), unit.size());
    bool const whole = unit[i] == '^' && end > i + 1 && (end == unit.size() || unit[end] != '.');
    out += whole ? raised(unit.substr(i + 1, end - i - 1)) : std::string(1, unit[i]);
    if (whole) i = end - 1;
  }
  return out;
}

}  // namespace

std::array<Colour, 256> palette_colours(Palette palette) {
  switch (palette) {
    case Palette::cividis: return unpacked(colour_tables::cividis);
    case Palette::magma: return unpacked(colour_tables::magma);
    case Palette::grey: return table_of(even_greys);
    case Palette::blue_red: return table_of(blue_to_red);
    case Palette::blue_brown: return table_of(blue_to_brown);
    case Palette::heat_on_grey: return table_of(grey_to_heat);
    default: return unpacked(colour_tables::viridis);
  }
}

Palette palette_for(std::string_view field, Palette asked) {
  bool const mostly_zero = field == "EquivalentPlasticStrain" || field == "Damage";
  return asked == Palette::automatic && mostly_zero ? Palette::heat_on_grey : asked;
}

ColourMap::ColourMap(double low, double high, Palette palette) : low_(low), high_(high) {
  if (!std::isfinite(low_) || !std::isfinite(high_)) low_ = high_ = 0;
  double const size = std::max(std::abs(low_), std::abs(high_));
  if (!(high_ - low_ > 1e-9 * size)) {  // a uniform field: show its value in the middle
    double const half = size > 0 ? 0.5 * size : 1;
    low_ -= half;
    high_ += half;
  }
  // Zero counts as inside if each side has at least a tenth of the other.
  bool const signed_ = low_ < 0 && high_ > 0 && std::min(-low_, high_) > 0.1 * std::max(-low_, high_);
  diverging_ = palette == Palette::automatic ? signed_ : palette == Palette::blue_red || palette == Palette::blue_brown;
  colours_ = palette_colours(diverging_ && palette == Palette::automatic ? Palette::blue_red : palette);
}

Colour ColourMap::operator()(double value) const {
  if (std::isnan(value)) return {255, 0, 255};
  double const share =
      diverging_ ? 0.5 + 0.5 * value / std::max(std::abs(low_), std::abs(high_)) : (value - low_) / (high_ - low_);
  return colours_[static_cast<std::size_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)))];
}

std::string field_words(std::string_view field) {
  std::string out;
  for (std::size_t i = 0; i < field.size(); ++i) {
    auto const c = static_cast<unsigned char>(field[i]);
    bool const starts = i > 0 && std::isupper(c) && !std::isupper(static_cast<unsigned char>(field[i - 1]));
    if (starts) out += ' ';
    bool const proper = field.substr(i).starts_with("Mises") || field.substr(i).starts_with("Piola") ||
                        field.substr(i).starts_with("Cauchy");
    out += proper ? field[i] : static_cast<char>(std::tolower(c));
  }
  return out;
}

ShownUnit shown_unit(double largest, std::string_view si_unit) {
  std::string const unit = si_unit == "1" ? "" : with_powers(si_unit);
  if (!(largest > 0) || !std::isfinite(largest) || unit.empty()) return {1, unit};  // a damage of 0.003 is no 3
  bool const nearly_one = largest < 1 && largest >= 0.5;                            // 0.6 m rather than 600 mm
  if (takes_prefix(si_unit)) {
    auto const prefix = prefix_for(nearly_one ? 1 : largest, si_unit);
    return {prefix.factor, std::string(prefix.word) + unit};
  }
  int const power = static_cast<int>(std::floor(std::log10(2 * largest) / 3)) * 3;
  if (power > -3 && power < 6) return {1, unit};
  return {std::pow(10.0, power), fmt::format("10{}{}{}", raised(std::to_string(power)), unit.empty() ? "" : " ", unit)};
}

}  // namespace piola
