// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/passes.hpp"
#include "piola/materials/laws.hpp"
#include "piola/parallel/halo.hpp"

/// One time step of JST-SPH, line by line as Algorithm 1 of Lee et al. (2016); equation numbers at the right.
namespace piola::jst_sph::inline PIOLA_MACHINE {

template <int D, class Loader>
class Step {
 public:
  Step(BodyState& body, Loader const& loader) : b_(body), loader_(loader) {}

  /// From t^n to t^(n+1) = t^n + dt by TVD Runge-Kutta of second order.
  void operator()(double dt) {
    stage({dt, false});                                                      // U* = U^n + dt U_dot(U^n)           (43)
    stage({dt, true});                                                       // U^(n+1) = (U^n + U* + dt U_dot*)/2 (43)
    FieldRef const next = b_.wave_speed_next;                                // c_p of the next step          step 2
    b_.wave_speed_next = b_.wave_speed;
    b_.wave_speed = next;
  }

  /// F from x, for displacement variables.
  void update_deformation() {
    halo_.refresh(b_.u);
    StoreDeformation<D> const store_F{read_reference(b_.C), write(b_.F)};
    exec::for_each_then(b_.slots, first_sweep<false>(), exec::erased(store_F));    // F = GRAD x                         (34)
  }

 private:
  void stage(StageUpdate const& stage) {
    halo_.refresh(b_.u);
    bool const stabilised = b_.constants.biharmonic != Biharmonic::none;
    if (stabilised)
      differentiate<true>(stage);                                            // F_dot, L v, P, F, A, D2       (33) (36) (12)
    else
      differentiate<false>(stage);
    halo_.refresh(b_.second);
    RigidRate const balance = sum_forces(stage);                             // T, D4 and their projections   (29c) (37) (48)
    advance(stage, balance);                                                 // v, x                          (43) (47) (49)
    hold_supports();                                                         // v_c = 0                       step 8
  }

  template <bool Laplacian>
  DifferentiateVelocity<D, Laplacian, Loader> first_sweep() const {
    return {loader_, {read_neighbours(b_.u), read_reference(b_.alpha), read_reference(b_.beta)}};
  }

  template <bool Laplacian>
  void differentiate(StageUpdate const& stage) {
    auto const sweep = first_sweep<Laplacian>();
    bool const to_F = stage.second || b_.constants.variables == Variables::displacement;
    with_law(b_.material, [&](auto const& law) {
      UpdateStress<D, Laplacian, std::decay_t<decltype(law)>> const update{
          law,           b_.constants,   stage,        read_reference(b_.C), read_reference(b_.V),
          read(b_.wave_speed), read(b_.F), read(b_.F_star), write(to_F ? b_.F : b_.F_star), write(b_.A),
          write(b_.w),   write(b_.rate), write(b_.wave_speed_next), b_.failure};
      exec::for_each_then(b_.slots, sweep, exec::erased(update));
    });
  }

  /// -T + D, and the rigid rate that removes their resultant and moment.
  RigidRate sum_forces(StageUpdate const& stage) {
    switch (b_.constants.biharmonic) {
      case Biharmonic::adjoint: return balance<Biharmonic::adjoint>(stage);
      case Biharmonic::literal: return balance<Biharmonic::literal>(stage);
      default: return balance<Biharmonic::none>(stage);
    }
  }

  template <Biharmonic B>
  RigidRate balance(StageUpdate const& stage) {
    SumForces<D, B, Loader> const pass{loader_,
                                       {read_neighbours(b_.second), read_reference(b_.alpha), read_reference(b_.beta)},
                                       b_.constants,
                                       read(b_.A),
                                       read(b_.w),
                                       read_reference(b_.V),
                                       read_reference(b_.G),
                                       read_reference(b_.diagonal),
                                       read(b_.wave_speed),
                                       read(b_.x),
                                       read(b_.v),
                                       write(b_.rate),
                                       read(b_.rate)};
    return project(exec::reduce<ForceTotals<D>::size>(b_.slots, pass, b_.partial), stage);
  }

  RigidRate project(exec::Totals<ForceTotals<D>::size> const& sums, StageUpdate const& stage) {
    using At = ForceTotals<D>;
    RateSums const T = rate_sums(sums, At::T, At::moment_T),
                   stabilisation = rate_sums(sums, At::stabilisation, At::moment_stabilisation),
                   v = rate_sums(sums, At::v, At::moment_v);
    RigidRate on_T, on_D;
    if (b_.constants.project) {
      on_T = balancing_rate(T, D);
      on_D = balancing_rate(stabilisation, D);
    }
    double const weight = 0.5 * stage.dt * b_.constants.rho0;                // both stages count half        (43)
    b_.totals.projection_loss -= weight * power_of(on_T, v);
    b_.totals.stabilisation_loss -= weight * (sums.v[At::power_stabilisation] + power_of(on_D, v));
    RigidRate both = on_T;
    for (int c = 0; c < 3; ++c) {
      both.spin[c] += on_D.spin[c];
      both.push[c] += on_D.push[c];
      both.centre[c] += b_.constants.centre[c];
    }
    return both;
  }

  static constexpr int component(int c) { return D == 3 ? c : 2; }

  RateSums rate_sums(exec::Totals<ForceTotals<D>::size> const& sums, int f, int moment) const {
    using At = ForceTotals<D>;
    static constexpr int to3[3][6] = {{0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
    RateSums r;
    r.volume = b_.constants.total_volume;
    for (int c = 0; c < D; ++c) {
      r.x[c] = sums.v[At::x + c];
      r.f[c] = sums.v[f + c];
    }
    for (int c = 0; c < SymMat<D>::size; ++c) r.xx[to3[D - 1][c]] = sums.v[At::xx + c];
    for (int c = 0; c < spins<D>; ++c) r.moment[component(c)] = sums.v[moment + c];
    return r;
  }

  void advance(StageUpdate const& stage, RigidRate const& balance) {
    AdvanceMomentum<D> const pass{stage,         balance,        b_.constants.variables, read(b_.rate),
                                  read(b_.v),    read(b_.v_n),   read(b_.x),             write(b_.v),
                                  write(b_.v_n), write(b_.x),    write(b_.u)};
    exec::for_each(b_.slots, pass);
  }

  void hold_supports() {
    HoldSupports const pass{b_.supports, write(b_.v), write(b_.x)};
    exec::for_each_item(b_.support_count, pass);
  }

  BodyState& b_;
  Loader loader_;
  Halo halo_;
};

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
