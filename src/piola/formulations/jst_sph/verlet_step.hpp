// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/fused_allreduce.hpp"
#include "piola/domain/halo.hpp"
#include "piola/formulations/jst_sph/boundary_passes.hpp"
#include "piola/formulations/jst_sph/filter.hpp"
#include "piola/formulations/jst_sph/forces.hpp"
#include "piola/formulations/jst_sph/hourglass_passes.hpp"
#include "piola/materials/laws.hpp"

/// One time step of the schemes "conservative" and "filtered": kick, drift, forces, kick. Derivation:
/// docs/theory/jst-sph-conservative.md, docs/theory/jst-sph-filtered.md.
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
    bool const filtered = b_.constants.kappa_filtered > 0;
    if (b_.constants.biharmonic == Biharmonic::none)
      deform<false>(dt, without_rigid, filtered);  // F^(n+1), J
    else
      deform<true>(dt, without_rigid, filtered);  // F^(n+1), J, L v'
    bool const hourglass = b_.constants.hourglass.modulus > 0;
    if (b_.constants.exact_speed && !hourglass) compute_wave_speed<D>(b_);
    if (hourglass && filtered)
      halo_.refresh(b_.ahead, b_.filter_source[0]);
    else if (hourglass)
      halo_.refresh(b_.ahead);
    else if (filtered)
      halo_.refresh(b_.filter_source[0]);
    if (filtered) filter();  // q = B* kappa_f (B J - 1)
    if (hourglass)
      weight_stress_and_hourglass(dt, without_rigid);  // as below, with the hourglass stress and force
    else if (filtered)
      weight_stress();  // P(F, kappa_l (J - 1) + q), A
    halo_.refresh(b_.second);
    RigidRate const balance = forces_(dt, &b_.wave_speed).rigid;  // -T + D at n + 1
    add_loads(dt);                                                // E at n + 1
    kick(dt, balance);                                            // v^(n+1)
  }

  /// Evaluates the hourglass energy and the filtered volume ratio of the current state.
  void observe_energy() {
    with_stress_law(b_, 0, StressAt::start, [&](auto const& law) {
      using Law = std::decay_t<decltype(law)>;
      exec::for_each(b_.slots, LookAtState<D, Law>{law, b_.constants, read_reference(b_.V), read(b_.F), read(b_.x),
                                                   write(b_.ahead)});
      if (b_.seen_ratio.data != nullptr)
        exec::for_each(b_.slots, ComputeVolumeRatio<D>{Law::small_strain, read(b_.F), write(b_.volume_ratio)});
    });
    halo_.refresh(b_.ahead);
    SumHourglass<D, Loader> const sweep{loader_, {read_neighbours(b_.ahead)}};
    StoreHourglassEnergy<D> const store{b_.constants, read_reference(b_.V), read(b_.ahead), write(b_.hourglass_energy)};
    exec::for_each_then(b_.slots, sweep, exec::erased(store));
    if (b_.seen_ratio.data == nullptr) return;
    Filter<Loader> const filter(b_, loader_);
    filter.prepare();
    filter.smooth_ratio_into(b_.seen_ratio);
  }

 private:
  using At = MotionTotals<D>;

  /// The accelerations of the start, dt = 0, do not belong to a motion.
  void drive(double dt) {
    if (b_.held_count == 0 || !(dt > 0)) return;
    exec::for_each_item(b_.held_count, DriveDirections<D>{dt, b_.held, read(b_.v), read(b_.rate), write(b_.rate)});
    if (b_.multipliers != nullptr) b_.enforce(*b_.multipliers, b_, {MultiplierCall::When::first_kick, dt});
  }

  void turn_loads(bool at_end) { exec::for_each_item(b_.loaded_count, TurnLoads<D>{at_end, b_.loaded, read(b_.F)}); }

  void add_loads(double dt) {
    if (b_.loaded_count == 0) return;
    turn_loads(true);
    exec::for_each_item(b_.loaded_count, WorkOfLoads<D>{dt, b_.loaded, read(b_.v), read(b_.v)});
    exec::for_each_item(b_.loaded_count, AddLoads<D>{true, b_.loaded, read(b_.rate), write(b_.rate)});
  }

  RigidRate kick_and_drift(double dt) {
    KickAndDrift<D> const pass{dt,         b_.constants, read_reference(b_.V), read(b_.rate),
                               read(b_.v), read(b_.x),   write(b_.v),          write(b_.x)};
    auto const sums = reduce_over_ranks<At::size>(b_.halo != nullptr, b_.slots, pass, b_.partial);
    if (b_.constants.mirrored) return {};
    return balancing_rate(rate_sums<D, At>(sums, At::v, At::moment_v, b_.constants.total_volume), D);
  }

  template <bool Stabilised>
  void deform(double dt, RigidRate const& without_rigid, bool filtered) {
    DifferentiateVelocity<D, Stabilised ? 2 * D : 0, Loader> const sweep{
        loader_, {read_neighbours(b_.u), read_reference(b_.alpha), read_reference(b_.beta)}};
    CarriedGeometry const carried{read(b_.H), read(b_.J), write(b_.H), write(b_.J), write(b_.ratio_increment),
                                  b_.starting};
    with_stress_law(b_, dt, stress_at(dt), [&](auto const& law) {
      using Law = std::decay_t<decltype(law)>;
      Deform<D, Stabilised> const shape{dt,
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
                                        carried,
                                        read(b_.filter_scale),
                                        read(b_.filter_input),
                                        write(b_.filter_source[0]),
                                        write(b_.filter_input),
                                        write(b_.ratio_change),
                                        b_.failure};
      if (b_.constants.hourglass.modulus > 0) {
        DeformAndLookAhead<D, Stabilised, Law> const both{shape, look_ahead(law, dt, without_rigid)};
        return exec::for_each_then(b_.slots, sweep, exec::erased(both));
      }
      if (filtered) return exec::for_each_then(b_.slots, sweep, exec::erased(shape));
      DeformAndWeightStress<D, Stabilised, Law> const both{shape, stress_pass(law)};
      exec::for_each_then(b_.slots, sweep, exec::erased(both));
    });
  }

  /// The accelerations of the start, dt = 0, belong to the current state.
  static StressAt stress_at(double dt) { return dt > 0 ? StressAt::end : StressAt::start; }

  template <class Law>
  LookAhead<D, Law> look_ahead(Law const& law, double dt, RigidRate const& without_rigid) {
    return {law,
            dt,
            b_.constants,
            without_rigid,
            read_reference(b_.C),
            read_reference(b_.V),
            read(b_.F),
            read(b_.x),
            read(b_.v),
            read(b_.hourglass_force),
            read(b_.hourglass_stress),
            read(b_.filtered_pressure),
            read(b_.ratio_change),
            write(b_.ahead),
            write(b_.viscous_work)};
  }

  void weight_stress_and_hourglass(double dt, RigidRate const& without_rigid) {
    SumHourglass<D, Loader> const sweep{loader_, {read_neighbours(b_.ahead)}};
    with_stress_law(b_, dt, stress_at(dt), [&](auto const& law) {
      WeightStressAndHourglass<D, std::decay_t<decltype(law)>> const weigh{stress_pass(law),
                                                                           dt,
                                                                           without_rigid,
                                                                           read(b_.v),
                                                                           read(b_.ahead),
                                                                           read(b_.ratio_change),
                                                                           read(b_.viscous_work),
                                                                           write(b_.hourglass_force),
                                                                           write(b_.hourglass_stress),
                                                                           write(b_.viscous_work)};
      exec::for_each_then(b_.slots, sweep, exec::erased(weigh));
    });
    if (b_.constants.exact_speed) compute_wave_speed<D>(b_);
  }

  template <class Law>
  WeightStress<D, Law> stress_pass(Law const& law) {
    return {law,
            b_.constants,
            read_reference(b_.C),
            read_reference(b_.V),
            read(b_.F),
            read(b_.volume_ratio),
            read(b_.filtered_pressure),
            read(b_.H),
            read(b_.J),
            write(b_.A)};
  }
  void weight_stress() {
    with_law(b_.material, [&](auto const& law) { exec::for_each(b_.slots, stress_pass(law)); });
  }

  void filter() {
    Filter<Loader> const filter(b_, loader_);
    if (b_.constants.variables == Variables::pF)
      filter.smooth_ratio();
    else
      filter.add_increment();
  }

  void kick(double dt, RigidRate const& balance) {
    exec::for_each(b_.slots, Kick<D>{dt, balance, read(b_.rate), read(b_.v), read(b_.x), write(b_.rate), write(b_.v)});
    exec::for_each_item(b_.support_count, HoldVelocity{dt, b_.trial, b_.supports, read(b_.v), read(b_.rate),
                                                       write(b_.v), write(b_.rate)});
    if (b_.held_count == 0 || !(dt > 0)) return;
    exec::for_each_item(b_.held_count, ArriveAlongDirections<D>{dt, b_.held, read(b_.v), read(b_.rate), write(b_.v)});
    if (b_.multipliers != nullptr && dt > 0) b_.enforce(*b_.multipliers, b_, {MultiplierCall::When::second_kick, dt});
  }

  BodyState& b_;
  Loader loader_;
  Forces<D, Loader> forces_;
  Halo halo_;
};

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
