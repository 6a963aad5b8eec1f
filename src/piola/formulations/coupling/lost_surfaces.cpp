// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/lost_surfaces.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>

namespace piola {
namespace {

/// Whether material of a body fails or becomes Eulerian under a formulation without contact of its own.
bool fails_without_contact(Assembly const& whole, std::size_t body) {
  auto const info = find_formulation(whole.formulations[body].name);
  auto const& materials = materials_of(whole, body);
  return info && info->can_be_coupled && !info->contact &&
         (whole.formulations[body].says("conversion", "eulerian") ||
          std::any_of(materials.begin(), materials.end(), &fails));
}

bool has_mirrors(Assembly const& whole, std::size_t body) {
  return std::any_of(whole.mirrors.begin(), whole.mirrors.end(), [&](auto const& m) { return m.body == body; });
}

}  // namespace

bool may_lose_surface(FormulationSpec const& formulation) {
  auto const info = find_formulation(formulation.name);
  return info && info->contact && !formulation.says("description", "total_lagrangian");
}

LostSurfaces::LostSurfaces(Assembly const& whole, contact::PairSettings const& settings) {
  auto const& bodies = whole.particles.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    bodies_.push_back({bodies[b].name, bodies[b].first, bodies[b].last, false, false, false});
  if (whole.materials.size() == bodies.size()) find_pairs(whole, settings);
  any_ = std::any_of(whole.formulations.begin(), whole.formulations.end(), &may_lose_surface) ||
         std::any_of(bodies_.begin(), bodies_.end(), [](BodyCount const& body) { return body.loses; });
}

void LostSurfaces::find_pairs(Assembly const& whole, contact::PairSettings const& settings) {
  std::size_t const n = bodies_.size();
  for (std::size_t a = 0; a < n; ++a) {
    if (!fails_without_contact(whole, a)) continue;
    BodyCount& body = bodies_[a];
    for (std::size_t b = 0; b < settings[a].size(); ++b) {
      if (a == b || !settings[a][b].is_active) continue;
      body.loses = true;
      bool const coloured = b < n && !whole.particles.axisymmetric && !has_mirrors(whole, a) && !has_mirrors(whole, b);
      if (b >= n) body.meets_shapes = true;
      if (b < n && !coloured) body.is_uncovered = true;
      if (coloured && (b > a || !fails_without_contact(whole, b)))
        pairs_.push_back({std::min(a, b), std::max(a, b), settings[a][b].factor, true});
    }
  }
}

void LostSurfaces::count(std::vector<char> const& lost, std::vector<std::int64_t> const& ids) {
  PIOLA_EXPECTS(lost.size() <= ids.size());
  for (BodyCount& body : bodies_) {
    if (!body.loses) continue;
    std::int64_t particles = 0;
    for (std::size_t k = 0; k < lost.size(); ++k)
      if (lost[k] != 0 && ids[k] >= body.first && ids[k] < body.last) ++particles;
    body.particles = std::max(body.particles, particles);  // marks may be those of another body alone
  }
}

void LostSurfaces::report(Diagnostics& sum) const {
  for (BodyCount const& body : bodies_) {
    if (body.particles > 0 && body.is_uncovered)
      sum.uncovered.push_back({"body " + in_quotes(body.name), "other bodies", body.particles});
  }
}

}  // namespace piola
