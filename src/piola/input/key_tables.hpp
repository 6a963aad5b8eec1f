// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_keys.hpp"
#include <array>
#include <string_view>
#include <vector>

/// The keys of a case file, topic by topic, in the order of the manual.
namespace piola {

inline constexpr std::array<std::string_view, 3> axis_words{"x", "y", "z"};

constexpr Interval closed(double low, double high) { return {low, high, false, false}; }
constexpr Interval above(double low, double high) { return {low, high, true, false}; }

// Lengths outside these bounds are slips, and their volumes would leave the range of numbers.
inline constexpr Interval place_range{-1e15, 1e15, false, false};
inline constexpr Interval length_range{1e-15, 1e15, false, false};
inline constexpr Interval count_range{1, 2147483647, false, false};

std::vector<KeyInfo> keys_of_run();         ///< run
std::vector<KeyInfo> keys_of_bodies();      ///< top of the file, body
std::vector<KeyInfo> keys_of_regions();     ///< body.part, region
std::vector<KeyInfo> keys_of_solids();      ///< shapes that are solids, their parts and placing
std::vector<KeyInfo> keys_of_boundaries();  ///< support, load, mirror, crack, rigid, contact, tie
std::vector<KeyInfo> keys_of_tables();      ///< table
std::vector<KeyInfo> keys_of_observers();   ///< probe, quantity
std::vector<KeyInfo> keys_of_output();      ///< output and its parts

}  // namespace piola
