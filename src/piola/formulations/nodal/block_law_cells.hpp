// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/formulations/nodal/viscosity.hpp"
#include "piola/materials/block_law.hpp"
#include "piola/materials/finite_increment.hpp"
#include "piola/materials/hypoelastic_solid.hpp"
#include "piola/math/embedding.hpp"
#include "piola/math/polar.hpp"

/// Cells of laws that advance blocks of points (materials/block_law.hpp). Theory: docs/theory/nodal.md, "Laws on
/// blocks of points".
namespace piola::nodal::inline PIOLA_BACKEND {

/// The points of a group of cells in the arrays of piola_points: point q of the cell in lane l is q * lane_count + l.
template <int D>
struct PointBlock {
  static constexpr int points = Quadratic<D>::points, count = points * lane_count;
  double F_old[9 * count], F_new[9 * count], U_old[6 * count], U_new[6 * count], stress[9 * count], energy[count],
      sound_speed[count], history[BlockLaw::most_history * count];

  PIOLA_FN static void put(double* array, int c, int q, Lanes const& value) {
    store(value, array + c * count + q * lane_count);
  }
  PIOLA_FN static Lanes get(double const* array, int c, int q) {
    return load<Lanes>(array + c * count + q * lane_count);
  }
};

/// A law on blocks of points, as UpdateStress calls it. The law sees gradients whose volume ratio is the mean one of
/// their cell, (Jm/J_q)^(1/3) F_q; stabilisation resists differences of J_q within a cell.
template <int D>
class BlockLawCells {
 public:
  static constexpr bool small_strain = false, volumetric_split = false;
  static constexpr int points = Quadratic<D>::points;

  /// Requested stress: at the end of the last step; of a trial displacement, which stores nothing; at the end of a
  /// step, which is stored.
  enum class Wanted { as_left, trial, end };

  /// `law` must outlive this. dt [s]: since the last step.
  BlockLawCells(BlockLaw const& law, MaterialRange const& range, BodyState const& body, double dt, Wanted wanted)
      : law_(&law),
        kappa_local_(range.constants.kappa_local),
        shock_(range.constants.shock),
        dt_(dt),
        time_(body.time),
        wanted_(wanted),
        first_(range.first),
        last_(range.last),
        failure_(body.failure),
        in_(read(body.history)),
        out_(write(body.history)) {}

  /// Stresses, volume ratios and energy of the cells of a group of lanes from their F.
  template <class Energy>
  PIOLA_FN void operator()(Index i, Energy& energy) const {
    Cell now;
    double mine[lane_count];
    for (int l = 0; l < lane_count; ++l) mine[l] = owns(i + l) ? 1 : 0;
    Lanes const owned = load<Lanes>(mine);
    for (int q = 0; q < points; ++q)
      for (int c = 0; c < 9; ++c) now.F[q].c[c] = select(owned > 0.5, energy.F[q].c[c], Lanes(c % 4 == 0 ? 1.0 : 0.0));
    if (law_->elastic())
      of_elastic(i, now, energy);
    else
      of_history(i, owned, now, energy);
    for (int q = 0; q < points; ++q) {
      energy.J[q] = now.J[q];
      energy.least_J = q == 0 ? now.J[q] : minimum(energy.least_J, now.J[q]);
    }
    energy.mean_J = now.mean_J;
  }

 private:
  using Block = PointBlock<D>;
  using At = BlockLawLayout;

  /// A group of cells at one instant.
  struct Cell {
    Mat<3, Lanes> F[points];     ///< deformation gradients
    Mat<3, Lanes> even[points];  ///< with the mean volume ratio
    Lanes J[points], mean_J;
    Mat<3, Lanes> R[points];  ///< rotation of F, of laws with a corotated stress

    PIOLA_FN void find_even(bool corotated) {
      mean_J = Lanes(0.0);
      for (int q = 0; q < points; ++q) {
        J[q] = determinant(F[q]);
        mean_J = mean_J + (1.0 / points) * J[q];
      }
      for (int q = 0; q < points; ++q) {
        even[q] = power_minus_third(J[q] / mean_J) * F[q];
        if (corotated) R[q] = rotation_of(even[q]);
      }
    }
    /// Elastic tension of a point over that of its cell, kappa_local (1/Jm - 1/J_q) [Pa].
    PIOLA_FN Lanes spread(int q, double kappa_local) const { return kappa_local * (1.0 / mean_J - 1.0 / J[q]); }
  };

  PIOLA_FN bool owns(Index i) const { return i >= first_ && i < last_; }

  template <class Energy>
  PIOLA_FN void of_elastic(Index i, Cell& now, Energy& energy) const {
    now.find_even(law_->corotated());
    Block block;
    Cell rest;
    for (int q = 0; q < points; ++q) rest.F[q] = rest.even[q] = rest.R[q] = identity<3, Lanes>();
    put_gradients(block, rest, now);
    for (int k = 0; k < 9 * Block::count; ++k) block.stress[k] = 0;
    call(i, block);
    Mat<3, Lanes> law_stress[points];
    Lanes spread[points];
    energy.energy = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      law_stress[q] = first_piola(now, q, block);
      spread[q] = now.spread(q, kappa_local_);
      energy.energy = energy.energy + (1.0 / points) * (Block::get(block.energy, 0, q) +
                                                        kappa_local_ * logarithm(now.mean_J / now.J[q]));
    }
    put_together(now, law_stress, spread, Lanes(0.0), energy.P);
  }

  /// The energy grows by the work of the mean of the stresses before and after. The law is given the energy before and
  /// the heat that the viscous pressure of shocks brings in the step.
  template <class Energy>
  PIOLA_FN void of_history(Index i, Lanes const& owned, Cell& now, Energy& energy) const {
    Block block;
    Cell old;
    Mat<3, Lanes> law_stress[points], P_old[points];
    Lanes spread[points];
    left_at(i, old, block, spread);
    for (int q = 0; q < points; ++q) law_stress[q] = first_piola(old, q, block);
    Lanes const shock_before =
        wanted_ == Wanted::as_left ? Lanes(0.0) : in_.template scalar<Lanes>(i, At::shock_pressure);
    put_together(old, law_stress, spread, shock_before, P_old);
    Lanes const specific = in_.template scalar<Lanes>(i, At::energy);
    energy.energy = law_->rho0 * specific;
    if (wanted_ == Wanted::as_left) {
      now = old;
      for (int q = 0; q < points; ++q) energy.P[q] = P_old[q];
      return;
    }
    now.find_even(law_->corotated());
    if (wanted_ == Wanted::trial && law_->yields()) return try_elastic(i, old, now, law_stress, spread, energy.P);
    put_gradients(block, old, now);
    Lanes const shock = shock_pressure(old, now), heated = energy.energy + heat_of(old, now, shock_before, shock);
    for (int q = 0; q < points; ++q) Block::put(block.energy, 0, q, heated);
    call(i, block);
    for (int q = 0; q < points; ++q) {
      Mat<3, Lanes> const before = law_stress[q];
      law_stress[q] = first_piola(now, q, block);
      Lanes const elastic = now.spread(q, kappa_local_);
      spread[q] = law_->yields() ? yielding_spread(old, now, q, before, law_stress[q], spread[q]) : elastic;
    }
    put_together(now, law_stress, spread, shock, energy.P);
    if (wanted_ == Wanted::trial) return;
    Lanes work = Lanes(0.0);
    for (int q = 0; q < points; ++q)
      work = work + (0.5 / points) * contract(P_old[q] + energy.P[q], now.F[q] - old.F[q]);
    energy.energy = energy.energy + work;
    keep(i, owned, now, block, spread, specific + (1 / law_->rho0) * work, shock);
  }

  /// Viscous pressure where the mean volume ratio J falls, in proportion to (dJ/dt)^2 / J [Pa]. Zero in trial steps.
  PIOLA_FN Lanes shock_pressure(Cell const& old, Cell const& now) const {
    if (!(dt_ > 0) || wanted_ == Wanted::trial) return Lanes(0.0);
    return shock_pressure_of(Lanes(shock_), 1 / dt_, old.mean_J, now.mean_J, now.mean_J);
  }
  /// Work on a cell of viscous pressures, `before` and `after` the step, per reference volume [J/m^3].
  PIOLA_FN static Lanes heat_of(Cell const& old, Cell const& now, Lanes const& before, Lanes const& after) {
    Lanes heat = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      Mat<3, Lanes> const dF = now.F[q] - old.F[q];
      heat = heat -
             (0.5 / points) * (before * contract(cofactor(old.F[q]), dF) + after * contract(cofactor(now.F[q]), dF));
    }
    return heat;
  }

  /// Stresses at a trial displacement of a law that yields, which is not called: by the moduli.
  PIOLA_FN void try_elastic(Index i, Cell const& old, Cell const& now, Mat<3, Lanes> (&law_stress)[points],
                            Lanes (&spread)[points], Mat<3, Lanes> (&P)[points]) const {
    for (int q = 0; q < points; ++q) {
      law_stress[q] = elastic_trial(i, old, now, q, law_stress[q]);
      spread[q] = spread[q] + now.spread(q, kappa_local_) - old.spread(q, kappa_local_);
    }
    put_together(now, law_stress, spread, Lanes(0.0), P);
  }

  /// Stresses of the points from those of the law at the gradients with the mean volume ratio: the derivative of
  /// mean_q W((Jm/J_q)^(1/3) F_q) by F_q, the spread, and a `pressure` of the cell [Pa].
  PIOLA_FN void put_together(Cell const& cell, Mat<3, Lanes> const (&law_stress)[points], Lanes const (&spread)[points],
                             Lanes const& pressure, Mat<3, Lanes> (&P)[points]) const {
    Lanes work[points], mean_work = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      work[q] = (1.0 / 3.0) * contract(law_stress[q], cell.even[q]);
      mean_work = mean_work + (1.0 / points) * work[q];
    }
    for (int q = 0; q < points; ++q)
      P[q] = power_minus_third(cell.J[q] / cell.mean_J) * law_stress[q] +
             Lanes(mean_work / cell.mean_J - work[q] / cell.J[q] + spread[q] - pressure) * cofactor(cell.F[q]);
  }

  PIOLA_FN void put_gradients(Block& block, Cell const& old, Cell const& now) const {
    for (int q = 0; q < points; ++q) {
      for (int c = 0; c < 9; ++c) {
        Block::put(block.F_old, c, q, old.even[q].c[c]);
        Block::put(block.F_new, c, q, now.even[q].c[c]);
      }
      Block::put(block.sound_speed, 0, q, Lanes(law_->p_wave_speed()));
      Block::put(block.energy, 0, q, Lanes(0.0));
      if (!law_->corotated()) continue;
      SymMat<3, Lanes> const before = stretch_of(old.R[q], old.even[q]), after = stretch_of(now.R[q], now.even[q]);
      for (int c = 0; c < 6; ++c) {
        Block::put(block.U_old, c, q, before.c[c]);
        Block::put(block.U_new, c, q, after.c[c]);
      }
    }
  }

  /// The first Piola stress [Pa] of the law's stress of a point.
  PIOLA_FN Mat<3, Lanes> first_piola(Cell const& cell, int q, Block const& block) const {
    Mat<3, Lanes> P;
    if (!law_->corotated()) {
      for (int c = 0; c < 9; ++c) P.c[c] = Block::get(block.stress, c, q);
      return P;
    }
    SymMat<3, Lanes> turned;
    for (int c = 0; c < 6; ++c) turned.c[c] = Block::get(block.stress, c, q);
    return (cell.R[q] * turned) * transpose(cell.R[q]) * cofactor(cell.even[q]);
  }

  /// Advances the points by the law. A law that fails, or a stress that is not a number, is a failure of all cells of
  /// the group whose stress is not a number, or of its first one.
  PIOLA_FN void call(Index i, Block& block) const {
    bool const turned = law_->corotated();
    fill_others(i, block);
    piola_points points_now{Block::count,
                            Block::count,
                            time_,
                            dt_,
                            0,
                            nullptr,
                            block.F_old,
                            block.F_new,
                            turned ? block.U_old : nullptr,
                            turned ? block.U_new : nullptr,
                            block.stress,
                            block.energy,
                            block.history,
                            block.sound_speed};
    int const code = law_->update(points_now);
    for (int l = 0; l < lane_count; ++l) {
      if (!owns(i + l)) continue;
      double sum = 0;
      for (int k = l; k < (turned ? 6 : 9) * Block::count; k += lane_count) sum += 0 * block.stress[k];
      if (code != 0 || sum != 0) exec::record(failure_, i + l, failure_of_law + (code > 0 ? code : 0));
    }
  }

  /// Lanes of other materials and without a particle get the values of one that has the law.
  PIOLA_FN void fill_others(Index i, Block& block) const {
    int mine = 0;
    while (mine < lane_count && !owns(i + mine)) ++mine;
    if (mine == lane_count) return;
    auto const fill = [&](double* array, int components, int l) {
      for (int k = 0; k < components * points; ++k) array[k * lane_count + l] = array[k * lane_count + mine];
    };
    for (int l = 0; l < lane_count; ++l) {
      if (owns(i + l)) continue;
      fill(block.F_old, 9, l);
      fill(block.F_new, 9, l);
      fill(block.stress, 9, l);
      if (law_->corotated()) {
        fill(block.U_old, 6, l);
        fill(block.U_new, 6, l);
      }
      fill(block.energy, 1, l);
      fill(block.history, law_->history_count(), l);
    }
  }

  /// Elastic change of the stress by the moduli, for trial displacements of a law that yields: first Piola stress at
  /// the gradient with the mean volume ratio.
  PIOLA_FN Mat<3, Lanes> elastic_trial(Index i, Cell const& old, Cell const& now, int q,
                                       Mat<3, Lanes> const& before) const {
    SymMat<3, Lanes> S = cauchy_stress(before, old.even[q], old.mean_J);
    Lanes const mean = take_mean(S);
    Lanes const bulk = in_.template scalar<Lanes>(i, At::modulus) - 4.0 / 3 * law_->mu;
    return first_piola_of(trial_deviator(S, law_->mu, old.even[q], now.even[q]),
                          Lanes(0.0 - mean - bulk * (now.mean_J / old.mean_J - 1.0)), now.even[q]);
  }

  /// Spread after a step, scaled by the factor that yielding leaves of the trial deviator, except for a part that stays
  /// elastic, so that no point is inverted.
  PIOLA_FN Lanes yielding_spread(Cell const& old, Cell const& now, int q, Mat<3, Lanes> const& before,
                                 Mat<3, Lanes> const& after, Lanes const& spread) const {
    constexpr double stays = 0.01;
    SymMat<3, Lanes> S_old = cauchy_stress(before, old.even[q], old.mean_J),
                     S = cauchy_stress(after, now.even[q], now.mean_J);
    take_mean(S_old);
    take_mean(S);
    Lanes const trial = von_mises(trial_deviator(S_old, law_->mu, old.even[q], now.even[q])), left = von_mises(S);
    Lanes const share = select(left < trial, left / maximum(trial, Lanes(1e-300)), Lanes(1.0));
    Lanes const elastic_old = old.spread(q, kappa_local_), elastic = now.spread(q, kappa_local_);
    return share * (spread - stays * elastic_old + (1 - stays) * (elastic - elastic_old)) + stays * elastic;
  }

  /// Leaves the deviator; returns the mean stress [Pa].
  PIOLA_FN static Lanes take_mean(SymMat<3, Lanes>& S) {
    Lanes const mean = (1.0 / 3.0) * (S.c[0] + S.c[1] + S.c[2]);
    for (int c = 0; c < 3; ++c) S.c[c] = S.c[c] - mean;
    return mean;
  }

  /// The cells at the end of the last step.
  PIOLA_FN void left_at(Index i, Cell& old, Block& block, Lanes (&spread)[points]) const {
    auto const number = [&](int c) { return in_.template scalar<Lanes>(i, c); };
    for (int q = 0; q < points; ++q) {
      int const at = At::point(q, D, law_->history_count());
      for (int c = 0; c < 9; ++c) Block::put(block.stress, c, q, number(at + At::stress + c));
      spread[q] = number(at + At::spread);
      Mat<D, Lanes> F;
      for (int c = 0; c < D * D; ++c) F.c[c] = number(at + At::F + c);
      old.F[q] = embed<D>(F);
      if constexpr (D == 2) old.F[q](2, 2) = number(at + At::F + D * D);
      for (int h = 0; h < law_->history_count(); ++h) Block::put(block.history, h, q, number(at + At::history(D) + h));
    }
    old.find_even(law_->corotated());
  }

  PIOLA_FN void keep(Index i, Lanes const& owned, Cell const& now, Block const& block, Lanes const (&spread)[points],
                     Lanes const& specific, Lanes const& shock) const {
    auto const put = [&](Lanes const& value, int c) {
      out_.scalar(i, select(owned > 0.5, value, in_.template scalar<Lanes>(i, c)), c);
    };
    Lanes modulus = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      int const at = At::point(q, D, law_->history_count());
      int const components = law_->corotated() ? 6 : 9;
      for (int c = 0; c < components; ++c) put(Block::get(block.stress, c, q), at + At::stress + c);
      put(spread[q], at + At::spread);
      for (int c = 0; c < D * D; ++c) put(now.F[q](c / D, c % D), at + At::F + c);
      if constexpr (D == 2) put(now.F[q](2, 2), at + At::F + D * D);
      for (int h = 0; h < law_->history_count(); ++h) put(Block::get(block.history, h, q), at + At::history(D) + h);
      Lanes const c = Block::get(block.sound_speed, 0, q);
      modulus = maximum(modulus, law_->rho0 / now.mean_J * c * c);
    }
    put(specific, At::energy);
    put(shock, At::shock_pressure);
    put(modulus, At::modulus);
  }

  BlockLaw const* law_;
  double kappa_local_, shock_, dt_, time_;
  Wanted wanted_;
  Index first_, last_;
  FailureSlot* failure_;
  View in_;
  WriteView out_;
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
