// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>
#include <string>

namespace piola {
namespace {

/// Whether the formulation can minimise, and the materials have one potential energy.
void check_body(BodySpec const& body, Problems& problems) {
  auto const info = find_formulation(body.formulation.name);
  if (info && !info->minimises)
    problems.add(place_of(body.places, "formulation"),
                 "run.relax_method is \"conjugate_gradients\", which the formulation " + in_quotes(info->name) +
                     " does not have (allowed: nodal) - take nodal, or relax_method = \"kinetic_damping\"");
  bool without = stores_internal_energy(body.material);
  for (PartSpec const& part : body.parts) without = without || stores_internal_energy(part.material);
  if (without)
    problems.add(place_of(body.places, "material"),
                 "run.relax_method is \"conjugate_gradients\", which needs a potential energy; solids in rate form "
                 "and laws of libraries with a history have none (allowed: hyperelastic laws) - take relax_method = "
                 "\"kinetic_damping\"");
}

}  // namespace

void check_minimisation(CaseSpec const& spec, Problems& problems) {
  if (!spec.run.minimises()) return;
  for (BodySpec const& body : spec.bodies) check_body(body, problems);
  bool const alone = spec.bodies.size() == 1 && spec.rigids.empty() && spec.contact_pairs.empty() && spec.ties.empty();
  if (!alone || (spec.contact && spec.contact->self))
    problems.add(place_of(spec.run.places, "relax_method"),
                 "run.relax_method is \"conjugate_gradients\", which is for one body without contact, ties and rigid "
                 "shapes - take relax_method = \"kinetic_damping\"");
  for (SupportSpec const& support : spec.supports)
    if (support.velocity)
      problems.add(place_of(support.places, "velocity"),
                   "support.velocity drives the body, and run.relax_method is \"conjugate_gradients\" (allowed: "
                   "supports at rest) - take relax_method = \"kinetic_damping\"");
}

}  // namespace piola
