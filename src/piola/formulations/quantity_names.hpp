// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// One number per particle that a probe may ask for: a component of a field, or the magnitude of a vector.
struct FieldQuantity {
  std::string name;   ///< as in a case file, e.g. "velocity_x"
  std::string field;  ///< VTK style field name, e.g. "Velocity"
  int component = 0;  ///< index into the field's components; `magnitude` for the length of a vector
  std::string unit;   ///< SI, UDUNITS notation
  static constexpr int magnitude = -1;
};

/// The field component that a quantity name stands for; nothing if the name is not known. "position_x" and its sisters
/// have the field "Position", which is X + Displacement and is made by whoever reads fields.
std::optional<FieldQuantity> find_quantity(std::string_view name);

/// Every known quantity name, for suggestions and the manual.
std::vector<FieldQuantity> const& all_quantities();

/// Numbers of a whole selection of particles: "twist_angle" [rad], "extent" [m], "relative_error" [1] and
/// "stress_intensity" [Pa m^0.5].
inline constexpr std::string_view twist_quantity = "twist_angle";
inline constexpr std::string_view extent_quantity = "extent";
inline constexpr std::string_view error_quantity = "relative_error";
inline constexpr std::string_view intensity_quantity = "stress_intensity";
inline constexpr std::string_view intensity_unit = "Pa m^0.5";

}  // namespace piola
