// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/mechanics/contact/rigid_pairs.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>

/// Checks of rigid shapes that are free or rotate.
namespace piola {
namespace {

std::string shape_words(RigidSpec const& rigid) {
  return std::string(rigid.free ? "the free" : "the turning") + " rigid shape " + in_quotes(rigid.name);
}

void check_bodies(CaseSpec const& spec, RigidSpec const& rigid, Problems& problems) {
  bool any = false;  // body that can touch the shape
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) any = any || has_surface(spec, b);
  std::vector<std::string> without;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (!has_surface(spec, b) && !(any && is_off(spec, spec.bodies[b].name, rigid.name)))
      without.push_back(in_quotes(spec.bodies[b].name));
  if (!without.empty())
    problems.add(place_of(rigid.places, "motion"),
                 "nothing keeps " + shape_words(rigid) + " apart from " + (without.size() > 1 ? "bodies " : "body ") +
                     joined(without) +
                     " (allowed: bodies with a surface: nodal, jst_sph, taylor_sph, or adaptle with description = "
                     "\"total_lagrangian\", without antisymmetric mirrors, with a contact.law) - change the body, or "
                     "let the shape be fixed or driven without turning" +
                     (any ? "; or say law = \"none\" in [[contact]] between them, for no contact" : ""));
  if (!spec.mirrors.empty())
    problems.add(place_of(rigid.places, "motion"),
                 shape_words(rigid) + " can touch body " + in_quotes(spec.mirrors.front().body) +
                     ", which has mirror planes (allowed: rigid shapes that are fixed or driven without turning: what "
                     "is behind the planes would push it, too) - model the whole, or change the motion");
  auto const named = std::find_if(spec.bodies.begin(), spec.bodies.end(),
                                  [&](BodySpec const& body) { return body.name == rigid.name; });
  if (named != spec.bodies.end())
    problems.add(place_of(rigid.places, "name"), "the name " + in_quotes(rigid.name) +
                                                     " is taken by a body (allowed: one name for one of them, whose "
                                                     "columns are alike) - choose another name");
}

void check_pair(RigidSpec const& a, RigidSpec const& b, int dimension, Problems& problems) {
  std::string const names = "the rigid shapes " + in_quotes(a.name) + " and " + in_quotes(b.name);
  std::vector<RigidShape> const both{a, b};
  contact::RigidPairs pair(both, dimension, {1, 1, {}});
  pair.start({contact::surface_of(a, dimension), contact::surface_of(b, dimension)});
  double const allowed = 1e-9 * std::min(contact::reach_of(contact::surface_of(a, dimension)),
                                         contact::reach_of(contact::surface_of(b, dimension)));
  if (!(pair.totals().deepest > allowed)) return;
  problems.add(place_of(b.places, ""), names + " start " + quantity_text(pair.totals().deepest, "m", 3) +
                                           " inside each other (allowed: apart, or touching) - move one of them");
}

}  // namespace

void check_free_rigids(CaseSpec const& spec, int dimension, Problems& problems) {
  for (std::size_t a = 0; a < spec.rigids.size(); ++a) {
    if (spec.rigids[a].turns()) check_bodies(spec, spec.rigids[a], problems);
    for (std::size_t b = a + 1; b < spec.rigids.size(); ++b)
      if (spec.rigids[a].free || spec.rigids[b].free) check_pair(spec.rigids[a], spec.rigids[b], dimension, problems);
  }
}

}  // namespace piola
