// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/domain/first_failure.hpp"
#include "piola/formulations/adaptle/axis_images.hpp"
#include "piola/formulations/adaptle/contact_sweep.hpp"
#include "piola/formulations/adaptle/finish_pass.hpp"
#include "piola/formulations/adaptle/force_sweep.hpp"
#include "piola/formulations/adaptle/half_state.hpp"
#include "piola/formulations/adaptle/riemann_sweep.hpp"
#include "piola/formulations/adaptle/spatial_sweep.hpp"
#include "piola/neighbours/cell_list_search.hpp"

/// One step, part by part; the host sorts particles and updates tables between the parts.
namespace piola::adaptle::inline PIOLA_BACKEND {

template <int D>
struct Step {
  System& s;

  Range body_range(int b) const { return s.part[b]; }

  void predict(double dt) const {
    for (int b = 0; b < s.bodies; ++b) exec::for_each_block(body_range(b), Drift<D>(s, material_of(b), dt));
    if (s.settings.axisymmetric)
      exec::for_each_block(Range{0, s.particles},
                           ImageMotion{write(s.field.x), write(s.field.v_half), s.position, s.particles});
  }

  void deform() const {
    put_images(0, MaterialRecord<2>::A);
    with_form([&](auto form) { deform_as<form()>(); });
  }

  template <bool Corrected>
  void half_state(double dt) const {
    for (int b = 0; b < s.bodies; ++b)
      with_solid(s.body[b].material, [&](auto const& law) {
        HalfStress const stress(law, s, s.body[b], dt);
        half_state<Corrected>(b, dt, LawPart<>(stress));
      });
  }

  void correct() const {
    Range const targets{0, s.spatial.targets};
    with_kernel(*s.settings.kernel, LaneKernels{}, [&]<class Shape>() {
      exec::for_each_block(targets, CorrectSpatial<D, Shape>{s.spatial, s.settings, s.body, s.body_of, s.correction});
    });
    exec::for_each_block(targets, FoldCorrection<D>{s.spatial, s.correction});
  }

  void sweep() const {
    put_images(MaterialRecord<2>::A, MaterialRecord<2>::values(s.settings.equations));
    if (s.settings.axisymmetric && s.spatial.record != nullptr)
      exec::for_each_block(Range{0, s.spatial.sources}, ImageSpatialRecords{s.spatial, s.particles});
    with_kernel(*s.settings.kernel, LaneKernels{}, [&]<class Shape>() { sweep_space<Shape>(); });
    with_form([&](auto form) { add_material_forces<form()>(); });
    Fields const& f = s.field;
    exec::for_each_block(
        Range{0, s.contact.targets},
        ContactSweep<D>{s.contact, s.spatial.slot, s.body, s.body_of, s.bodies, read(f.x), read(f.v_half),
                        read(f.volume_half), write(f.force), write(f.contact), s.settings.axisymmetric, s.particles});
    if (s.rigid.count > 0) push_off_shapes();
  }

  StepSums finish(double dt) const {
    StepSums m;
    m.dt = 1e300;
    exec::ReproducibleSums<BlockMeasures::sums> sums;
    for (int b = 0; b < s.bodies; ++b)
      with_solid(s.body[b].material, [&](auto const& law) {
        FinishStress const stress(law, s, s.body[b], dt);
        finish(b, dt, law.damages, LawPart<BlockScratch>(stress));
        add_blocks(exec::block_count(body_range(b)), m, sums);
      });
    m.neighbour_overflow = s.neighbour_overflow;
    if (s.shared) combine_over_ranks(m, sums);
    using B = BlockMeasures;
    m.contact_power = sums.value(B::contact);
    m.hourglass_power = sums.value(B::hourglass);
    m.rigid_power = sums.value(B::rigid);
    m.held_power = sums.value(B::held);
    m.load_power = sums.value(B::load);
    m.viscous_power = sums.value(B::viscous);
    m.artificial_power = sums.value(B::artificial);
    return m;
  }

 private:
  /// Parts of a step for one body, by what its law does.
  template <bool Corrected>
  PIOLA_SHARED inline void half_state(int b, double dt, LawPart<> const& stress) const {
    exec::for_each_block(body_range(b), HalfState<D, Corrected, LawPart<>>{
                                            HalfVolume(s, s.body[b], material_of(b), dt), stress,
                                            WriteRecords<D, Corrected>(s, s.body[b], material_of(b), dt)});
  }
  PIOLA_SHARED inline void finish(int b, double dt, bool damages, LawPart<BlockScratch> const& stress) const {
    exec::for_each_block(body_range(b), Finish<D, LawPart<BlockScratch>>{
                                            Kick<D>(s, material_of(b), dt), stress,
                                            StepEnd<D>(s, s.body[b], material_of(b), damages, dt), s.partial});
  }

  /// Puts components of the records of images for sums over reference neighbours.
  void put_images(int first, int last) const {
    if (!s.material.used) return;
    exec::for_each_block(
        Range{0, s.material.images},
        ImageMaterialRecords{s.material, s.particles, MaterialRecord<2>::stride(s.settings.equations), first, last});
  }

  /// Block by block of each body: blocks are its tiles.
  void push_off_shapes() const {
    double* action = s.rigid.action;
    for (int b = 0; b < s.bodies; ++b) {
      Range const r = body_range(b);
      exec::for_each_block(r, RigidSweep<D>{s.rigid.pose, s.rigid.count, s.contact.scale, s.body, s.body_of,
                                            read(s.field.x), read(s.field.v_half), write(s.field.force),
                                            write(s.field.contact), s.rigid.power, action, s.settings.axisymmetric});
      action += std::ptrdiff_t{6} * s.rigid.count * exec::block_count(r);
    }
  }

  /// The table of material sums for one body.
  MaterialTable material_of(int b) const {
    MaterialTable table = s.material;
    if (table.rows_of != nullptr) table.rows = table.rows_of[b];
    return table;
  }

  /// Calls f(form) with a compile-time form.
  template <class F>
  void with_form(F const& f) const {
    using Form = MaterialForm;
    switch (s.settings.equations.form) {
      case Form::corrected: return f(std::integral_constant<Form, Form::corrected>{});
      case Form::plain: return f(std::integral_constant<Form, Form::plain>{});
      case Form::published: return f(std::integral_constant<Form, Form::published>{});
      case Form::published_plain: return f(std::integral_constant<Form, Form::published_plain>{});
    }
  }

  /// Local lattice positions of a body.
  Range places_of(int b) const { return {s.part[b].first - s.body[b].first, s.part[b].last - s.body[b].first}; }

  template <MaterialForm Form>
  void deform_as() const {
    for (int b = 0; b < s.bodies; ++b) {
      Range const slots = body_range(b);
      Deform<D, Form> const end(s, material_of(b), s.body[b]);
      if (end.table.rows.record != nullptr)
        exec::for_each_block(places_of(b), DeformRows<D, Form>{end, slots.last});
      else
        exec::for_each_block(slots, DeformLists<D, Form>{end});
    }
  }

  template <MaterialForm Form>
  void add_material_forces() const {
    for (int b = 0; b < s.bodies && s.material.used; ++b) {
      Range const slots = body_range(b);
      MaterialForces<D, Form> const end(s, material_of(b), s.body[b]);
      if (end.table.rows.record != nullptr)
        exec::for_each_block(places_of(b), ForceRows<D, Form>{end});
      else
        exec::for_each_block(slots, ForceLists<D, Form>{end});
    }
  }

  template <class Shape>
  void sweep_space() const {
    Range const targets{0, s.spatial.targets};
    if (s.settings.viscosity == Viscosity::riemann)
      exec::for_each_block(targets, RiemannSweep<D, Shape>{s.spatial, s.body, s.body_of});
    else if (s.settings.corrected)
      sweep_space<Shape, true>(targets);
    else
      sweep_space<Shape, false>(targets);
  }

  template <class Shape, bool Corrected>
  void sweep_space(Range targets) const {
    if (s.settings.artificial_stress)
      exec::for_each_block(targets, SpatialSweep<D, Corrected, true, Shape>{s.spatial, s.settings, s.body, s.body_of});
    else
      exec::for_each_block(targets, SpatialSweep<D, Corrected, false, Shape>{s.spatial, s.settings, s.body, s.body_of});
  }

  /// Reduces the results of the step over ranks.
  void combine_over_ranks(StepSums& m, exec::ReproducibleSums<BlockMeasures::sums>& sums) const {
    struct StepReduction {
      StepSums m;
      exec::ReproducibleSums<BlockMeasures::sums> sums;
      FirstFailure first;
    } said{m, sums, FirstFailure(*s.failure)};
    comm::allreduce(said, [](void const* other, void* mine) {
      StepReduction const& from = *static_cast<StepReduction const*>(other);
      StepReduction& to = *static_cast<StepReduction*>(mine);
      to.sums.add(from.sums);
      to.first.add(from.first);
      to.m.dt = from.m.dt < to.m.dt ? from.m.dt : to.m.dt;
      to.m.overlap = from.m.overlap > to.m.overlap ? from.m.overlap : to.m.overlap;
      to.m.conversion_requests += from.m.conversion_requests;
      to.m.axis_crossings += from.m.axis_crossings;
      to.m.neighbour_overflow = to.m.neighbour_overflow || from.m.neighbour_overflow;
    });
    m = said.m;
    sums = said.sums;
    said.first.put(*s.failure);
  }

  PIOLA_SHARED inline void add_blocks(Index blocks, StepSums& m,
                                      exec::ReproducibleSums<BlockMeasures::sums>& sums) const {
    using B = BlockMeasures;
    for (Index k = 0; k < blocks; ++k) {
      double const* p = s.partial + static_cast<std::ptrdiff_t>(k) * B::size;
      sums.add(p);
      m.dt = p[B::dt] < m.dt ? p[B::dt] : m.dt;
      m.overlap = p[B::overlap] > m.overlap ? p[B::overlap] : m.overlap;
      m.conversion_requests += static_cast<Index>(p[B::conversion_requests]);
      m.axis_crossings += static_cast<Index>(p[B::axis_crossings]);
    }
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
