// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/math/lanes.hpp"
#include "piola/neighbours/pair_table_views.hpp"
#include "piola/neighbours/record_gather.hpp"
#if PIOLA_HAS_PACKS && defined(__AVX512F__)
#include <immintrin.h>
#endif

/// Sums over the neighbours of one particle, taken from a list. The coefficients c = s (P(r), mu) of a pair form one
/// vector, which multiplies whole rows: of the motion of the neighbour in the first sweep, of its stress in the second.
/// Nothing is transposed; lanes are added only at the end.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Layout of the particle records. A coefficient vector has the monomials first, then mu, then zeros.
template <int D>
struct Records {
  static constexpr int values = Quadratic<D>::values, used = values + D;
  static constexpr int width = (used + 7) / 8 * 8;  ///< of a coefficient vector, in doubles
  // Motion: X in spacings, x, mu, the constant one.
  static constexpr int position = D, mu = 2 * D, one = 3 * D;
  static constexpr int motion_size = 3 * D < 8 ? 8 : 16;
  static constexpr int stress_size = D * width;  ///< D rows (Y_i, Z_i)
};

template <int D>
struct ListSums {
  using R = Records<D>;
  ListTable table;
  double const* motion;  ///< records of particles
  double const* stress;

  /// Rows (T_i, N_i) of width R::width:  T = sum_b s (x_b - x_a) (x) P(r),  N = sum_b s (x_b - x_a) (x) mu_b.
  PIOLA_FN void of_motion(Index a, double* rows) const {
    for (int c = 0; c < D * R::width; ++c) rows[c] = 0;
    double const* const own = motion_of(a);
    for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
      double const* const other = motion_of(table.neighbour[k]);
      double c[R::width];
      coefficients(table.s[k], own, other, other, c);
      for (int i = 0; i < D; ++i) {
        double const dx = other[R::position + i] - own[R::position + i];
        for (int n = 0; n < R::width; ++n) rows[i * R::width + n] += dx * c[n];
      }
    }
  }

  /// sum_b s ( Y_b P(-r) + Z_b mu_a ): contribution of the neighbours' stresses.
  PIOLA_FN Vec<D> of_stress(Index a) const {
    double const* const own = motion_of(a);
    double rows[D * R::width];
    for (double& row : rows) row = 0;
    for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
      Index const b = table.neighbour[k];
      double c[R::width];
      coefficients(table.s[k], motion_of(b), own, own, c);
      double const* const other = stress_of(b);
      for (int n = 0; n < D * R::width; ++n) rows[n] += other[n] * c[n % R::width];
    }
    Vec<D> sum;
    for (int i = 0; i < D; ++i)
      for (int n = 0; n < R::used; ++n) sum[i] += rows[i * R::width + n];
    return sum;
  }

 private:
  PIOLA_FN double const* motion_of(Index a) const { return motion + static_cast<std::ptrdiff_t>(a) * R::motion_size; }
  PIOLA_FN double const* stress_of(Index a) const { return stress + static_cast<std::ptrdiff_t>(a) * R::stress_size; }
  /// s (P(X_to - X_from), mu of `bearer`).
  PIOLA_FN static void coefficients(double s, double const* from, double const* to, double const* bearer,
                                    double (&c)[R::width]) {
    Vec<D> r;
    for (int i = 0; i < D; ++i) r[i] = to[i] - from[i];
    double p[R::values];
    monomials<D>(r, p);
    for (int n = 0; n < R::values; ++n) c[n] = s * p[n];
    for (int J = 0; J < D; ++J) c[R::values + J] = s * bearer[R::mu + J];
    for (int n = R::used; n < R::width; ++n) c[n] = 0;
  }
};

#if PIOLA_HAS_PACKS && defined(__AVX512F__)
/// Coefficient vectors of three dimensions in two registers, as products of permuted values.
struct Coefficients {
  __m512i low_a = _mm512_setr_epi64(9, 0, 1, 2, 0, 1, 2, 1), low_b = _mm512_setr_epi64(9, 9, 9, 9, 0, 1, 2, 2);
  __m512i high_a = _mm512_setr_epi64(0, 0, 6, 7, 8, 10, 10, 10), high_b = _mm512_setr_epi64(2, 1, 9, 9, 9, 9, 9, 9);
  __m512d half = _mm512_setr_pd(1, 1, 1, 1, 0.5, 0.5, 0.5, 1);
  __m512d low, high;

  /// d: r, three unused values, mu_1, mu_2;  rest: mu_3, one, zeros.
  void operator()(__m512d d, __m512d rest, double s) {
    __m512d const weight = _mm512_set1_pd(s);
    low = _mm512_mul_pd(_mm512_mul_pd(_mm512_permutex2var_pd(d, low_a, rest), _mm512_permutex2var_pd(d, low_b, rest)),
                        _mm512_mul_pd(weight, half));
    high = _mm512_mul_pd(
        _mm512_mul_pd(_mm512_permutex2var_pd(d, high_a, rest), _mm512_permutex2var_pd(d, high_b, rest)), weight);
  }
};

template <>
inline void ListSums<3>::of_motion(Index a, double* rows) const {
  Coefficients c;
  __m512d low[3], high[3];
  for (int i = 0; i < 3; ++i) low[i] = high[i] = _mm512_setzero_pd();
  __m512d const own = _mm512_maskz_loadu_pd(0x3f, motion_of(a));  // without mu
  for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
    double const* const other = motion_of(table.neighbour[k]);
    __m512d const d = _mm512_sub_pd(_mm512_loadu_pd(other), own);
    c(d, _mm512_loadu_pd(other + 8), table.s[k]);
    for (int i = 0; i < 3; ++i) {
      __m512d const dx = _mm512_permutexvar_pd(_mm512_set1_epi64(3 + i), d);
      low[i] = _mm512_fmadd_pd(dx, c.low, low[i]);
      high[i] = _mm512_fmadd_pd(dx, c.high, high[i]);
    }
  }
  for (int i = 0; i < 3; ++i) {
    _mm512_storeu_pd(rows + 16 * i, low[i]);
    _mm512_storeu_pd(rows + 16 * i + 8, high[i]);
  }
}

template <>
inline Vec<3> ListSums<3>::of_stress(Index a) const {
  Coefficients c;
  __m512d low[3], high[3];
  for (int i = 0; i < 3; ++i) low[i] = high[i] = _mm512_setzero_pd();
  __m512d const own = _mm512_loadu_pd(motion_of(a)), rest = _mm512_loadu_pd(motion_of(a) + 8);
  for (std::int64_t k = table.begin[a]; k < table.begin[a + 1]; ++k) {
    Index const b = table.neighbour[k];
    c(_mm512_sub_pd(own, _mm512_maskz_loadu_pd(0x07, motion_of(b))), rest, table.s[k]);
    double const* const other = stress_of(b);
    for (int i = 0; i < 3; ++i) {
      low[i] = _mm512_fmadd_pd(_mm512_loadu_pd(other + 16 * i), c.low, low[i]);
      high[i] = _mm512_fmadd_pd(_mm512_loadu_pd(other + 16 * i + 8), c.high, high[i]);
    }
  }
  Vec<3> sum;
  for (int i = 0; i < 3; ++i) sum[i] = _mm512_reduce_add_pd(_mm512_add_pd(low[i], high[i]));
  return sum;
}

/// Inverse of load_records for successive records: value c of lane l goes to base[l * stride + c]. N is a multiple of
/// 8.
template <int N>
PIOLA_FN void store_records(double* base, std::ptrdiff_t stride, Lanes const (&f)[N]) {
  static_assert(N % 8 == 0);
  for (int first = 0; first < N; first += 8) {
    __m512d r[8];
    for (int c = 0; c < 8; ++c) r[c] = static_cast<__m512d>(f[first + c]);
    piola::PIOLA_BACKEND::detail::transpose(r);
    for (int l = 0; l < 8; ++l) _mm512_storeu_pd(base + l * stride + first, r[l]);
  }
}
#else
template <int N>
PIOLA_FN void store_records(double* base, std::ptrdiff_t stride, Lanes const (&f)[N]) {
  for (int l = 0; l < lane_count; ++l)
    for (int c = 0; c < N; ++c) base[l * stride + c] = lane(f[c], l);
}
#endif

/// Stores component c of the rows (Y, Z) of the lanes at i for the second sweep: in records for lists, component after
/// component for lattices.
template <int D>
PIOLA_FN void put_row(WriteView const& stress, Index i, int c, Lanes (&row)[Records<D>::width]) {
  if (stress.particle_stride == 1) {
    for (int m = 0; m < Records<D>::used; ++m) stress.scalar(i, row[m], c * Records<D>::used + m);
    return;
  }
  for (int m = Records<D>::used; m < Records<D>::width; ++m) row[m] = Lanes(0.0);
  store_records(stress.data + i * stress.particle_stride + c * Records<D>::width, stress.particle_stride, row);
}

}  // namespace piola::nodal::inline PIOLA_BACKEND
