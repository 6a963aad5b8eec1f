// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/warnings.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/doubts.hpp"
#include "piola/input/closeness.hpp"
#include "piola/input/region_checks.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {

bool knows_contact(CaseSpec const& spec) {
  auto const info = find_formulation(spec.bodies.front().formulation.name);
  return info && info->contact;
}

namespace {

/// Of "material.density", else of "material".
Place place_of_doubt(BodySpec const& body, std::string const& key) {
  std::size_t const dot = key.find('.');
  if (dot == std::string::npos) return place_of(body.places, key);
  return place_in_table(body.places, key.substr(0, dot), key.substr(dot + 1));
}

void warn_of_strangers(CaseSpec const& spec, Problems& found) {
  if (spec.bodies.size() < 2 || knows_contact(spec)) return;
  found.add(place_of(spec.bodies[1].places, ""),
            fmt::format("the formulation {} knows no contact, so that its {} bodies do not see each other and pass "
                        "through one another if they meet - take adaptle if they can meet",
                        spec.bodies.front().formulation.name, spec.bodies.size()));
}

/// Settings of contact that find nothing to act on.
void warn_of_idle_contact(CaseSpec const& spec, Problems& found) {
  if (!spec.contact || spec.bodies.size() > 1) return;
  Places const& places = spec.contact->places;
  if (spec.rigids.empty()) {
    found.add(place_of(places, ""), "contact has no effect here (there is one body and no rigid shape) - remove it");
    return;
  }
  Place const section = place_of(places, "");
  for (char const* key : {"stiffness", "closing_speed", "exponent"}) {
    Place const place = place_of(places, key);
    bool const given = place.line != section.line || place.column != section.column || place.file != section.file;
    if (given)
      found.add(place, fmt::format("contact.{} has no effect here (it acts between bodies, and there is one; rigid "
                                   "shapes know scale alone) - remove it",
                                   key));
  }
}

std::optional<double> contact_energy(std::optional<Diagnostics> const& start) {
  for (std::size_t k = 0; start && k < start->more.size(); ++k)
    if (start->more[k].first == "contact_energy") return start->more[k].second;
  return std::nullopt;
}

std::string energy_text(std::optional<Diagnostics> const& start) {
  auto const energy = contact_energy(start);
  if (!energy) return "";
  double const total = start->total_energy();
  return fmt::format("; contact holds {} at the start, {} % of all energy, which nothing has paid for",
                     quantity_text(*energy, "J", 3), number_text(total > 0 ? 100 * *energy / total : 0.0, 2));
}

/// Bodies, and bodies and rigid shapes, that push each other from the start.
void warn_of_touch(CaseSpec const& spec, ParticleSet const& particles, std::optional<Diagnostics> const& start,
                   Problems& found) {
  constexpr double touching = 1.001, reach = 3, much = 1e-3;
  bool const merged = spec.contact && spec.contact->law == ContactRule::Law::none;
  auto const energy = contact_energy(start);
  if (!knows_contact(spec) || (energy && !(*energy > 0))) return;
  bool const counts = energy && *energy > much * start->total_energy();
  std::string const held = energy_text(start);
  for (Closeness const& pair : close_bodies(spec, particles, counts ? reach : touching)) {
    if (merged) break;
    found.add(
        place_of(spec.bodies[pair.other].places, "shape"),
        fmt::format("the bodies {} and {} start close to each other: their nearest particles are {} apart, {:.2f} "
                    "spacings{} - leave two smoothing lengths between their particles",
                    in_quotes(spec.bodies[pair.body].name), in_quotes(spec.bodies[pair.other].name),
                    quantity_text(pair.distance, "m"), pair.distance / pair.spacing, held));
  }
  for (Closeness const& pair : close_shapes(spec, particles))
    found.add(place_of(spec.rigids[pair.other].places, ""),
              fmt::format("the rigid shape {} starts {} from a particle of body {}, nearer than half a spacing, {}{} - "
                          "leave half a spacing between them",
                          in_quotes(spec.rigids[pair.other].name), quantity_text(pair.distance, "m"),
                          in_quotes(spec.bodies[pair.body].name), quantity_text(pair.spacing, "m"), held));
}

}  // namespace

std::vector<std::string> warnings_of(CaseSpec const& spec, Assembly const& assembly, Prospect const& prospect) {
  Problems found;
  find_slips(spec, body_facts(spec, assembly.particles), prospect.step, found);
  for (Doubt const& doubt : doubts(assembly)) found.add(place_of_doubt(spec.bodies[doubt.body], doubt.key), doubt.text);
  warn_of_strangers(spec, found);
  warn_of_idle_contact(spec, found);
  warn_of_touch(spec, assembly.particles, prospect.start, found);
  found.sort_by_place();
  return found.lines();
}

}  // namespace piola
