// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>

namespace piola {
namespace {

constexpr std::string_view who_has_one =
    " (allowed: nodal, jst_sph, taylor_sph and total-Lagrangian adaptle, without antisymmetric mirrors)";

/// Error text if no body has a contact surface, because of its formulation or its settings.
std::string no_surface(CaseSpec const& spec, FormulationInfo const& first, std::string const& what) {
  if (!first.can_be_coupled) return refusal(first, what);
  return what + " found no surface: body " + in_quotes(spec.bodies[0].name) + " has none, " +
         why_without_surface(spec, 0) + std::string(who_has_one) + " - remove it, or change the body";
}

// Contact and rigid shapes require at least one body that supports them; other bodies cause a warning.
void check_contact_ability(CaseSpec const& spec, Problems& problems) {
  auto const all = formulations_of(spec);
  bool none = !all.empty();
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) none = none && !has_rigid_contact(spec, b);
  bool const off = spec.contact && spec.contact->law == ContactRule::Law::none;
  if (!none || (off && spec.rigids.empty())) return;
  if (spec.contact && spec.contact->law == ContactRule::Law::surface && all.front().contact) return;  // reported there
  bool const able =
      off && std::any_of(all.begin(), all.end(), [](FormulationInfo const& info) { return info.can_be_coupled; });
  for (RigidSpec const& rigid : spec.rigids)
    problems.add(
        place_of(rigid.places, ""),
        able ? "the rigid shape " + in_quotes(rigid.name) +
                   " has no contact with any body, since contact.law is \"none\" (allowed: one of them) - remove one"
             : no_surface(spec, all.front(), "rigid shapes"));
  if (spec.contact && !able) problems.add(place_of(spec.contact->places, ""), no_surface(spec, all.front(), "contact"));
}

/// The members that a pair names: numbers of bodies, and how many rigid shapes.
struct PairMembers {
  std::vector<std::size_t> bodies;
  std::size_t rigids = 0;
  bool left_alone = false;  ///< a shape in contact with surfaces only, switched off
};

/// Reports names that the case does not have.
PairMembers members_of(CaseSpec const& spec, ContactPairSpec const& pair, Problems& problems) {
  PairMembers members;
  std::vector<std::string> known;
  for (BodySpec const& body : spec.bodies) known.push_back(body.name);
  for (RigidSpec const& rigid : spec.rigids) known.push_back(rigid.name);
  for (std::string const& name : pair.between) {
    auto const found = std::find(known.begin(), known.end(), name);
    auto const k = static_cast<std::size_t>(found - known.begin());
    if (found == known.end())
      problems.add(place_of(pair.places, "between"), "contact.between names " + in_quotes(name) + " (allowed: " +
                                                         joined(known) + ") - " + advice_for_name(name, known));
    else if (k < spec.bodies.size())
      members.bodies.push_back(k);
    else {
      ++members.rigids;
      members.left_alone = pair.off && spec.rigids[k - spec.bodies.size()].turns();
    }
  }
  return members;
}

void check_contact_pair(CaseSpec const& spec, ContactPairSpec const& pair, Problems& problems) {
  Place const place = place_of(pair.places, "between");
  auto const [bodies, rigids, left_alone] = members_of(spec, pair, problems);
  if (bodies.size() + rigids < 2) return;
  if (bodies.empty()) problems.add(place, "contact.between names two rigid shapes (allowed: one) - name a body");
  if (bodies.size() == 2 && starts_with_surface_contact(spec, bodies[0], bodies[1])) return;
  bool const coloured =
      bodies.size() == 2 && (pair.off || pushed_by_colour(spec, bodies[0], bodies[1])) && !pair.friction.any();
  for (std::size_t const body : bodies)
    if (!has_surface(spec, body) && !coloured && !left_alone)
      problems.add(place, "contact.between: body " + in_quotes(spec.bodies[body].name) +
                              " has no surface by which others could push it, " + why_without_surface(spec, body) +
                              std::string(who_has_one) + " - change the body, or remove " +
                              (pair.friction.any() ? "friction" : "the table"));
  bool const own =
      std::all_of(bodies.begin(), bodies.end(), [&](std::size_t b) { return has_kernel_contact(spec, b); });
  bool const self = bodies.size() == 2 && bodies[0] == bodies[1];
  if (own && !bodies.empty() && !self && !left_alone)
    problems.add(
        place,
        "contact.between names what adaptle keeps apart by a contact of its own (allowed: pairs with a "
        "body of another formulation; two bodies with description = \"adaptive\" or \"total_lagrangian\" "
        "without failed = \"delete\" and particles from a file, which then have surface contact first, without law "
        "= \"none\") - remove the table, or change one of them");
}

/// Reports a setting for all bodies that body b, which has no surface, cannot satisfy.
void refuse_setting(CaseSpec const& spec, char const* key, std::size_t b, Problems& problems) {
  problems.add(place_of(spec.contact->places, key), std::string("contact.") + key + " has nothing to act on: body " +
                                                        in_quotes(spec.bodies[b].name) + " has no surface, " +
                                                        why_without_surface(spec, b) + std::string(who_has_one) +
                                                        " - remove it, or change the body");
}

/// Reports friction and self-contact of bodies without a surface, if other bodies are in surface contact. A pair with
/// an entry of its own may slide without friction.
void check_some_surfaces(CaseSpec const& spec, Problems& problems) {
  if (spec.contact->self && spec.bodies.front().shape.dimension == 1)
    problems.add(place_of(spec.contact->places, "self"),
                 "contact.self is true in 1D (allowed: 2D, 3D) - remove it: a bar cannot touch itself");
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (has_surface(spec, b)) continue;
    bool rubs = false;
    for (std::size_t a = 0; a < spec.bodies.size() && spec.contact->friction.any(); ++a)
      rubs = rubs || (pushed_by_colour(spec, a, b) &&
                      find_pair(spec.contact_pairs, spec.bodies[a].name, spec.bodies[b].name) == nullptr);
    if (rubs) refuse_setting(spec, "friction", b, problems);
    if (spec.contact->self) refuse_setting(spec, "self", b, problems);
  }
}

/// Reports friction or self-contact if no bodies are in surface contact.
void check_surface_settings(CaseSpec const& spec, Problems& problems) {
  if (!spec.contact || spec.contact->law == ContactRule::Law::none) return;
  if (has_surface_contact(spec)) return check_some_surfaces(spec, problems);
  bool const rubs = spec.contact->friction.kinetic > 0 && (spec.bodies.size() > 1 || !spec.rigids.empty());
  if (!rubs && !spec.contact->self) return;
  char const* const key = rubs ? "friction" : "self";
  bool able = false;  // otherwise reported already
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) able = able || has_rigid_contact(spec, b);
  for (std::size_t b = 0; able && b < spec.bodies.size(); ++b)
    if (!has_surface(spec, b)) refuse_setting(spec, key, b, problems);
}

/// Bodies that nothing keeps apart from other bodies or rigid shapes.
void check_strangers(CaseSpec const& spec, Problems& problems) {
  if (spec.contact && spec.contact->law == ContactRule::Law::none) return;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    std::vector<std::string> through;
    std::string const& name = spec.bodies[b].name;
    for (std::size_t a = 0; a < spec.bodies.size(); ++a)
      if (a != b && !has_contact_between(spec, a, b) && !is_off(spec, name, spec.bodies[a].name))
        through.push_back(in_quotes(spec.bodies[a].name));
    for (RigidSpec const& rigid : spec.rigids)
      if (!rigid.turns() && spec.bodies.size() > 1 && !has_rigid_contact(spec, b) && !is_off(spec, name, rigid.name))
        through.push_back("the rigid shape " + in_quotes(rigid.name));
    // Reports the body without a surface, not its partner.
    if (through.empty() || has_surface(spec, b)) continue;
    problems.add(
        place_of(spec.bodies[b].places, "formulation"),
        "body " + in_quotes(name) + ": nothing keeps it apart from " + joined(through) + " (" +
            why_without_surface(spec, b) + "), so that they would pass through one another" + std::string(who_has_one) +
            " - change the body; or say contact = \"none\", or law = \"none\" in [[contact]] between them, if they "
            "are not to be in contact");
  }
}

/// Faces of cracks are no surfaces.
void check_cracked(CaseSpec const& spec, Problems& problems) {
  for (CrackSpec const& crack : spec.cracks) {
    ContactPairSpec const* const pair = find_pair(spec.contact_pairs, crack.body, crack.body);
    if (pair != nullptr ? pair->off : !(spec.contact && spec.contact->self)) continue;
    problems.add(place_of(crack.places, ""),
                 "body " + in_quotes(crack.body) +
                     " is to touch itself, but faces of cracks are no surfaces (allowed: one of the two) - remove the "
                     "crack, or contact of the body with itself");
  }
}

/// Whoever may turn Eulerian loses its surface.
void check_surface_law(CaseSpec const& spec, Problems& problems) {
  if (!spec.contact || spec.contact->law != ContactRule::Law::surface) return;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    auto const info = find_formulation(spec.bodies[b].formulation.name);
    if (info && info->contact && !has_surface(spec, b))
      problems.add(
          place_of(spec.contact->places, "law"),
          "contact.law is \"surface\", but body " + in_quotes(spec.bodies[b].name) +
              " keeps none (allowed: bodies of adaptle with description = \"total_lagrangian\", without failed = "
              "\"delete\") - choose another law or description");
  }
}

void check_contact_pairs(CaseSpec const& spec, Problems& problems) {
  for (std::size_t k = 0; k < spec.contact_pairs.size(); ++k) {
    ContactPairSpec const& pair = spec.contact_pairs[k];
    check_contact_pair(spec, pair, problems);
    if (find_pair(spec.contact_pairs, pair.between[0], pair.between[1]) != &pair)
      problems.add(place_of(pair.places, "between"),
                   "contact.between names a pair for the second time (allowed: one "
                   "table a pair) - remove one");
  }
}

}  // namespace

void check_contact(CaseSpec const& spec, Problems& problems) {
  check_contact_ability(spec, problems);
  check_contact_pairs(spec, problems);
  check_surface_law(spec, problems);
  check_surface_settings(spec, problems);
  check_strangers(spec, problems);
  check_cracked(spec, problems);
}

}  // namespace piola
