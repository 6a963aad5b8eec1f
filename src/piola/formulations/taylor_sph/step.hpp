// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/adjoint_passes.hpp"
#include "piola/formulations/taylor_sph/boundary_passes.hpp"
#include "piola/formulations/taylor_sph/cell_passes.hpp"
#include "piola/formulations/taylor_sph/filter_passes.hpp"
#include "piola/formulations/taylor_sph/momentum_passes.hpp"

namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// The parts of a step of one body, in their order; solver.cpp calls them.
template <int D, class Kernel, class Law>
class Step {
 public:
  Step(BodyState& body, Law const& law) : b_(body), law_(law) {}

  /// Eqs. (21): v and sigma of the virtual particles at t^(n+1/2) from the real ones at t^n.
  void half(double dt) {
    exec::for_each(b_.virtuals, HalfStep<D, Kernel, Law>{law_, b_.k, b_.to_virtual, b_.cells, b_.real, b_.virtual_,
                                                         acceleration(), dt});
  }
  /// Eqs. (22), (23): v, sigma, x of the real particles at t^(n+1) from the virtual ones at t^(n+1/2).
  void full(double dt) {
    exec::for_each(
        b_.interior,
        FullStep<D, Kernel, Law>{law_, b_.k, b_.to_real, b_.virtual_, b_.real, write(b_.out_of_plane), write(b_.drift),
                                 write(b_.displacement), acceleration(), b_.interior_count, b_.failure, dt});
    exec::for_each(b_.boundary,
                   BoundaryStep<D, Kernel, Law>{law_, b_.k, b_.to_real, b_.virtual_, b_.real, write(b_.out_of_plane),
                                                write(b_.drift), write(b_.displacement), acceleration(), b_.items,
                                                b_.boundary.first, b_.boundary_count, b_.failure, dt});
  }
  /// Prescribed values at t^(n+1).
  void impose() { exec::for_each_item(b_.boundary_count, Impose<D>{b_.real, b_.items, b_.boundary.first}); }
  /// The hourglass filter, if the lattice has patterns to filter.
  void filter() {
    if constexpr (D > 1) {
      exec::for_each(Range{0, b_.hourglass.boxes}, MeasurePatterns<D>{b_.hourglass, b_.real});
      b_.filter_loss += damp(b_.interior, b_.interior_count);
      b_.filter_loss += damp(b_.boundary, b_.boundary_count);
    }
  }
  /// Mass, momentum and inertia of the body.
  void motion(double* sums) {
    add_motion(b_.interior, b_.interior_count, sums);
    add_motion(b_.boundary, b_.boundary_count, sums);
  }
  void add_rigid(double const* r) {
    AddRigidMotion<D> const pass{b_.real, {r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
    for (Range const range : {b_.interior, b_.boundary}) exec::for_each(range, pass);
  }
  /// A whole step by the adjoint exchange.
  void adjoint(double dt) {
    Range const cells = b_.virtuals;
    exec::for_each(cells, CornerForces<D, Law>{law_, b_.k, b_.cells, b_.cell_state, b_.real, b_.virtual_, dt});
    b_.work = 0;
    b_.work += advance_velocities(b_.interior, b_.interior_count, nullptr, dt);
    b_.work += advance_velocities(b_.boundary, b_.boundary_count, b_.items, dt);
    exec::for_each_block(cells, StrainCells<D, Law>{law_, b_.k, b_.cells, b_.cell_state, b_.real, view(b_.drift),
                                                    b_.virtual_, b_.virtual_count, b_.partial, dt});
    double square = sum_of_blocks<1>(cells).value();
    square -= advance_stresses(b_.interior, b_.interior_count, dt);
    square -= advance_stresses(b_.boundary, b_.boundary_count, dt);
    b_.exchange_loss += 0.5 * (1 - b_.k.stress_retention) * dt * dt * square;
  }
  /// Energies of the cells.
  CellEnergy cell_energy() {
    using Pass = CellEnergies<D, Law>;
    exec::for_each_block(b_.virtuals,
                         Pass{law_, b_.k, b_.cells, b_.cell_state, b_.real, b_.virtual_, b_.virtual_count, b_.partial});
    auto const sum = exec::add_partials<Pass::results>(b_.partial, exec::block_count(b_.virtuals));
    return {sum.v[0], sum.v[1], sum.v[2]};
  }
  /// Moves virtual particles to the centres of their cells.
  CellMeasures place() {
    Range const cells = b_.virtuals;
    exec::for_each_block(cells, PlaceVirtuals<D>{b_.cells, b_.real, b_.virtual_, b_.partial});
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
  /// Sums over the blocks of these slots in `partial`.
  template <int N>
  exec::ReproducibleSums<N> sum_of_blocks(Range slots) const {
    exec::ReproducibleSums<N> sums;
    for (Index k = 0; k < exec::block_count(slots); ++k) sums.add(b_.partial + static_cast<std::ptrdiff_t>(k) * N);
    return sums;
  }
  /// Work of the step.
  double advance_velocities(Range range, Index count, BoundaryItem const* items, double dt) {
    exec::for_each_block(
        range, AdvanceVelocities<D>{b_.k, b_.around, b_.cell_state, b_.real, view(b_.mass), acceleration(),
                                    write(b_.drift), items, range.first, range.first + count, b_.partial, dt});
    return sum_of_blocks<1>(range).value();
  }
  double advance_stresses(Range range, Index count, double dt) {
    exec::for_each_block(
        range, AdvanceStresses<D, Law>{law_, b_.k, b_.around, b_.cell_state, b_.cells.corners, b_.virtual_, b_.real,
                                       write(b_.out_of_plane), write(b_.displacement), view(b_.drift),
                                       range.first + count, b_.failure, b_.partial, dt});
    return sum_of_blocks<1>(range).value();
  }
  void gather_volumes(Range range, Index count) {
    exec::for_each_block(range, GatherVolumes<D>{b_.k, b_.around, b_.cells.corners, b_.virtual_, b_.real, view(b_.mass),
                                                 range.first + count});
  }
  void add_motion(Range range, Index count, double* sums) {
    exec::for_each_block(range, SumMotion<D>{b_.real, view(b_.mass), range.first + count, b_.partial});
    auto const of_range = sum_of_blocks<MotionSums::size>(range);
    for (int k = 0; k < MotionSums::size; ++k) sums[k] += of_range.value(k);
  }
  /// Energy that the filter takes.
  double damp(Range range, Index count) {
    exec::for_each_block(range, DampPatterns<D, Law>{law_, b_.k, b_.hourglass, b_.real, view(b_.mass),
                                                     view(b_.out_of_plane), range.first, count, b_.partial});
    return sum_of_blocks<1>(range).value();
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

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
