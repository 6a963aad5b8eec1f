// SPDX-License-Identifier: Apache-2.0
#include "piola/input/places.hpp"
#include "piola/base/text.hpp"

namespace piola {

Place place_of(Places const& places, std::string_view key) {
  auto const found = places.find(key);
  if (found != places.end()) return found->second;
  return key.empty() ? Place{} : place_of(places, "");
}

bool is_given(Places const& places, std::string_view key) { return places.contains(key); }

Place place_in_table(Places const& places, std::string_view table, std::string_view key) {
  auto const found = places.find(std::string(table) + "." + std::string(key));
  return found == places.end() ? place_of(places, table) : found->second;
}

std::string point_text(std::array<double, 3> const& X, int dimension) {
  std::string text = "(";
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    text += (d > 0 ? ", " : "") + number_text(X[d], 4);
  return text + ") m";
}

}  // namespace piola
