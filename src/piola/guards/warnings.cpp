// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/warnings.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/setting_warnings.hpp"
#include "piola/guards/warn_of_narrow.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/model/clearance.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {

namespace {

/// Place of "material.density", else of "material".
Place place_of_warning(BodySpec const& body, std::string const& key) {
  std::size_t const dot = key.find('.');
  if (dot == std::string::npos) return place_of(body.places, key);
  return place_in_table(body.places, key.substr(0, dot), key.substr(dot + 1));
}

/// Settings of contact that find nothing to act on.
void warn_of_idle_contact(CaseSpec const& spec, Problems& found) {
  if (!spec.contact || spec.bodies.size() > 1 || spec.contact->self) return;
  Places const& places = spec.contact->places;
  if (spec.rigids.empty()) {
    found.add(place_of(places, ""), "contact has no effect here (there is one body and no rigid shape) - remove it");
    return;
  }
  for (char const* key : {"stiffness", "closing_speed", "exponent"}) {
    if (is_given(places, key))
      found.add(place_of(places, key),
                fmt::format("contact.{} has no effect here (it acts between bodies, and there is one; rigid "
                            "shapes know scale alone) - remove it",
                            key));
  }
}

bool rubs(CaseSpec const& spec) {
  return (spec.contact && spec.contact->friction.any()) ||
         std::any_of(spec.contact_pairs.begin(), spec.contact_pairs.end(),
                     [](ContactPairSpec const& pair) { return pair.friction.any(); });
}

void warn_of_chatter(CaseSpec const& spec, Problems& found) {
  for (BodySpec const& body : spec.bodies) {
    if (!rubs(spec) || body.formulation.name != "nodal" || body.formulation.numbers.contains("fluctuation_viscosity"))
      continue;
    bool const mirrored = std::any_of(spec.mirrors.begin(), spec.mirrors.end(),
                                      [&](MirrorSpec const& mirror) { return mirror.body == body.name; });
    if (number_of(body.formulation, "chatter_damping", 1) > 0 && !mirrored) continue;
    found.add(
        place_of(body.places, "formulation"),
        fmt::format("body {}: nothing damps the chatter of a sliding surface under nodal{}, which lowers friction by a "
                    "tenth - {}give fluctuation_viscosity = 0.3",
                    in_quotes(body.name), mirrored ? " with mirror planes" : "",
                    mirrored ? "" : "leave out chatter_damping, or "));
  }
}

/// Settings of one kind of contact where there is only the other one.
void warn_of_other_contact(CaseSpec const& spec, Problems& found) {
  if (!spec.contact || spec.contact->law == ContactRule::Law::none) return;
  Places const& places = spec.contact->places;
  auto const all = formulations_of(spec);
  bool const own = std::any_of(all.begin(), all.end(), [](FormulationInfo const& info) { return info.contact; });
  for (char const* key : {"law", "stiffness", "closing_speed", "exponent"})
    if (!own && is_given(places, key))
      found.add(place_of(places, key),
                fmt::format("contact.{} has no effect here (it is for bodies of adaptle) - remove it", key));
  if (!has_surface_contact(spec) && is_given(places, "self"))
    found.add(place_of(places, "self"),
              "contact.self has no effect here (no body has a surface that could touch itself) - remove it, or take "
              "nodal or jst_sph");
  if (!has_surface_contact(spec) && is_given(places, "friction"))
    found.add(place_of(places, "friction"),
              "contact.friction has no effect here (contact between bodies of adaptle has no friction) - remove it, or "
              "take nodal or jst_sph for one of them");
}

std::optional<double> column_at_start(std::optional<Diagnostics> const& start, std::string_view name) {
  for (std::size_t k = 0; start && k < start->more.size(); ++k)
    if (start->more[k].first == name) return start->more[k].second;
  return std::nullopt;
}
std::optional<double> contact_energy(std::optional<Diagnostics> const& start) {
  return column_at_start(start, "contact_energy");
}

std::string energy_text(std::optional<Diagnostics> const& start) {
  auto const energy = contact_energy(start);
  if (!energy) return "";
  double const total = start->total_energy();
  return fmt::format("; contact holds {} at the start, {} % of all energy, which nothing has paid for",
                     quantity_text(*energy, "J", 3), number_text(total > 0 ? 100 * *energy / total : 0.0, 2));
}

/// Warns of bodies, and bodies and rigid shapes, that are in contact from the start. otherwise: other remedies.
void warn_of_touch(CaseSpec const& spec, ParticleSet const& particles, std::optional<Diagnostics> const& start,
                   std::string const& otherwise, Problems& found) {
  constexpr double touching = 1.001, reach = 3, much = 1e-3;
  bool const merged = spec.contact && spec.contact->law == ContactRule::Law::none;
  auto const energy = contact_energy(start);
  if (energy && !(*energy > 0)) return;
  bool const counts = energy && *energy > much * start->total_energy();
  std::string const held = energy_text(start);
  constexpr double deep = 0.05;  // of a spacing; touching faces overlap by rounding
  double const overlap = column_at_start(start, "contact_overlap").value_or(0);
  if (has_surface_contact(spec) && !has_kernel_contact(spec) && overlap > deep)
    found.add(
        place_of(spec.bodies.back().places, "shape"),
        fmt::format("surfaces of bodies or rigid shapes overlap at the start by {:.2g} spacings{} - move them apart",
                    overlap, held));
  std::string const by_surfaces =
      otherwise.empty() ? "" : ", or give the two a [[contact]] table, which lets their surfaces touch";
  for (Clearance const& pair : close_bodies(spec, particles, counts ? reach : touching)) {
    if (merged) break;
    if (!has_own_contact(spec, pair.body, pair.other)) continue;
    found.add(
        place_of(spec.bodies[pair.other].places, "shape"),
        fmt::format("the bodies {} and {} start close to each other: their nearest particles are {} apart, {:.2f} "
                    "spacings{} - leave two smoothing lengths between their particles{}{}",
                    in_quotes(spec.bodies[pair.body].name), in_quotes(spec.bodies[pair.other].name),
                    quantity_text(pair.distance, "m"), pair.distance / pair.spacing, held, by_surfaces, otherwise));
  }
  for (Clearance const& pair : close_shapes(spec, particles)) {
    if (!has_kernel_contact(spec, pair.body)) continue;
    found.add(place_of(spec.rigids[pair.other].places, ""),
              fmt::format("the rigid shape {} starts {} from a particle of body {}, nearer than half a spacing, {}{} - "
                          "leave half a spacing between them{}",
                          in_quotes(spec.rigids[pair.other].name), quantity_text(pair.distance, "m"),
                          in_quotes(spec.bodies[pair.body].name), quantity_text(pair.spacing, "m"), held, otherwise));
  }
}

/// Parts of solids that have too few particles across.
void warn_of_thin_parts(CaseSpec const& spec, Problems& found) {
  constexpr double least = 3;  // spacings
  for (BodySpec const& body : spec.bodies) {
    if (!body.shape.solid) continue;
    auto const thin = body.shape.solid_particles->thinnest(body.shape);
    double const across = thin ? thin->thickness / body.shape.spacing : least;
    if (across > least * (1 - 1e-6)) continue;
    found.add(place_in_table(body.places, "shape", "spacing"),
              fmt::format("body {} is {} spacings thick around {} (at least {} to be computed) - make the spacing "
                          "smaller, or leave the part out",
                          in_quotes(body.name), number_text(across, 2),
                          point_text({thin->X[0], thin->X[1], thin->X[2]}, body.shape.dimension), least));
  }
}

/// Warns of bodies whose formulation is inaccurate on their particles (docs/user/formulations.md, Figures to expect).
void warn_of_inaccurate_particles(CaseSpec const& spec, Problems& found) {
  using Arrangement = ShapeSpec::Arrangement;
  for (BodySpec const& body : spec.bodies) {
    ShapeSpec const& shape = body.shape;
    if (body.formulation.name != "jst_sph" || shape.dimension == 1 || shape.kind == ShapeSpec::Kind::points) continue;
    bool const irregular = shape.arrangement == Arrangement::packed || shape.random || shape.jitter > 0;
    bool const curved = shape.kind != ShapeSpec::Kind::box || shape.solid;
    Place const place = place_of(body.places, "formulation");
    if (irregular)
      found.add(place, fmt::format("body {}: on irregular particles jst_sph is wrong by some percent that more "
                                   "particles do not cure: stresses at surfaces by 3 to 5 % "
                                   "(cases/geometry/thick_tube) - take nodal",
                                   in_quotes(body.name)));
    else if (curved && shape.arrangement == Arrangement::lattice)
      found.add(place, fmt::format("body {}: curved surfaces cut from a lattice are staircases, on which jst_sph is "
                                   "wrong by 2 to 10 % in periods (cases/geometry/sphere_modes) - take nodal, or "
                                   "arrangement = \"packed\"",
                                   in_quotes(body.name)));
  }
}

}  // namespace

void refuse_unpaid_contact(CaseSpec const& spec, ParticleSet const& particles, Diagnostics const& start) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  auto const energy = contact_energy(start);
  if (!energy || !has_kernel_contact(spec) || (spec.contact && is_given(spec.contact->places, "law"))) return;
  double const total = start.total_energy();
  bool const moves = total - *energy > 0;  // at rest the energy of later loads is unknown: a warning reports this
  if (!moves || !(*energy > largest_unpaid_contact * total)) return;
  Problems problems;
  warn_of_touch(
      spec, particles, start,
      fmt::format(" (allowed: at most {:.3g} % of all energy), or name contact.law (now: kernel) if this energy "
                  "is wanted",
                  100 * largest_unpaid_contact),
      problems);
  problems.sort_by_place();
  problems.raise_if_any();
}

std::vector<std::string> warnings_of(CaseSpec const& spec, Assembly const& assembly, StartEstimate const& prospect) {
  PIOLA_EXPECTS(spec.bodies.size() == assembly.particles.bodies.size());
  Problems found;
  for (OldSpelling const& spelling : spec.old_spellings) found.add(spelling.place, spelling.text);
  find_implausible_values(spec, assembly.particles, body_properties(spec, assembly.particles), prospect.step, found);
  for (SettingWarning const& setting_warning : setting_warnings(assembly))
    found.add(place_of_warning(spec.bodies[setting_warning.body], setting_warning.key), setting_warning.text);
  warn_of_thin_parts(spec, found);
  warn_of_inaccurate_particles(spec, found);
  warn_of_idle_contact(spec, found);
  warn_of_chatter(spec, found);
  warn_of_other_contact(spec, found);
  warn_of_ties(spec, assembly.particles, found);
  warn_of_touch(spec, assembly.particles, prospect.start, "", found);
  warn_of_narrow_shapes(spec, assembly.particles, found);
  found.sort_by_place();
  return found.lines();
}

}  // namespace piola
