// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/math/lanes.hpp"
#include "piola/neighbours/record_gather.hpp"
#include <cstring>

/// Sums over the neighbours of one particle, taken from a list. The coefficients c = (s p(r), G) of a pair form one
/// vector, which multiplies whole rows: of the motion of the neighbour in the first sweep, of its stress in the second.
/// Nothing is transposed; lanes are added only at the end.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Layout of the particle records. A coefficient vector has the monomials without the constant first, then the
/// gradient.
template <int D>
struct Records {
  static constexpr int terms = Quadratic<D>::terms, used = terms + D;
  static constexpr int width = (used + 7) / 8 * 8;  ///< of a row of sums, in doubles
  // Motion: X in spacings, then x from `position` on. Three values of each, and one more, are read at once.
  static constexpr int position = 4, motion_size = 8;
  static constexpr int stress_size = (D * used + 1 + 7) / 8 * 8;  ///< D rows (V Q_i k^T, P_i), and one more value
};

#if PIOLA_HAS_PACKS
/// Four values, of which loops over lists use three.
using Four [[gnu::vector_size(32)]] = double;
PIOLA_INLINE_FN Four load_four(double const* p) {
  Four r;
  std::memcpy(&r, p, sizeof r);
  return r;
}
/// s p(r) in three vectors, and G; in 2D in two vectors.
template <int D>
struct Coefficients {
  static constexpr int vectors = D == 3 ? 4 : 2;
  Four c[vectors];
  PIOLA_INLINE_FN Coefficients(Four const& r, double s, double const* G) {
    if constexpr (D == 3) {
      c[0] = s * r;
      c[1] = c[0] * (0.5 * r);
      c[2] = __builtin_shufflevector(c[0], c[0], 1, 0, 0, 3) * __builtin_shufflevector(r, r, 2, 2, 1, 3);
      c[3] = load_four(G);
    } else {
      c[0] = s * Four{r[0], r[1], 0.5 * (r[0] * r[0]), 0.5 * (r[1] * r[1])};
      c[1] = Four{s * (r[0] * r[1]), G[0], G[1], 0};
    }
  }
};
#endif

template <int D>
struct ListSums {
  using R = Records<D>;
  GradientList table;
  double const* motion;  ///< records of particles
  double const* stress;

  /// Rows (T_i, F_i) of width R::width:  T = sum_b s (x_b - x_a) (x) p(r),  F = sum_b (x_b - x_a) (x) G_ab.
  PIOLA_INLINE_FN void of_motion(Index a, double* rows) const {
    double const* const own = motion_of(a);
#if PIOLA_HAS_PACKS
    if constexpr (D > 1) {
      constexpr int vectors = Coefficients<D>::vectors, apart = D == 3 ? 3 : 4;
      Four const X = load_four(own), x = load_four(own + R::position);
      Four sum[D][vectors]{};
      for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
        double const* const other = motion_of(table.neighbour[k]);
        Coefficients<D> const of(load_four(other) - X, table.s[k], table.gradient + D * k);
        Four const moved = load_four(other + R::position) - x;
        for (int i = 0; i < D; ++i)
          for (int n = 0; n < vectors; ++n) sum[i][n] += moved[i] * of.c[n];
      }
      for (int i = 0; i < D; ++i)
        for (int n = 0; n < vectors; ++n) std::memcpy(rows + i * R::width + apart * n, &sum[i][n], sizeof(Four));
      return;
    }
#endif
    for (int c = 0; c < D * R::width; ++c) rows[c] = 0;
    for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
      double const* const other = motion_of(table.neighbour[k]);
      double c[R::used];
      coefficients(table.s[k], own, other, table.gradient + D * k, c);
      for (int i = 0; i < D; ++i) {
        double const dx = other[R::position + i] - own[R::position + i];
        for (int n = 0; n < R::used; ++n) rows[i * R::width + n] += dx * c[n];
      }
    }
  }

  /// Force of the neighbours' stresses: sum_b V_b (P_b G_ba + Q_b K_ba).
  PIOLA_INLINE_FN Vec<D> of_stress(Index a) const {
    double const* const own = motion_of(a);
    Vec<D> force;
#if PIOLA_HAS_PACKS
    if constexpr (D > 1) {
      constexpr int vectors = Coefficients<D>::vectors, apart = D == 3 ? 3 : 4;
      Four const X = load_four(own);
      Four sum[D][vectors]{};
      for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
        Index const b = table.neighbour[k];
        Coefficients<D> const of(X - load_four(motion_of(b)), table.s_back[k], table.reaction + D * k);
        double const* const other = stress_of(b);
        for (int i = 0; i < D; ++i)
          for (int n = 0; n < vectors; ++n) sum[i][n] += load_four(other + i * R::used + apart * n) * of.c[n];
      }
      for (int i = 0; i < D; ++i) {
        if constexpr (D == 3) {
          Four const all = (sum[i][0] + sum[i][1]) + (sum[i][2] + sum[i][3]);
          force[i] = all[0] + all[1] + all[2];
        } else {
          Four const first = sum[i][0], last = sum[i][1];  // the last value of `last` is that of the next row
          force[i] = ((first[0] + first[1]) + (first[2] + first[3])) + (last[0] + last[1] + last[2]);
        }
      }
      return force;
    }
#endif
    for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
      Index const b = table.neighbour[k];
      double c[R::used];
      coefficients(table.s_back[k], motion_of(b), own, table.reaction + D * k, c);
      double const* const other = stress_of(b);
      for (int i = 0; i < D; ++i)
        for (int n = 0; n < R::used; ++n) force[i] += other[i * R::used + n] * c[n];
    }
    return force;
  }

 private:
  PIOLA_INLINE_FN double const* motion_of(Index a) const {
    return motion + static_cast<std::ptrdiff_t>(a) * R::motion_size;
  }
  PIOLA_INLINE_FN double const* stress_of(Index a) const {
    return stress + static_cast<std::ptrdiff_t>(a) * R::stress_size;
  }
  /// s p(X_to - X_from), G.
  PIOLA_INLINE_FN static void coefficients(double s, double const* from, double const* to, double const* G,
                                           double (&c)[R::used]) {
    Vec<D> r;
    for (int i = 0; i < D; ++i) r[i] = to[i] - from[i];
    double p[Quadratic<D>::values];
    monomials<D>(r, p);
    for (int n = 0; n < R::terms; ++n) c[n] = s * p[1 + n];
    for (int J = 0; J < D; ++J) c[R::terms + J] = G[J];
  }
};

/// Value c of lane l goes to base[l * stride + c].
template <int N>
PIOLA_INLINE_FN void store_records(double* base, [[maybe_unused]] std::ptrdiff_t stride, Lanes const (&f)[N]) {
#if PIOLA_HAS_PACKS
  static_assert(lane_count % 4 == 0, "lanes are those of AVX or wider");
  for (int first = 0; first + 4 <= N; first += 4) {
    double rows[4 * lane_count];
    for (int c = 0; c < 4; ++c) store(f[first + c], rows + c * lane_count);
    for (int l = 0; l < lane_count; l += 4) {
      Four r[4], t[4];
      for (int c = 0; c < 4; ++c) r[c] = load_four(rows + c * lane_count + l);
      for (int c = 0; c < 4; c += 2) {
        t[c] = __builtin_shufflevector(r[c], r[c + 1], 0, 4, 2, 6);
        t[c + 1] = __builtin_shufflevector(r[c], r[c + 1], 1, 5, 3, 7);
      }
      for (int c = 0; c < 2; ++c) {
        Four const low = __builtin_shufflevector(t[c], t[c + 2], 0, 1, 4, 5),
                   high = __builtin_shufflevector(t[c], t[c + 2], 2, 3, 6, 7);
        std::memcpy(base + (l + c) * stride + first, &low, sizeof low);
        std::memcpy(base + (l + c + 2) * stride + first, &high, sizeof high);
      }
    }
  }
  for (int c = N / 4 * 4; c < N; ++c)
    for (int l = 0; l < lane_count; ++l) base[l * stride + c] = lane(f[c], l);
#else
  for (int c = 0; c < N; ++c) base[c] = f[c];
#endif
}

}  // namespace piola::nodal::inline PIOLA_BACKEND
