// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace piola {

/// Result of reading a quantity such as "17 MPa": a value in SI, or what is wrong with it.
struct Quantity {
  double value = 0;
  std::optional<std::string> problem;  ///< e.g. '"5 MPa" is not a length (expected a unit such as m)'
};

/// Reads "number unit" and converts to `si_unit` (UDUNITS-2 notation; "1" for a pure number). The last factor of a unit
/// may have the power 0.5, as in "MPa m^0.5", which UDUNITS itself does not support. A number without unit is taken as
/// SI. Thread safe after first use. Never throws on bad text.
Quantity read_quantity(std::string_view text, std::string_view si_unit);

/// Reads "number unit" with any unit and converts to the SI base units it is made of ("17 MPa" -> 1.7e7).
Quantity read_any_quantity(std::string_view text);

/// Whether a text is a unit, e.g. "mm".
bool is_unit(std::string_view text);

/// Whether both texts are units and one can be converted to the other.
bool same_dimension(std::string_view a, std::string_view b);

/// Name of a quantity of this unit for messages: "a length" for "m", "a quantity in X" if it has no common name.
std::string dimension_noun(std::string_view si_unit);

/// Converts an SI value of `si_unit` to `unit` for printing. Throws std::invalid_argument if they do not fit.
double convert_from_si(double value, std::string_view si_unit, std::string_view unit);

}  // namespace piola
