// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/model/region_checks.hpp"

namespace piola {
namespace {

void check_material(MaterialParameters const& material, BodySpec const& body, Place const& place, Problems& problems) {
  auto const info = find_formulation(body.formulation.name);
  Heat const heat = heat_of(material);
  bool const conducts = heat.conductivity > 0, gets_warm = heat.specific_heat < unbounded;
  if (conducts && info && !info->conducts)
    problems.add(place, "material.conductivity is given, and heat is not conducted in the formulation " +
                            in_quotes(info->name) + " (allowed: nodal) - take nodal, or leave conductivity out");
  if (conducts && !gets_warm)
    problems.add(place,
                 "material.conductivity is given without a specific_heat, so that nothing gets warm - give both");
  if (body.initial_temperature && info && info->conducts && !gets_warm)
    problems.add(place_of(body.places, "initial_temperature"),
                 "body.initial_temperature is given, and the material of body " + in_quotes(body.name) +
                     " has no specific_heat (allowed: laws in rate form that yield) - give specific_heat, or leave "
                     "initial_temperature out");
}

}  // namespace

void check_heat(BodySpec const& body, Problems& problems) {
  auto const info = find_formulation(body.formulation.name);
  if (body.initial_temperature && info && !info->conducts)
    problems.add(place_of(body.places, "initial_temperature"),
                 "body.initial_temperature is for bodies of nodal, and body " + in_quotes(body.name) + " is one of " +
                     std::string(info->name) + " (allowed there: material.initial_temperature, the same everywhere)");
  check_material(body.material, body, place_of(body.places, "material"), problems);
  for (PartSpec const& part : body.parts)
    check_material(part.material, body, place_of(body.places, "material"), problems);
}

}  // namespace piola
