// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/contact_sweep.hpp"
#include "piola/formulations/adaptle/finish_pass.hpp"
#include "piola/formulations/adaptle/material_sweep.hpp"
#include "piola/formulations/adaptle/published_sweep.hpp"
#include "piola/formulations/adaptle/riemann_sweep.hpp"
#include "piola/formulations/adaptle/spatial_sweep.hpp"
#include "piola/neighbours/moving_search.hpp"

/// One step, part by part; the host sorts particles and updates tables between the parts.
namespace piola::adaptle::inline PIOLA_MACHINE {

template <int D>
struct Step {
  System& s;

  Range body_range(int b) const { return {s.body[b].first, s.body[b].last}; }

  void predict(double dt) const {
    for (int b = 0; b < s.bodies; ++b)
      with_solid(s.body[b].material, [&](auto const& law) {
        exec::for_each_block(body_range(b),
                             Predict<D, std::decay_t<decltype(law)>>{law, dt, s.reference, s.state, s.rates, s.half,
                                                                     s.sums, s.position, s.material, s.own, s.failure});
      });
  }

  void deform() const {
    Range const kinematics{0, s.material.kinematics};
    if (s.settings.published)
      exec::for_each_block(kinematics, PublishedDeformSweep<D>{s.material, s.state, s.half, s.body, s.body_of,
                                                               s.settings.corrected_material, s.deformation});
    else if (s.settings.corrected_material)
      exec::for_each_block(kinematics, deform_sweep<float>());
    else
      exec::for_each_block(kinematics, deform_sweep<double>());
  }

  template <bool Corrected>
  void half_state(double dt) const {
    for (int b = 0; b < s.bodies; ++b)
      with_solid(s.body[b].material, [&](auto const& law) {
        exec::for_each_block(body_range(b), HalfState<D, Corrected, std::decay_t<decltype(law)>>{
                                                law, s.body[b], s.settings, dt, s.reference, s.state, s.half,
                                                s.deformation, s.own, s.spatial, s.material, s.failure});
      });
  }

  void correct() const {
    Range const targets{0, s.spatial.targets};
    exec::for_each_block(targets, CorrectSpatial<D>{s.spatial, s.settings, s.body, s.body_of, s.correction});
    exec::for_each_block(targets, FoldCorrection<D>{s.spatial, s.correction});
  }

  void sweep() const {
    Range const targets{0, s.spatial.targets};
    if (s.settings.viscosity == Viscosity::riemann)
      exec::for_each_block(targets, RiemannSweep<D>{s.spatial, s.body, s.body_of, s.sums});
    else if (s.settings.corrected)
      sweep_space<true>(targets);
    else
      sweep_space<false>(targets);
    sweep_material();
    exec::for_each_block(Range{0, s.contact.targets}, ContactSweep<D>{s.contact, s.spatial.slot, s.body, s.body_of,
                                                                      s.bodies, s.state, s.half, s.sums});
    if (s.rigids > 0)
      exec::for_each_block(Range{0, s.particles},
                           RigidSweep<D>{s.rigid, s.rigids, s.contact.scale, s.body, s.body_of, s.state, s.half, s.sums,
                                         s.rigid_power, s.rigid_action});
  }

  Measures finish(double dt) const {
    Measures m;
    m.dt = 1e300;
    exec::ExactSums<BlockMeasures::sums> sums;
    for (int b = 0; b < s.bodies; ++b)
      with_solid(s.body[b].material, [&](auto const& law) {
        Range const r = body_range(b);
        double const* rigid_power = s.rigids > 0 ? s.rigid_power : nullptr;
        exec::for_each_block(
            r, Finish<D, std::decay_t<decltype(law)>>{law, s.body[b], s.settings, dt, s, rigid_power, s.partial});
        add_blocks(exec::block_count(r), m, sums);
      });
    using B = BlockMeasures;
    m.contact_power = sums.value(B::contact);
    m.hourglass_power = sums.value(B::hourglass);
    m.rigid_power = sums.value(B::rigid);
    m.held_power = sums.value(B::held);
    m.load_power = sums.value(B::load);
    m.viscous_power = sums.value(B::viscous);
    return m;
  }

 private:
  void sweep_material() const {
    Range const targets{0, s.material.targets};
    if (s.settings.published)
      exec::for_each_block(targets, PublishedMaterialSweep<D>{s.material, s.settings, s.body, s.body_of, s.reference,
                                                              s.state, s.deformation, s.sums});
    else if (s.settings.corrected_material)
      exec::for_each_block(targets, material_sweep<float>());
    else
      exec::for_each_block(targets, material_sweep<double>());
  }

  template <class Gradient>
  DeformSweep<D, Gradient> deform_sweep() const {
    return {s.material, s.state, s.half, s.reference, s.body, s.body_of, s.deformation, s.sums};
  }
  template <class Gradient>
  MaterialSweep<D, Gradient> material_sweep() const {
    return {s.material, s.body, s.body_of, s.reference, s.state, s.deformation, s.sums};
  }

  template <bool Corrected>
  void sweep_space(Range targets) const {
    if (s.settings.artificial_stress)
      exec::for_each_block(targets, SpatialSweep<D, Corrected, true>{s.spatial, s.settings, s.body, s.body_of, s.sums});
    else
      exec::for_each_block(targets,
                           SpatialSweep<D, Corrected, false>{s.spatial, s.settings, s.body, s.body_of, s.sums});
  }

  void add_blocks(Index blocks, Measures& m, exec::ExactSums<BlockMeasures::sums>& sums) const {
    using B = BlockMeasures;
    for (Index k = 0; k < blocks; ++k) {
      double const* p = s.partial + static_cast<std::ptrdiff_t>(k) * B::size;
      sums.add(p);
      m.dt = p[B::dt] < m.dt ? p[B::dt] : m.dt;
      m.overlap = p[B::overlap] > m.overlap ? p[B::overlap] : m.overlap;
      m.wishes += static_cast<Index>(p[B::wishes]);
    }
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
