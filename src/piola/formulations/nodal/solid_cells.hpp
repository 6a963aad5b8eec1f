// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/cell_stress.hpp"
#include "piola/formulations/nodal/solid_cell_state.hpp"
#include "piola/formulations/nodal/viscosity.hpp"
#include "piola/materials/finite_increment.hpp"
#include "piola/materials/hypoelastic_registry.hpp"

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
    end,      ///< at the end of a step, whose state is stored
    refitted  ///< as left, with gradients that have changed, whose F is stored
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
        kappa_(law.kappa),
        kappa_local_(range.constants.kappa_local),
        shock_(range.constants.shock),
        dt_(dt),
        wanted_(wanted),
        first_(range.first),
        last_(range.last),
        fails_(body.has.failure),
        failure_(range.failure),
        history_(body) {}

  /// Stresses, volume ratios and energy of the cells of a group of lanes from their F.
  template <class Energy>
  PIOLA_FN void operator()(Index i, Energy& energy) const {
    energy.mean_J = Lanes(0.0);
    if (fails_) put_at_rest(i, energy);
    for (int q = 0; q < points; ++q) {
      energy.J[q] = determinant(energy.F[q]);
      energy.mean_J = energy.mean_J + (1.0 / points) * energy.J[q];
      energy.least_J = q == 0 ? energy.J[q] : minimum(energy.least_J, energy.J[q]);
    }
    Cell cell = left_at(i);
    if (wanted_ == Wanted::as_left) {
      stresses(cell, cell.pressure, energy.P);
    } else if (wanted_ == Wanted::refitted) {
      refit(i, cell, energy);
      stresses(cell, Lanes(cell.pressure + cell.shock_pressure), energy.P);
    } else {
      advance(i, cell, energy);
      if (wanted_ == Wanted::end) keep(i, cell);
    }
    energy.energy = rho0_ * cell.energy;
    if (!fails_) return;
    energy.mean_J = cell.volume_factor * energy.mean_J;
    energy.least_J = select(cell.is_intact(), energy.least_J, Lanes(1.0));  // broken cells may be inverted
  }
  /// `value`, and 0 for cells whose gradients are without use.
  PIOLA_FN Lanes where_used(Index i, Lanes const& value) const {
    return fails_ ? select(history_.rests(i), Lanes(0.0), value) : value;
  }

 private:
  using Cell = SolidCellState<D>;

  template <class Law>
  static PIOLA_FN void update(void const* law, SolidHistory& history, SymMat<3> const& trial, double pressure,
                              double rho, double dt) {
    static_cast<Law const*>(law)->update(history, trial, pressure, rho, dt);
  }
  template <class Law>
  static PIOLA_FN double pressure(void const* law, double rho, double e, double toughness) {
    SolidHistory h;
    h.toughness = toughness;
    return static_cast<Law const*>(law)->pressure(h, rho, e);
  }

  /// P_q = (S_q + (spread_q - pressure) I) cof F_q [Pa]; of cells that may fail what is carried of S_q and spread_q,
  /// and times the volume factor. The pressure is used as given.
  PIOLA_FN void stresses(Cell const& cell, Lanes const& pressure, Mat<3, Lanes> (&P)[points]) const {
    for (int q = 0; q < points; ++q) {
      if (!fails_) {
        P[q] = first_piola_of(cell.S[q], Lanes(pressure - cell.spread[q]), cell.F[q]);
        continue;
      }
      SymMat<3, Lanes> S = cell.S[q];
      for (Lanes& s : S.c) s = cell.carried * s;
      P[q] = cell.volume_factor * first_piola_of(S, Lanes(pressure - cell.carried * cell.spread[q]), cell.F[q]);
    }
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
    Lanes const rho = rho0_ / volume_ratio(cell, energy.mean_J);
    flow(i, cell, energy.F, rho);
    stresses(cell, Lanes(0.0), energy.P);
    work = cell.energy + (0.5 / rho0_) * (work + mean_work(energy.P, dF));
    Lanes const volume = (0.5 / rho0_) * mean_work(H, dF) * (fails_ ? cell.volume_factor : Lanes(1.0));
    work = work - cell.shock_pressure * volume;
    for (int k = 0; k < 3; ++k) cell.pressure = carried_pressure(cell, rho, work - cell.pressure * volume);
    cell.energy = work - cell.pressure * volume;
    Lanes const whole = (cell.pressure + cell.shock_pressure) * (fails_ ? cell.volume_factor : Lanes(1.0));
    for (int q = 0; q < points; ++q) energy.P[q] = energy.P[q] - whole * H[q];
  }

  /// Viscous pressure where the mean volume ratio J falls, in proportion to (dJ/dt)^2 / J. Zero in trial steps.
  PIOLA_FN Lanes shock_pressure(Cell const& cell, Lanes const& mean_J) const {
    if (!(dt_ > 0) || wanted_ == Wanted::trial) return Lanes(0.0);
    Lanes before = Lanes(0.0);
    for (int q = 0; q < points; ++q) before = before + (1.0 / points) * determinant(cell.F[q]);
    if (!fails_) return shock_pressure_of(Lanes(shock_), 1 / dt_, before, mean_J, mean_J);
    Lanes const Q =
        shock_pressure_of(shock_ * cell.volume_factor, 1 / dt_, before, mean_J, maximum(mean_J, Lanes(least_ratio)));
    return select(history_.rests(cell.condition), Lanes(0.0), Q);
  }

  /// Volume ratio of the cell for its density. That of a cell that is not intact has a lower bound: such cells may be
  /// inverted before they are detached.
  PIOLA_FN Lanes volume_ratio(Cell const& cell, Lanes const& mean_J) const {
    if (!fails_) return mean_J;
    Lanes const J = cell.volume_factor * mean_J;
    return select(cell.is_intact(), J, maximum(J, Lanes(least_ratio)));
  }

  /// Pressure of the cell, tension times what is carried of it [Pa].
  PIOLA_FN Lanes carried_pressure(Cell const& cell, Lanes const& rho, Lanes const& e) const {
    Lanes const p = pressures(cell, rho, e);
    if (!fails_) return p;
    return select(history_.rests(cell.condition), Lanes(0.0), select(p < 0.0, cell.carried * p, p));
  }

  /// Detached and Eulerian cells are at rest in their reference shape.
  template <class Energy>
  PIOLA_FN void put_at_rest(Index i, Energy& energy) const {
    auto const resting = history_.rests(i);
    if (!any(resting)) return;
    for (int q = 0; q < points; ++q)
      for (int c = 0; c < 9; ++c) energy.F[q].c[c] = select(resting, Lanes(c % 4 == 0 ? 1.0 : 0.0), energy.F[q].c[c]);
  }

  /// Takes over gradients that have changed: stress and density stay, and the volume factor makes up for the change of
  /// the volume ratio. A cell that the new gradients see crushed, or of quite another volume, keeps its mark.
  template <class Energy>
  PIOLA_FN void refit(Index i, Cell& cell, Energy const& energy) const {
    auto const marked = history_.of_failure(i, FailureLayout::refitted) > 0.5;
    if (!any(marked)) return;
    Lanes least = energy.J[0], before = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      least = minimum(least, energy.J[q]);
      before = before + (1.0 / points) * determinant(cell.F[q]);
    }
    Lanes const most = select(cell.is_intact(), Lanes(most_change), Lanes(2 * most_change));
    auto const changed =
        marked && least > least_ratio && energy.mean_J < most * before && most * energy.mean_J > before;
    for (int q = 0; q < points; ++q)
      for (int c = 0; c < 9; ++c) cell.F[q].c[c] = select(changed, energy.F[q].c[c], cell.F[q].c[c]);
    double is_changed[lane_count];
    store(select(changed, Lanes(1.0), Lanes(0.0)), is_changed);
    cell.volume_factor = select(changed, cell.volume_factor * before / energy.mean_J, cell.volume_factor);
    for (int l = 0; l < lane_count; ++l) {
      if (!owns(i + l) || is_changed[l] == 0) continue;
      history_.put_of_failure(i + l, lane(cell.volume_factor, l), FailureLayout::volume_factor);
      history_.put_of_failure(i + l, 0.0, FailureLayout::refitted);
      for (int q = 0; q < points; ++q) {
        int const at = HistoryLayout::point(q, D) + HistoryLayout::F;
        for (int c = 0; c < D * D; ++c) history_.put(i + l, lane(cell.F[q](c / D, c % D), l), at + c);
        if constexpr (D == 2) history_.put(i + l, lane(cell.F[q](2, 2), l), at + D * D);
      }
    }
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
    Lanes const pressure = pressures(cell, rho, cell.energy);
    double strain[lane_count]{};
    for (int q = 0; q < points; ++q) {
      if (fails_)
        for (int c = 0; c < 6; ++c) cell.S[q].c[c] = select(cell.is_intact(), cell.S[q].c[c], Lanes(0.0));
      Lanes const share = wanted_ == Wanted::trial ? Lanes(1.0) : return_to_yield(i, q, cell, pressure, rho, strain);
      Lanes const yielding = cell.spread[q] - stays * before[q] + (1 - stays) * (now[q] - before[q]);
      cell.spread[q] = share * yielding + stays * now[q];
      if (fails_) cell.spread[q] = select(cell.is_intact(), cell.spread[q], Lanes(0.0));
    }
    if (fails_ && wanted_ == Wanted::end) soften(i, cell, pressure, strain);
  }

  /// Softening of the cells of a group of lanes. pressure: of the undamaged material [Pa]; strain: mean increment of
  /// the plastic strain of the points.
  PIOLA_FN void soften(Index i, Cell& cell, Lanes const& pressure, double const (&strain)[lane_count]) const {
    using At = FailureLayout;
    double carried[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      carried[l] = lane(cell.carried, l);
      if (!owns(i + l) || !(lane(cell.condition, l) < 0.5)) continue;
      auto const value = [&](int of) { return history_.of_failure_at(i + l, of); };
      auto const put = [&](int of, double now) { history_.put_of_failure(i + l, now, of); };
      CellStress<points> const stress(cell, pressure, l);
      double const before = value(At::softening);
      double now = before;
      if (failure_.strength < unbounded) {
        CrackBand const band =
            crack_band(failure_.strength * lane(cell.toughness, l), failure_.energy, failure_.modulus, failure_.band);
        double const largest = value(At::largest_stress);
        double const least = maximum(largest, band.strength);
        double const most = maximum(largest, stress.tension(least, failure_.modulus, kappa_, mu_));
        if (most > largest) put(At::largest_stress, most);
        now = maximum(now, band.softening(most));
      }
      if (failure_.damages && mean_damage(i + l) > least_damage)
        now = maximum(now,
                      before + (failure_.per_strain > 0 ? failure_.per_strain * strain[l] : failure_.per_time * dt_));
      now = minimum(now, 1.0);
      if (!(now > before)) continue;
      put(At::softening, now);
      put(At::fracture_energy, value(At::fracture_energy) + (now - before) * stress.shear_and_tension(kappa_, mu_));
      carried[l] = 1 - now;
    }
    cell.carried = load<Lanes>(carried);
  }

  PIOLA_FN double mean_damage(Index i) const {
    double sum = 0;
    for (int q = 0; q < points; ++q)
      sum += history_.value(i, HistoryLayout::point(q, D) + HistoryLayout::damage) / points;
    return sum;
  }

  /// Factor that the yield surface leaves of the trial deviator of a point. Adds the mean increment of plastic strain
  /// to `grown`. Cells of other materials, empty and broken ones are skipped.
  PIOLA_FN Lanes return_to_yield(Index i, int q, Cell& cell, Lanes const& pressure, Lanes const& rho,
                                 double (&grown)[lane_count]) const {
    using At = HistoryLayout;
    SymMat<3, Lanes>& S = cell.S[q];
    double left[6][lane_count], share[lane_count];
    int const at = At::point(q, D);
    for (int l = 0; l < lane_count; ++l) {
      SymMat<3> trial;
      for (int c = 0; c < 6; ++c) left[c][l] = trial.c[c] = lane(S.c[c], l);
      share[l] = 1;
      if (!owns(i + l) || (fails_ && !(lane(cell.condition, l) < 0.5))) continue;
      auto const value = [&](int c) { return history_.value(i + l, at + c); };
      SolidHistory h;
      h.plastic_strain = value(At::plastic_strain);
      h.temperature = value(At::temperature);
      h.damage = value(At::damage);
      h.plastic_work = value(At::plastic_work);
      if (fails_) h.toughness = lane(cell.toughness, l);
      double const strain = h.plastic_strain;
      update_(law_, h, trial, lane(pressure, l), lane(rho, l), dt_);
      if (h.plastic_strain > strain) share[l] = von_mises(h.S) / von_mises(trial);
      grown[l] += (h.plastic_strain - strain) / points;
      for (int c = 0; c < 6; ++c) left[c][l] = h.S.c[c];
      history_.put(i + l, h.plastic_strain, at + At::plastic_strain);
      history_.put(i + l, h.temperature, at + At::temperature);
      history_.put(i + l, h.damage, at + At::damage);
      history_.put(i + l, h.plastic_work, at + At::plastic_work);
    }
    for (int c = 0; c < 6; ++c) S.c[c] = load<Lanes>(left[c]);
    return load<Lanes>(share);
  }

  /// Pressures of the undamaged material [Pa].
  PIOLA_FN Lanes pressures(Cell const& cell, Lanes const& rho, Lanes const& e) const {
    double p[lane_count];
    for (int l = 0; l < lane_count; ++l)
      p[l] = pressure_(law_, lane(rho, l), lane(e, l), fails_ ? lane(cell.toughness, l) : 1);
    return load<Lanes>(p);
  }
  PIOLA_FN bool owns(Index i) const { return i >= first_ && i < last_; }

  /// The cells at the end of the last step. Eulerian ones, which carry their stress elsewhere, are empty here except
  /// for output.
  PIOLA_FN Cell left_at(Index i) const {
    Cell cell = history_(i);
    if (!fails_) return cell;
    auto const rests = history_.rests(cell.condition);
    if (!any(rests)) return cell;
    if (wanted_ == Wanted::as_left) {
      cell.carried = select(rests, Lanes(1.0 - cell.softening), cell.carried);
      return cell;
    }
    cell.pressure = select(rests, Lanes(0.0), cell.pressure);
    cell.shock_pressure = select(rests, Lanes(0.0), cell.shock_pressure);
    return cell;
  }
  /// Stores the state of cells that do not rest.
  PIOLA_FN void keep(Index i, Cell const& cell) const {
    double mine[lane_count];
    for (int l = 0; l < lane_count; ++l) mine[l] = owns(i + l) && !(fails_ && history_.rests_at(i + l)) ? 1 : 0;
    history_.put(i, cell, mine);
  }

  static constexpr double least_ratio = 0.05;    ///< of the volume of a cell that is not intact
  static constexpr double most_change = 2;       ///< of the volume ratio of an intact cell by new gradients
  static constexpr double least_damage = 0.999;  ///< from which a cell softens

  void const* law_;
  void (*update_)(void const*, SolidHistory&, SymMat<3> const&, double, double, double);
  double (*pressure_)(void const*, double, double, double);
  double rho0_, mu_, kappa_, kappa_local_, shock_, dt_;
  Wanted wanted_;
  Index first_, last_;
  bool fails_;  ///< cells may fail
  FailureConstants failure_;
  SolidCellHistory<D> history_;
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
