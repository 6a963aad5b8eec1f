// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/boundary_keys.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <cmath>

/// Springs and dashpots of free rigid shapes.
namespace piola {
namespace {

/// Number of the rigid shape of this name; empty (and a problem) if there is none.
std::optional<std::size_t> shape_named(Value const& item, std::vector<RigidSpec> const& rigids, Problems& problems) {
  auto const name = read_text(item, problems);
  if (!name) return {};
  std::vector<std::string> known;
  for (std::size_t k = 0; k < rigids.size(); ++k) {
    if (rigids[k].name == *name) return k;
    if (!rigids[k].name.empty()) known.push_back(rigids[k].name);
  }
  problems.add(item.node.place, item.name + " is " + in_quotes(*name) + " (allowed: " +
                                    (known.empty() ? "names of [[rigid]] shapes, and there are none" : joined(known)) +
                                    ") - " + advice_for_name(*name, known));
  return {};
}

void read_between(Section const& section, std::vector<RigidSpec> const& rigids, SpringSpec& spring) {
  auto const value = section.find("between");
  auto const items = value ? read_list(*value, 1, 2, section.problems()) : std::nullopt;
  if (!items) return;
  auto const first = shape_named(items->front(), rigids, section.problems());
  if (first) spring.first = *first;
  if (items->size() == 2) spring.second = shape_named(items->back(), rigids, section.problems());
  if (!first || (items->size() == 2 && !spring.second)) return;
  std::string const names = section.name_of("between") + " names ";
  if (spring.second == first)
    section.problems().add(value->node.place,
                           names + in_quotes(rigids[*first].name) +
                               " twice (allowed: two shapes, or one and a point) - name another shape, "
                               "or leave it out");
  else if (!rigids[*first].free && !(spring.second && rigids[*spring.second].free))
    section.problems().add(value->node.place, names +
                                                  "no free shape (allowed: one or two with motion = \"free\") - free "
                                                  "one, or remove the spring");
}

void read_points(Section const& section, BodyNames const& names, SpringSpec& spring) {
  auto const value = section.find("points");
  auto const items = value ? read_list(*value, 2, 2, section.problems()) : std::nullopt;
  if (!items) return;
  auto const dimension = static_cast<std::size_t>(names.dimension);
  for (std::size_t end = 0; end < 2; ++end) {
    auto const components = read_list((*items)[end], dimension, dimension, section.problems());
    if (!components) continue;
    for (std::size_t d = 0; d < dimension; ++d)
      if (auto const x = read_number((*components)[d], "m", any_value, section.problems())) spring.points[end][d] = *x;
    if (names.axisymmetric && spring.points[end][0] != 0)
      section.problems().add((*items)[end].node.place,
                             (*items)[end].name +
                                 " is beside the axis (allowed in axisymmetric cases: on it) - set its "
                                 "first component to 0");
  }
  auto const& [a, b] = spring.points;
  spring.rest_length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// Reads stiffness or damping, whose unit depends on the dimension.
void read_per_length(Section const& section, std::string_view key, std::string unit, BodyNames const& names,
                     double& target) {
  auto const value = section.find(key);
  if (!value) return;
  if (names.dimension == 2 && !names.axisymmetric) unit += "^2";
  if (auto const number = read_number(*value, unit, section.info_of(key).allowed, section.problems())) target = *number;
}

}  // namespace

SpringSpec read_spring(Section const& section, BodyNames const& names, std::vector<RigidSpec> const& rigids) {
  SpringSpec spring;
  read_members(section, spring_keys(), spring);
  read_between(section, rigids, spring);
  std::size_t const before = section.problems().count();
  read_points(section, names, spring);
  bool const apart = spring.rest_length > 0 || section.problems().count() > before || !section.has("points");
  read_per_length(section, "stiffness", "N/m", names, spring.stiffness);
  read_per_length(section, "damping", "N s/m", names, spring.damping);
  section.read("rest_length", spring.rest_length);
  if (!section.has("stiffness") && !section.has("damping"))
    section.report_missing("stiffness\" or \"damping", "the force of the spring", "stiffness = \"1 kN/m\"");
  if (!apart && (spring.rest_length > 0 || spring.damping > 0))
    section.problems().add(section.place_of("points"),
                           section.name_of("points") +
                               " coincide, so that the force has no direction (allowed: so with "
                               "rest_length = 0 and without damping) - move one of them");
  section.refuse_unknown();
  spring.places = places_of(section, {"between", "points", "stiffness", "damping", "rest_length"});
  return spring;
}

}  // namespace piola
