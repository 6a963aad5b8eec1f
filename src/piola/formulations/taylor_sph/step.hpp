// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/adjoint_passes.hpp"
#include "piola/formulations/taylor_sph/boundary_passes.hpp"
#include "piola/formulations/taylor_sph/cell_passes.hpp"
#include "piola/formulations/taylor_sph/filter_passes.hpp"
#include "piola/formulations/taylor_sph/momentum_passes.hpp"
#include "piola/parallel/own_slots.hpp"
#include "piola/parallel/reduce.hpp"

namespace piola::taylor_sph::inline PIOLA_MACHINE {

/// The parts of a step of one body, in their order; solver.cpp calls them. On several ranks each works on its part of
/// the slots; then all have all of them, so that what is not in a loop over particles is the same everywhere.
template <int D, class Kernel, class Law>
class Step {
 public:
  Step(BodyState& body, Law const& law) : b_(body), law_(law) {}

  /// Eqs. (21): v and sigma of the virtual particles at t^(n+1/2) from the real ones at t^n.
  void half(double dt) {
    exec::for_each(own_part(b_.virtuals), HalfStep<D, Kernel, Law>{law_, b_.k, b_.to_virtual, b_.cells, b_.real,
                                                                   b_.virtual_, acceleration(), dt});
    complete_slots(b_.virtual_, Record<D>::stride, b_.virtuals);
  }
  /// Eqs. (22), (23): v, sigma, x of the real particles at t^(n+1) from the virtual ones at t^(n+1/2).
  void full(double dt) {
    exec::for_each(
        own_part(b_.interior),
        FullStep<D, Kernel, Law>{law_, b_.k, b_.to_real, b_.virtual_, b_.real, write(b_.out_of_plane), write(b_.drift),
                                 write(b_.displacement), acceleration(), b_.interior_count, b_.failure, dt});
    exec::for_each(own_part(b_.boundary),
                   BoundaryStep<D, Kernel, Law>{law_, b_.k, b_.to_real, b_.virtual_, b_.real, write(b_.out_of_plane),
                                                write(b_.drift), write(b_.displacement), acceleration(), b_.items,
                                                b_.boundary.first, b_.boundary_count, b_.failure, dt});
    complete_particles();
    share_failure(*b_.failure);
  }
  /// Prescribed values at t^(n+1).
  void impose() { exec::for_each_item(b_.boundary_count, Impose<D>{b_.real, b_.items, b_.boundary.first}); }
  /// The hourglass filter, where the lattice has patterns to filter.
  void filter() {
    if constexpr (D > 1) {
      Range const boxes{0, b_.hourglass.boxes};
      exec::for_each(own_part(boxes), MeasurePatterns<D>{b_.hourglass, b_.real});
      complete_slots(b_.hourglass.pattern, Patterns<D>::count * Record<D>::fields, boxes);
      damp(b_.interior, b_.interior_count);
      damp(b_.boundary, b_.boundary_count);
      complete_records();
    }
  }
  /// Mass, momentum and inertia of the body.
  void motion(double* sums) {
    sum_motion(b_.interior, b_.interior_count, sums);
    sum_motion(b_.boundary, b_.boundary_count, sums);
  }
  void add_rigid(double const* r) {
    AddRigidMotion<D> const pass{b_.real, {r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
    for (Range const range : {b_.interior, b_.boundary}) exec::for_each(range, pass);
  }
  /// A whole step by the adjoint exchange.
  void adjoint(double dt) {
    Range const cells = own_part(b_.virtuals);
    exec::for_each(cells, CornerForces<D, Law>{law_, b_.k, b_.cells, b_.memory, b_.real, b_.virtual_, dt});
    complete_slots(b_.memory.force, std::ptrdiff_t{D} * b_.cells.corners, b_.virtuals);
    b_.work = 0;
    advance_velocities(b_.interior, b_.interior_count, nullptr, dt);
    advance_velocities(b_.boundary, b_.boundary_count, b_.items, dt);
    complete_records();
    complete_real(b_.drift, D);
    exec::for_each_block(cells, StrainCells<D, Law>{law_, b_.k, b_.cells, b_.memory, b_.real, view(b_.drift),
                                                    b_.virtual_, b_.virtual_count, b_.partial, dt});
    complete_cells();
    double square = total(cells);
    square -= advance_stresses(b_.interior, b_.interior_count, dt);
    square -= advance_stresses(b_.boundary, b_.boundary_count, dt);
    b_.exchange_loss += 0.5 * (1 - b_.k.memory) * dt * dt * square;
    complete_particles();
    share_failure(*b_.failure);
  }
  /// Of all ranks, by each of them alone.
  CellEnergy cell_energy() {
    using Pass = CellEnergies<D, Law>;
    exec::for_each_block(b_.virtuals,
                         Pass{law_, b_.k, b_.cells, b_.memory, b_.real, b_.virtual_, b_.virtual_count, b_.partial});
    auto const sum = exec::add_partials<Pass::results>(b_.partial, exec::block_count(b_.virtuals));
    return {sum.v[0], sum.v[1], sum.v[2]};
  }
  /// Virtual particles into the middle of their cells. On several ranks the measures are those of the own cells, but
  /// for the dilation.
  CellMeasures place() {
    Range const cells = own_part(b_.virtuals);
    exec::for_each_block(cells, PlaceVirtuals<D>{b_.cells, b_.real, b_.virtual_, b_.partial});
    complete_slots(b_.virtual_, Record<D>::stride, b_.virtuals);
    CellMeasures m{0, 1e300, 1e300, 0};
    for (Index k = 0; k < exec::block_count(cells); ++k) {
      double const* const part = b_.partial + PlaceVirtuals<D>::results * k;
      m.strain = maximum(m.strain, part[0]);
      m.quality = minimum(m.quality, part[1]);
      m.spacing = minimum(m.spacing, part[2]);
      if (!(part[3] > 0)) m.inverted = true;
    }
    if (b_.k.adjoint) {
      gather_volumes(b_.interior, b_.interior_count);
      gather_volumes(b_.boundary, b_.boundary_count);
    }
    m.dilation =
        maximum(largest_volume(b_.interior, b_.interior_count), largest_volume(b_.boundary, b_.boundary_count)) /
        b_.k.kernel_volume;
    return m;
  }

 private:
  View acceleration() const { return view(b_.acceleration); }
  static View view(FieldRef const& f) { return {f.data, f.component_stride, f.particle_stride, f.tile_extra}; }
  static WriteView write(FieldRef const& f) { return {f.data, f.component_stride, f.particle_stride, f.tile_extra}; }
  /// Of real particles and of cells, what steps change.
  void complete_records() { complete_ranges(b_.real, Record<D>::stride); }
  void complete_real(FieldRef const& field, int components) {
    for (int c = 0; c < components; ++c) complete_ranges(field.data + c * field.component_stride, 1);
  }
  void complete_ranges(double* data, std::ptrdiff_t size) {
    complete_slots(data, size, b_.interior);
    complete_slots(data, size, b_.boundary);
  }
  void complete_particles() {
    complete_records();
    complete_real(b_.drift, D);
    if (D == 2) complete_real(b_.out_of_plane, 1);
    if (!b_.k.moving) complete_real(b_.displacement, D);
  }
  void complete_cells() {
    complete_slots(b_.virtual_, Record<D>::stride, b_.virtuals);
    complete_slots(b_.memory.across, 1, b_.virtuals);
    complete_slots(b_.memory.gradient, std::ptrdiff_t{D} * D, b_.virtuals);
    if (b_.memory.patterns > 0)
      complete_slots(b_.memory.hourglass, std::ptrdiff_t{D} * b_.memory.patterns, b_.virtuals);
  }
  /// Of what a loop over these slots, and the loops of other ranks over theirs, have left in `partial`.
  double total(Range own) const { return add_over_ranks<1>(true, b_.partial, exec::block_count(own)).v[0]; }
  void advance_velocities(Range range, Index count, BoundaryItem const* items, double dt) {
    Range const own = own_part(range);
    exec::for_each_block(
        own, AdvanceVelocities<D>{b_.k, b_.around, b_.memory, b_.real, view(b_.mass), acceleration(), write(b_.drift),
                                  items, range.first, range.first + count, b_.partial, dt});
    b_.work += total(own);
  }
  double advance_stresses(Range range, Index count, double dt) {
    Range const own = own_part(range);
    exec::for_each_block(own, AdvanceStresses<D, Law>{law_, b_.k, b_.around, b_.memory, b_.cells.corners, b_.virtual_,
                                                      b_.real, write(b_.out_of_plane), write(b_.displacement),
                                                      view(b_.drift), range.first + count, b_.failure, b_.partial, dt});
    return total(own);
  }
  void gather_volumes(Range range, Index count) {
    exec::for_each_block(range, GatherVolumes<D>{b_.k, b_.around, b_.cells.corners, b_.virtual_, b_.real, view(b_.mass),
                                                 range.first + count});
  }
  void sum_motion(Range range, Index count, double* sums) {
    Range const own = own_part(range);
    exec::for_each_block(own, SumMotion<D>{b_.real, view(b_.mass), range.first + count, b_.partial});
    auto const part = add_over_ranks<MotionSums::size>(true, b_.partial, exec::block_count(own));
    for (int k = 0; k < MotionSums::size; ++k) sums[k] += part.v[k];
  }
  void damp(Range range, Index count) {
    Range const own = own_part(range);
    exec::for_each_block(own, DampPatterns<D, Law>{law_, b_.k, b_.hourglass, b_.real, view(b_.mass),
                                                   view(b_.out_of_plane), range.first, count, b_.partial});
    b_.filter_loss += total(own);
  }
  double largest_volume(Range range, Index count) {
    exec::for_each_block(range, LargestVolume<D>{b_.real, range.first + count, b_.partial});
    double largest = 0;
    for (Index k = 0; k < exec::block_count(range); ++k) largest = maximum(largest, b_.partial[k]);
    return largest;
  }

  BodyState& b_;
  Law const& law_;
};

}  // namespace piola::taylor_sph::inline PIOLA_MACHINE
