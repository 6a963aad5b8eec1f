// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/taylor_sph/state.hpp"
#include "piola/kernels/cubic_spline.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include "piola/neighbours/record_gather.hpp"

/// Kernel sums over the sources around a target, and the resulting values and gradients. Numbers of equations are those
/// of Serroukh and Mabssout (2022).
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// Sums over sources J with weights w = W_IJ Omega_J and g_J = Omega_J grad W_IJ = s (x_J - x_I), x from the target.
/// Constant factors of the kernel are omitted, because they cancel.
template <int D, class V>
struct KernelSums {
  static constexpr int fields = Record<D>::fields;
  V w, w_volume;         ///< sum w, sum w Omega
  Vec<D, V> wx, g;       ///< sum w x, sum g
  SymMat<D, V> xg;       ///< sum x (x) g
  V wf[fields];          ///< sum w f
  Vec<D, V> fg[fields];  ///< sum f g
};

/// A kernel at q = r / h without its constant factor.
template <class K, int D, class V>
PIOLA_FN V kernel_value(V const& q) {
  if constexpr (requires { K::w(D, q); })
    return K::w(D, q);
  else
    return K::w(q);
}
template <class K, int D, class V>
PIOLA_FN V kernel_slope(V const& q) {
  if constexpr (requires { K::dw(D, q); })
    return K::dw(D, q);
  else
    return K::dw(q);
}

/// The record of the lanes that start at slot i.
template <int D>
PIOLA_FN void load_local(double const* records, Index i, Lanes (&r)[Record<D>::values]) {
  Index at[lane_count];
  for (int l = 0; l < lane_count; ++l) at[l] = i + l;
  load_records(records, Record<D>::stride, at, r);
}
template <int D>
PIOLA_FN void store_own(Lanes const (&r)[Record<D>::values], Index i, double* records) {
  for (int l = 0; l < lane_count; ++l)
    for (int c = 0; c < Record<D>::values; ++c) records[(i + l) * Record<D>::stride + c] = lane(r[c], l);
}

/// Adds one source per lane.
template <int D, class K>
PIOLA_FN void add_source(Lanes const (&f)[Record<D>::values], Vec<D, Lanes> const& target, Lanes const& inverse_h,
                         KernelSums<D, Lanes>& sums) {
  using R = Record<D>;
  Vec<D, Lanes> x;
  for (int c = 0; c < D; ++c) x[c] = f[R::x + c] - target[c];
  Lanes const r = square_root(dot(x, x)), q = r * inverse_h;
  Lanes const w = kernel_value<K, D>(q) * f[R::volume];
  Lanes const s = -(kernel_slope<K, D>(q) * f[R::volume]) / maximum(q, Lanes(1e-12));
  sums.w = sums.w + w;
  sums.w_volume = sums.w_volume + w * f[R::volume];
  for (int a = 0; a < D; ++a) {
    Lanes const g = s * x[a];
    sums.wx[a] = sums.wx[a] + w * x[a];
    sums.g[a] = sums.g[a] + g;
    for (int b = a; b < D; ++b) sums.xg(a, b) = sums.xg(a, b) + g * x[b];
    for (int c = 0; c < R::fields; ++c) sums.fg[c][a] = sums.fg[c][a] + f[R::v + c] * g;
  }
  for (int c = 0; c < R::fields; ++c) sums.wf[c] = sums.wf[c] + f[R::v + c] * w;
}

/// Sums of the lanes of targets that start at i.
template <int D, class K>
PIOLA_FN KernelSums<D, Lanes> sum_sources(CrossSetPairTable const& pairs, double const* sources, Index i,
                                          Vec<D, Lanes> const& target) {
  KernelSums<D, Lanes> sums{};
  Lanes const inverse_h = load<Lanes>(pairs.inverse_h + i);
  Index const group = i / lane_count;
  for (Index k = pairs.begin[group]; k < pairs.begin[group + 1]; ++k) {
    Lanes f[Record<D>::values];
    load_records(sources, Record<D>::stride, pairs.source + static_cast<std::ptrdiff_t>(k) * lane_count, f);
    add_source<D, K>(f, target, inverse_h, sums);
  }
  return sums;
}

/// Values and gradients of velocity and stress at a target.
template <int D, class V>
struct Estimate {
  V f[Record<D>::fields];
  Vec<D, V> gradient[Record<D>::fields];
};

/// The centroid form: with fb = <f>, xb = <x> (19),  A = sum (x_J - xb) (x) g_J,
///   grad f = A^-T sum (f_J - fb) g_J,   f_I = fb - grad f . xb                 (x from the target)
/// The printed form (20) takes A about the target and f_I = fb.
template <int D, class V>
PIOLA_FN Estimate<D, V> estimate(KernelSums<D, V> const& sums, GradientForm form) {
  Estimate<D, V> e;
  V const share = 1.0 / sums.w;
  bool const exact = form == GradientForm::linear_exact;
  Vec<D, V> xb = share * sums.wx;
  if (!exact) xb = 0.0 * xb;
  Mat<D, V> A;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) A(a, b) = sums.xg(a, b) - xb[a] * sums.g[b];
  Mat<D, V> const C = inverse(A);
  for (int c = 0; c < Record<D>::fields; ++c) {
    V const mean = share * sums.wf[c];
    Vec<D, V> const q = sums.fg[c] - mean * sums.g;
    for (int a = 0; a < D; ++a) {
      V sum = C(0, a) * q[0];
      for (int b = 1; b < D; ++b) sum = sum + C(b, a) * q[b];
      e.gradient[c][a] = sum;
    }
    e.f[c] = mean - dot(e.gradient[c], xb);
  }
  return e;
}

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
