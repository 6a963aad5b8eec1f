// SPDX-License-Identifier: Apache-2.0
#include "piola/input/probe_kinds.hpp"
#include "piola/formulations/quantity_names.hpp"
#include <algorithm>

namespace piola {

std::string_view unit_of_probe_quantity(ProbeKind kind, std::string_view quantity) {
  for (HistoryName const& own : info_of(kind).quantities)
    if (own.name == quantity) return own.unit;
  auto const& known = all_quantities();
  auto const found =
      std::find_if(known.begin(), known.end(), [&](FieldQuantity const& q) { return q.name == quantity; });
  return found == known.end() ? std::string_view("1") : std::string_view(found->unit);
}

}  // namespace piola
