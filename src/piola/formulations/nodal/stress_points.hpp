// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/block_law_cells.hpp"
#include "piola/formulations/nodal/passes.hpp"
#include "piola/formulations/nodal/solid_cells.hpp"
#include "piola/formulations/nodal/stress_free.hpp"
#include "piola/formulations/nodal/stress_resultants.hpp"
#include "piola/formulations/nodal/viscosity.hpp"
#include "piola/materials/laws.hpp"
#include "piola/math/embedding.hpp"

/// The energy of a cell, from a few points of it. Theory: docs/theory/nodal.md, section 2.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Energy of a cell from its points:
///   W = mean_q [ Wiso(F_q) + kappa_l ln(Jm / J_q) ] + kappa/2 (Jm - 1)^2,   Jm = mean_q J_q,
/// for laws whose energy is an isochoric part plus kappa/2 (J - 1)^2. In small strain J = 1 + tr e, and the logarithm
/// is kappa_l/2 (J_q - Jm)^2. For other laws the mean of W at the gradients (Jm / J_q)^(1/3) F_q replaces the
/// isochoric and the volumetric part, which is equivalent for laws with a split.
template <class Law, int Points, bool WithEnergy>
struct CellEnergy {
  Law law;
  double kappa, kappa_local;
  Mat<3, Lanes> F[Points];
  Mat<3, Lanes> P[Points];
  Lanes J[Points], mean_J, least_J, energy;

  /// P and energy from F.
  PIOLA_INLINE_FN void operator()() {
    volume_ratios();
    if constexpr (Law::volumetric_split)
      split();
    else
      whole();
  }

  /// As above if the directions from D on are free of stress, each point by itself: F is completed by the solution.
  /// Nothing locks there, so that every point has the energy of its own volume ratio.
  template <int D>
  PIOLA_INLINE_FN void without_lateral_stress() {
    StressFree<D, Law> const relax(law);
    for (int q = 0; q < Points; ++q) relax(F[q]);
    volume_ratios();
    for (int q = 0; q < Points; ++q) {
      P[q] = law.first_piola(F[q]);
      if constexpr (WithEnergy) energy = energy + (1.0 / Points) * law.energy(F[q]);
    }
  }

 private:
  PIOLA_INLINE_FN void volume_ratios() {
    mean_J = energy = Lanes(0.0);
    for (int q = 0; q < Points; ++q) {
      J[q] = volume_ratio_of(Law::small_strain, F[q]);
      mean_J = mean_J + (1.0 / Points) * J[q];
      least_J = q == 0 ? J[q] : minimum(least_J, J[q]);
    }
  }
  PIOLA_INLINE_FN Mat<3, Lanes> area_map(int q) const {
    if constexpr (Law::small_strain)
      return identity<3, Lanes>();
    else
      return cofactor(F[q]);
  }
  /// Pressure of the logarithm at a point [Pa].
  PIOLA_INLINE_FN Lanes spread_pressure(int q) const {
    if constexpr (Law::small_strain)
      return kappa_local * (J[q] - mean_J);
    else
      return kappa_local * (1.0 / mean_J - 1.0 / J[q]);
  }
  PIOLA_INLINE_FN Lanes spread_energy(int q) const {
    if constexpr (Law::small_strain)
      return (0.5 * kappa_local) * ((J[q] - mean_J) * (J[q] - mean_J));
    else
      return kappa_local * logarithm(mean_J / J[q]);
  }

  PIOLA_INLINE_FN void split() {
    Lanes const change = mean_J - 1.0;
    for (int q = 0; q < Points; ++q) {
      Mat<3, Lanes> const H = area_map(q);
      P[q] = law.stress_with_pressure(F[q], H, J[q], Lanes(kappa * change + spread_pressure(q)));
      if constexpr (WithEnergy)
        energy = energy + (1.0 / Points) * (law.isochoric_energy(F[q], H, J[q]) + spread_energy(q));
    }
    energy = energy + (0.5 * kappa) * (change * change);
  }

  PIOLA_INLINE_FN void whole() {
    Lanes work[Points], mean_work = Lanes(0.0), scale[Points];
    for (int q = 0; q < Points; ++q) {
      scale[q] = power_minus_third(J[q] / mean_J);
      Mat<3, Lanes> const even = scale[q] * F[q];
      P[q] = law.first_piola(even);
      work[q] = (1.0 / 3.0) * contract(P[q], even);
      mean_work = mean_work + (1.0 / Points) * work[q];
      if constexpr (WithEnergy) energy = energy + (1.0 / Points) * (law.energy(even) + spread_energy(q));
    }
    for (int q = 0; q < Points; ++q)
      P[q] = scale[q] * P[q] + Lanes(mean_work / mean_J - work[q] / J[q] + spread_pressure(q)) * area_map(q);
  }
};

/// First sums to stress resultants: F_a, H_a, the points, P_a and Q_a,
/// which the second sweep reads at neighbours, and the particle's own part of its force,
/// V_a (P_a sum_b G_ab + Q_a sum_b K_ab). Records the first particle with a point of J <= 0 or not a number.
template <int D, class Law, bool Observed>
struct UpdateStress {
  static constexpr int points = Quadratic<D>::points, numbers = MotionSums<D>::numbers;
  Law law;
  Constants constants;
  StressResultants<D> out;
  View offset, C_measured;
  WriteView C_marked;
  bool marks;
  View kept;
  Viscosity<D> viscosity;
  WriteView change, F_out, P_out, cell;
  FailureSlot* failure;

  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    CellPoints<D> at = cell_points<D>(out.L, out.has_hoop(), i, in);
    if (offset.data != nullptr) at.F = at.F + offset.matrix<D, Lanes>(i);
    CellEnergy<Law, points, Observed> energy{law, constants.kappa, constants.kappa_local, {}, {}, {}, {}, {}, {}};
    for (int q = 0; q < points; ++q) energy.F[q] = at.whole_at(q);
    if constexpr (std::is_same_v<Law, SolidCells<D>> || std::is_same_v<Law, BlockLawCells<D>>)
      law(i, energy);
    else if (D < 3 && constants.stress_free)
      energy.template without_lateral_stress<D>();
    else
      energy();
    // Observed stress is that of the law alone.
    if (!Observed && viscosity.on()) viscosity.template add<Law::small_strain>(i, at, energy);
    if constexpr (Observed)
      put_output_fields(i, at, energy);
    else {
      Lanes const allowed = constants.least_share * kept.template scalar<Lanes>(i, 3 * D);
      if (any(!(energy.least_J > maximum(allowed, Lanes(0.0))))) record_failure(i, energy.least_J, allowed);
      Lanes largest = largest_change(i, at.F);
      if constexpr (std::is_same_v<Law, SolidCells<D>>) largest = law.where_used(i, largest);
      change.scalar(i, largest, 0);
      change.scalar(i, energy.least_J, 1);
      Lanes rows[D][numbers];
      out.rows_of(i, energy.P, rows);
      Lanes q[3]{};
      if (out.has_hoop()) out.hoop_of(i, energy.P, q);
      out.put(i, rows, q);
    }
  }

 private:
  /// Largest change of a component of F^T F / 2 since the last measurement of the step, relative to its value there:
  /// 0.1 is a tenth of a stretch.
  PIOLA_INLINE_FN Lanes largest_change(Index i, Mat<D, Lanes> const& F) const {
    SymMat<D, Lanes> const measured = C_measured.symmetric<D, Lanes>(i);
    Lanes most = Lanes(0.0);
    for (int J = 0; J < D; ++J)
      for (int K = J; K < D; ++K) {
        Lanes C = F(0, J) * F(0, K);
        for (int c = 1; c < D; ++c) C = C + F(c, J) * F(c, K);
        if (marks) C_marked.scalar(i, C, SymMat<D>::at(J, K));
        Lanes const moved = 0.5 * (C - measured(J, K)) /
                            minimum(Lanes(1.0), maximum(Lanes(1e-12), square_root(measured(J, J) * measured(K, K))));
        most = maximum(most, maximum(moved, 0.0 - moved));
      }
    return most;
  }
  PIOLA_FN void put_output_fields(Index i, CellPoints<D> const& at,
                                  CellEnergy<Law, points, Observed> const& energy) const {
    F_out.matrix<D>(i, at.F);
    Mat<3, Lanes> P = (1.0 / points) * energy.P[0];
    for (int q = 1; q < points; ++q) P = P + (1.0 / points) * energy.P[q];
    P_out.matrix<3>(i, P);
    cell.scalar(i, energy.energy, 0);
    cell.scalar(i, energy.mean_J, 1);
    cell.scalar(i, energy.least_J, 2);
    Lanes lateral = energy.F[0](2, 2);
    for (int q = 1; q < points; ++q) lateral = lateral + energy.F[q](2, 2);
    cell.scalar(i, (1.0 / points) * lateral, 3);
  }

  PIOLA_FN void record_failure(Index i, Lanes const& least, Lanes const& allowed) const {
    for (int l = 0; l < lane_count; ++l)
      if (!(lane(least, l) > 0) || !(lane(least, l) > lane(allowed, l))) exec::record(failure, i + l, 1);
  }
};

/// offset_a -= F(X_a), the gradient of positions at the particle, F_a - H_a.c_a with the centroid c_a of the cell.
template <int D>
struct SubtractGradients {
  static constexpr int numbers = MotionSums<D>::numbers;
  View centroid, offset;
  WriteView offset_out;

  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    Vec<D, Lanes> const far = centroid.vector<D, Lanes>(i);
    Mat<D, Lanes> r = offset.matrix<D, Lanes>(i);
    for (int c = 0; c < D; ++c)
      for (int J = 0; J < D; ++J) {
        r(c, J) = r(c, J) - load<Lanes>(in.at(i, c * numbers + J));
        for (int K = 0; K < D; ++K)
          r(c, J) = r(c, J) + load<Lanes>(in.at(i, c * numbers + D + Quadratic<D>::at(J, K))) * far[K];
      }
    offset_out.matrix<D>(i, r);
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
