// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

/// Gathering whole records of neighbours (load and transpose) and adding up lanes. A gather instruction costs as much
/// as the scalar loads it replaces; loading each neighbour's record as a vector and transposing is two to four times
/// faster.
namespace piola::inline PIOLA_BACKEND {

#if PIOLA_HAS_PACKS && defined(__AVX512F__)
namespace detail {
inline void transpose(__m512d (&r)[8]) {
  __m512d t[8], u[8];
  for (int k = 0; k < 4; ++k) {
    t[2 * k] = _mm512_unpacklo_pd(r[2 * k], r[2 * k + 1]);
    t[2 * k + 1] = _mm512_unpackhi_pd(r[2 * k], r[2 * k + 1]);
  }
  for (int h = 0; h < 2; ++h)
    for (int k = 0; k < 2; ++k) {
      u[4 * h + k] = _mm512_shuffle_f64x2(t[4 * h + k], t[4 * h + k + 2], 0x88);
      u[4 * h + k + 2] = _mm512_shuffle_f64x2(t[4 * h + k], t[4 * h + k + 2], 0xdd);
    }
  for (int k = 0; k < 4; ++k) {
    r[k] = _mm512_shuffle_f64x2(u[k], u[k + 4], 0x88);
    r[k + 4] = _mm512_shuffle_f64x2(u[k], u[k + 4], 0xdd);
  }
}
}  // namespace detail

/// f[c] = component c of the records base + index[l] * stride, l over the lanes. Reads whole groups of lane_count
/// components: records are padded to a multiple of 8 doubles.
template <int N>
PIOLA_INLINE_FN void load_records(double const* base, std::ptrdiff_t stride, Index const* index, Lanes (&f)[N]) {
  for (int first = 0; first < N; first += 8) {
    __m512d r[8];
    for (int l = 0; l < 8; ++l) r[l] = _mm512_loadu_pd(base + index[l] * stride + first);
    detail::transpose(r);
    for (int c = 0; c < 8 && first + c < N; ++c) f[first + c] = Lanes(r[c]);
  }
}

/// out[c] = sum of the lanes of a[c]; out has room for a multiple of 8 values.
template <int N>
PIOLA_INLINE_FN void add_lanes(Lanes const (&a)[N], double* out) {
  for (int first = 0; first < N; first += 8) {
    __m512d r[8], s[4], x[2];
    for (int c = 0; c < 8; ++c)
      r[c] = first + c < N ? static_cast<__m512d>(a[first + c < N ? first + c : 0]) : _mm512_setzero_pd();
    for (int k = 0; k < 4; ++k)
      s[k] = _mm512_add_pd(_mm512_unpacklo_pd(r[2 * k], r[2 * k + 1]), _mm512_unpackhi_pd(r[2 * k], r[2 * k + 1]));
    for (int k = 0; k < 2; ++k)
      x[k] = _mm512_add_pd(_mm512_shuffle_f64x2(s[2 * k], s[2 * k + 1], 0x88),
                           _mm512_shuffle_f64x2(s[2 * k], s[2 * k + 1], 0xdd));
    __m512d const sum = _mm512_add_pd(_mm512_shuffle_f64x2(x[0], x[1], 0x88), _mm512_shuffle_f64x2(x[0], x[1], 0xdd));
    _mm512_storeu_pd(out + first, sum);
  }
}
#elif PIOLA_HAS_PACKS && defined(__AVX2__)
template <int N>
PIOLA_INLINE_FN void load_records(double const* base, std::ptrdiff_t stride, Index const* index, Lanes (&f)[N]) {
  for (int first = 0; first < N; first += 4) {
    __m256d r[4], t[4];
    for (int l = 0; l < 4; ++l) r[l] = _mm256_loadu_pd(base + index[l] * stride + first);
    for (int k = 0; k < 2; ++k) {
      t[2 * k] = _mm256_unpacklo_pd(r[2 * k], r[2 * k + 1]);
      t[2 * k + 1] = _mm256_unpackhi_pd(r[2 * k], r[2 * k + 1]);
    }
    for (int k = 0; k < 2; ++k) {
      if (first + k < N) f[first + k] = Lanes(_mm256_permute2f128_pd(t[k], t[k + 2], 0x20));
      if (first + k + 2 < N) f[first + k + 2] = Lanes(_mm256_permute2f128_pd(t[k], t[k + 2], 0x31));
    }
  }
}

template <int N>
PIOLA_INLINE_FN void add_lanes(Lanes const (&a)[N], double* out) {
  for (int first = 0; first < N; first += 4) {
    __m256d r[4], s[2];
    for (int c = 0; c < 4; ++c)
      r[c] = first + c < N ? static_cast<__m256d>(a[first + c < N ? first + c : 0]) : _mm256_setzero_pd();
    for (int k = 0; k < 2; ++k) s[k] = _mm256_hadd_pd(r[2 * k], r[2 * k + 1]);
    _mm256_storeu_pd(out + first,
                     _mm256_add_pd(_mm256_permute2f128_pd(s[0], s[1], 0x20), _mm256_permute2f128_pd(s[0], s[1], 0x31)));
  }
}
#else
template <int N>
PIOLA_INLINE_FN void load_records(double const* base, std::ptrdiff_t stride, Index const* index, Lanes (&f)[N]) {
  for (int c = 0; c < N; ++c) {
#if PIOLA_HAS_PACKS
    for (int l = 0; l < lane_count; ++l) f[c][l] = base[index[l] * stride + c];
#else
    f[c] = base[index[0] * stride + c];
#endif
  }
}

template <int N>
PIOLA_INLINE_FN void add_lanes(Lanes const (&a)[N], double* out) {
  for (int c = 0; c < N; ++c) {
    double sum = 0;
    for (int l = 0; l < lane_count; ++l) sum += lane(a[c], l);
    out[c] = sum;
  }
}
#endif

}  // namespace piola::inline PIOLA_BACKEND
