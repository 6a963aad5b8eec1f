// SPDX-License-Identifier: Apache-2.0
// Settings of contact, from the assembly.
#include "piola/base/contracts.hpp"
#include "piola/formulations/coupling/contact_coupling.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace piola {
namespace {

std::vector<contact::RigidSurface> rigid_surfaces(Assembly const& whole) {
  std::vector<contact::RigidSurface> all;
  for (RigidShape const& shape : whole.rigid_shapes)
    all.push_back(contact::surface_of(shape, whole.particles.dimension));
  return all;
}

/// Closing speed, in units of the bulk speed of sound, above which surfaces of bodies whose material flows on as
/// Eulerian particles do not last.
constexpr double fast = 0.2;

/// Mean of the initial velocities of a body [m/s].
Vec<3> mean_velocity(Assembly const& whole, std::size_t body) {
  Body const& of = whole.particles.bodies[body];
  exec::ReproducibleSums<3> sum;
  for (auto id = of.first; id < of.last && !whole.initial_velocity.empty(); ++id)
    sum.add(whole.initial_velocity[static_cast<std::size_t>(id)].data());
  double const share = 1.0 / static_cast<double>(of.last - of.first);
  return {share * sum.value(0), share * sum.value(1), share * sum.value(2)};
}

/// Whether two bodies collide so fast that surfaces do not last, and the case does not ask for them.
bool collide_fast(Assembly const& whole, std::size_t a, std::size_t b) {
  if (whole.contact.law == ContactRule::Law::surface) return false;
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t const body : {a, b})
    with_any_law(whole.materials[body],
                 [&](auto const& law) { slowest = std::min(slowest, std::sqrt(law.kappa / law.rho0)); });
  Vec<3> const apart = mean_velocity(whole, a) - mean_velocity(whole, b);
  double const given = whole.contact.closing_speed, speed = std::isnan(given) ? std::sqrt(dot(apart, apart)) : given;
  return speed > fast * slowest;
}

/// Whether two bodies can be in surface contact, or a body and a rigid shape, numbered after the bodies.
bool have_surfaces(Assembly const& whole, std::size_t a, std::size_t b) {
  std::size_t const n = whole.particles.bodies.size();
  auto const has = [&](std::size_t body) { return !whole.surfaces[body].points.empty(); };
  auto const keeps = [&](std::size_t body) { return has(body) && !may_lose_surface(whole.formulations[body]); };
  if (b >= n) return keeps(a);
  auto const own = [&](std::size_t body) {
    auto const info = find_formulation(whole.formulations[body].name);
    return info && info->contact;
  };
  auto const& bodies = whole.particles.bodies;
  auto const converts = [&](std::size_t body) { return whole.formulations[body].says("conversion", "eulerian"); };
  if (a != b && (converts(a) || converts(b)) && collide_fast(whole, a, b)) return false;
  return has(a) && has(b) &&
         ((keeps(a) && keeps(b)) ||
          (a != b && own(a) && own(b) && find_pair(whole.contact_pairs, bodies[a].name, bodies[b].name) != nullptr));
}

/// Pair settings of surface contact. Surfaces are in contact unless both bodies have kernel contact of their own and
/// are neither tied nor named as a pair, or one has it and the other is a rigid shape that does not rotate. Settings of
/// a pair override those of all.
contact::PairSettings pair_settings(Assembly const& whole) {
  auto const own = [&](std::size_t b) {
    auto const info = find_formulation(whole.formulations[b].name);
    return info && info->contact && whole.contact.law != ContactRule::Law::surface;
  };
  auto const& bodies = whole.particles.bodies;
  std::size_t const n = bodies.size(), all = n + whole.rigid_shapes.size();
  contact::PairSettings settings(n, std::vector<contact::PairSetting>(all));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < all; ++b) {
      bool const rigid = b >= n;
      std::string const& name = rigid ? whole.rigid_shapes[b - n].name : bodies[b].name;
      ContactPair const* const pair = find_pair(whole.contact_pairs, bodies[a].name, name);
      bool const surfaces = have_surfaces(whole, a, b);
      // By the contact of their own formulation.
      bool const apart = own(a) && (rigid ? !whole.rigid_shapes[b - n].turns()
                                          : own(b) && !contact::is_tied(whole.ties, a, b) && pair == nullptr);
      bool const others = a == b ? pair != nullptr || whole.contact.self : !apart;
      bool const off = whole.contact.law == ContactRule::Law::none || (pair != nullptr && pair->off);
      settings[a][b] = {surfaces && others && !off, 0.5 * (pair != nullptr ? pair->scale : whole.contact.scale),
                        pair != nullptr ? pair->friction : whole.contact.friction};
    }
  return settings;
}

/// Pairs in colour contact: bodies that accept external impulses, one of them without a surface. Not with mirror
/// planes, whose images have no colour.
std::vector<contact::ColourContact::Pair> coloured_pairs(Assembly const& whole) {
  std::vector<contact::ColourContact::Pair> pairs;
  if (whole.contact.law == ContactRule::Law::none) return pairs;
  auto const& bodies = whole.particles.bodies;
  auto const info = [&](std::size_t b) { return find_formulation(whole.formulations[b].name); };
  auto const can = [&](std::size_t b) {
    return info(b) && info(b)->can_be_coupled &&
           std::none_of(whole.mirrors.begin(), whole.mirrors.end(), [&](auto const& m) { return m.body == b; });
  };
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      if (!can(a) || !can(b)) continue;
      bool const surfaces = have_surfaces(whole, a, b);
      bool const own = info(a)->contact && info(b)->contact && whole.contact.law != ContactRule::Law::surface;
      ContactPair const* const pair = find_pair(whole.contact_pairs, bodies[a].name, bodies[b].name);
      if (surfaces || own || (pair != nullptr && pair->off)) continue;
      pairs.push_back({a, b, 0.5 * (pair != nullptr ? pair->scale : whole.contact.scale)});
    }
  return pairs;
}

contact::SurfaceContactSystem system_of(Assembly const& whole) {
  return {whole.particles, whole.surfaces, rigid_surfaces(whole), pair_settings(whole)};
}

/// The layer between rigid shapes is that of the stiffest body that has a surface.
contact::RigidMotion motion_of(Assembly const& whole) {
  contact::RigidPairs::Setting between{0, 0, whole.contact.friction};
  for (contact::Surface const& surface : whole.surfaces) {
    if (surface.points.empty()) continue;
    double const k = contact::penalty_stiffness(1, 0.5 * whole.contact.scale, surface.modulus, surface.spacing);
    if (k > between.stiffness) between = {k, surface.spacing, whole.contact.friction};
  }
  return {whole.rigid_shapes, whole.particles.dimension, between, whole.springs};
}

/// Largest fraction of the friction heat for chatter damping, by body. Zero with mirror planes, because half of a
/// particle on a plane is missing in its cluster.
std::vector<double> chatter_fractions(Assembly const& whole) {
  constexpr std::string_view key = "chatter_damping";
  std::vector<double> fractions;
  for (FormulationSpec const& formulation : whole.formulations) {
    std::size_t const body = fractions.size();
    fractions.push_back(0);
    if (std::any_of(whole.mirrors.begin(), whole.mirrors.end(), [&](auto const& m) { return m.body == body; }))
      continue;
    auto const info = find_formulation(formulation.name);
    for (Parameter const& parameter : info ? info->parameters : std::span<Parameter const>{})
      if (parameter.name == key) fractions.back() = number_of(formulation, key, parameter.default_value);
  }
  return fractions;
}

std::vector<std::string> names_of(ParticleSet const& particles) {
  std::vector<std::string> names;
  for (Body const& body : particles.bodies) names.push_back(body.name);
  return names;
}

bool contains(LostSurfaces::Pairs const& pairs, std::size_t body) {
  return std::any_of(pairs.begin(), pairs.end(), [&](auto const& pair) { return pair.a == body || pair.b == body; });
}

/// Appends the particles without surface points that colour contact of `pairs` and the lost surfaces need. Returns the
/// indices of all particles by id.
std::map<std::int64_t, Index> append_particles(Assembly const& whole, LostSurfaces::Pairs const& pairs,
                                               LostSurfaces const& lost, ContactParticles& to) {
  std::map<std::int64_t, Index> at = to.indices();
  auto const append = [&](std::size_t b, bool late) {
    Body const& body = whole.particles.bodies[b];
    for (auto id = body.first; id < body.last; ++id) {
      if (!at.emplace(id, static_cast<Index>(to.count())).second) continue;
      if (late)
        to.append_late(id);
      else
        to.append(id);
    }
  };
  std::size_t const bodies = whole.particles.bodies.size();
  for (std::size_t b = 0; b < bodies; ++b)
    if (contains(pairs, b)) append(b, false);
  for (std::size_t b = 0; b < bodies; ++b)
    if (lost.may_lose(b) || contains(lost.pairs(), b)) append(b, true);
  return at;
}

/// Colour contact of the run. Appends its particles to `contact_particles`.
contact::ColourContact colour_contact_of(Assembly const& whole, LostSurfaces const& lost,
                                         ContactParticles& contact_particles) {
  PIOLA_EXPECTS(whole.materials.size() == whole.particles.bodies.size());
  LostSurfaces::Pairs pairs = coloured_pairs(whole);
  std::map<std::int64_t, Index> const at = append_particles(whole, pairs, lost, contact_particles);
  pairs.insert(pairs.end(), lost.pairs().begin(), lost.pairs().end());
  if (pairs.empty()) return {};
  ParticleSet const& particles = whole.particles;
  std::vector<contact::ColourContact::Body> bodies(particles.bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!contains(pairs, b)) continue;
    Body const& body = particles.bodies[b];
    bodies[b].spacing = *std::max_element(body.spacing.begin(), body.spacing.begin() + particles.dimension);
    with_any_law(whole.materials[b], [&](auto const& law) { bodies[b].modulus = law.kappa + 4.0 / 3 * law.mu; });
    for (auto id = body.first; id < body.last; ++id) {
      bodies[b].at.push_back(at.at(id));
      bodies[b].volume.push_back(particles.volume[static_cast<std::size_t>(id)]);
    }
  }
  return {particles.dimension, std::move(bodies), pairs};
}

}  // namespace

ContactCoupling::ContactCoupling(Assembly const& whole, std::vector<FormulationGroup> const& parts)
    : ContactCoupling(whole, MirroredAssembly(whole), parts) {}

ContactCoupling::ContactCoupling(Assembly const& whole, MirroredAssembly const& continued,
                                 std::vector<FormulationGroup> const& parts)
    : names_(names_of(whole.particles)),
      shapes_(whole.rigid_shapes),
      system_(system_of(continued.assembly)),
      motion_(motion_of(whole)),
      ties_(continued.assembly, system_),
      particles_(continued, system_.ids()),
      lost_(whole, pair_settings(whole)),
      colours_(colour_contact_of(whole, lost_, particles_)),
      held_(continued, whole, particles_.indices(), particles_.count()),
      actions_(whole.supports, whole.loads, whole.rigid_shapes),
      pair_impulses_(names_.size()) {
  PIOLA_EXPECTS(whole.particles.dimension >= 1 && whole.particles.dimension <= 3);
  motion_.place(system_.rigids());
  for (std::size_t b = 0; b < continued.mirrors.size(); ++b) system_.set_mirrors(b, continued.mirrors[b]);
  system_.damp_chatter(chatter_fractions(whole));
  particles_.assign(parts);
  std::map<std::int64_t, Index> const indices = particles_.indices();
  for (std::size_t b = 0; b < names_.size(); ++b) {
    if (!lost_.meets_shapes(b)) continue;
    std::vector<Index> at;
    std::vector<double> volumes;
    for (auto id = whole.particles.bodies[b].first; id < whole.particles.bodies[b].last; ++id) {
      at.push_back(indices.at(id));
      volumes.push_back(whole.particles.volume[static_cast<std::size_t>(id)]);
    }
    system_.late_rigids().set_particles(b, at, volumes);
  }
}

}  // namespace piola
