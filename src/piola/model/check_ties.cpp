// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/setup/contact_surface.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr double stiff_enough = 10;     // K delta_max / t_max: the elastic branch is short
constexpr double spacings_of_zone = 3;  // that resolve where a tie softens

/// Elastic moduli of a body's material [Pa].
struct Moduli {
  double kappa = 0, mu = 0;
  double wave() const { return kappa + 4.0 / 3 * mu; }
  double young() const { return 9 * kappa * mu / (3 * kappa + mu); }
};
Moduli moduli_of(BodySpec const& body) {
  Moduli m;
  with_any_law(body.material, [&](auto const& law) { m = {law.kappa, law.mu}; });
  return m;
}

/// Why a body cannot be tied; empty: it can.
std::string why_not(CaseSpec const& spec, std::size_t body) {
  BodySpec const& b = spec.bodies[body];
  auto const info = find_formulation(b.formulation.name);
  if (can_have_surface(spec, body)) return "";
  if (!info || !info->can_be_coupled) return "the formulation " + b.formulation.name + " cannot be pushed";
  if (info->name == "taylor_sph" || b.shape.kind == ShapeSpec::Kind::points) return why_without_surface(spec, body);
  bool const mirrored = std::any_of(spec.mirrors.begin(), spec.mirrors.end(), [&](MirrorSpec const& mirror) {
    return mirror.body == b.name && mirror.antisymmetric;
  });
  return mirrored ? "it has antisymmetric mirror planes" : "its particles may turn Eulerian";
}

/// adaptle among itself keeps its bodies from shapes that do not turn by the kernel, held points, too.
void check_own_contact(CaseSpec const& spec, TieSpec const& tie, Problems& problems) {
  if (!tie.rigid || spec.rigids[*tie.rigid].turns() || !has_kernel_contact(spec, tie.bodies[0])) return;
  problems.add(place_of(tie.places, "between"),
               "the tie " + in_quotes(tie.name) + " holds body " + in_quotes(spec.bodies[tie.bodies[0]].name) +
                   " to a rigid shape from which adaptle keeps it by a contact of its own (allowed: contact by "
                   "surfaces) - set contact.law = \"surface\"");
}

/// Whether the bodies of all ties have surfaces.
bool check_bodies(CaseSpec const& spec, Problems& problems) {
  bool sound = true;
  for (TieSpec const& tie : spec.ties) {
    check_own_contact(spec, tie, problems);
    for (std::size_t k = 0; k < (tie.rigid ? 1U : 2U); ++k) {
      std::size_t const b = tie.bodies[k];
      std::string const why = why_not(spec, b);
      if (why.empty()) continue;
      sound = false;
      problems.add(place_of(tie.places, "between"), "the tie " + in_quotes(tie.name) + " cannot hold body " +
                                                        in_quotes(spec.bodies[b].name) + ": " + why +
                                                        " (allowed: bodies of nodal, jst_sph, taylor_sph and "
                                                        "total-Lagrangian adaptle without antisymmetric mirrors) - "
                                                        "choose another body or formulation");
    }
  }
  return sound;
}

void check_found(TieSpec const& tie, contact::Ties::TieReport const& found, Problems& problems) {
  if (found.points[0] > 0 && (tie.rigid || found.points[1] > 0)) return;
  for (std::size_t const k : {0, 1})
    if (!tie.rigid && found.points[1 - k] > 0) {
      problems.add(place_of(tie.places, "between"),
                   "the tie " + in_quotes(tie.name) + " holds no point of " + in_quotes(tie.between[k]) +
                       " (allowed: points of both bodies) - let it hold more" + (tie.where ? ", by where" : ""));
      return;
    }
  std::string const nearest = std::isfinite(found.nearest)
                                  ? "the nearest surfaces that face each other are " + number_text(found.nearest, 3) +
                                        " spacings apart, as a gap or an overlap"
                                  : "no surfaces face each other within two spacings";
  problems.add(place_of(tie.places, "between"),
               "the tie " + in_quotes(tie.name) + " holds nothing: between " + in_quotes(tie.between[0]) + " and " +
                   in_quotes(tie.between[1]) + (tie.where ? ", and where its condition holds, " : " ") + nearest +
                   " (allowed: half a spacing) - let the bodies touch" + (tie.where ? ", or change where" : ""));
}

void check_stiffness(TieSpec const& tie, contact::Ties::TieReport const& found, Problems& problems) {
  if (!tie.fails()) return;
  double const last = 2 * tie.toughness / tie.strength, least = stiff_enough * tie.strength / last;
  if (found.stiffness >= least) return;
  double const factor = tie.stiffness * least / found.stiffness;
  problems.add(place_of(tie.places, "strength"),
               fmt::format("the tie {} is too soft for its strength: it opens by {} before it softens, and {} is where "
                           "it has failed (allowed: a tenth of that) - take stiffness = {} or more, a smaller strength "
                           "or a smaller spacing",
                           in_quotes(tie.name), quantity_text(tie.strength / found.stiffness, "m", 3),
                           quantity_text(last, "m", 3), number_text(std::ceil(10 * factor) / 10, 3)));
}

double spacing_of(ParticleSet const& particles, std::size_t body) {
  auto const& spacing = particles.bodies[body].spacing;
  return *std::max_element(spacing.begin(), spacing.begin() + particles.dimension);
}

}  // namespace

std::vector<contact::Ties::TieReport> found_by_ties(CaseSpec const& spec, ParticleSet const& particles) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  Problems none;
  if (spec.ties.empty() || !check_bodies(spec, none)) return {};
  std::vector<contact::Surface> surfaces(spec.bodies.size());
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (!is_tied(spec, b)) continue;
    surfaces[b] = contact_surface(spec.bodies[b].shape, particles, particles.bodies[b]);
    surfaces[b].modulus = moduli_of(spec.bodies[b]).wave();
  }
  contact::HostParticles const hosts(particles, surfaces);
  std::vector<Vec<3>> x;
  for (auto const id : hosts.ids()) {
    auto const i = static_cast<std::size_t>(id);
    auto const at = start_of(spec.bodies[static_cast<std::size_t>(particles.body[i])], particles.X[i]);
    x.push_back(vector_of(at));
  }
  std::vector<contact::RigidSurface> rigids;
  for (RigidSpec const& rigid : spec.rigids) rigids.push_back(contact::surface_of(rigid, particles.dimension));
  return contact::Ties({spec.ties.begin(), spec.ties.end()}, particles, surfaces, hosts, x, rigids).found();
}

void check_ties(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  if (spec.ties.empty() || !check_bodies(spec, problems)) return;
  for (TieSpec const& tie : spec.ties)
    for (std::size_t const b : tie.bodies)
      if (tie.where && !FormulaCheck(particles, particles.bodies[b], problems)
                            .finite(*tie.where, "tie.where", place_of(tie.places, "where")))
        return;
  try {
    auto const found = found_by_ties(spec, particles);
    for (std::size_t k = 0; k < found.size(); ++k) {
      check_found(spec.ties[k], found[k], problems);
      check_stiffness(spec.ties[k], found[k], problems);
    }
  } catch (InputError const& error) {  // a body of one layer
    problems.add(place_of(spec.ties.front().places, "between"), error.what());
  }
}

namespace {

/// Faces that part at an angle, or that another tie should hold.
void warn_of_what_is_left(TieSpec const& tie, contact::Ties::TieReport const& of, Problems& found) {
  if (!(of.left_area > of.area)) return;
  found.add(
      place_of(tie.places, "between"),
      fmt::format("the tie {} holds {} points, but {} more that face the other body are farther from it than half "
                  "a spacing, as a gap or an overlap, and stay free - let the bodies touch, or select the "
                  "points by where",
                  in_quotes(tie.name), of.points[0] + of.points[1], of.left));
}

}  // namespace

void warn_of_ties(CaseSpec const& spec, ParticleSet const& particles, Problems& found) {
  auto const all = found_by_ties(spec, particles);
  for (std::size_t k = 0; k < all.size(); ++k) warn_of_what_is_left(spec.ties[k], all[k], found);
  for (TieSpec const& tie : spec.ties) {
    if (!tie.fails()) continue;
    double const young =
        std::min(moduli_of(spec.bodies[tie.bodies[0]]).young(), moduli_of(spec.bodies[tie.bodies[1]]).young());
    double const spacing = std::max(spacing_of(particles, tie.bodies[0]), spacing_of(particles, tie.bodies[1]));
    double const zone = young * tie.toughness / (tie.strength * tie.strength);
    if (!(zone < spacings_of_zone * spacing)) continue;
    found.add(
        place_of(tie.places, "strength"),
        fmt::format("the tie {} softens over a length of about E G_c/t_max^2 = {}, {} spacings, which takes three "
                    "or more - take a smaller strength or a smaller spacing",
                    in_quotes(tie.name), quantity_text(zone, "m", 3), number_text(zone / spacing, 2)));
  }
}

}  // namespace piola
