// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/body_materials.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::nodal {

BodyMaterials::BodyMaterials(std::vector<MaterialParameters> const& materials, ParticleSet const& set, Body const& body,
                             SlotOrder const& order, Options const& options) {
  double const spacing = *std::min_element(body.spacing.begin(), body.spacing.begin() + set.dimension);
  auto const part = [&](Index slot) {
    return part_of(set, static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)]));
  };
  Index first = 0;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    Index last = first;
    while (last < order.particles && part(last) == k) ++last;
    with_any_law(materials[k], [&](auto const& law) {
      Constants const constants{
          law.rho0, law.kappa, law.mu, std::min(law.kappa, law.mu), spacing / law.p_wave_speed(), options.stress_free,
          0};
      ranges_.push_back({materials[k], constants, first, last});
    });
    first = last;
  }
  PIOLA_ENSURES(first == order.particles);
}

void BodyMaterials::attach(BodyState& state, Body const& body, Options const& options) const {
  state.materials = ranges_.data();
  state.material_count = static_cast<Index>(ranges_.size());
  state.constants = ranges_.front().constants;
  for (MaterialRange const& range : ranges_)
    state.constants.unit_step = std::min(state.constants.unit_step, range.constants.unit_step);
  if (state.has.viscosity && ranges_.size() > 1)
    throw InputError(fmt::format(
        "body '{}': fluctuation_viscosity and shock_viscosity are those of one material (allowed: 0 for a body with "
        "parts) - leave them out, or make the parts bodies and tie them",
        body.name));
  state.viscosity = viscosity(state, body, options);
}

ViscousConstants BodyMaterials::viscosity(BodyState const& state, Body const& body, Options const& options) const {
  ViscousConstants viscosity{};
  with_any_law(ranges_.front().material, [&](auto const& law) {
    double h = 1;
    for (std::size_t c = 0; c < static_cast<std::size_t>(state.dimension); ++c)
      h *= std::pow(body.spacing[c], 1.0 / state.dimension);
    double const speed = std::sqrt((state.constants.kappa_local + 4 * law.mu / 3) / law.rho0);
    viscosity = {options.fluctuation_viscosity * law.rho0 * h * speed,
                 options.shock_viscosity * 0.06 * law.rho0 * h * law.p_wave_speed(),
                 options.shock_viscosity * 1.2 * law.rho0 * h * h};
  });
  return viscosity;
}

std::vector<double> BodyMaterials::densities() const {
  std::vector<double> densities;
  for (MaterialRange const& range : ranges_) densities.push_back(range.constants.rho0);
  return densities;
}

MaterialRange const& BodyMaterials::of(Index slot) const {
  return *std::find_if(ranges_.begin(), ranges_.end(), [&](MaterialRange const& r) { return slot < r.last; });
}

}  // namespace piola::nodal
