// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/geometry/mesh.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/read_solid.hpp"
#include "piola/input/region_names.hpp"
#include "piola/input/sections.hpp"
#include "piola/math/array_conversion.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace piola {
namespace {

using Point = std::array<double, 3>;

constexpr std::array<std::string_view, 3> region_kinds{"where", "shape", "near"};

/// Inside or on the surface; a shape in 2D goes on along z.
Names::OfPlace inside_of(geometry::SolidPtr solid) {
  return [solid = std::move(solid)](Point const& X) { return solid->at(vector_of(X)).distance <= 0 ? 1.0 : 0.0; };
}

Names::OfPlace read_near(Section const& near, RegionSpec& region) {
  std::string file;
  double within = 0;
  bool const given = near.read("file", file);
  auto const unit = read_length_unit(near);
  bool const bounded = near.read("within", within);
  near.refuse_unknown();
  if (!given || !unit || !bounded) return {};
  region.files.push_back(case_file(near, file));
  geometry::MeshOptions options;
  options.scale = *unit;
  // Only how far a place is counts, so the surface need not enclose anything.
  options.repair = geometry::MeshOptions::Repair::holes;
  options.largest_hole = std::numeric_limits<double>::max();
  geometry::MeshReport report;
  auto solid = geometry::read_mesh(region.files.back().path.string(), options, report);
  for (std::string const& problem : report.problems) near.problems().add(near.place_of("file"), problem);
  if (!solid) return {};
  return [solid = std::move(solid), within](Point const& X) {
    return std::abs(solid->at(vector_of(X)).distance) <= within ? 1.0 : 0.0;
  };
}

Names::OfPlace read_condition(Section const& section, Names const& names) {
  auto formula = section.formula("where", names);
  if (!formula) return {};
  if (formula->depends_on_time()) {
    section.problems().add(section.place_of("where"),
                           section.name_of("where") +
                               " depends on t (allowed: X, Y, Z and constants) - regions stay "
                               "where they are");
    return {};
  }
  return [formula = std::move(*formula)](Point const& X) { return formula(X) != 0 ? 1.0 : 0.0; };
}

Names::OfPlace read_what(Section const& section, Names const& names, RegionSpec& region) {
  auto const given =
      std::count_if(region_kinds.begin(), region_kinds.end(), [&](std::string_view kind) { return section.has(kind); });
  if (given != 1) {
    section.refuse_count("region", given, "where, shape, near");
    return {};
  }
  if (section.has("where")) return read_condition(section, names);
  auto const table = section.table(section.has("shape") ? "shape" : "near");
  if (!table) return {};
  if (section.has("near")) return read_near(*table, region);
  ShapeSpec shape;
  region.solid = read_part_solid(Section(table->node(), "body.shape.part", section.problems()), names, shape);
  region.files = std::move(shape.files);
  region.text += key_of(region.files);
  return region.solid ? inside_of(region.solid) : Names::OfPlace{};
}

}  // namespace

RegionSpec read_region(Section const& section, Names const& names) {
  RegionSpec region;
  region.text = toml_value(section.node());
  if (section.read("name", region.name)) {
    bool const built_in =
        std::find(own_names_of_places.begin(), own_names_of_places.end(), region.name) != own_names_of_places.end();
    if (built_in || is_reserved_name(region.name) || names.constants.contains(region.name))
      section.problems().add(section.place_of("name"), "the region " + in_quotes(region.name) +
                                                           " has the name of something else in formulas - choose "
                                                           "another name");
  }
  region.holds = read_what(section, names, region);
  section.refuse_unknown();
  // Known as empty all the same, so that formulas which use it do not complain again.
  if (!region.holds) region.holds = [](Point const&) { return 0.0; };
  return region;
}

void add_names_of_places(ShapeSpec const& shape, bool usable, Names& names) {
  if (shape.dimension < 2 || shape.kind == ShapeSpec::Kind::points) return;
  geometry::SolidPtr solid;
  if (usable) solid = shape.kind == ShapeSpec::Kind::solid ? shape.solid : solid_of(shape);
  if (usable && !solid) return;
  for (std::size_t k = 0; k < own_names_of_places.size(); ++k) {
    std::string const name(own_names_of_places[k]);
    if (names.constants.contains(name) || static_cast<int>(k) > shape.dimension) continue;
    names.places[name] = [solid, k](Point const& X) {
      if (!solid) return 0.0;
      geometry::Foot const foot = solid->at(vector_of(X));
      return k == 0 ? -foot.distance : foot.normal[static_cast<int>(k) - 1];
    };
  }
}

}  // namespace piola
