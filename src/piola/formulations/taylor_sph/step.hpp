// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/first_failure.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/taylor_sph/adjoint_passes.hpp"
#include "piola/formulations/taylor_sph/boundary_passes.hpp"
#include "piola/formulations/taylor_sph/cell_passes.hpp"
#include "piola/formulations/taylor_sph/filter_passes.hpp"
#include "piola/formulations/taylor_sph/momentum_passes.hpp"
#include <vector>

namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// The parts of a step of one body, in their order; solver.cpp calls them. On several ranks each rank computes its
/// range of slots; then the results are replicated, so that code outside loops over particles is the same everywhere.
template <int D, class Kernel, class Law>
class Step {
 public:
  Step(BodyState& body, Law const& law) : b_(body), law_(law) {}

  /// Eqs. (21): v and sigma of the virtual particles at t^(n+1/2) from the real ones at t^n.
  void half(double dt) {
    exec::for_each(even_local_range(b_.virtuals), HalfStep<D, Kernel, Law>{law_, b_.k, b_.to_virtual, b_.cells, b_.real,
                                                                           b_.virtual_, acceleration(), dt});
    allgather_slots(b_.virtual_, Record<D>::stride, b_.virtuals);
  }
  /// Eqs. (22), (23): v, sigma, x of the real particles at t^(n+1) from the virtual ones at t^(n+1/2).
  void full(double dt) {
    exec::for_each(
        even_local_range(b_.interior),
        FullStep<D, Kernel, Law>{law_, b_.k, b_.to_real, b_.virtual_, b_.real, write(b_.out_of_plane), write(b_.drift),
                                 write(b_.displacement), acceleration(), b_.interior_count, b_.failure, dt});
    exec::for_each(even_local_range(b_.boundary),
                   BoundaryStep<D, Kernel, Law>{law_, b_.k, b_.to_real, b_.virtual_, b_.real, write(b_.out_of_plane),
                                                write(b_.drift), write(b_.displacement), acceleration(), b_.items,
                                                b_.boundary.first, b_.boundary_count, b_.failure, dt});
    AtEnd end(*b_.failure);
    complete_and_add(end, records(), of_particles(b_.drift, D), stresses_and_places());
    end.first.put(*b_.failure);
  }
  /// Prescribed values at t^(n+1).
  void impose() { exec::for_each_item(b_.boundary_count, Impose<D>{b_.real, b_.items, b_.boundary.first}); }
  /// The hourglass filter, if the lattice has patterns to filter.
  void filter() {
    if constexpr (D > 1) {
      Range const boxes{0, b_.hourglass.boxes};
      exec::for_each(even_local_range(boxes), MeasurePatterns<D>{b_.hourglass, b_.real});
      allgather_slots(b_.hourglass.pattern, Patterns<D>::count * Record<D>::fields, boxes);
      Sums<2> losses;
      damp(b_.interior, b_.interior_count, losses.of[0]);
      damp(b_.boundary, b_.boundary_count, losses.of[1]);
      complete_and_add(losses, records());
      for (auto const& loss : losses.of) b_.filter_loss += loss.value();
    }
  }
  /// Mass, momentum and inertia of the body.
  void motion(double* sums) {
    Sums<2, exec::ReproducibleSums<MotionSums::size>> parts;
    sum_motion(b_.interior, b_.interior_count, parts.of[0]);
    sum_motion(b_.boundary, b_.boundary_count, parts.of[1]);
    comm::allreduce_sum(parts);
    for (auto const& part : parts.of)
      for (int k = 0; k < MotionSums::size; ++k) sums[k] += part.value(k);
  }
  void add_rigid(double const* r) {
    AddRigidMotion<D> const pass{b_.real, {r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
    for (Range const range : {b_.interior, b_.boundary}) exec::for_each(range, pass);
  }
  /// A whole step by the adjoint exchange.
  void adjoint(double dt) {
    Range const cells = even_local_range(b_.virtuals);
    exec::for_each(cells, CornerForces<D, Law>{law_, b_.k, b_.cells, b_.cell_state, b_.real, b_.virtual_, dt});
    allgather_slots(b_.cell_state.force, std::ptrdiff_t{D} * b_.cells.corners, b_.virtuals);
    Sums<2> work;
    advance_velocities(b_.interior, b_.interior_count, nullptr, dt, work.of[0]);
    advance_velocities(b_.boundary, b_.boundary_count, b_.items, dt, work.of[1]);
    complete_and_add(work, records(), of_particles(b_.drift, D));
    b_.work = 0;
    for (auto const& part : work.of) b_.work += part.value();
    exec::for_each_block(cells, StrainCells<D, Law>{law_, b_.k, b_.cells, b_.cell_state, b_.real, view(b_.drift),
                                                    b_.virtual_, b_.virtual_count, b_.partial, dt});
    Sums<1> of_cells;
    add_blocks(cells, of_cells.of[0]);
    complete_and_add(of_cells, changed_cells());
    AtEnd end(*b_.failure);
    advance_stresses(b_.interior, b_.interior_count, dt, end.squares[0]);
    advance_stresses(b_.boundary, b_.boundary_count, dt, end.squares[1]);
    end.first = FirstFailure(*b_.failure);
    complete_and_add(end, records(), stresses_and_places());
    end.first.put(*b_.failure);
    double square = of_cells.of[0].value();
    for (auto const& part : end.squares) square -= part.value();
    b_.exchange_loss += 0.5 * (1 - b_.k.stress_retention) * dt * dt * square;
  }
  /// Energies of the cells of all ranks; not collective.
  CellEnergy cell_energy() {
    using Pass = CellEnergies<D, Law>;
    exec::for_each_block(b_.virtuals,
                         Pass{law_, b_.k, b_.cells, b_.cell_state, b_.real, b_.virtual_, b_.virtual_count, b_.partial});
    auto const sum = exec::add_partials<Pass::results>(b_.partial, exec::block_count(b_.virtuals));
    return {sum.v[0], sum.v[1], sum.v[2]};
  }
  /// Moves virtual particles to the centres of their cells.
  CellMeasures place() {
    Range const cells = even_local_range(b_.virtuals);
    exec::for_each_block(cells, PlaceVirtuals<D>{b_.cells, b_.real, b_.virtual_, b_.partial});
    CellMeasures m{0, 1e300, 1e300, 0};
    for (Index k = 0; k < exec::block_count(cells); ++k) {
      double const* const part = b_.partial + PlaceVirtuals<D>::results * k;
      m.strain = maximum(m.strain, part[0]);
      m.quality = minimum(m.quality, part[1]);
      m.spacing = minimum(m.spacing, part[2]);
      if (!(part[3] > 0)) m.inverted = true;
    }
    complete_and_add(m, Arrays{{b_.virtual_, Record<D>::stride, b_.virtuals}});
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
  using Arrays = std::vector<SlotArray>;
  using Sum = exec::ReproducibleSums<1>;
  /// Sums of the loops over several ranges.
  template <int N, class S = Sum>
  struct Sums {
    S of[N];
    void add(Sums const& other) {
      for (int k = 0; k < N; ++k) of[k].add(other.of[k]);
    }
  };
  /// Sums of a step and arrays that it changes.
  struct AtEnd {
    explicit AtEnd(FailureSlot const& failure) : first(failure) {}
    Sum squares[2];
    FirstFailure first;
    void add(AtEnd const& other) {
      for (int k = 0; k < 2; ++k) squares[k].add(other.squares[k]);
      first.add(other.first);
    }
  };
  /// Replicates all of these arrays and reduces the sums over ranks, in one message.
  template <class T, class... More>
  static void complete_and_add(T& sums, Arrays arrays, More const&... more) {
    (arrays.insert(arrays.end(), more.begin(), more.end()), ...);
    allgather_slots_and_sum(std::span<SlotArray const>(arrays), sums);
  }
  /// Arrays of real particles and of cells that steps change.
  Arrays records() const {
    return {{b_.real, Record<D>::stride, b_.interior}, {b_.real, Record<D>::stride, b_.boundary}};
  }
  Arrays of_particles(FieldRef const& field, int components) const {
    Arrays arrays;
    for (int c = 0; c < components; ++c)
      for (Range const range : {b_.interior, b_.boundary})
        arrays.push_back({field.data + c * field.component_stride, 1, range});
    return arrays;
  }
  Arrays stresses_and_places() const {
    Arrays arrays = of_particles(b_.out_of_plane, D == 2 ? 1 : 0),
           places = of_particles(b_.displacement, b_.k.moving ? 0 : D);
    arrays.insert(arrays.end(), places.begin(), places.end());
    return arrays;
  }
  Arrays changed_cells() const {
    return {{b_.virtual_, Record<D>::stride, b_.virtuals},
            {b_.cell_state.across, 1, b_.virtuals},
            {b_.cell_state.gradient, std::ptrdiff_t{D} * D, b_.virtuals},
            {b_.cell_state.hourglass, std::ptrdiff_t{D} * b_.cell_state.patterns, b_.virtuals}};
  }
  /// Sum over the blocks of these slots in `partial`.
  template <int N>
  void add_blocks(Range own, exec::ReproducibleSums<N>& sums) const {
    for (Index k = 0; k < exec::block_count(own); ++k) sums.add(b_.partial + static_cast<std::ptrdiff_t>(k) * N);
  }
  void advance_velocities(Range range, Index count, BoundaryItem const* items, double dt, Sum& work) {
    Range const own = even_local_range(range);
    exec::for_each_block(
        own, AdvanceVelocities<D>{b_.k, b_.around, b_.cell_state, b_.real, view(b_.mass), acceleration(),
                                  write(b_.drift), items, range.first, range.first + count, b_.partial, dt});
    add_blocks(own, work);
  }
  void advance_stresses(Range range, Index count, double dt, Sum& square) {
    Range const own = even_local_range(range);
    exec::for_each_block(
        own, AdvanceStresses<D, Law>{law_, b_.k, b_.around, b_.cell_state, b_.cells.corners, b_.virtual_, b_.real,
                                     write(b_.out_of_plane), write(b_.displacement), view(b_.drift),
                                     range.first + count, b_.failure, b_.partial, dt});
    add_blocks(own, square);
  }
  void gather_volumes(Range range, Index count) {
    exec::for_each_block(range, GatherVolumes<D>{b_.k, b_.around, b_.cells.corners, b_.virtual_, b_.real, view(b_.mass),
                                                 range.first + count});
  }
  void sum_motion(Range range, Index count, exec::ReproducibleSums<MotionSums::size>& sums) {
    Range const own = even_local_range(range);
    exec::for_each_block(own, SumMotion<D>{b_.real, view(b_.mass), range.first + count, b_.partial});
    add_blocks(own, sums);
  }
  void damp(Range range, Index count, Sum& loss) {
    Range const own = even_local_range(range);
    exec::for_each_block(own, DampPatterns<D, Law>{law_, b_.k, b_.hourglass, b_.real, view(b_.mass),
                                                   view(b_.out_of_plane), range.first, count, b_.partial});
    add_blocks(own, loss);
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
