// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/cell_points.hpp"
#include "piola/formulations/nodal/state.hpp"

/// Artificial viscosity of a cell, off by default; laws have no viscous stress. Theory: docs/theory/nodal.md,
/// section 5.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Viscous pressure of shocks, where the volume ratio J falls from `before` to `now` in 1/rate [s]: coefficient
/// (dJ/dt)^2 over `divisor`, J or a bound of it [Pa].
PIOLA_FN Lanes shock_pressure_of(Lanes const& coefficient, double rate, Lanes const& before, Lanes const& now,
                                 Lanes const& divisor) {
  Lanes const closing = maximum(rate * (before - now), Lanes(0.0));
  return coefficient * closing * closing / divisor;
}

/// History of a cell. Per point: the strain E in the directions of the body and the viscous stress S at the end of the
/// last step. Per cell: the mean volume ratio, the shock pressure Q, and the dissipated energy per volume.
template <int D>
struct ViscousHistory {
  static constexpr int strain = SymMat<D>::size, points = Quadratic<D>::points;
  static constexpr int S = points * strain, ratio = 2 * points * strain, Q = ratio + 1, loss = ratio + 2,
                       size = ratio + 3;
};

/// Adds to the stresses of the points
///   F_q S_q,  S_q = eta (dE_q - mean dE) / dt,   and   -Q cof F_q,  Q = shock r^2 / Jm if r = dJm/dt < 0,
/// and their dissipation: (S + S of the step before) : dE / 2 and the same of Q, as the motion loses it in a step.
template <int D>
struct Viscosity {
  using At = ViscousHistory<D>;
  double dt;  ///< since the last step; 0: the history begins; negative: no viscous stress
  ViscousConstants constants;
  View before;
  WriteView after;

  PIOLA_FN bool on() const { return before.data != nullptr && dt >= 0; }

  template <bool SmallStrain, class Energy>
  PIOLA_FN void add(Index i, CellPoints<D> const& at, Energy& energy) const {
    Mat<D, Lanes> F[At::points];
    SymMat<D, Lanes> E[At::points], mean;
    Lanes ratio = Lanes(0.0);
    double const rate = dt > 0 ? 1 / dt : 0;
    for (int q = 0; q < At::points; ++q) {
      F[q] = at.at(q);
      E[q] = strain_of<SmallStrain>(F[q]);
      ratio = ratio + (1.0 / At::points) * volume_ratio_of(SmallStrain, at.whole_at(q));
      for (int c = 0; c < At::strain; ++c) {
        Lanes const change = (1.0 / At::points) * (E[q].c[c] - before.scalar<Lanes>(i, q * At::strain + c));
        mean.c[c] = q == 0 ? change : mean.c[c] + change;
      }
    }
    Lanes loss = before.scalar<Lanes>(i, At::loss);
    for (int q = 0; q < At::points; ++q) {
      SymMat<D, Lanes> S;
      for (int c = 0; c < At::strain; ++c) {
        int const place = q * At::strain + c;
        Lanes const change = E[q].c[c] - before.scalar<Lanes>(i, place);
        S.c[c] = (constants.fluctuation * rate) * (change - mean.c[c]);
        double const share = (c < D ? 0.5 : 1.0) * (rate > 0 ? 1.0 : 0.0) / At::points;
        loss = loss + share * (S.c[c] + before.scalar<Lanes>(i, At::S + place)) * change;
        after.scalar(i, E[q].c[c], place);
        after.scalar(i, S.c[c], At::S + place);
      }
      add_to_corner(energy.P[q], stress_of<SmallStrain>(F[q], S));
    }
    Lanes const ratio_before = before.scalar<Lanes>(i, At::ratio), change = ratio - ratio_before;
    Lanes const Q = shock_pressure_of(Lanes(constants.shock), rate, ratio_before, ratio, ratio);
    if (rate > 0) loss = loss - 0.5 * (Q + before.scalar<Lanes>(i, At::Q)) * change;
    for (int q = 0; q < At::points; ++q) energy.P[q] = energy.P[q] + (0.0 - Q) * area_map<SmallStrain>(at.whole_at(q));
    after.scalar(i, ratio, At::ratio);
    after.scalar(i, Q, At::Q);
    after.scalar(i, loss, At::loss);
  }

 private:
  template <bool SmallStrain>
  PIOLA_FN static SymMat<D, Lanes> strain_of(Mat<D, Lanes> const& F) {
    SymMat<D, Lanes> E;
    for (int J = 0; J < D; ++J)
      for (int K = J; K < D; ++K) {
        if constexpr (SmallStrain) {
          E(J, K) = 0.5 * (F(J, K) + F(K, J));
        } else {
          Lanes sum = F(0, J) * F(0, K);
          for (int c = 1; c < D; ++c) sum = sum + F(c, J) * F(c, K);
          E(J, K) = 0.5 * sum;
        }
      }
    return E;
  }
  template <bool SmallStrain>
  PIOLA_FN static Mat<D, Lanes> stress_of(Mat<D, Lanes> const& F, SymMat<D, Lanes> const& S) {
    if constexpr (SmallStrain)
      return identity<D, Lanes>() * S;
    else
      return F * S;
  }
  template <bool SmallStrain>
  PIOLA_FN static Mat<3, Lanes> area_map(Mat<3, Lanes> const& F) {
    if constexpr (SmallStrain)
      return identity<3, Lanes>();
    else
      return cofactor(F);
  }
  PIOLA_FN static void add_to_corner(Mat<3, Lanes>& P, Mat<D, Lanes> const& more) {
    for (int i = 0; i < D; ++i)
      for (int J = 0; J < D; ++J) P(i, J) = P(i, J) + more(i, J);
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
