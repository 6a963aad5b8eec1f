// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/fields.hpp"
#include <tuple>

namespace piola::adaptle {

ParticleFields Fields::refs() const {
  Fields const& f = *this;
  ParticleFields r;
  std::tie(r.X, r.volume, r.mass) = std::tuple(f.X.ref(), f.volume.ref(), f.mass.ref());
  std::tie(r.x, r.v, r.S, r.rho, r.energy) = std::tuple(f.x.ref(), f.v.ref(), f.S.ref(), f.rho.ref(), f.energy.ref());
  std::tie(r.plastic_strain, r.temperature, r.damage, r.plastic_work) =
      std::tuple(f.plastic_strain.ref(), f.temperature.ref(), f.damage.ref(), f.plastic_work.ref());
  std::tie(r.thickness, r.thickness_half, r.viscosity, r.phi, r.active, r.released, r.bulking) =
      std::tuple(f.thickness.ref(), f.thickness_half.ref(), f.viscosity.ref(), f.phi.ref(), f.active.ref(),
                 f.released.ref(), f.bulking.ref());
  std::tie(r.a, r.S_rate, r.rho_rate, r.energy_rate, r.thickness_rate, r.flow) = std::tuple(
      f.a.ref(), f.S_rate.ref(), f.rho_rate.ref(), f.energy_rate.ref(), f.thickness_rate.ref(), f.flow.ref());
  std::tie(r.v_half, r.S_half, r.volume_half, r.rho_half, r.pressure, r.c) =
      std::tuple(f.v_half.ref(), f.S_half.ref(), f.volume_half.ref(), f.rho_half.ref(), f.pressure.ref(), f.c.ref());
  std::tie(r.F, r.F_rate, r.gap) = std::tuple(f.F.ref(), f.F_rate.ref(), f.gap.ref());
  std::tie(r.force, r.heat, r.hourglass, r.compression, r.contact) =
      std::tuple(f.force.ref(), f.heat.ref(), f.hourglass.ref(), f.compression.ref(), f.contact.ref());
  std::tie(r.K, r.gradient_sum, r.kernel_sum, r.N, r.gradient_mean) =
      std::tuple(f.K.ref(), f.gradient_sum.ref(), f.kernel_sum.ref(), f.N.ref(), f.gradient_mean.ref());
  return r;
}

}  // namespace piola::adaptle
