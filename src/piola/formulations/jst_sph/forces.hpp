// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/fused_allreduce.hpp"
#include "piola/formulations/jst_sph/passes.hpp"

namespace piola::jst_sph::inline PIOLA_BACKEND {

/// Sums of a body for mechanics/rigid_rate.hpp: arms x, and a rate with its moments.
template <int D, class At, int N>
RateSums rate_sums(exec::Totals<N> const& sums, int rate, int moment, double total_volume) {
  static constexpr int to3[3][6] = {{0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
  RateSums r;
  r.volume = total_volume;
  for (int c = 0; c < D; ++c) {
    r.x[c] = sums.v[At::x + c];
    r.f[c] = sums.v[rate + c];
  }
  for (int c = 0; c < SymMat<D>::size; ++c) r.xx[to3[D - 1][c]] = sums.v[At::xx + c];
  for (int c = 0; c < spins<D>; ++c) r.moment[D == 3 ? c : 2] = sums.v[moment + c];
  return r;
}

/// Correction that balances the rates of a stage.
struct StageBalance {
  RigidRate rigid;    ///< removes resultant and moment of T and D(p), eqs. (47)-(49)
  double J_rate = 0;  ///< mean of D(J), eq. (51) [1/s]
};

/// The largest wave speed of the body, or of its local part [m/s].
inline double largest_wave_speed_of(BodyState const& b, FieldRef const& wave_speed) {
  exec::for_each_block(b.slots, LargestWaveSpeed{read(wave_speed), b.partial});
  double largest = 0;
  for (Index k = 0; k < exec::block_count(b.slots); ++k) largest = maximum(largest, b.partial[k]);
  return largest;
}

/// The second sweep of a stage: -T + D of every particle, and the rigid rate that removes their resultant and moment.
template <int D, class Loader>
class Forces {
 public:
  Forces(BodyState& body, Loader const& loader) : b_(body), loader_(loader) {}

  /// `time`: duration of these forces for the energy balance [s]. In the last stage of a step the largest value of the
  /// field `ended`, the wave speed, and the first failure are reduced (collective).
  StageBalance operator()(double time, FieldRef const* ended) {
    FusedReductions beside;
    if (ended != nullptr && !b_.trial) {
      b_.largest_wave_speed = largest_wave_speed_of(b_, *ended);
      beside = {&b_.largest_wave_speed, b_.failure};
    }
    switch (b_.constants.biharmonic) {
      case Biharmonic::adjoint: return sweep<Biharmonic::adjoint, D>(time, beside);
      case Biharmonic::literal:
        return smooths_volume(b_.constants) ? sweep<Biharmonic::literal, D + 1>(time, beside)
                                            : sweep<Biharmonic::literal, D>(time, beside);
      default: return sweep<Biharmonic::none, D>(time, beside);
    }
  }

 private:
  template <Biharmonic B, int Smoothed>
  StageBalance sweep(double time, FusedReductions const& beside) {
    SumForces<D, B, Smoothed, Loader> const pass{
        loader_,
        {read_neighbours(b_.second), read_reference(b_.alpha), read_reference(b_.beta)},
        b_.constants,
        read(b_.A),
        read(b_.w),
        read_reference(b_.V),
        read_reference(b_.weight),
        read_reference(b_.G),
        read_reference(b_.diagonal),
        read(b_.wave_speed),
        read(b_.x),
        read(b_.v),
        write(b_.rate),
        read(b_.rate),
        write(b_.J_rate),
        read(b_.J_rate)};
    // A trial step without projection does not need the sums.
    bool const asked = !b_.trial || b_.constants.project || smooths_volume(b_.constants);
    return project(reduce_over_ranks<At::size>(b_.halo != nullptr && asked, b_.slots, pass, b_.partial, beside), time);
  }

  /// Projections of T and D (47)-(49) and their powers.
  StageBalance project(exec::Totals<ForceTotals<D>::size> const& sums, double time) {
    auto const of = [&](int rate, int moment) {
      return rate_sums<D, At>(sums, rate, moment, b_.constants.total_volume);
    };
    RigidRate on_T, on_D;
    if (b_.constants.project) {
      on_T = balancing_rate(of(At::T, At::moment_T), D);
      on_D = balancing_rate(of(At::stabilisation, At::moment_stabilisation), D);
    }
    RateSums const v = of(At::v, At::moment_v);
    double const weight = time * b_.constants.rho0;
    b_.totals.projection_loss -= weight * power_of(on_T, v);
    b_.totals.stabilisation_loss -= weight * (sums.v[At::power_stabilisation] + power_of(on_D, v));
    RigidRate both = on_T;
    for (int c = 0; c < 3; ++c) {
      both.spin[c] += on_D.spin[c];
      both.push[c] += on_D.push[c];
      both.centre[c] += b_.constants.centre[c];
    }
    return {both, sums.v[At::J_rate] / b_.constants.total_volume};
  }

  using At = ForceTotals<D>;
  BodyState& b_;
  Loader loader_;
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
