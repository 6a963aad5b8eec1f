// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#if defined(PIOLA_BACKEND_IS_V3) || defined(PIOLA_BACKEND_IS_V4) || defined(PIOLA_BACKEND_IS_NATIVE)
#define PIOLA_HAS_PACKS 1
#include <experimental/simd>
#if defined(__AVX__)
#include <immintrin.h>
#endif
#else
#define PIOLA_HAS_PACKS 0
#endif

namespace piola {
/// Number of a particle, a slot or a neighbour.
using Index = std::int32_t;
}  // namespace piola

/// Functions that physics uses on a value that is either a `double` or a pack of lanes (Lanes); laws and passes call
/// them unqualified.
namespace piola::inline PIOLA_BACKEND {

PIOLA_INLINE_FN double select(bool condition, double yes, double no) { return condition ? yes : no; }
/// NaN if either argument is NaN, as minimum() of IEEE 754-2019. A NaN thus survives a reduction and reaches the report
/// of failures. Slots without a particle must be excluded before.
PIOLA_INLINE_FN double minimum(double a, double b) { return b < a || b != b ? b : a; }
PIOLA_INLINE_FN double maximum(double a, double b) { return a < b || b != b ? b : a; }
PIOLA_INLINE_FN double square_root(double a) { return std::sqrt(a); }
PIOLA_INLINE_FN double inverse_square_root(double a) { return 1.0 / std::sqrt(a); }
PIOLA_INLINE_FN bool any(bool condition) { return condition; }
PIOLA_FN double power_minus_third_exact(double a) { return 1.0 / std::cbrt(a); }
PIOLA_FN double logarithm_exact(double a) { return std::log(a); }

#if PIOLA_HAS_PACKS
/// One value for each of several consecutive particles, in the SIMD width of the instruction set.
using Lanes = std::experimental::native_simd<double>;
inline constexpr int lane_count = static_cast<int>(Lanes::size());

PIOLA_INLINE_FN Lanes select(Lanes::mask_type const& condition, Lanes const& yes, Lanes const& no) {
#if defined(__clang__) && defined(__AVX512F__)
  // Where masks are bits, where() of g++ 12's library takes all lanes or none when clang compiles it.
  auto const bits = static_cast<__mmask8>(condition.__to_bitset().to_ulong());
  return Lanes(_mm512_mask_blend_pd(bits, static_cast<__m512d>(no), static_cast<__m512d>(yes)));
#else
  Lanes r = no;
  where(condition, r) = yes;
  return r;
#endif
}
/// b where it is less (greater), else a, and so a where it is not a number: as the instruction of the processor does,
/// while compilers may take the two of std::experimental::min in either order.
#if defined(__AVX512F__)
PIOLA_INLINE_FN Lanes less_of(Lanes const& a, Lanes const& b) {
  return Lanes(_mm512_min_pd(static_cast<__m512d>(b), static_cast<__m512d>(a)));
}
PIOLA_INLINE_FN Lanes greater_of(Lanes const& a, Lanes const& b) {
  return Lanes(_mm512_max_pd(static_cast<__m512d>(b), static_cast<__m512d>(a)));
}
#elif defined(__AVX__)
PIOLA_INLINE_FN Lanes less_of(Lanes const& a, Lanes const& b) {
  return Lanes(_mm256_min_pd(static_cast<__m256d>(b), static_cast<__m256d>(a)));
}
PIOLA_INLINE_FN Lanes greater_of(Lanes const& a, Lanes const& b) {
  return Lanes(_mm256_max_pd(static_cast<__m256d>(b), static_cast<__m256d>(a)));
}
#else
PIOLA_INLINE_FN Lanes less_of(Lanes const& a, Lanes const& b) { return select(b < a, b, a); }
PIOLA_INLINE_FN Lanes greater_of(Lanes const& a, Lanes const& b) { return select(b > a, b, a); }
#endif
// If b is a compile-time constant, as bounds are, one instruction remains.
PIOLA_INLINE_FN Lanes minimum(Lanes const& a, Lanes const& b) { return select(b != b, b, less_of(a, b)); }
PIOLA_INLINE_FN Lanes maximum(Lanes const& a, Lanes const& b) { return select(b != b, b, greater_of(a, b)); }
PIOLA_INLINE_FN Lanes square_root(Lanes const& a) { return std::experimental::sqrt(a); }
PIOLA_INLINE_FN bool any(Lanes::mask_type const& condition) { return any_of(condition); }
PIOLA_FN Lanes power_minus_third_exact(Lanes const& a) {
  Lanes r = a;
  for (int l = 0; l < lane_count; ++l) r[l] = 1.0 / std::cbrt(static_cast<double>(a[l]));
  return r;
}
PIOLA_FN Lanes logarithm_exact(Lanes const& a) {
  Lanes r = a;
  for (int l = 0; l < lane_count; ++l) r[l] = std::log(static_cast<double>(a[l]));
  return r;
}
PIOLA_INLINE_FN Lanes load(double const* p, Lanes) { return Lanes(p, std::experimental::element_aligned); }
PIOLA_INLINE_FN void store(Lanes const& v, double* p) { v.copy_to(p, std::experimental::element_aligned); }
PIOLA_INLINE_FN double lane(Lanes const& v, int l) { return v[l]; }
#if defined(__AVX512F__)
/// 1 / sqrt(a) to a unit or two in the last place: two of Newton's steps from 14 bits, without the slow divider.
PIOLA_INLINE_FN Lanes inverse_square_root(Lanes const& a) {
  Lanes y(_mm512_rsqrt14_pd(static_cast<__m512d>(a)));
  Lanes const half = 0.5 * a;
  for (int k = 0; k < 2; ++k) y = y + y * (0.5 - half * y * y);
  return y;
}
#else
PIOLA_INLINE_FN Lanes inverse_square_root(Lanes const& a) { return 1.0 / square_root(a); }
#endif
#else
/// One particle at a time: the portable path and the GPU.
using Lanes = double;
inline constexpr int lane_count = 1;
#endif

PIOLA_INLINE_FN double load(double const* p, double) { return *p; }
PIOLA_INLINE_FN void store(double v, double* p) { *p = v; }
PIOLA_INLINE_FN double lane(double v, int) { return v; }

/// Values of the lanes that start at p.
template <class V>
PIOLA_INLINE_FN V load(double const* p) {
  return load(p, V{});
}

/// Number of particles in a value of type V.
template <class V>
inline constexpr int width = std::is_same_v<V, double> ? 1 : lane_count;

/// exp(a), lane by lane.
template <class V>
PIOLA_FN V exponential(V const& a) {
  double r[width<V>];
  for (int l = 0; l < width<V>; ++l) r[l] = std::exp(lane(a, l));
  return load<V>(r);
}

}  // namespace piola::inline PIOLA_BACKEND
