// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/kick_pass.hpp"

namespace piola::adaptle::inline PIOLA_BACKEND {

/// Plane stress: the out-of-plane strain rate for which the out-of-plane stress vanishes at the end of the step, by the
/// secant method, particle by particle [1/s].
template <class Law>
struct RateAcross {
  Law const& law;
  PointFields const& point;
  Balance const& balance;
  double dt;

  PIOLA_FN double operator()(Index i, BlockScratch const& scratch) const {
    Mat<3> L;
    for (int c = 0; c < 9; ++c) L.c[c] = scratch.L[c][i - scratch.first];
    double const heat = scratch.heat[i - scratch.first];
    auto const stress = [&](double rate) {
      L(2, 2) = rate;
      return stress_across(i, L, heat);
    };
    double const bulk = law.kappa, inverse = 1 / (dt * (bulk + 4.0 / 3.0 * law.mu));
    double a = -(bulk - 2.0 / 3.0 * law.mu) / (bulk + 4.0 / 3.0 * law.mu) * (L(0, 0) + L(1, 1)), f_a = stress(a);
    if (!(dt > 0)) return a;
    double b = a - f_a * inverse;
    for (int k = 0; k < 12; ++k) {
      double const f_b = stress(b);
      if (!(std::fabs(f_b) > 1e-9 * bulk * 1e-3) || f_b == f_a) break;
      double const next = b - f_b * (b - a) / (f_b - f_a);
      a = b;
      f_a = f_b;
      b = next;
    }
    return b;
  }

 private:
  PIOLA_FN double stress_across(Index i, Mat<3> const& L, double heat) const {
    SymMat<3> const S_half = balance.S_half.symmetric<double>(i), rate = law.deviator_rate(S_half, L);
    SymMat<3> trial = point.S.symmetric<double>(i);
    SolidHistory const history = point.history<double>(i, trial);
    for (int c = 0; c < 6; ++c) trial.c[c] += dt * rate.c[c];
    double const rho_half = balance.rho_half.at(i), thickness = balance.thickness_of<double>(i);
    SymMat<3> const S = law.returned(history, trial, dt, balance.pressure.at(i), rho_half / law.rho0);
    double const energy = balance.energy.at(i) + dt * (balance.stress_power(i, L) * thickness + heat);
    // A total-Lagrangian density follows from the thickness at the end of the step.
    double const end = balance.thickness.at(i) + dt * thickness * L(2, 2);
    double const rho = balance.phi.at(i) > 0 ? balance.rho.at(i) - dt * rho_half * trace(L)
                                             : rho_half * (1 - 0.5 * dt * (L(0, 0) + L(1, 1))) * thickness / end;
    return S.c[2] - point.pressure<double>(law, i, rho, energy / balance.mass.at(i));
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
