// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/fused_allreduce.hpp"
#include "piola/domain/halo.hpp"
#include "piola/formulations/jst_sph/boundary_passes.hpp"
#include "piola/formulations/jst_sph/forces.hpp"
#include "piola/formulations/jst_sph/stress_passes.hpp"
#include "piola/materials/laws.hpp"

/// One time step of the scheme "paper" and of displacement variables, line by line as Algorithm 1 of Lee et al. (2016);
/// equation numbers at the right.
namespace piola::jst_sph::inline PIOLA_BACKEND {

template <int D, class Loader>
class Step {
 public:
  Step(BodyState& body, Loader const& loader) : b_(body), loader_(loader), forces_(body, loader), halo_{body.halo} {}

  /// From t^n to t^(n+1) = t^n + dt by TVD Runge-Kutta of second order.
  void operator()(double dt) {
    stage({dt, false});                        // U* = U^n + dt U_dot(U^n)           (43)
    stage({dt, true});                         // U^(n+1) = (U^n + U* + dt U_dot*)/2 (43)
    FieldRef const next = b_.wave_speed_next;  // c_p of the next step          step 2
    b_.wave_speed_next = b_.wave_speed;
    b_.wave_speed = next;
  }

  /// F from x, for displacement variables.
  void update_deformation() {
    halo_.refresh(b_.u);
    StoreDeformation<D> const store_F{read_reference(b_.C), write(b_.F)};
    exec::for_each_then(b_.slots, first_sweep<0>(), exec::erased(store_F));  // F = GRAD x                         (34)
  }

 private:
  void stage(StageUpdate const& stage) {
    halo_.refresh(b_.u);
    differentiate(stage);  // F_dot, H_dot, J_dot, L v, L J, P, A, D2       (33) (36) (12)
    halo_.refresh(b_.second);
    FieldRef const* const ended = stage.second ? &b_.wave_speed_next : nullptr;
    StageBalance const balance = forces_(0.5 * stage.dt, ended);  // T, D4 and their projections   (29c) (37) (48) (51)
    add_loads(stage);                                             // E                             (32)
    if (smooths_volume(b_.constants)) advance_volume(stage, balance.J_rate);  // J                     (43) (38)
    advance(stage, balance.rigid);                                            // v, x                  (43) (47) (49)
    hold_supports(stage);                                                     // v_c = prescribed      step 8
  }

  template <int Smoothed>
  DifferentiateVelocity<D, Smoothed, Loader> first_sweep() const {
    return {loader_, {read_neighbours(b_.u), read_reference(b_.alpha), read_reference(b_.beta)}};
  }

  /// The first sweep, with the pass that uses its sums.
  PIOLA_SHARED inline void sweep_then(int smoothed, exec::PointPass const& then) const {
    if (smoothed == 0)
      exec::for_each_then(b_.slots, first_sweep<0>(), then);
    else if (smoothed == D)
      exec::for_each_then(b_.slots, first_sweep<D>(), then);
    else
      exec::for_each_then(b_.slots, first_sweep<D + 1>(), then);
  }

  void differentiate(StageUpdate const& stage) {
    int const smoothed = b_.constants.biharmonic == Biharmonic::none ? 0 : smooths_volume(b_.constants) ? D + 1 : D;
    bool const to_F = stage.second || b_.constants.variables == Variables::displacement;
    FieldRef const& J_out = smooths_volume(b_.constants) ? b_.J_next : b_.J;
    EvolvedGeometry const evolved{
        read(b_.H),   read(b_.H_star), read(b_.J), read(b_.J_n), write(stage.second ? b_.H : b_.H_star),
        write(J_out), write(b_.J_n)};
    with_law(b_.material, [&](auto const& law) {
      UpdateStress<D, std::decay_t<decltype(law)>> const update{law,
                                                                smoothed,
                                                                b_.constants,
                                                                stage,
                                                                read_reference(b_.C),
                                                                read_reference(b_.V),
                                                                read(b_.wave_speed),
                                                                read(b_.F),
                                                                read(b_.F_star),
                                                                evolved,
                                                                write(to_F ? b_.F : b_.F_star),
                                                                write(b_.A),
                                                                write(b_.w),
                                                                write(b_.rate),
                                                                write(b_.J_rate),
                                                                write(b_.wave_speed_next),
                                                                b_.failure};
      sweep_then(smoothed, exec::erased(update));
    });
  }

  void advance_volume(StageUpdate const& stage, double mean) {
    exec::for_each(b_.slots, AdvanceVolume{stage.second ? 0.5 * stage.dt : stage.dt, mean, read(b_.J_next),
                                           read(b_.J_rate), write(b_.J), b_.failure});
  }

  void advance(StageUpdate const& stage, RigidRate const& balance) {
    AdvanceMomentum<D> const pass{
        stage,      balance,     b_.constants.variables, read(b_.rate), read(b_.v), read(b_.v_n),
        read(b_.x), write(b_.v), write(b_.v_n),          write(b_.x),   write(b_.u)};
    exec::for_each(b_.slots, pass);
  }

  void add_loads(StageUpdate const& stage) {
    if (b_.boundary.loaded_count == 0) return;
    exec::for_each_item(b_.boundary.loaded_count, TurnLoads<D>{stage.second, b_.boundary.loaded, read(b_.F)});
    // v^n and v*: twice the mean velocity of the step, which is known in stage 2.
    if (stage.second)
      exec::for_each_item(b_.boundary.loaded_count,
                          WorkOfLoads<D>{stage.dt, b_.boundary.loaded, read(b_.v_n), read(b_.v)});
    exec::for_each_item(b_.boundary.loaded_count,
                        AddLoads<D>{stage.second, b_.boundary.loaded, read(b_.rate), write(b_.rate)});
  }

  void hold_supports(StageUpdate const& stage) {
    HoldSupports const pass{stage.second, b_.boundary.supports, read(b_.v), write(b_.v), write(b_.x)};
    exec::for_each_item(b_.boundary.support_count, pass);
    if (b_.boundary.held_count == 0) return;
    HoldDirections<D> const drive{stage,      b_.boundary.held, read(b_.v), read(b_.v_n),
                                  read(b_.x), write(b_.v),      write(b_.x)};
    exec::for_each_item(b_.boundary.held_count, drive);
    using When = MultiplierCall::When;
    if (b_.boundary.multipliers != nullptr)  // step 9
      b_.boundary.enforce(*b_.boundary.multipliers, b_, {stage.second ? When::stage_2 : When::stage_1, stage.dt});
  }

  BodyState& b_;
  Loader loader_;
  Forces<D, Loader> forces_;
  Halo halo_;
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
