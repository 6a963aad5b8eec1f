// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/cell_passes.hpp"
#include "piola/formulations/taylor_sph/filter_passes.hpp"
#include "piola/formulations/taylor_sph/rates.hpp"

/// The adjoint exchange: forces leave a cell by the transpose of the gradient that strains it, so that energy and
/// momenta balance on any set of particles. A cell's virtual particle is its single point; gradients are those of its
/// corners instead of kernel sums. Theory, with the energy balance: docs/theory/taylor-sph.md.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// The corners of a cell at half time, for both cell passes.
template <int D>
struct CornerMotion {
  CornerPositions<D> place;
  Vec<D, Lanes> v[CornerPositions<D>::most];
  SymMat<D, Lanes> s[CornerPositions<D>::most];
};

/// Elastic resistance of boxes to the patterns that their middle does not see (Flanagan and Belytschko 1981), of boxes
/// only:  gamma_k = h_k - sum_j h_j x_j . g_k,   stiffness 0.05 D_11 V sum |g|^2 / 8.
template <int D>
PIOLA_FN Lanes hourglass_vector(CornerMotion<D> const& corner, CellGradients<D> const& cell, int pattern, int k) {
  Lanes sum(Patterns<D>::sign(pattern, k));
  for (int b = 0; b < D; ++b) {
    Lanes moment(0.0);
    for (int j = 0; j < Patterns<D>::corners; ++j)
      moment = moment + Patterns<D>::sign(pattern, j) * corner.place.x[j][b];
    sum = sum - moment * cell.g[k][b];
  }
  return sum;
}
template <int D>
PIOLA_FN Lanes hourglass_stiffness(Constants const& k, CellGradients<D> const& cell) {
  Lanes sum(0.0);
  for (int c = 0; c < CornerPositions<D>::most; ++c) sum = sum + dot(cell.g[c], cell.g[c]);
  return (k.hourglass_stiffness * k.modulus / 8) * (cell.volume * sum);
}

/// Real to virtual: the stress of half time of each cell, and the forces that it puts on its corners,
///   s_J = turned_half[ (1 - b) <s>_J + b t_J ] + dt/2 D:d_J(v),     force_Jk = V_J s_J . g_Jk
template <int D, class Law>
struct CornerForces {
  Law law;
  Constants k;
  CellTable cells;
  CellState state;
  double const* real;
  double* virtual_;
  double dt;

  PIOLA_FN void operator()(Index i) const {
    using R = Record<D>;
    CornerMotion<D> corner;
    load(i, corner);
    auto const cell = cell_gradients<D>(corner.place, cells.simplices);
    Mat<D, Lanes> L{};
    SymMat<D, Lanes> s{};
    for (int n = 0; n < cells.corners; ++n) {
      L = L + outer(corner.v[n], cell.g[n]);
      for (int c = 0; c < R::stress; ++c) s.c[c] = s.c[c] + corner.s[n].c[c];
    }
    double const mean = (1 - k.stress_retention) / cells.corners;
    for (int c = 0; c < R::stress; ++c) {
      double own[lane_count];
      for (int l = 0; l < lane_count; ++l) own[l] = virtual_[static_cast<std::ptrdiff_t>(i + l) * R::stride + R::s + c];
      s.c[c] = mean * s.c[c] + k.stress_retention * load_lanes(own);
    }
    if (k.moving) s = turned(s, cayley(L, 0.5 * dt));
    auto const rate = elastic_rate<D>(law, k.lateral, L);
    for (int c = 0; c < R::stress; ++c) s.c[c] = s.c[c] + (0.5 * dt) * rate.in_plane.c[c];
    Vec<D, Lanes> force[CornerPositions<D>::most];
    for (int n = 0; n < cells.corners; ++n)
      for (int a = 0; a < D; ++a) {
        Lanes sum = s(a, 0) * cell.g[n][0];
        for (int b = 1; b < D; ++b) sum = sum + s(a, b) * cell.g[n][b];
        force[n][a] = cell.volume * sum;
      }
    if constexpr (D > 1)
      if (!cells.simplices && k.hourglass_stiffness > 0) add_hourglass_forces(corner, cell, i, force);
    for (int l = 0; l < lane_count; ++l) {
      virtual_[static_cast<std::ptrdiff_t>(i + l) * R::stride + R::volume] = lane(cell.volume, l);
      double* const out = state.force + static_cast<std::ptrdiff_t>(i + l) * cells.corners * D;
      for (int n = 0; n < cells.corners; ++n)
        for (int a = 0; a < D; ++a) out[n * D + a] = lane(force[n][a], l);
    }
  }

 private:
  PIOLA_FN static Lanes load_lanes(double const (&values)[lane_count]) { return piola::load<Lanes>(values); }
  PIOLA_FN void load(Index i, CornerMotion<D>& corner) const {
    using R = Record<D>;
    corner.place.count = cells.corners;
    for (int n = 0; n < cells.corners; ++n) {
      Lanes f[R::values];
      load_records(real, R::stride,
                   cells.corner + (static_cast<std::ptrdiff_t>(i / lane_count) * cells.corners + n) * lane_count, f);
      for (int c = 0; c < D; ++c) {
        corner.v[n][c] = f[R::v + c];
        corner.place.x[n][c] = k.moving ? f[R::x + c] + (0.5 * dt) * f[R::v + c] : f[R::x + c];
      }
      for (int c = 0; c < R::stress; ++c) corner.s[n].c[c] = f[R::s + c];
    }
  }
  PIOLA_FN void add_hourglass_forces(CornerMotion<D> const& corner, CellGradients<D> const& cell, Index i,
                                     Vec<D, Lanes> (&force)[CornerPositions<D>::most]) const {
    Lanes const stiffness = hourglass_stiffness<D>(k, cell);
    for (int p = 0; p < Patterns<D>::count; ++p) {
      Lanes gamma[CornerPositions<D>::most];
      Vec<D, Lanes> q{};
      for (int n = 0; n < cells.corners; ++n) {
        gamma[n] = hourglass_vector<D>(corner, cell, p, n);
        q = q + (0.5 * dt * gamma[n]) * corner.v[n];
      }
      for (int c = 0; c < D; ++c) {
        double own[lane_count];
        for (int l = 0; l < lane_count; ++l) own[l] = state.hourglass_of<D>(i + l, p)[c];
        q[c] = q[c] + load_lanes(own);
      }
      for (int n = 0; n < cells.corners; ++n) force[n] = force[n] + (stiffness * gamma[n]) * q;
    }
  }
};

/// Strains of the cells by the mean velocity of the step: their own stress, and V_J L_J for its corners.
/// Sums V L:D:L, per block.
template <int D, class Law>
struct StrainCells {
  Law law;
  Constants k;
  CellTable cells;
  CellState state;
  double const* real;
  View drift;
  double* virtual_;
  Index last;  ///< number of cells
  double* partial;
  double dt;

  PIOLA_FN void operator()(Range b, Index block) const {
    double sum = 0;
    for (Index i = b.first; i < b.last; i += lane_count) {
      Lanes const square = strain(i);
      for (int l = 0; l < lane_count && i + l < last; ++l) sum += lane(square, l);
    }
    partial[block] = sum;
  }

 private:
  PIOLA_FN Lanes strain(Index i) const {
    using R = Record<D>;
    CornerMotion<D> corner;
    load(i, corner);
    auto const cell = cell_gradients<D>(corner.place, cells.simplices);
    Mat<D, Lanes> L{};
    for (int n = 0; n < cells.corners; ++n) L = L + outer(corner.v[n], cell.g[n]);
    Lanes own[R::values];
    load_local<D>(virtual_, i, own);
    SymMat<D, Lanes> t;
    for (int c = 0; c < R::stress; ++c) t.c[c] = own[R::s + c];
    Lanes across = piola::load<Lanes>(state.across + i);
    advance_stress<D>(law, k, L, dt, t, across);
    for (int l = 0; l < lane_count; ++l) {
      double* const record = virtual_ + static_cast<std::ptrdiff_t>(i + l) * R::stride;
      for (int c = 0; c < R::stress; ++c) record[R::s + c] = lane(t.c[c], l);
      state.across[i + l] = lane(across, l);
      for (int c = 0; c < D * D; ++c)
        state.gradient[static_cast<std::ptrdiff_t>(i + l) * D * D + c] = lane(cell.volume * L.c[c], l);
    }
    if constexpr (D > 1)
      if (!cells.simplices && k.hourglass_stiffness > 0) advance_patterns(corner, cell, L, i);
    return cell.volume * elastic_square<D>(law, k.lateral, L);
  }
  /// Positions at half time and mean velocities: x^h = x + dt/2 v with v = 2 <v> - present v.
  PIOLA_FN void load(Index i, CornerMotion<D>& corner) const {
    using R = Record<D>;
    corner.place.count = cells.corners;
    for (int n = 0; n < cells.corners; ++n) {
      Index const* const at =
          cells.corner + (static_cast<std::ptrdiff_t>(i / lane_count) * cells.corners + n) * lane_count;
      Lanes f[R::v + D];
      load_records(real, R::stride, at, f);
      for (int c = 0; c < D; ++c) {
        double mean[lane_count];
        for (int l = 0; l < lane_count; ++l) mean[l] = drift.scalar<double>(at[l], c);
        corner.v[n][c] = piola::load<Lanes>(mean);
        Lanes const before = 2.0 * corner.v[n][c] - f[R::v + c];
        corner.place.x[n][c] = k.moving ? f[R::x + c] + (0.5 * dt) * before : f[R::x + c];
      }
    }
  }
  PIOLA_FN void advance_patterns(CornerMotion<D> const& corner, CellGradients<D> const& cell, Mat<D, Lanes> const& L,
                                 Index i) const {
    Mat<D, Lanes> const turn = cayley(L, dt);
    for (int p = 0; p < Patterns<D>::count; ++p) {
      Vec<D, Lanes> q;
      for (int c = 0; c < D; ++c) {
        double own[lane_count];
        for (int l = 0; l < lane_count; ++l) own[l] = state.hourglass_of<D>(i + l, p)[c];
        q[c] = piola::load<Lanes>(own);
      }
      if (k.moving) q = turn * q;
      for (int n = 0; n < cells.corners; ++n) q = q + (dt * hourglass_vector<D>(corner, cell, p, n)) * corner.v[n];
      for (int l = 0; l < lane_count; ++l)
        for (int c = 0; c < D; ++c) state.hourglass_of<D>(i + l, p)[c] = lane(q[c], l);
    }
  }
};

/// Energies of the cells, and the correction for the staggered times of velocity and stress; per block: V t:D^-1:t / 2,
/// hourglass energy, V L:D:L of the present velocities.
template <int D, class Law>
struct CellEnergies {
  Law law;
  Constants k;
  CellTable cells;
  CellState state;
  double const* real;
  double const* virtual_;
  Index last;
  double* partial;
  static constexpr int results = 3;

  PIOLA_FN void operator()(Range b, Index block) const {
    double sum[results] = {};
    for (Index i = b.first; i < b.last; i += lane_count) add(i, sum);
    for (int c = 0; c < results; ++c) partial[results * block + c] = sum[c];
  }

 private:
  PIOLA_FN void add(Index i, double (&sum)[results]) const {
    using R = Record<D>;
    CornerPositions<D> const corner = load_corners<D>(cells, real, i);
    auto const cell = cell_gradients<D>(corner, cells.simplices);
    Mat<D, Lanes> L{};
    for (int n = 0; n < cells.corners; ++n) {
      Lanes f[R::v + D];
      load_records(real, R::stride,
                   cells.corner + (static_cast<std::ptrdiff_t>(i / lane_count) * cells.corners + n) * lane_count, f);
      Vec<D, Lanes> v;
      for (int c = 0; c < D; ++c) v[c] = f[R::v + c];
      L = L + outer(v, cell.g[n]);
    }
    Lanes const square = cell.volume * elastic_square<D>(law, k.lateral, L);
    Lanes stiffness(0.0);
    if constexpr (D > 1)
      if (!cells.simplices) stiffness = hourglass_stiffness<D>(k, cell);
    for (int l = 0; l < lane_count && i + l < last; ++l) {
      sum[0] += lane(cell.volume, l) * stored(i + l);
      sum[2] += lane(square, l);
      if (cells.simplices) continue;
      for (int p = 0; p < Patterns<D>::count; ++p)
        for (int c = 0; c < D; ++c) {
          double const q = state.hourglass_of<D>(i + l, p)[c];
          sum[1] += 0.5 * lane(stiffness, l) * q * q;
        }
    }
  }
  PIOLA_FN double stored(Index i) const {
    double const* const own = virtual_ + static_cast<std::ptrdiff_t>(i) * Record<D>::stride + Record<D>::s;
    SymMat<3> s{};
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) s(a, b) = own[SymMat<D>::at(a, b)];
    if (D == 2) s(2, 2) = state.across[i];
    return law.energy_of_stress(s);
  }
};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
