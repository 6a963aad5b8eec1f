// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/taylor_sph/state.hpp"

/// Linear and angular momentum of a body, and the rigid motion that restores them: interpolation between two sets of
/// particles does not conserve them.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// Sums the motion of the real particles of a range.
template <int D>
struct SumMotion {
  double const* real;
  View mass;
  Index last;
  double* partial;  ///< [block][MotionSums::size]

  PIOLA_FN void operator()(Range b, Index block) const {
    double* const sum = partial + MotionSums::size * block;
    for (int k = 0; k < MotionSums::size; ++k) sum[k] = 0;
    for (Index i = b.first; i < b.last && i < last; ++i) add(i, sum);
  }

 private:
  PIOLA_FN void add(Index i, double* sum) const {
    using S = MotionSums;
    static constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
    double const m = mass.scalar<double>(i);
    double x[3] = {}, v[3] = {};
    for (int c = 0; c < D; ++c) {
      x[c] = real[i * Record<D>::stride + Record<D>::x + c];
      v[c] = real[i * Record<D>::stride + Record<D>::v + c];
    }
    sum[S::mass] += m;
    for (int c = 0; c < 3; ++c) {
      int const p = (c + 1) % 3, q = (c + 2) % 3;
      sum[S::x + c] += m * x[c];
      sum[S::v + c] += m * v[c];
      sum[S::moment + c] += m * (x[p] * v[q] - x[q] * v[p]);
    }
    for (int k = 0; k < 6; ++k) sum[S::xx + k] += m * x[row[k]] * x[column[k]];
  }
};

/// Adds a rigid motion to the velocities.
template <int D>
struct AddRigidMotion {
  double* real;
  double spin[3], push[3], centre[3];

  PIOLA_FN void operator()(Index i) const {
    for (Index p = i; p < i + lane_count; ++p) {
      double* const own = real + p * Record<D>::stride;
      double arm[3] = {};
      for (int c = 0; c < D; ++c) arm[c] = own[Record<D>::x + c] - centre[c];
      for (int c = 0; c < D; ++c) {
        int const a = (c + 1) % 3, b = (c + 2) % 3;
        own[Record<D>::v + c] += push[c] + spin[a] * arm[b] - spin[b] * arm[a];
      }
    }
  }
};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
