// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"

/// Lanes of many packs at once: transposed, they are added up as packs.
namespace piola::inline PIOLA_MACHINE {

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
inline void store_first(__m512d v, int n, double* p) {
  if (n >= 8) return _mm512_storeu_pd(p, v);
  _mm512_mask_storeu_pd(p, static_cast<__mmask8>((1 << n) - 1), v);
}
using Pack = __m512d;
}  // namespace detail
#elif PIOLA_HAS_PACKS && defined(__AVX2__)
namespace detail {
inline void transpose(__m256d (&r)[4]) {
  __m256d t[4];
  for (int k = 0; k < 2; ++k) {
    t[2 * k] = _mm256_unpacklo_pd(r[2 * k], r[2 * k + 1]);
    t[2 * k + 1] = _mm256_unpackhi_pd(r[2 * k], r[2 * k + 1]);
  }
  for (int k = 0; k < 2; ++k) {
    r[k] = _mm256_permute2f128_pd(t[k], t[k + 2], 0x20);
    r[k + 2] = _mm256_permute2f128_pd(t[k], t[k + 2], 0x31);
  }
}
inline void store_first(__m256d v, int n, double* p) {
  if (n >= 4) return _mm256_storeu_pd(p, v);
  alignas(32) double all[4];
  _mm256_store_pd(all, v);
  for (int c = 0; c < n; ++c) p[c] = all[c];
}
using Pack = __m256d;
}  // namespace detail
#endif

/// out[c] = ((0 + lane 0 of a[c]) + lane 1) + ..., c = 0 ... N - 1: with the bits of adding one lane after the other.
template <int N>
PIOLA_FN void add_lanes_in_order(Lanes const (&a)[N], double* out) {
#if PIOLA_HAS_PACKS && (defined(__AVX512F__) || defined(__AVX2__))
  for (int first = 0; first < N; first += lane_count) {
    detail::Pack r[lane_count];
    for (int c = 0; c < lane_count; ++c)
      r[c] = static_cast<detail::Pack>(first + c < N ? a[first + c < N ? first + c : 0] : Lanes(0.0));
    detail::transpose(r);
    Lanes sum(0.0);
    for (int l = 0; l < lane_count; ++l) sum += Lanes(r[l]);
    detail::store_first(static_cast<detail::Pack>(sum), N - first, out + first);
  }
#else
  for (int c = 0; c < N; ++c) {
    double sum = 0;
    for (int l = 0; l < lane_count; ++l) sum += lane(a[c], l);
    out[c] = sum;
  }
#endif
}

}  // namespace piola::inline PIOLA_MACHINE
