// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/derived_fields.hpp"
#include "piola/base/contracts.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include <algorithm>

namespace piola {

DerivedField const* find_derived(std::string_view field) {
  auto const all = derived_fields();
  auto const found = std::find_if(all.begin(), all.end(), [&](DerivedField const& d) { return d.name == field; });
  return found == all.end() ? nullptr : &*found;
}

int components_of(DerivedField const& derived) {
  auto const table = output_field_table();
  return std::find_if(table.begin(), table.end(), [&](auto const& f) { return f.name == derived.name; })->components;
}

void derive(DerivedField const& derived, std::span<double const> from, std::span<double> out) {
  PIOLA_EXPECTS(out.size() % static_cast<std::size_t>(components_of(derived)) == 0);
  auto const width = static_cast<std::size_t>(components_of(derived)), count = out.size() / width;
  for (std::size_t i = 0; i < count; ++i) derived.put(&from[i * (from.size() / count)], &out[i * width]);
}

std::string stored_field(std::string const& field, std::span<std::string const> in_frame) {
  auto const there = [&](std::string_view name) {
    return std::find(in_frame.begin(), in_frame.end(), name) != in_frame.end();
  };
  if (there(field)) return field;
  DerivedField const* const made = find_derived(field);
  return made != nullptr && there(made->from) ? std::string(made->from) : "";
}

}  // namespace piola
