// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>

namespace piola {
namespace {

/// The number of the region that a condition is, if it is a region with a shape and nothing else.
std::optional<std::size_t> shape_region(std::string const& condition, std::vector<RegionSpec> const& regions) {
  auto const words = expression_words(condition);
  if (words.size() != 1 || condition.find_first_not_of(words[0] + " \t") != std::string::npos) return {};
  auto const found =
      std::find_if(regions.begin(), regions.end(), [&](RegionSpec const& region) { return region.name == words[0]; });
  if (found == regions.end() || !found->solid) return {};
  return static_cast<std::size_t>(found - regions.begin());
}

PartSpec read_part(Section const& section, BodyNames const& body, std::vector<RegionSpec> const& regions,
                   CaseLibrary const& library) {
  PartSpec part;
  section.read("name", part.name);
  if (auto where = section.formula("where", body.names)) {
    part.where = std::move(*where);
    part.region = shape_region(part.where.text(), regions);
    if (part.where.depends_on_time())
      section.problems().add(section.place_of("where"),
                             section.name_of("where") +
                                 " depends on t (allowed: X, Y, Z, regions and constants) - a "
                                 "part stays what it is");
  }
  if (auto const material = table_with_keys(section, "material", "body.material")) {
    BodySpec of;
    read_material(*material, library, of);
    part.material = of.material;
    part.law = of.law;
    part.places = of.places;
  }
  section.refuse_unknown();
  part.places.merge(places_of(section, {"where", "material"}));
  return part;
}

}  // namespace

std::vector<PartSpec> read_parts(Section const& section, BodyNames const& body, std::vector<RegionSpec> const& regions,
                                 CaseLibrary const& library) {
  std::vector<PartSpec> parts;
  constexpr std::size_t most = 100;
  for (Section const& table : tables_in(section, "part", most)) {
    parts.push_back(read_part(table, body, regions, library));
    if (parts.back().name.empty()) parts.back().name = "part_" + std::to_string(parts.size());
  }
  return parts;
}

}  // namespace piola
