// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/fused_allreduce.hpp"
#include "piola/domain/halo.hpp"
#include "piola/formulations/jst_sph/boundary_passes.hpp"
#include "piola/formulations/jst_sph/filter.hpp"
#include "piola/formulations/jst_sph/forces.hpp"
#include "piola/formulations/jst_sph/verlet_passes.hpp"
#include "piola/materials/laws.hpp"

/// One time step of the scheme "filtered": kick, drift, forces, kick. Derivation: docs/theory/jst-sph-filtered.md.
namespace piola::jst_sph::inline PIOLA_BACKEND {

template <int D, class Loader>
class VerletStep {
 public:
  VerletStep(BodyState& body, Loader const& loader)
      : b_(body), loader_(loader), forces_(body, loader), halo_{body.halo} {}

  /// From t^n to t^(n+1) = t^n + dt. With dt = 0 only the accelerations a^n are computed.
  void operator()(double dt) {
    turn_loads(false);                                   // E at n
    drive(dt);                                           // v^(n+1/2) in prescribed directions
    RigidRate const without_rigid = kick_and_drift(dt);  // v^(n+1/2), x^(n+1)
    halo_.refresh(b_.u);
    deform(dt, without_rigid);  // F^(n+1), J, L v'
    if (b_.constants.exact_speed) compute_wave_speed<D>(b_);
    if (b_.constants.kappa_filtered > 0) {
      halo_.refresh(b_.filter_source[0]);
      Filter<Loader>(b_, loader_)();  // q = B* kappa_f (B J - 1)
      weight_stress();                // P(F, kappa_l (J - 1) + q), A
    }
    halo_.refresh(b_.second);
    RigidRate const balance = forces_(dt, &b_.wave_speed).rigid;  // -T + D at n + 1
    add_loads(dt);                                                // E at n + 1
    kick(dt, balance);                                            // v^(n+1)
  }

 private:
  using At = MotionTotals<D>;

  /// The accelerations of the start, dt = 0, do not belong to a motion.
  void drive(double dt) {
    if (b_.boundary.held_count == 0 || !(dt > 0)) return;
    exec::for_each_item(b_.boundary.held_count,
                        DriveDirections<D>{dt, b_.boundary.held, read(b_.v), read(b_.rate), write(b_.rate)});
    if (b_.boundary.multipliers != nullptr)
      b_.boundary.enforce(*b_.boundary.multipliers, b_, {MultiplierCall::When::first_kick, dt});
  }

  void turn_loads(bool at_end) {
    exec::for_each_item(b_.boundary.loaded_count, TurnLoads<D>{at_end, b_.boundary.loaded, read(b_.F)});
  }

  void add_loads(double dt) {
    if (b_.boundary.loaded_count == 0) return;
    turn_loads(true);
    exec::for_each_item(b_.boundary.loaded_count, WorkOfLoads<D>{dt, b_.boundary.loaded, read(b_.v), read(b_.v)});
    exec::for_each_item(b_.boundary.loaded_count, AddLoads<D>{true, b_.boundary.loaded, read(b_.rate), write(b_.rate)});
  }

  RigidRate kick_and_drift(double dt) {
    KickAndDrift<D> const pass{dt,         b_.constants, read_reference(b_.V), read(b_.rate),
                               read(b_.v), read(b_.x),   write(b_.v),          write(b_.x)};
    auto const sums = reduce_over_ranks<At::size>(b_.halo != nullptr, b_.slots, pass, b_.partial);
    if (b_.constants.mirrored) return {};
    return balancing_rate(rate_sums<D, At>(sums, At::v, At::moment_v, b_.constants.total_volume), D);
  }

  void deform(double dt, RigidRate const& without_rigid) {
    DifferentiateVelocity<D, 2 * D, Loader> const sweep{
        loader_, {read_neighbours(b_.u), read_reference(b_.alpha), read_reference(b_.beta)}};
    with_law(b_.material, [&](auto const& law) {
      using Law = std::decay_t<decltype(law)>;
      Deform<D> const shape{dt,
                            b_.constants,
                            Law::small_strain,
                            without_rigid,
                            read_reference(b_.C),
                            read_reference(b_.V),
                            read(b_.F),
                            read(b_.wave_speed),
                            write(b_.F),
                            write(b_.wave_speed),
                            write(b_.volume_ratio),
                            write(b_.w),
                            write(b_.rate),
                            read(b_.filter_scale),
                            write(b_.filter_source[0]),
                            b_.failure};
      if (b_.constants.kappa_filtered > 0) return exec::for_each_then(b_.slots, sweep, exec::erased(shape));
      DeformAndWeightStress<D, Law> const both{shape, stress_pass(law)};
      exec::for_each_then(b_.slots, sweep, exec::erased(both));
    });
  }

  template <class Law>
  WeightStress<D, Law> stress_pass(Law const& law) {
    return {law,        b_.constants,          read_reference(b_.C),       read_reference(b_.V),
            read(b_.F), read(b_.volume_ratio), read(b_.filtered_pressure), write(b_.A)};
  }
  void weight_stress() {
    with_law(b_.material, [&](auto const& law) { exec::for_each(b_.slots, stress_pass(law)); });
  }

  void kick(double dt, RigidRate const& balance) {
    exec::for_each(b_.slots, Kick<D>{dt, balance, read(b_.rate), read(b_.v), read(b_.x), write(b_.rate), write(b_.v)});
    exec::for_each_item(b_.boundary.support_count, HoldVelocity{dt, b_.trial, b_.boundary.supports, read(b_.v),
                                                                read(b_.rate), write(b_.v), write(b_.rate)});
    if (b_.boundary.held_count == 0 || !(dt > 0)) return;
    exec::for_each_item(b_.boundary.held_count,
                        ArriveAlongDirections<D>{dt, b_.boundary.held, read(b_.v), read(b_.rate), write(b_.v)});
    if (b_.boundary.multipliers != nullptr && dt > 0)
      b_.boundary.enforce(*b_.boundary.multipliers, b_, {MultiplierCall::When::second_kick, dt});
  }

  BodyState& b_;
  Loader loader_;
  Forces<D, Loader> forces_;
  Halo halo_;
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
