// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>
#include <span>
#include <string_view>

namespace piola {

/// Admissible values of a parameter: an interval, each end open or closed.
struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  constexpr bool contains(double value) const {
    bool const above = low_open ? value > low : value >= low;
    bool const below = high_open ? value < high : value <= high;
    return above && below;
  }
};

inline constexpr double unbounded = std::numeric_limits<double>::infinity();
inline constexpr Interval any_value{};
inline constexpr Interval positive{0, unbounded, true, true};
inline constexpr Interval not_negative{0, unbounded, false, true};

/// A parameter without default must be given by the user.
inline constexpr double no_default = std::numeric_limits<double>::quiet_NaN();

/// Word of a choice for which a parameter is used. Without a choice it is always used.
struct Condition {
  std::string_view choice{};  ///< Choice::name
  std::string_view word{};    ///< the word, or one of two
  std::string_view other{};

  constexpr bool always() const { return choice.empty(); }
  constexpr bool holds(std::string_view chosen) const { return chosen == word || (!other.empty() && chosen == other); }
};

/// One number that a user may give. Declared once, next to the law or the scheme that owns it; reading, unit check,
/// range check, error text, `piola describe` and the manual come from this entry.
struct Parameter {
  std::string_view name;     ///< key in the case file
  std::string_view unit;     ///< SI unit in UDUNITS notation; "1" for a pure number
  std::string_view meaning;  ///< half a sentence for the manual
  Interval allowed = any_value;
  double default_value = no_default;  ///< SI; no_default: required
  std::string_view standard{};        ///< the default in words, where a number is not informative ("none")
  Condition when{};                   ///< given and needed only with this word

  constexpr bool required() const { return default_value != default_value; }
};

/// One word that a user may choose from a closed list.
struct Choice {
  std::string_view name;
  std::string_view meaning;
  std::span<std::string_view const> allowed;  ///< the first is the default
};

}  // namespace piola
