// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/record_gather.hpp"

/// Gathering records whose last few components do not fill whole lanes.
namespace piola::inline PIOLA_BACKEND {

#if PIOLA_HAS_PACKS && defined(__AVX512F__)
namespace detail {
/// Four components of eight rows, put together in pairs of rows as they are loaded: half the shuffles of eight.
inline void load_four(double const* const (&row)[8], __m512d (&r)[4]) {
  auto const pair = [&](int a, int b) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(row[a])), _mm256_loadu_pd(row[b]), 1);
  };
  __m512d const a = pair(0, 2), b = pair(1, 3), c = pair(4, 6), d = pair(5, 7);
  __m512d const low = _mm512_unpacklo_pd(a, b), high = _mm512_unpackhi_pd(a, b), low_rest = _mm512_unpacklo_pd(c, d),
                high_rest = _mm512_unpackhi_pd(c, d);
  r[0] = _mm512_shuffle_f64x2(low, low_rest, 0x88);
  r[1] = _mm512_shuffle_f64x2(high, high_rest, 0x88);
  r[2] = _mm512_shuffle_f64x2(low, low_rest, 0xdd);
  r[3] = _mm512_shuffle_f64x2(high, high_rest, 0xdd);
}

/// Two components of eight rows.
inline void load_two(double const* const (&row)[8], __m512d (&r)[2]) {
  auto const four = [&](int first) {
    __m256d const low =
        _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(row[first])), _mm_loadu_pd(row[first + 2]), 1);
    __m256d const high =
        _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(row[first + 4])), _mm_loadu_pd(row[first + 6]), 1);
    return _mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
  };
  __m512d const even = four(0), odd = four(1);
  r[0] = _mm512_unpacklo_pd(even, odd);
  r[1] = _mm512_unpackhi_pd(even, odd);
}
}  // namespace detail

/// As load_records; what is left of the components beyond a multiple of eight, up to four, costs half a transposition.
template <int N>
PIOLA_INLINE_FN void load_components(double const* base, std::ptrdiff_t stride, Index const* index, Lanes (&f)[N]) {
  constexpr int rest = N % 8, whole = N - rest;
  if constexpr (rest == 0 || rest > 4) {
    load_records<N>(base, stride, index, f);
  } else {
    for (int first = 0; first < whole; first += 8) {
      __m512d r[8];
      for (int l = 0; l < 8; ++l) r[l] = _mm512_loadu_pd(base + index[l] * stride + first);
      detail::transpose(r);
      for (int c = 0; c < 8; ++c) f[first + c] = Lanes(r[c]);
    }
    double const* row[8];
    for (int l = 0; l < 8; ++l) row[l] = base + index[l] * stride + whole;
    __m512d r[rest > 2 ? 4 : 2];
    if constexpr (rest > 2)
      detail::load_four(row, r);
    else
      detail::load_two(row, r);
    for (int c = 0; c < rest; ++c) f[whole + c] = Lanes(r[c]);
  }
}

/// to[l][first + c] = lane l of f[c], for the rows that are not null.
template <int N>
PIOLA_FN void store_records(double* const (&to)[8], int first, Lanes const (&f)[N]) {
  for (int begin = 0; begin < N; begin += 8) {
    int const size = N - begin < 8 ? N - begin : 8;
    __m512d r[8];
    for (int c = 0; c < 8; ++c)
      r[c] = c < size ? static_cast<__m512d>(f[c < size ? begin + c : 0]) : _mm512_setzero_pd();
    detail::transpose(r);
    auto const part = static_cast<__mmask8>((1 << size) - 1);
    for (int l = 0; l < 8; ++l)
      if (to[l] != nullptr) _mm512_mask_storeu_pd(to[l] + first + begin, part, r[l]);
  }
}
#else
template <int N>
PIOLA_FN void store_records(double* const (&to)[lane_count], int first, Lanes const (&f)[N]) {
  for (int c = 0; c < N; ++c)
    for (int l = 0; l < lane_count; ++l)
      if (to[l] != nullptr) to[l][first + c] = lane(f[c], l);
}

template <int N>
PIOLA_INLINE_FN void load_components(double const* base, std::ptrdiff_t stride, Index const* index, Lanes (&f)[N]) {
  load_records<N>(base, stride, index, f);
}
#endif

}  // namespace piola::inline PIOLA_BACKEND
