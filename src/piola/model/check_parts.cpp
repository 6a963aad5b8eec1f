// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/particles/part_properties.hpp"
#include <algorithm>

namespace piola {
namespace {

void check_part(BodySpec const& body, PartSpec const& part, FormulationInfo const& info, Problems& problems) {
  auto const& usable = info.laws;
  if (part.law.empty() || std::find(usable.begin(), usable.end(), std::string_view(part.law)) != usable.end()) return;
  problems.add(place_of(part.places, "material"), "the formulation " + in_quotes(info.name) + " cannot use the law " +
                                                      in_quotes(part.law) + " (allowed: " + joined(usable) +
                                                      ") - change the material of the part " + in_quotes(part.name) +
                                                      " of body " + in_quotes(body.name));
}

}  // namespace

void mark_parts(CaseSpec const& spec, ParticleSet& particles) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    auto const& parts = spec.bodies[b].parts;
    if (parts.empty()) continue;
    if (particles.part.empty()) particles.part.assign(particles.X.size(), 0);
    std::vector<int>& mark = particles.part.own();
    for (auto id = particles.bodies[b].first; id < particles.bodies[b].last; ++id) {
      auto const i = static_cast<std::size_t>(id);
      auto const found = std::find_if(parts.begin(), parts.end(),
                                      [&](PartSpec const& part) { return part.where(particles.X[i]) != 0; });
      mark[i] = found == parts.end() ? 0 : static_cast<int>(found - parts.begin()) + 1;
    }
  }
}

void check_parts(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    BodySpec const& from = spec.bodies[b];
    Body const& body = particles.bodies[b];
    auto const info = find_formulation(from.formulation.name);
    if (from.parts.empty() || !info) continue;
    if (!info->parts) {
      problems.add(place_of(from.parts.front().places, ""), refusal(*info, "parts"));
      continue;
    }
    auto const shares = part_properties(particles, body, from.parts.size());
    for (std::size_t k = 0; k < from.parts.size(); ++k) {
      PartSpec const& part = from.parts[k];
      Place const place = place_of(part.places, "where");
      check_part(from, part, *info, problems);
      if (check_where(part.where, "body.part.where", place, particles, body, problems) && shares[k + 1].particles == 0)
        problems.add(place, "the part " + in_quotes(part.name) + " of body " + in_quotes(from.name) +
                                " has no particle that no part before it has - change the order or the conditions");
    }
    if (shares[0].particles == 0)
      problems.add(place_of(from.places, "material"),
                   "the parts of body " + in_quotes(from.name) +
                       " leave nothing to its own material - leave one part out and give the body its material");
  }
}

}  // namespace piola
