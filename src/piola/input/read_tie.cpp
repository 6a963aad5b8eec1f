// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/boundary_keys.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>

namespace piola {
namespace {

/// Indices of what a tie names, as far as there are such bodies and rigid shapes.
void read_between(Section const& section, std::vector<BodyNames> const& bodies, std::vector<RigidSpec> const& rigids,
                  TieSpec& tie) {
  auto const value = section.find("between");
  if (!value) return;
  auto const items = read_list(*value, 2, 2, section.problems());
  if (!items) return;
  std::vector<std::string> known;
  for (BodyNames const& body : bodies)
    if (!body.name.empty()) known.push_back(body.name);
  for (RigidSpec const& rigid : rigids)
    if (!rigid.name.empty()) known.push_back(rigid.name);
  std::vector<std::size_t> found;  // bodies
  int shapes = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    auto const name = read_text((*items)[k], section.problems());
    if (!name) continue;
    tie.between[k] = *name;
    auto const body = std::find_if(bodies.begin(), bodies.end(), [&](BodyNames const& b) { return b.name == *name; });
    auto const rigid = std::find_if(rigids.begin(), rigids.end(), [&](RigidSpec const& r) { return r.name == *name; });
    if (body != bodies.end()) {
      found.push_back(static_cast<std::size_t>(body - bodies.begin()));
    } else if (rigid != rigids.end()) {
      ++shapes;
      tie.rigid = static_cast<std::size_t>(rigid - rigids.begin());
      tie.rigid_first = k == 0;
    } else {
      section.problems().add((*items)[k].node.place, (*items)[k].name + " is " + in_quotes(*name) + " (allowed: " +
                                                         joined(known) + ") - " + advice_for_name(*name, known));
    }
  }
  if (found.empty() && shapes == 2)
    section.problems().add(value->node.place,
                           "tie.between names two rigid shapes (allowed: two bodies, or a body and a rigid shape) - "
                           "name a body");
  if (found.size() == 2 && found[0] == found[1])
    section.problems().add(value->node.place,
                           "tie.between names " + in_quotes(tie.between[0]) +
                               " twice (allowed: two bodies, or a body and a rigid shape) - name another body");
  if (!found.empty()) tie.bodies = {found.front(), found.back()};
}

}  // namespace

TieSpec read_tie(Section const& section, std::vector<BodyNames> const& bodies, std::vector<RigidSpec> const& rigids) {
  TieSpec tie;
  read_members(section, tie_keys(), tie);
  read_between(section, bodies, rigids, tie);
  if (auto where = section.formula("where", bodies.empty() ? Names{} : bodies[tie.bodies[0]].names))
    tie.where = std::move(*where);
  if (section.has("strength")) {
    if (!section.has("toughness"))
      section.report_missing("toughness", "energy that failure takes per area", "toughness = \"100 J/m^2\"");
    section.read("toughness", tie.toughness);
    section.read("shear_weight", tie.shear_weight);
  } else {
    for (auto const* key : {"toughness", "shear_weight"}) section.refuse(key, "is used only by a tie with a strength");
  }
  section.refuse_unknown();
  tie.places = places_of(section, {"between", "where", "stiffness", "strength", "toughness"});
  return tie;
}

}  // namespace piola
