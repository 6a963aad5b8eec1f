// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/contact_sweep.hpp"
#include "piola/formulations/adaptle/finish_pass.hpp"
#include "piola/formulations/adaptle/force_sweep.hpp"
#include "piola/formulations/adaptle/riemann_sweep.hpp"
#include "piola/formulations/adaptle/spatial_sweep.hpp"
#include "piola/neighbours/moving_search.hpp"
#include "piola/parallel/ranks.hpp"

/// One step, part by part; the host sorts particles and updates tables between the parts.
namespace piola::adaptle::inline PIOLA_MACHINE {

template <int D>
struct Step {
  System& s;

  Range body_range(int b) const { return s.part[b]; }

  void predict(double dt) const {
    for (int b = 0; b < s.bodies; ++b)
      with_solid(s.body[b].material, [&](auto const& law) {
        exec::for_each_block(body_range(b), Predict<D, std::decay_t<decltype(law)>>{
                                                law, dt, s.reference, s.state, s.rates, s.half, s.sums, s.position,
                                                material_of(b), s.settings.published, s.own, s.failure});
      });
  }

  void deform() const {
    with_form([&](auto form) { deform_as<form()>(); });
  }

  template <bool Corrected>
  void half_state(double dt) const {
    for (int b = 0; b < s.bodies; ++b)
      with_solid(s.body[b].material, [&](auto const& law) {
        exec::for_each_block(body_range(b), HalfState<D, Corrected, std::decay_t<decltype(law)>>{
                                                law, s.body[b], s.settings, dt, s.reference, s.state, s.half,
                                                s.deformation, s.own, s.spatial, material_of(b), s.failure});
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
    with_form([&](auto form) { add_material_forces<form()>(); });
    exec::for_each_block(Range{0, s.contact.targets}, ContactSweep<D>{s.contact, s.spatial.slot, s.body, s.body_of,
                                                                      s.bodies, s.state, s.half, s.sums});
    if (s.rigids > 0) push_off_shapes();
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
    m.crowded = s.crowded;
    if (s.shared) combine_over_ranks(m, sums);
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
  /// Block by block of each body: blocks are its tiles.
  void push_off_shapes() const {
    double* action = s.rigid_action;
    for (int b = 0; b < s.bodies; ++b) {
      Range const r = body_range(b);
      exec::for_each_block(r, RigidSweep<D>{s.rigid, s.rigids, s.contact.scale, s.body, s.body_of, s.state, s.half,
                                            s.sums, s.rigid_power, action});
      action += std::ptrdiff_t{6} * s.rigids * exec::block_count(r);
    }
  }

  /// The table of material sums for one body.
  MaterialTable material_of(int b) const {
    MaterialTable table = s.material;
    if (table.rows_of != nullptr) table.rows = table.rows_of[b];
    return table;
  }

  /// f(form), which is known when it is compiled.
  template <class F>
  void with_form(F const& f) const {
    using Form = MaterialForm;
    if (s.settings.published && s.settings.corrected_material)
      f(std::integral_constant<Form, Form::published>{});
    else if (s.settings.published)
      f(std::integral_constant<Form, Form::published_plain>{});
    else if (s.settings.corrected_material)
      f(std::integral_constant<Form, Form::corrected>{});
    else
      f(std::integral_constant<Form, Form::plain>{});
  }

  /// f(body, its table, its places) for the bodies that are lattices.
  template <class F>
  void each_lattice(F const& f) const {
    if (!s.material.used) return;
    for (int b = 0; b < s.bodies; ++b) {
      MaterialTable const table = material_of(b);
      Index const first = s.body[b].first;
      if (table.rows.record != nullptr) f(s.body[b], table, Range{s.part[b].first - first, s.part[b].last - first});
    }
  }

  template <MaterialForm Form>
  void deform_as() const {
    auto const end = [&](MaterialTable const& table, BodyConstants const& b) {
      return Deform<D, Form>{table,       s.particles,   s.state, s.half,
                             s.reference, s.deformation, s.sums,  {PairConstants(b)}};
    };
    exec::for_each_block(Range{0, s.material.kinematics},
                         DeformLists<D, Form>{end(s.material, s.body[0]), s.body, s.body_of});
    each_lattice([&](BodyConstants const& b, MaterialTable const& table, Range places) {
      exec::for_each_block(places, DeformRows<D, Form>{end(table, b), b.last});
    });
  }

  template <MaterialForm Form>
  void add_material_forces() const {
    auto const end = [&](MaterialTable const& table) {
      return MaterialForces<D, Form>{table,       s.settings, s.particles,   s.body, s.body_of,
                                     s.reference, s.state,    s.deformation, s.sums};
    };
    exec::for_each_block(Range{0, s.material.targets}, ForceLists<D, Form>{end(s.material)});
    each_lattice([&](BodyConstants const& b, MaterialTable const& table, Range places) {
      exec::for_each_block(places, ForceRows<D, Form>{end(table), b});
    });
  }

  template <bool Corrected>
  void sweep_space(Range targets) const {
    if (s.settings.artificial_stress)
      exec::for_each_block(targets, SpatialSweep<D, Corrected, true>{s.spatial, s.settings, s.body, s.body_of, s.sums});
    else
      exec::for_each_block(targets,
                           SpatialSweep<D, Corrected, false>{s.spatial, s.settings, s.body, s.body_of, s.sums});
  }

  /// What the steps of all ranks say: the same on all of them.
  static void combine_over_ranks(Measures& m, exec::ExactSums<BlockMeasures::sums>& sums) {
    struct Said {
      Measures m;
      exec::ExactSums<BlockMeasures::sums> sums;
    } said{m, sums};
    ranks::combine(said, [](void const* other, void* mine) {
      Said const& from = *static_cast<Said const*>(other);
      Said& to = *static_cast<Said*>(mine);
      to.sums.add(from.sums);
      to.m.dt = from.m.dt < to.m.dt ? from.m.dt : to.m.dt;
      to.m.overlap = from.m.overlap > to.m.overlap ? from.m.overlap : to.m.overlap;
      to.m.wishes += from.m.wishes;
      to.m.crowded = to.m.crowded || from.m.crowded;
    });
    m = said.m;
    sums = said.sums;
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
