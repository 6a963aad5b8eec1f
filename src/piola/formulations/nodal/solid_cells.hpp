// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/materials/finite_increment.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/math/embedding.hpp"
#include "piola/math/scalar.hpp"

/// Cells of solids in rate form: their stresses follow from the state that the last step stored at their points, and
/// from the present deformation gradients. Theory: docs/theory/nodal.md, "Solids in rate form".
namespace piola::nodal::inline PIOLA_BACKEND {

/// Interface of a solid for UpdateStress. The law is hidden behind two functions, so that passes are compiled once for
/// all solids: formulas run in lanes; return mapping and pressure run one by one.
template <int D>
class SolidCells {
 public:
  static constexpr bool small_strain = false, volumetric_split = false;
  static constexpr int points = Quadratic<D>::points;

  /// Requested stress.
  enum class Wanted {
    as_left,  ///< the stress at the end of the last step
    trial,    ///< of a trial step, which stores no state and has no yield
    end       ///< at the end of a step, whose state is stored
  };

  /// For the particles of a material, dt [s] after the last step. `law` must outlive this.
  template <class Law>
  PIOLA_SHARED inline SolidCells(Law const& law, MaterialRange const& range, BodyState const& body, double dt,
                                 Wanted wanted)
      : law_(&law),
        update_(&update<Law>),
        pressure_(&pressure<Law>),
        rho0_(law.rho0),
        mu_(law.mu),
        kappa_local_(range.constants.kappa_local),
        shock_(range.constants.shock),
        dt_(dt),
        wanted_(wanted),
        first_(range.first),
        last_(range.last),
        history_(read(body.history)),
        history_out_(write(body.history)) {}

  /// Stresses, volume ratios and energy of the cells of a group of lanes from their F.
  template <class Energy>
  PIOLA_FN void operator()(Index i, Energy& energy) const {
    energy.mean_J = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      energy.J[q] = determinant(energy.F[q]);
      energy.mean_J = energy.mean_J + (1.0 / points) * energy.J[q];
      energy.least_J = q == 0 ? energy.J[q] : minimum(energy.least_J, energy.J[q]);
    }
    Cell cell = left_at(i);
    if (wanted_ == Wanted::as_left) {
      stresses(cell, cell.pressure, energy.P);
    } else {
      advance(i, cell, energy);
      if (wanted_ == Wanted::end) keep(i, cell);
    }
    energy.energy = rho0_ * cell.energy;
  }

 private:
  /// The cells of a group of lanes at one instant.
  struct Cell {
    Mat<3, Lanes> F[points];
    SymMat<3, Lanes> S[points];
    Lanes spread[points];  ///< tension of a point over that of the cell [Pa]
    Lanes pressure;        ///< of the cell, positive in compression [Pa]
    Lanes shock_pressure;  ///< viscous, of the cell [Pa]
    Lanes energy;          ///< specific internal energy [J/kg]
  };

  template <class Law>
  static PIOLA_FN void update(void const* law, SolidHistory& history, SymMat<3> const& trial, double pressure,
                              double rho, double dt) {
    static_cast<Law const*>(law)->update(history, trial, pressure, rho, dt);
  }
  template <class Law>
  static PIOLA_FN double pressure(void const* law, double rho, double e) {
    return static_cast<Law const*>(law)->pressure(rho, e);
  }

  /// P_q = (S_q + (spread_q - pressure) I) cof F_q [Pa].
  PIOLA_FN static void stresses(Cell const& cell, Lanes const& pressure, Mat<3, Lanes> (&P)[points]) {
    for (int q = 0; q < points; ++q) P[q] = first_piola_of(cell.S[q], Lanes(pressure - cell.spread[q]), cell.F[q]);
  }
  PIOLA_FN static Lanes mean_work(Mat<3, Lanes> const (&P)[points], Mat<3, Lanes> const (&dF)[points]) {
    Lanes sum = contract(P[0], dF[0]);
    for (int q = 1; q < points; ++q) sum = sum + contract(P[q], dF[q]);
    return (1.0 / points) * sum;
  }

  /// Elastic estimate of the tension of points over that of their cell, from the logarithmic energy:
  /// kappa_l (1/Jm - 1/J_q) [Pa].
  PIOLA_FN void elastic_spread(Cell const& cell, Lanes (&spread)[points]) const {
    Lanes mean = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      spread[q] = determinant(cell.F[q]);
      mean = mean + (1.0 / points) * spread[q];
    }
    for (int q = 0; q < points; ++q) spread[q] = kappa_local_ * (1.0 / mean - 1.0 / spread[q]);
  }

  /// Advances from the end of the last step to the gradients in `energy`. The energy grows by the mean of the stresses
  /// before and after, e += mean_q (P_n + P) : (F - F_n) / (2 rho0): the work that the kinetic energy loses in a Verlet
  /// step. The pressure belongs to the mean volume ratio and to this energy; both are solved for together.
  template <class Energy>
  PIOLA_FN void advance(Index i, Cell& cell, Energy& energy) const {
    Mat<3, Lanes> dF[points], H[points];
    stresses(cell, Lanes(cell.pressure + cell.shock_pressure), energy.P);
    cell.shock_pressure = shock_pressure(cell, energy.mean_J);
    for (int q = 0; q < points; ++q) {
      dF[q] = energy.F[q] - cell.F[q];
      H[q] = cofactor(energy.F[q]);
    }
    Lanes work = mean_work(energy.P, dF);
    Lanes const rho = rho0_ / energy.mean_J;
    flow(i, cell, energy.F, rho);
    stresses(cell, Lanes(0.0), energy.P);
    work = cell.energy + (0.5 / rho0_) * (work + mean_work(energy.P, dF));
    Lanes const volume = (0.5 / rho0_) * mean_work(H, dF);
    work = work - cell.shock_pressure * volume;
    for (int k = 0; k < 3; ++k) cell.pressure = pressures(rho, work - cell.pressure * volume);
    cell.energy = work - cell.pressure * volume;
    Lanes const whole = cell.pressure + cell.shock_pressure;
    for (int q = 0; q < points; ++q) energy.P[q] = energy.P[q] - whole * H[q];
  }

  /// Viscous pressure where the mean volume ratio J falls, in proportion to (dJ/dt)^2 / J. Zero in trial steps.
  PIOLA_FN Lanes shock_pressure(Cell const& cell, Lanes const& mean_J) const {
    if (!(dt_ > 0) || wanted_ == Wanted::trial) return Lanes(0.0);
    Lanes before = Lanes(0.0);
    for (int q = 0; q < points; ++q) before = before + (1.0 / points) * determinant(cell.F[q]);
    Lanes const closing = maximum((1 / dt_) * (before - mean_J), Lanes(0.0));
    return shock_ * closing * closing / mean_J;
  }

  /// Deviators and spread of the points at the gradients F. At a yielding point, the spread is scaled by the factor of
  /// the deviator, except for a part that stays elastic, so that no point is inverted.
  PIOLA_FN void flow(Index i, Cell& cell, Mat<3, Lanes> const (&F)[points], Lanes const& rho) const {
    constexpr double stays = 0.01;
    Lanes before[points], now[points];
    elastic_spread(cell, before);
    for (int q = 0; q < points; ++q) {
      cell.S[q] = trial_deviator(cell.S[q], mu_, cell.F[q], F[q]);
      cell.F[q] = F[q];
    }
    elastic_spread(cell, now);
    Lanes const pressure = pressures(rho, cell.energy);
    for (int q = 0; q < points; ++q) {
      Lanes const share = wanted_ == Wanted::trial ? Lanes(1.0) : return_to_yield(i, q, cell.S[q], pressure, rho);
      Lanes const yielding = cell.spread[q] - stays * before[q] + (1 - stays) * (now[q] - before[q]);
      cell.spread[q] = share * yielding + stays * now[q];
    }
  }

  /// Factor that the yield surface leaves of the trial deviator S of a point. Cells of other materials, and empty ones,
  /// are skipped.
  PIOLA_FN Lanes return_to_yield(Index i, int q, SymMat<3, Lanes>& S, Lanes const& pressure, Lanes const& rho) const {
    using At = HistoryLayout;
    double left[6][lane_count], share[lane_count];
    int const at = At::point(q, D);
    for (int l = 0; l < lane_count; ++l) {
      SymMat<3> trial;
      for (int c = 0; c < 6; ++c) left[c][l] = trial.c[c] = lane(S.c[c], l);
      share[l] = 1;
      if (!owns(i + l)) continue;
      auto const value = [&](int c) { return history_.scalar<double>(i + l, at + c); };
      SolidHistory h;
      h.plastic_strain = value(At::plastic_strain);
      h.temperature = value(At::temperature);
      h.damage = value(At::damage);
      h.plastic_work = value(At::plastic_work);
      double const strain = h.plastic_strain;
      update_(law_, h, trial, lane(pressure, l), lane(rho, l), dt_);
      if (h.plastic_strain > strain) share[l] = von_mises(h.S) / von_mises(trial);
      for (int c = 0; c < 6; ++c) left[c][l] = h.S.c[c];
      history_out_.scalar(i + l, h.plastic_strain, at + At::plastic_strain);
      history_out_.scalar(i + l, h.temperature, at + At::temperature);
      history_out_.scalar(i + l, h.damage, at + At::damage);
      history_out_.scalar(i + l, h.plastic_work, at + At::plastic_work);
    }
    for (int c = 0; c < 6; ++c) S.c[c] = load<Lanes>(left[c]);
    return load<Lanes>(share);
  }

  PIOLA_FN Lanes pressures(Lanes const& rho, Lanes const& e) const {
    double p[lane_count];
    for (int l = 0; l < lane_count; ++l) p[l] = pressure_(law_, lane(rho, l), lane(e, l));
    return load<Lanes>(p);
  }
  PIOLA_FN bool owns(Index i) const { return i >= first_ && i < last_; }

  PIOLA_FN Cell left_at(Index i) const {
    auto const value = [&](int c) { return history_.scalar<Lanes>(i, c); };
    Cell cell;
    cell.pressure = value(HistoryLayout::pressure);
    cell.shock_pressure = value(HistoryLayout::shock_pressure);
    cell.energy = value(HistoryLayout::energy);
    for (int q = 0; q < points; ++q) {
      int const at = HistoryLayout::point(q, D);
      cell.spread[q] = value(at + HistoryLayout::spread);
      for (int c = 0; c < 6; ++c) cell.S[q].c[c] = value(at + HistoryLayout::S + c);
      Mat<D, Lanes> F;
      for (int c = 0; c < D * D; ++c) F.c[c] = value(at + HistoryLayout::F + c);
      cell.F[q] = embed<D>(F);
      if constexpr (D == 2) cell.F[q](2, 2) = value(at + HistoryLayout::F + D * D);
    }
    return cell;
  }
  /// Stores the state, except what return_to_yield has stored.
  PIOLA_FN void keep(Index i, Cell const& cell) const {
    double own[lane_count];
    for (int l = 0; l < lane_count; ++l) own[l] = owns(i + l) ? 1 : 0;
    auto const mine = load<Lanes>(own) > 0.5;
    auto const put = [&](Lanes const& now, int c) {
      history_out_.scalar(i, select(mine, now, history_.scalar<Lanes>(i, c)), c);
    };
    put(cell.pressure, HistoryLayout::pressure);
    put(cell.energy, HistoryLayout::energy);
    put(cell.shock_pressure, HistoryLayout::shock_pressure);
    for (int q = 0; q < points; ++q) {
      int const at = HistoryLayout::point(q, D);
      put(cell.spread[q], at + HistoryLayout::spread);
      for (int c = 0; c < 6; ++c) put(cell.S[q].c[c], at + HistoryLayout::S + c);
      for (int c = 0; c < D * D; ++c) put(cell.F[q](c / D, c % D), at + HistoryLayout::F + c);
      if constexpr (D == 2) put(cell.F[q](2, 2), at + HistoryLayout::F + D * D);
    }
  }

  void const* law_;
  void (*update_)(void const*, SolidHistory&, SymMat<3> const&, double, double, double);
  double (*pressure_)(void const*, double, double);
  double rho0_, mu_, kappa_local_, shock_, dt_;
  Wanted wanted_;
  Index first_, last_;
  View history_;
  WriteView history_out_;
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
