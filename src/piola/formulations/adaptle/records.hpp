// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/state.hpp"
#include "piola/kernels/list.hpp"
#include "piola/math/tensor.hpp"
#include "piola/neighbours/partial_records.hpp"

/// Neighbour data of a particle: records of doubles, a multiple of eight long, and the kernel between two of them.
namespace piola::adaptle::inline PIOLA_BACKEND {

constexpr int whole(int values) { return (values + 7) / 8 * 8; }

/// Record of a particle in space at half time. M = phi V sigma (its weight in the stress forces). With the correction
/// folded in (gt_ab = N g - n W, N = K/S, n = K G/S^2) M becomes M N, and m = M n. The viscosity is its factor, with a
/// negative sign for total-Lagrangian particles. R, the artificial stress of eq. (10), comes last and only if used: in
/// three dimensions the rest is just two cache lines.
template <int D, bool Corrected>
struct SpatialRecord {
  static constexpr int symmetric = D * (D + 1) / 2;
  static constexpr int x = 0, v = D, volume = 2 * D, rho = 2 * D + 1, c = 2 * D + 2, viscosity = 2 * D + 3,
                       M = 2 * D + 4;
  static constexpr int m = M + D * D, N = m + D, n = N + D * D;  ///< corrected only
  static constexpr int R = Corrected ? n + D : M + symmetric, full = R + symmetric;
  static constexpr int values(bool stressed) { return stressed ? full : R; }
  static constexpr int stride(bool stressed) { return whole(values(stressed)); }
};

/// Record for sums over reference neighbours. First sweep: displacement, velocity at half time, reference volume,
/// factor of the viscosity (negative: not total-Lagrangian), reference position. Second sweep: A = (1 - phi) V0 P K, in
/// three dimensions the second and third cache line; with the sums of set (2) also a = (1 - phi) V0 P n, the F^-T N and
/// F^-T n of the viscosity, and 1/J. On lattices each component is an array of its own (MaterialRows).
template <int D>
struct MaterialRecord {
  static constexpr int u = 0, v = D, volume = 2 * D, viscosity = 2 * D + 1, X = 2 * D + 2, A = X + D, a = A + D * D,
                       N = a + D, n = N + D * D, inverse_J = n + D;
  PIOLA_FN static constexpr int values(EquationSet e) { return e.records_deformation() ? inverse_J + 1 : a; }
  PIOLA_FN static constexpr int stride(EquationSet e) { return whole(values(e)); }
};

/// A kernel of one smoothing length, of support 2h. Of contact always the cubic spline.
template <int D, class Shape = CubicSpline>
struct Kernel {
  static_assert(Shape::support == 2);
  double inverse_h, norm;
  PIOLA_FN explicit Kernel(double h) : inverse_h(1 / h), norm(Shape::sigma(D)) {
    for (int c = 0; c < D; ++c) norm *= inverse_h;
  }
  PIOLA_FN double operator()(double r) const { return norm * w(r * inverse_h); }
  /// s = -W'(r)/r, so that grad_a W_ab = s (x_b - x_a), and W.
  template <class T>
  PIOLA_INLINE_FN void evaluate(T const& square, T& s, T& W) const {
    T const inverse_r = inverse_square_root(maximum(square, T(1e-300)));
    T const q = square * (inverse_r * inverse_h), scaled = (-norm * inverse_h) * inverse_r;
    s = dw(q) * scaled;
    W = norm * w(q);
  }

 private:
  template <class T>
  PIOLA_INLINE_FN static T w(T const& q) {
    if constexpr (requires { Shape::w(D, q); })
      return Shape::w(D, q);
    else
      return Shape::w(q);
  }
  template <class T>
  PIOLA_INLINE_FN static T dw(T const& q) {
    if constexpr (requires { Shape::dw(D, q); })
      return Shape::dw(D, q);
    else
      return Shape::dw(q);
  }
};

/// Zeros to start sums from; the argument is any finite number. The compiler cannot see that they are zeros; otherwise
/// it would also write them to memory that is never read.
PIOLA_INLINE_FN Lanes zeros_from(double finite) { return Lanes(finite - finite); }

template <int D>
PIOLA_INLINE_FN Vec<D, Lanes> difference(Lanes const* there, int at, double const* here) {
  Vec<D, Lanes> r;
  for (int c = 0; c < D; ++c) r[c] = there[at + c] - here[at + c];
  return r;
}

/// Values of the lanes that start at p, as doubles.
PIOLA_FN Lanes load_gradients(double const* p) { return load<Lanes>(p); }
PIOLA_FN Lanes load_gradients(float const* p) {
#if PIOLA_HAS_PACKS
  return Lanes(p, std::experimental::element_aligned);
#else
  return static_cast<double>(*p);
#endif
}

PIOLA_FN double sum_of_lanes(Lanes const& a) {
  double sum = 0;
  for (int l = 0; l < lane_count; ++l) sum += lane(a, l);
  return sum;
}
PIOLA_FN double largest_of(Lanes const& a) {
  double largest = lane(a, 0);
  for (int l = 1; l < lane_count; ++l) largest = lane(a, l) > largest ? lane(a, l) : largest;
  return largest;
}

/// Sums over lanes of N values: out[c] = sum of the lanes of a[c].
template <int N>
PIOLA_FN void total(Lanes const (&a)[N], double (&out)[whole(N)]) {
  add_lanes(a, out);
}

/// a^n for whole n >= 0.
template <class T>
PIOLA_FN T whole_power(T const& a, int n) {
  T r = T(1.0);
  for (int k = 0; k < n; ++k) r = r * a;
  return r;
}

}  // namespace piola::adaptle::inline PIOLA_BACKEND
