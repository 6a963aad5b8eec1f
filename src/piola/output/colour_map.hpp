// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/image.hpp"
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// From numbers to colours over a range: dark violet to yellow with evenly rising lightness, or, if the range has zero
/// well inside, blue through light grey (zero) to red.
class ColourMap {
 public:
  ColourMap(double low, double high);
  Colour operator()(double value) const;  ///< values outside the range get the end's colour, not-a-number magenta
  double low() const { return low_; }
  double high() const { return high_; }
  bool diverging() const { return diverging_; }
  /// Round numbers inside the range, about six.
  std::vector<double> ticks() const;

 private:
  double low_, high_;
  bool diverging_;
};

/// A field name as people write it: "VonMisesStress" -> "von Mises stress".
std::string field_words(std::string_view field);

/// The decimal prefix for showing values of this size: {1e6, "MPa"} for 3e7 and "Pa"; a unit that takes no prefix gets
/// {1e6, "1e6 kg/m^3"}.
struct ShownUnit {
  double factor = 1;
  std::string text;
};
ShownUnit shown_unit(double largest, std::string_view si_unit);

}  // namespace piola
