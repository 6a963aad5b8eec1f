// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include <array>
#include <string>
#include <string_view>

namespace piola {

/// Place of a key; of the section if it does not give the key.
Place place_of(Places const& places, std::string_view key);
/// Whether the section gives the key, in the case file or by a setting (--set, Python).
bool is_given(Places const& places, std::string_view key);
/// Place of a key in a table of the section; of the table if it does not give the key.
Place place_in_table(Places const& places, std::string_view table, std::string_view key);
/// "(0.5, 6, 0.5) m".
std::string point_text(std::array<double, 3> const& X, int dimension);

}  // namespace piola
