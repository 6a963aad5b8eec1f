// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo.hpp"
#include "piola/formulations/nodal/block_law_cells.hpp"
#include "piola/formulations/nodal/boundary_passes.hpp"
#include "piola/formulations/nodal/mirror_passes.hpp"
#include "piola/formulations/nodal/mixed_material_lanes.hpp"
#include "piola/formulations/nodal/pressure_passes.hpp"
#include "piola/formulations/nodal/stress_points.hpp"

/// One step of the nodal formulation: kick, drift, forces, kick. Theory: docs/theory/nodal.md.
namespace piola::nodal::inline PIOLA_BACKEND {

template <int D>
class Step {
 public:
  explicit Step(BodyState& body) : b_(body), halo_{body.halo} {}

  /// From t^n to t^(n+1) = t^n + dt. With dt = 0 only the accelerations are computed.
  void operator()(double dt) {
    absorb(dt, false);
    if (b_.boundary.follows) turn_loads(false);
    if (dt > 0) drive(dt);  // v^(n+1/2) in prescribed directions
    bool const implicit = b_.implicit_pressure != nullptr && dt > 0;
    if (implicit) {
      exec::for_each(b_.slots, Kick<D>{dt, read(b_.a), read(b_.v), write(b_.v)});
      b_.move_by_pressure(*b_.implicit_pressure, dt);
    } else {
      exec::for_each(b_.slots, KickAndDrift<D>{dt, read(b_.a), read(b_.v), read(b_.x), write(b_.v), write(b_.x)});
    }
    accelerate(dt);
    if (b_.boundary.follows) turn_loads(true);
    View const mean = read(implicit ? b_.mean_v : b_.v);
    exec::for_each_item(b_.boundary.loaded_count, WorkOfLoads<D>{dt, b_.boundary.loaded, mean, mean});
    exec::for_each_item(b_.boundary.loaded_count, AddLoads<D>{true, b_.boundary.loaded, read(b_.a), write(b_.a)});
    exec::for_each_item(b_.boundary.mirrored_count, StayOnPlanes<D>{b_.boundary.mirrored, write(b_.a)});
    exec::for_each(b_.slots, Kick<D>{dt, read(b_.a), read(b_.v), write(b_.v)});
    if (dt > 0) arrive(dt);
    absorb(dt, true);
  }

  /// Computes a of the internal forces at x: -dPi/dx over the masses, and of viscous forces if `dt` [s], the time since
  /// the last step, is given.
  void accelerate(double dt = -1) {
    sweep<false>(dt);
    exec::for_each_item(b_.boundary.mirrored_count, KeepEven<D>{b_.boundary.mirrored, write(b_.stress_for_neighbours)});
    sum_forces();
    exec::for_each_item(b_.boundary.mirrored_count, StayOnPlanes<D>{b_.boundary.mirrored, write(b_.a)});
  }

  void subtract_gradients(FieldRef const& centroid) {
    halo_.refresh(b_.x);
    SubtractGradients<D> const pass{read(centroid), read(b_.offset), write(b_.offset)};
    fused(b_.slots, exec::erased(pass));
  }

  /// See Backend.
  void linearise_pressure() {
    halo_.refresh(b_.x);
    with_law(b_.materials[0].material, [&](auto const& law) {
      LinearisePressure<D, std::decay_t<decltype(law)>::small_strain> const pass{resultants(), read(b_.offset),
                                                                                 write(b_.unit), write(b_.ratio)};
      fused(b_.slots, exec::erased(pass));
    });
  }
  void change_of_ratio() {
    halo_.refresh(b_.x);
    ChangeOfRatio<D> const pass{read(b_.unit), write(b_.ratio)};
    fused(b_.slots, exec::erased(pass));
  }
  void accelerate_by_pressure() {
    exec::for_each(b_.slots, StressOfPressure<D>{resultants(), read(b_.unit), read(b_.ratio)});
    sum_forces();
  }

  /// Computes the fields that steps leave as they are, for output and energies: F, P and cell at x.
  void update_output_fields() { sweep<true>(-1); }

  void keep() const {
    exec::for_each(b_.slots, CopyMotion<D>{read(b_.x), read(b_.v), read(b_.a), write(b_.kept), write(b_.kept),
                                           write(b_.kept), 0, D});
    exec::for_each(b_.slots, CopyLeast{read(b_.change), write(b_.kept), 1, 3 * D});
    copy_histories(b_.viscous, b_.viscous_kept, b_.history, b_.history_kept);
  }
  void restore() const {
    exec::for_each(b_.slots, CopyMotion<D>{read(b_.kept), read(b_.kept), read(b_.kept), write(b_.x), write(b_.v),
                                           write(b_.a), D, 0});
    exec::for_each(b_.slots, CopyLeast{read(b_.kept), write(b_.change), 3 * D, 1});
    copy_histories(b_.viscous_kept, b_.viscous, b_.history_kept, b_.history);
  }

 private:
  bool on_lattice() const { return b_.lattice.group != nullptr; }
  ListSums<D> of_motion() const { return {b_.list, read_neighbours(b_.motion_for_neighbours).data, nullptr}; }
  ListSums<D> of_stress() const {
    return {b_.list, read_neighbours(b_.motion_for_neighbours).data, read_neighbours(b_.stress_for_neighbours).data};
  }

  PIOLA_SHARED inline StressResultants<D> resultants() const {
    return {b_.particles,
            read_reference(b_.V),
            read_reference(b_.L),
            read_reference(b_.k),
            read_reference(b_.own),
            read_reference(b_.hoop),
            write(b_.stress_for_neighbours),
            write(b_.a)};
  }

  /// The first sweep, block by block, with the pass that uses its sums.
  PIOLA_SHARED inline void fused(Range slots, exec::PointPass const& then) {
    if (on_lattice())
      exec::for_each_then(
          slots, SumLatticeMotion<D>(LatticeSums<D>{b_.lattice, read_neighbours(b_.motion_for_neighbours), {}}), then);
    else
      exec::for_each_then(slots, SumMotion<D>(of_motion(), read_reference(b_.k), read_reference(b_.hoop), read(b_.x)),
                          then);
  }

  void sum_forces() {
    halo_.refresh(b_.stress_for_neighbours);
    if (on_lattice())
      exec::for_each(b_.slots, SumLatticeForces<D>{{b_.lattice, {}, read_neighbours(b_.stress_for_neighbours)},
                                                   read_reference(b_.mass),
                                                   read(b_.a),
                                                   write(b_.a)});
    else
      exec::for_each(b_.slots, SumForces<D>{of_stress(), read_reference(b_.mass), read(b_.a), write(b_.a)});
  }

  void copy_histories(FieldRef const& viscous, FieldRef const& viscous_to, FieldRef const& solid,
                      FieldRef const& solid_to) const {
    copy_history(viscous, viscous_to, ViscousHistory<D>::size);
    copy_history(solid, solid_to, b_.history_values());
  }
  void copy_history(FieldRef const& from, FieldRef const& to, int values) const {
    if (from.data != nullptr) exec::for_each(b_.slots, CopyValues{read(from), write(to), values});
  }

  void turn_loads(bool at_end) {
    halo_.refresh(b_.x);
    exec::for_each_item(b_.boundary.loaded_count,
                        TurnLoads<D>{at_end, b_.boundary.loaded, b_.boundary.loaded_centroid, b_.boundary.loaded_radius,
                                     of_motion(), read_reference(b_.k), read(b_.offset), read(b_.x)});
  }

  void absorb(double dt, bool at_end) {
    if (b_.boundary.absorbing != nullptr && dt > 0) b_.boundary.absorb(*b_.boundary.absorbing, b_, 0.5 * dt, at_end);
  }
  void drive(double dt) {
    exec::for_each_item(b_.boundary.held_count,
                        DriveDirections<D>{dt, b_.boundary.held, read(b_.v), read(b_.a), write(b_.a)});
    if (b_.boundary.surface != nullptr) b_.boundary.kick_surface(*b_.boundary.surface, b_, true, dt);
  }
  void arrive(double dt) {
    exec::for_each_item(b_.boundary.held_count,
                        ArriveAlongDirections<D>{dt, b_.boundary.held, read(b_.v), read(b_.a), write(b_.v)});
    if (b_.boundary.surface != nullptr) b_.boundary.kick_surface(*b_.boundary.surface, b_, false, dt);
  }

  template <bool Observed>
  void sweep(double dt) {
    halo_.refresh(b_.x);
    for (Index k = 0; k < b_.material_count; ++k) update_stress<Observed>(b_.materials[k], dt);
  }

  /// For the local particles of one material.
  template <bool Observed>
  void update_stress(MaterialRange const& range, double dt) {
    Range const slots = groups_of(range);
    if (slots.first >= slots.last) return;
    MixedMaterialLanes<D> const of_law_before(b_, group_of(range.first), range.first);
    Constants constants = range.constants;
    constants.least_share = b_.constants.least_share;
    if (!Observed && b_.implicit_pressure != nullptr) constants.kappa = 0;
    with_law(range.material, [&](auto const& law) { update_stress<Observed>(law, constants, slots, dt); });
    with_solid(range.material, [&](auto const& law) {
      using Cells = SolidCells<D>;
      auto const wanted = Observed    ? Cells::Wanted::as_left
                          : b_.refits ? Cells::Wanted::refitted
                          : dt < 0    ? Cells::Wanted::trial
                                      : Cells::Wanted::end;
      update_stress<Observed>(Cells(law, range, b_, maximum(dt, 0.0), wanted), constants, slots, dt);
    });
    if (range.block != nullptr) {
      using Cells = BlockLawCells<D>;
      auto const wanted = Observed ? Cells::Wanted::as_left : dt < 0 ? Cells::Wanted::trial : Cells::Wanted::end;
      update_stress<Observed>(Cells(*range.block, range, b_, maximum(dt, 0.0), wanted), constants, slots, dt);
    }
    of_law_before.put_back();
  }

  template <bool Observed, class Law>
  PIOLA_SHARED inline void update_stress(Law const& law, Constants const& constants, Range slots, double dt) {
    UpdateStress<D, Law, Observed> const update{law,
                                                constants,
                                                resultants(),
                                                read(b_.offset),
                                                read(b_.C_measured),
                                                write(b_.C_measured),
                                                b_.marks,
                                                read(b_.kept),
                                                {dt, b_.viscosity, read(b_.viscous), write(b_.viscous)},
                                                write(b_.change),
                                                write(b_.F),
                                                write(b_.P),
                                                write(b_.cell),
                                                b_.failure};
    fused(slots, exec::erased(update));
  }

  static Index group_of(Index slot) { return slot - slot % lane_count; }
  /// The local particles of one material, in whole groups of lanes.
  Range groups_of(MaterialRange const& range) const {
    if (range.first == range.last) return {};
    Index const first = group_of(range.first), last = group_of(range.last + lane_count - 1);
    return {first > b_.slots.first ? first : b_.slots.first,
            range.last < b_.particles && last < b_.slots.last ? last : b_.slots.last};
  }

  BodyState& b_;
  Halo halo_;
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
