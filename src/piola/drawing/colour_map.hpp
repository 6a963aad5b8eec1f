// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/image.hpp"
#include "piola/input/picture_spec.hpp"
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// The colours of a map from its low to its high end; those of `automatic` are viridis.
std::array<Colour, 256> palette_colours(Palette palette);
/// Resolves `automatic` for a field: heat_on_grey for plastic strain and damage, else still automatic.
Palette palette_for(std::string_view field, Palette asked);

/// From numbers to colours over a range.
class ColourMap {
 public:
  ColourMap(double low, double high, Palette palette = Palette::automatic);
  Colour operator()(double value) const;  ///< values outside the range get the end's colour, not-a-number magenta
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double low_, high_;
  bool diverging_;
  std::array<Colour, 256> colours_;
};

/// A field name as text: "VonMisesStress" -> "von Mises stress".
std::string field_words(std::string_view field);

/// The decimal prefix for showing values of this size: {1e6, "MPa"} for 3e7 and "Pa"; a unit that takes no prefix gets
/// {1e6, "10\u2076 kg/m\u00b3"}. Powers are written as such (UTF-8).
struct ShownUnit {
  double factor = 1;
  std::string text;
};
ShownUnit shown_unit(double largest, std::string_view si_unit);

}  // namespace piola
