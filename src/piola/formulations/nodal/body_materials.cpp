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
namespace {

/// Coefficient of the viscous pressure of shocks where heat changes the pressure.
constexpr double default_shock = 2;

}  // namespace

double mean_spacing(Body const& body, int dimension) {
  double mean = 1;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c)
    mean *= std::pow(body.spacing[c], 1.0 / dimension);
  return mean;
}

double width_of_crack(Body const& body, int dimension) { return 2 * mean_spacing(body, dimension); }

BodyMaterials::BodyMaterials(std::vector<MaterialParameters> const& materials, ParticleSet const& set, Body const& body,
                             SlotOrder const& order, Options const& options)
    : name_(body.name) {
  double const spacing = *std::min_element(body.spacing.begin(), body.spacing.begin() + set.dimension);
  mean_spacing_ = mean_spacing(body, set.dimension);
  auto const part = [&](Index slot) {
    return part_of(set, static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)]));
  };
  Index first = 0;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    Index last = first;
    while (last < order.particles && part(last) == k) ++last;
    with_any_law(materials[k], [&](auto const& law) {
      double const shock = options.shock_viscosity.value_or(has_thermal_pressure(materials[k]) ? default_shock : 0);
      Constants const constants{law.rho0,
                                law.kappa,
                                law.mu,
                                std::min(law.kappa, law.mu),
                                spacing / law.p_wave_speed(),
                                options.stress_free,
                                shock * law.rho0 * mean_spacing_ * mean_spacing_,
                                0};
      ranges_.push_back({materials[k], constants, first, last});
    });
    with_block_law(materials[k], [&](BlockLaw const& law) { ranges_.back().block = &block_laws_.emplace_back(law); });
    if (options.failure)
      with_solid(materials[k], [&](auto const& law) {
        double const band = width_of_crack(body, set.dimension);
        ranges_.back().failure = {law.fracture.strength,
                                  law.fracture.energy,
                                  modulus_across_crack(set.dimension, law.kappa, law.mu),
                                  band,
                                  law.damages,
                                  law.s_wave_speed() / band,
                                  law.fracture.displacement > 0 ? band / law.fracture.displacement : 0};
      });
    first = last;
  }
  PIOLA_ENSURES(first == order.particles);
}

void BodyMaterials::attach(BodyState& state, Options const& options) const {
  state.materials = ranges_.data();
  state.material_count = static_cast<Index>(ranges_.size());
  state.constants = ranges_.front().constants;
  for (MaterialRange const& range : ranges_)
    state.constants.unit_step = std::min(state.constants.unit_step, range.constants.unit_step);
  if (state.has.viscosity && ranges_.size() > 1)
    throw InputError(fmt::format(
        "body '{}': fluctuation_viscosity, and shock_viscosity of hyperelastic laws, are those of one material "
        "(allowed: 0 for a body with parts) - leave them out, or make the parts bodies and tie them",
        name_));
  Constants const& of = ranges_.front().constants;
  double const speed = std::sqrt((of.kappa_local + 4 * of.mu / 3) / of.rho0);
  state.viscosity = {options.fluctuation_viscosity * of.rho0 * mean_spacing_ * speed,
                     stores_internal_energy(ranges_.front().material) ? 0 : of.shock};
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
