// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/cell_points.hpp"
#include "piola/formulations/nodal/passes.hpp"

/// From the sums of the first sweep to the gradients at the points of a cell, and from the stresses there to what the
/// second sweep sums. Theory: docs/theory/nodal.md, section 2.
namespace piola::nodal::inline PIOLA_BACKEND {

/// The gradients of a cell from the sums of the motion. L: of the cell's spread. with_hoop: the body is axisymmetric.
template <int D>
PIOLA_INLINE_FN CellPoints<D> cell_points(ReferenceView const& L, bool with_hoop, Index i, exec::Scratch const& in) {
  constexpr int numbers = MotionSums<D>::numbers;
  CellPoints<D> r;
  LanesOfField const spread = lanes_of(L, i);
  for (int c = 0; c < D; ++c) {
    for (int J = 0; J < D; ++J) r.F(c, J) = load<Lanes>(in.at(i, c * numbers + J));
    for (int m = 0; m < D; ++m)
      for (int J = 0; J < D; ++J) {
        Lanes sum = Lanes(0.0);
        for (int K = m; K < D; ++K)
          sum = sum + load<Lanes>(in.at(i, c * numbers + D + Quadratic<D>::at(J, K))) * spread[K * D + m];
        r.along[m](c, J) = sum;
      }
  }
  if constexpr (D == 2)
    for (int n = 0; n < 3; ++n)
      r.hoop[n] = with_hoop ? load<Lanes>(in.at(i, MotionSums<D>::hoop_sums + n)) : Lanes(n == 0 ? 1.0 : 0.0);
  return r;
}

/// Stress resultants (P, Q) of cells, row after row: the work of the stresses is P : dF + Q : dH.
template <int D>
struct StressResultants {
  static constexpr int second = Quadratic<D>::second, points = Quadratic<D>::points, numbers = MotionSums<D>::numbers;
  Index particles;                   ///< slots after them are empty
  ReferenceView V, L, k, own, hoop;  ///< hoop: no data unless the body is axisymmetric
  WriteView stress, a;

  PIOLA_INLINE_FN bool has_hoop() const { return D == 2 && hoop.stored.data != nullptr; }

  /// From the stresses P_q of the points.
  PIOLA_INLINE_FN void rows_of(Index i, Mat<3, Lanes> const (&P_at)[points], Lanes (&rows)[D][numbers]) const {
    LanesOfField const spread = lanes_of(L, i);
    Mat<D, Lanes> mean, along[D];
    for (int q = 0; q < points; ++q) {
      Mat<D, Lanes> const P = (1.0 / points) * restrict_to<D>(P_at[q]);
      mean = q == 0 ? P : mean + P;
      for (int m = 0; m < D; ++m) {
        if (q == 0)
          along[m] = Quadratic<D>::point(q, m) * P;
        else
          along[m] = Quadratic<D>::point(q, m) > 0 ? along[m] + P : along[m] - P;
      }
    }
    for (int c = 0; c < D; ++c) {
      for (int J = 0; J < D; ++J) rows[c][J] = mean(c, J);
      for (int J = 0; J < D; ++J)
        for (int K = J; K < D; ++K) {
          Lanes sum = Lanes(0.0);
          for (int m = 0; m < D; ++m) {
            sum = sum + along[m](c, J) * spread[K * D + m];
            if (J != K) sum = sum + along[m](c, K) * spread[J * D + m];
          }
          rows[c][D + Quadratic<D>::at(J, K)] = sum;
        }
      if (i + lane_count > particles) clear_empty(i, rows[c]);
    }
  }

  /// Resultants of P_33: its work is q . d eta, see HoopSums.
  PIOLA_INLINE_FN void hoop_of(Index i, Mat<3, Lanes> const (&P_at)[points], Lanes (&q)[3]) const {
    for (int n = 0; n < 3; ++n) q[n] = Lanes(0.0);
    for (int p = 0; p < points; ++p) {
      Lanes const P = (1.0 / points) * P_at[p](2, 2);
      q[0] = q[0] + P;
      for (int m = 0; m < 2; ++m) q[1 + m] = Quadratic<2>::point(p, m) > 0 ? q[1 + m] + P : q[1 + m] - P;
    }
    if (i + lane_count > particles) clear_empty(i, q);
  }

  /// Stores them for the neighbours, and the particle's own part of its force in `a`. q: of P_33 if the body is
  /// axisymmetric.
  PIOLA_INLINE_FN void put(Index i, Lanes const (&rows)[D][numbers], Lanes const (&q)[3]) const {
    LanesOfField const sums = lanes_of(own, i);
    Lanes const volume = V.scalar<Lanes>(i);
    for (int c = 0; c < D; ++c) {
      Lanes own_force = Lanes(0.0);
      for (int n = 0; n < numbers; ++n) own_force = own_force + rows[c][n] * sums[n];
      if (c == 0 && has_hoop())
        for (int n = 0; n < 3; ++n)
          own_force = own_force + q[n] * lanes_of(hoop, i)[static_cast<int>(HoopSums::own) + n];
      a.scalar(i, Lanes(volume * own_force), c);
      put_row(i, c, rows[c], q);
    }
  }

 private:
  /// Slots without a particle must hold finite numbers, which neighbours on a lattice read.
  template <int N>
  PIOLA_FN void clear_empty(Index i, Lanes (&row)[N]) const {
    double here[lane_count];
    for (int l = 0; l < lane_count; ++l) here[l] = i + l < particles ? 1 : 0;
    for (Lanes& number : row) number = select(load<Lanes>(here) > 0.5, number, Lanes(0.0));
  }
  /// Component c of (P, Q) for lattices; in records of lists (V Q k^T, P), because weights s do not hold the volume.
  PIOLA_INLINE_FN void put_row(Index i, int c, Lanes const (&row)[numbers], Lanes const (&q)[3]) const {
    if (stress.particle_stride == 1) {
      for (int n = 0; n < numbers; ++n) stress.scalar(i, row[n], c * numbers + n);
      return;
    }
    using R = Records<D>;
    LanesOfField const to_H = lanes_of(k, i);
    Lanes const volume = V.scalar<Lanes>(i);
    Lanes record[R::used];
    for (int m = 0; m < R::terms; ++m) {
      Lanes sum = row[D] * to_H[m * second];
      for (int n = 1; n < second; ++n) sum = sum + row[D + n] * to_H[m * second + n];
      if (c == 0 && has_hoop())
        for (int n = 0; n < 3; ++n) sum = sum + q[n] * lanes_of(hoop, i)[m * static_cast<int>(HoopSums::numbers) + n];
      record[m] = volume * sum;
    }
    for (int J = 0; J < D; ++J) record[R::terms + J] = row[J];
    store_records(stress.data + i * stress.particle_stride + c * R::used, stress.particle_stride, record);
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
