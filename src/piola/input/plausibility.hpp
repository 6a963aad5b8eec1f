// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// Plausible range of a number of a case. A number outside [low, high] is allowed but probably an error of unit or
/// digit. docs/user/when-it-stops.md lists the rules; tests/model/implausible_values_test.cpp has one test for each of
/// them.
struct PlausibleRange {
  std::string_view name;       ///< as the manual lists it; of a parameter of a law: the name of that parameter
  std::string_view quantity;   ///< subject of the message
  std::string_view unit;       ///< SI, of what is measured; "1": a pure number
  std::string_view reference;  ///< the bounds count in multiples of this quantity; empty: in `unit`
  double low, high;            ///< the bounds, which are plausible themselves
  std::string_view below = {}, above = {};  ///< what such a value means (what is usual) - what to do
};

/// All rules, in the order of the manual.
std::span<PlausibleRange const> plausible_ranges();
/// The rule of this name; null if there is none.
PlausibleRange const* find_plausible_range(std::string_view name);
/// The rule of this name, which must exist.
PlausibleRange const& plausible_range(std::string_view name);

/// The sentence about a value outside of its range, "" inside: "yield_stress is 300 Pa, softer ... - was MPa meant?".
/// Values that are not finite are not judged.
std::string implausible(PlausibleRange const& range, double value);
/// Judges a value in multiples of `reference` (> 0, SI unit `reference_unit`).
std::string implausible(PlausibleRange const& range, double value, double reference, std::string_view reference_unit);

}  // namespace piola
