// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/boundary_passes.hpp"
#include "piola/formulations/jst_sph/forces.hpp"
#include "piola/materials/laws.hpp"
#include "piola/parallel/halo.hpp"

/// One time step of JST-SPH, line by line as Algorithm 1 of Lee et al. (2016); equation numbers at the right.
namespace piola::jst_sph::inline PIOLA_MACHINE {

template <int D, class Loader>
class Step {
 public:
  Step(BodyState& body, Loader const& loader) : b_(body), loader_(loader), forces_(body, loader) {}

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
    bool const stabilised = b_.constants.biharmonic != Biharmonic::none;
    if (stabilised)
      differentiate<true>(stage);  // F_dot, L v, P, F, A, D2       (33) (36) (12)
    else
      differentiate<false>(stage);
    halo_.refresh(b_.second);
    RigidRate const balance = forces_(0.5 * stage.dt);  // T, D4 and their projections   (29c) (37) (48)
    add_loads(stage);                                   // E                             (32)
    advance(stage, balance);                            // v, x                          (43) (47) (49)
    hold_supports(stage);                               // v_c = prescribed              step 8
  }

  template <int Laplacians>
  DifferentiateVelocity<D, Laplacians, Loader> first_sweep() const {
    return {loader_, {read_neighbours(b_.u), read_reference(b_.alpha), read_reference(b_.beta)}};
  }

  template <bool Laplacian>
  void differentiate(StageUpdate const& stage) {
    auto const sweep = first_sweep < Laplacian ? 1 : 0 > ();
    bool const to_F = stage.second || b_.constants.variables == Variables::displacement;
    with_law(b_.material, [&](auto const& law) {
      UpdateStress<D, Laplacian, std::decay_t<decltype(law)>> const update{law,
                                                                           b_.constants,
                                                                           stage,
                                                                           read_reference(b_.C),
                                                                           read_reference(b_.V),
                                                                           read(b_.wave_speed),
                                                                           read(b_.F),
                                                                           read(b_.F_star),
                                                                           write(to_F ? b_.F : b_.F_star),
                                                                           write(b_.A),
                                                                           write(b_.w),
                                                                           write(b_.rate),
                                                                           write(b_.wave_speed_next),
                                                                           b_.failure};
      exec::for_each_then(b_.slots, sweep, exec::erased(update));
    });
  }

  void advance(StageUpdate const& stage, RigidRate const& balance) {
    AdvanceMomentum<D> const pass{
        stage,      balance,     b_.constants.variables, read(b_.rate), read(b_.v), read(b_.v_n),
        read(b_.x), write(b_.v), write(b_.v_n),          write(b_.x),   write(b_.u)};
    exec::for_each(b_.slots, pass);
  }

  void add_loads(StageUpdate const& stage) {
    if (b_.loaded_count == 0) return;
    // v^n and v*: twice the mean velocity of the step, which is known in stage 2.
    if (stage.second)
      exec::for_each_item(b_.loaded_count, WorkOfLoads<D>{stage.dt, b_.loaded, read(b_.v_n), read(b_.v)});
    exec::for_each_item(b_.loaded_count, AddLoads<D>{stage.second, b_.loaded, read(b_.rate), write(b_.rate)});
  }

  void hold_supports(StageUpdate const& stage) {
    HoldSupports const pass{b_.supports, write(b_.v), write(b_.x)};
    exec::for_each_item(b_.support_count, pass);
    if (b_.held_count == 0) return;
    HoldDirections<D> const drive{stage, b_.held, read(b_.v), read(b_.v_n), read(b_.x), write(b_.v), write(b_.x)};
    exec::for_each_item(b_.held_count, drive);
    using When = MultiplierCall::When;
    if (b_.multipliers != nullptr)  // step 9
      b_.enforce(*b_.multipliers, b_, {stage.second ? When::stage_2 : When::stage_1, stage.dt});
  }

  BodyState& b_;
  Loader loader_;
  Forces<D, Loader> forces_;
  Halo halo_;
};

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
