// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/boundary_keys.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>

namespace piola {
namespace {

using Law = ContactRule::Law;

void refuse_for(Section const& section, std::string_view key, bool refused, std::string const& laws) {
  if (refused) section.refuse(key, "is used only by the law " + laws);
}

void read_stiffness(Section const& section, int dimension, ContactRule& contact) {
  if (contact.law != Law::as_published) return;
  std::string const unit = dimension == 1 ? "Pa/m" : "Pa/m^" + std::to_string(dimension);
  if (auto const value = section.find("stiffness")) {
    if (auto const number = read_number(*value, unit, positive, section.problems())) contact.stiffness = *number;
  } else {
    section.report_missing("stiffness", "the constant of the law \"published\", in " + unit,
                           "stiffness = \"1e16 " + unit + "\"");
  }
}

/// Friction keys common to [contact] and its pairs. The static coefficient decays with the sliding speed.
void read_friction(Section const& section, contact::FrictionLaw& friction) {
  read_members(section, friction_keys(), friction);
  bool const still = section.read("static_friction", friction.still);
  if (still && !(friction.decay_speed > 0) && !section.has("decay_speed"))
    section.report_missing("decay_speed", "the speed over which friction falls from static_friction to friction",
                           "decay_speed = \"10 mm/s\"");
  if (!still && !(friction.still > 0)) section.refuse("decay_speed", "is used only with static_friction");
  if (friction.still > 0 && friction.still < friction.kinetic)
    section.problems().add(section.place_of(still ? "static_friction" : "friction"),
                           "contact.static_friction is " + number_text(friction.still) +
                               " (allowed: at least friction, which is " + number_text(friction.kinetic) + ")");
  if (!friction.any()) section.refuse("shear_limit", "is used only with friction");
}

void refuse_friction(Section const& section, bool refused, std::string const& laws) {
  for (FrictionKey const& key : friction_keys()) refuse_for(section, key.info.key, refused, laws);
}

ContactSpec read_whole(Section const& section, int dimension) {
  ContactSpec contact;
  read_members(section, contact_keys(), contact);
  Law const law = contact.law;
  std::string const all = "\"kernel\", \"linear\", \"published\" or \"surface\"";
  for (char const* key : {"scale", "self"}) refuse_for(section, key, law == Law::none, all);
  refuse_friction(section, law == Law::none, all);
  refuse_for(section, "stiffness", law != Law::as_published, "\"published\"");
  refuse_for(section, "closing_speed", law != Law::kernel, "\"kernel\"");
  refuse_for(section, "exponent", law != Law::kernel && law != Law::as_published, "\"kernel\" or \"published\"");
  read_stiffness(section, dimension, contact);
  if (law != Law::none) read_friction(section, contact.friction);
  section.refuse_unknown();
  contact.places = places_of(
      section, {"law", "scale", "friction", "static_friction", "self", "stiffness", "closing_speed", "exponent"});
  return contact;
}

/// Missing values of a pair are those of [contact].
ContactPairSpec read_pair(Section const& section, ContactRule const& whole) {
  ContactPairSpec pair;
  pair.scale = whole.scale;
  pair.friction = whole.friction;
  if (whole.law == Law::none)
    section.problems().add(section.place(),
                           "contact between a pair is given, and contact.law is \"none\" for all "
                           "(allowed: one of them) - remove one");
  if (auto const between = section.find("between"))
    if (auto const items = read_list(*between, 2, 2, section.problems()))
      for (std::size_t k = 0; k < 2; ++k)
        if (auto const name = read_text((*items)[k], section.problems())) pair.between[k] = *name;
  ContactSpec own;
  ContactKey const& law_key = contact_keys().front();
  read_member(section, law_key, own);
  Law const law = own.law;
  if (law != Law::kernel && law != Law::none)
    section.problems().add(
        section.place_of("law"),
        "contact.law of a pair is neither left out nor none (allowed: these) - write it once, without "
        "between");
  pair.off = law == Law::none;
  for (char const* key : {"self", "stiffness", "closing_speed", "exponent"})
    section.refuse(key, "is for all bodies together, not for a pair");
  std::string const all = "\"kernel\"";
  refuse_for(section, "scale", law == Law::none, all);
  refuse_friction(section, law == Law::none, all);
  section.read("scale", pair.scale);
  if (!pair.off) read_friction(section, pair.friction);
  section.refuse_unknown();
  pair.places = places_of(section, {"between", "law", "scale", "friction"});
  return pair;
}

void refuse_second(Section const& section, std::string const& what) {
  section.problems().add(section.place(), what + " (allowed: one) - remove one");
}

}  // namespace

void read_contact(Value const& value, int dimension, Problems& problems, CaseSpec& spec) {
  if (value.node.is_text("none")) {
    spec.contact.emplace();
    spec.contact->law = Law::none;
    spec.contact->places = {{"", value.node.place}, {"law", value.node.place}};
    return;
  }
  std::vector<Section> wholes, pairs;
  auto const sort = [&](Node const& node) {
    Section const section(node, "contact", problems);
    (section.has("between") ? pairs : wholes).push_back(section);
  };
  if (value.node.is_table())
    sort(value.node);
  else if (value.node.is_list_of_tables())
    std::for_each(value.node.items.begin(), value.node.items.end(), sort);
  else
    problems.add(value.node.place, "contact is " + shown(value.node) +
                                       " (allowed: a table such as contact = { ... }, tables [[contact]], \"none\")");
  for (std::size_t k = 0; k < wholes.size(); ++k) {
    if (k == 0)
      spec.contact = read_whole(wholes[k], dimension);
    else
      refuse_second(wholes[k], "a second [[contact]] without between");
  }
  for (Section const& section : pairs)
    spec.contact_pairs.push_back(read_pair(section, spec.contact ? ContactRule(*spec.contact) : ContactRule()));
}

}  // namespace piola
