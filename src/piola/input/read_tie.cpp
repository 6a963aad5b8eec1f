// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>

namespace piola {
namespace {

/// Indices of the bodies that a tie names, as far as there are such bodies.
void read_between(Section const& section, std::vector<BodyNames> const& bodies, std::vector<RigidSpec> const& rigids,
                  TieSpec& tie) {
  auto const value = section.find("between");
  if (!value) return;
  auto const items = read_list(*value, 2, 2, section.problems());
  if (!items) return;
  std::vector<std::string> known;
  for (BodyNames const& body : bodies)
    if (!body.name.empty()) known.push_back(body.name);
  int right = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    auto const name = read_text((*items)[k], section.problems());
    if (!name) continue;
    tie.between[k] = *name;
    auto const body = std::find_if(bodies.begin(), bodies.end(), [&](BodyNames const& b) { return b.name == *name; });
    tie.bodies[k] = static_cast<std::size_t>(body - bodies.begin());
    if (body != bodies.end()) {
      ++right;
      continue;
    }
    tie.bodies[k] = 0;
    bool const rigid = std::any_of(rigids.begin(), rigids.end(), [&](RigidSpec const& r) { return r.name == *name; });
    section.problems().add(
        (*items)[k].node.place,
        (*items)[k].name + " is " + in_quotes(*name) + (rigid ? ", a rigid shape" : "") +
            " (allowed: " + joined(known) + ", bodies) - " +
            (rigid ? "hold a body by a [[support]], driven where the shape moves" : advice_for_name(*name, known)));
  }
  if (right == 2 && tie.bodies[0] == tie.bodies[1])
    section.problems().add(value->node.place, "tie.between names " + in_quotes(tie.between[0]) +
                                                  " twice (allowed: two bodies) - name another body");
}

}  // namespace

TieSpec read_tie(Section const& section, std::vector<BodyNames> const& bodies, std::vector<RigidSpec> const& rigids) {
  TieSpec tie;
  section.read("name", tie.name);
  read_between(section, bodies, rigids, tie);
  if (auto where = section.formula("where", bodies.empty() ? Names{} : bodies[tie.bodies[0]].names))
    tie.where = std::move(*where);
  section.read("stiffness", tie.stiffness);
  section.read("strength", tie.strength);
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

void name_ties(std::vector<TieSpec>& ties) {
  for (std::size_t k = 0; k < ties.size(); ++k)
    if (ties[k].name.empty()) ties[k].name = "tie_" + std::to_string(k);
}

}  // namespace piola
