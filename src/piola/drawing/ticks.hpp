// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Marks of an axis and their texts.
struct Tick {
  double value = 0;
  std::string
      text;  ///< with a true minus sign (UTF-8), with the same number of decimals along an axis, or in powers of ten
};

/// Marks at multiples of 1, 2 or 5 times a power of ten within [low, high], two to nine; for low < high, both finite.
std::vector<Tick> linear_ticks(double low, double high);
/// Powers of ten within [low, high], thinned out to at most nine; for 0 < low < high. None if no power lies inside.
std::vector<Tick> decade_ticks(double low, double high);

/// The SI prefix that makes numbers as large as `largest` easy to read, for units that take prefixes (m, s, N, J, Pa,
/// m/s ... but not kg, 1 or units with powers; see takes_prefix).
struct Prefix {
  std::string_view word;  ///< "M", "" or "\u00b5", ...
  double factor = 1;      ///< of the unit with the prefix
};
bool takes_prefix(std::string_view unit);
Prefix prefix_for(double largest, std::string_view unit);

}  // namespace piola
