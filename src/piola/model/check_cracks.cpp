// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/setup/cracks.hpp"
#include <algorithm>

namespace piola {
namespace {

std::optional<FormulationInfo> formulation_of(CaseSpec const& spec, std::string const& body_name) {
  auto const body = std::find_if(spec.bodies.begin(), spec.bodies.end(),
                                 [&](BodySpec const& candidate) { return candidate.name == body_name; });
  return body == spec.bodies.end() ? std::nullopt : find_formulation(body->formulation.name);
}

}  // namespace

bool holds_surface(CaseSpec const& spec, SupportSpec const& support) {
  auto const info = formulation_of(spec, support.body);
  if (!support.patch || !info || !info->surface_supports) return false;
  // Surfaces cannot be held together with mirror planes, which the axis is.
  auto const otherwise = spec.axisymmetric ? SupportSpec::Hold::particles : SupportSpec::Hold::surface;
  return support.hold.value_or(otherwise) == SupportSpec::Hold::surface;
}

void open_cracks(CaseSpec const& spec, ParticleSet& particles, Problems& problems) {
  PIOLA_EXPECTS(!particles.bodies.empty());
  std::size_t const body = particles.bodies.size() - 1;
  for (CrackSpec const& crack : spec.cracks) {
    if (crack.body != particles.bodies[body].name) continue;
    CrackPath const path = trace_crack(particles, body, crack.from, crack.to);
    if (path.problem.empty())
      open_crack(particles, body, crack.from, crack.to);
    else
      problems.add(place_of(crack.places, path.key), path.problem);
  }
}

namespace {

void check_absorption(CaseSpec const& spec, Problems& problems) {
  for (LoadSpec const& load : spec.loads) {
    auto const info = formulation_of(spec, load.body);
    if (info && !info->absorbs && load.kind == LoadSpec::Kind::non_reflecting)
      problems.add(place_of(load.places, "non_reflecting"), refusal(*info, "non-reflecting faces"));
  }
}

}  // namespace

void check_abilities(CaseSpec const& spec, Problems& problems) {
  check_contact(spec, problems);
  check_minimisation(spec, problems);
  for (CrackSpec const& crack : spec.cracks) {
    auto const info = formulation_of(spec, crack.body);
    if (info && !info->cracks) problems.add(place_of(crack.places, ""), refusal(*info, "cracks"));
  }
  check_absorption(spec, problems);
  for (SupportSpec const& support : spec.supports) {
    auto const info = formulation_of(spec, support.body);
    if (info && support.hold == SupportSpec::Hold::surface && !holds_surface(spec, support))
      problems.add(place_of(support.places, "hold"),
                   "support.hold is \"surface\", which the formulation " + in_quotes(info->name) +
                       " cannot do (allowed: \"particles\"; \"surface\" with nodal) - change hold or "
                       "body.formulation");
  }
  for (BodySpec const& body : spec.bodies) {
    auto const info = find_formulation(body.formulation.name);
    bool const packed = body.shape.arrangement == ShapeSpec::Arrangement::packed;
    bool const off_lattice = body.shape.arrangement != ShapeSpec::Arrangement::lattice;
    if (info && off_lattice && !info->off_lattice)
      problems.add(place_of(body.places, "shape"), refusal(*info, packed ? "packed clouds" : "rings"));
    if (info && info->outline && body.shape.kind == ShapeSpec::Kind::points)
      problems.add(place_of(body.places, "shape"), refusal(*info, "points from files"));
  }
  for (MirrorSpec const& mirror : spec.mirrors) {
    auto const info = formulation_of(spec, mirror.body);
    if (info && !info->mirrors) problems.add(place_of(mirror.places, ""), refusal(*info, "mirrors"));
    BodySpec const& body = *std::find_if(spec.bodies.begin(), spec.bodies.end(),
                                         [&](BodySpec const& candidate) { return candidate.name == mirror.body; });
    // Formulations that use the outline of bodies place the plane on the face itself.
    if (info && info->mirrors && !info->outline && body.shape.kind == ShapeSpec::Kind::box &&
        body.shape.placement != ShapeSpec::Placement::on_boundary)
      problems.add(place_of(mirror.places, "body"),
                   "a mirror needs particles on its face in " + in_quotes(info->name) + ", but those of body " +
                       in_quotes(mirror.body) +
                       " are in the middle of cells (allowed: placement = \"on_boundary\"; any with nodal) - change "
                       "body.shape");
  }
}

}  // namespace piola
