// SPDX-License-Identifier: Apache-2.0
#include "piola/output/colour_map.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace piola {
namespace {

// Control points at equal distances; lightness (CIE L*) rises about evenly along the first list.
constexpr std::array<Colour, 8> sequential{{{52, 14, 84},
                                            {62, 52, 134},
                                            {50, 92, 146},
                                            {36, 128, 142},
                                            {36, 160, 130},
                                            {94, 190, 98},
                                            {172, 212, 58},
                                            {250, 230, 60}}};
constexpr std::array<Colour, 7> blue_to_red{
    {{28, 52, 140}, {66, 116, 190}, {150, 188, 224}, {232, 232, 230}, {238, 172, 136}, {208, 88, 72}, {142, 14, 40}}};

Colour between(std::span<Colour const> points, double share) {
  double const at = std::clamp(share, 0.0, 1.0) * static_cast<double>(points.size() - 1);
  auto const k = std::min(static_cast<std::size_t>(at), points.size() - 2);
  double const s = at - static_cast<double>(k);
  Colour mixed{};
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = static_cast<std::uint8_t>(std::lround((1 - s) * points[k][c] + s * points[k + 1][c]));
  return mixed;
}

}  // namespace

ColourMap::ColourMap(double low, double high) : low_(low), high_(high) {
  if (!std::isfinite(low_) || !std::isfinite(high_)) low_ = high_ = 0;
  double const size = std::max(std::abs(low_), std::abs(high_));
  if (!(high_ - low_ > 1e-9 * size)) {  // a uniform field: show its value in the middle
    double const half = size > 0 ? 0.5 * size : 1;
    low_ -= half;
    high_ += half;
  }
  // Zero counts as inside if each side has at least a tenth of the other.
  diverging_ = low_ < 0 && high_ > 0 && std::min(-low_, high_) > 0.1 * std::max(-low_, high_);
}

Colour ColourMap::operator()(double value) const {
  if (std::isnan(value)) return {255, 0, 255};
  if (diverging_) return between(blue_to_red, 0.5 + 0.5 * value / std::max(-low_, high_));
  return between(sequential, (value - low_) / (high_ - low_));
}

std::vector<double> ColourMap::ticks() const {
  double const rough = (high_ - low_) / 6, decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (double const nice : {5.0, 2.0, 1.0}) {
    if (nice * decade >= rough * 0.999) step = nice * decade;
  }
  std::vector<double> list;
  for (double k = std::ceil(low_ / step - 1e-9); k * step <= high_ + 1e-9 * step; ++k) list.push_back(k * step + 0.0);
  return list;
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
  if (!(largest > 0) || !std::isfinite(largest)) return {1, si_unit == "1" ? "" : std::string(si_unit)};
  int const power = static_cast<int>(std::floor(std::log10(2 * largest) / 3)) * 3;  // 0.6 m rather than 600 mm
  bool const prefixed = si_unit == "Pa" || si_unit == "m" || si_unit == "m/s" || si_unit == "J";
  constexpr std::string_view prefixes = "num kMGT";  // 1e-9 to 1e12
  int const index = power / 3 + 3;
  if (power == 0 || (!prefixed && power > -3 && power < 6)) return {1, si_unit == "1" ? "" : std::string(si_unit)};
  if (prefixed && si_unit != "m" && si_unit != "m/s" && index >= 0 && index < 8) {
    return {std::pow(10.0, power), fmt::format("{}{}", prefixes[static_cast<std::size_t>(index)], si_unit)};
  }
  if (prefixed && power < 0 && power >= -6) {
    return {std::pow(10.0, power), fmt::format("{}{}", prefixes[static_cast<std::size_t>(index)], si_unit)};
  }
  return {std::pow(10.0, power), si_unit == "1" ? fmt::format("1e{}", power) : fmt::format("1e{} {}", power, si_unit)};
}

}  // namespace piola
