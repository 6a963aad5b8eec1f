// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/passes.hpp"
#include "piola/math/solve.hpp"
#include "piola/math/symmetric_eigen.hpp"

/// Real particles with prescribed velocities or tractions. A prescribed component has a gradient of full rank from its
/// known value. A free one has, if the sources lie in one layer, only its tangential derivative; the missing derivative
/// of the velocity along the normal follows from the rate of the traction. These three rules determine all gradients.
/// Theory: docs/theory/taylor-sph.md.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// Components of a symmetric tensor in the order of SymMat, shear ones times sqrt(2): an orthonormal basis.
template <int D>
struct Mandel {
  static constexpr double root2 = 1.4142135623730951;
  double c[SymMat<D>::size];
  static constexpr double factor(int k) { return k < D ? 1 : root2; }
  PIOLA_FN static double dot(double const* a, double const* b) {
    double sum = 0;
    for (int k = 0; k < SymMat<D>::size; ++k) sum += a[k] * b[k];
    return sum;
  }
  PIOLA_FN static Mandel of(SymMat<D> const& s) {
    Mandel m;
    for (int k = 0; k < SymMat<D>::size; ++k) m.c[k] = factor(k) * s.c[k];
    return m;
  }
  PIOLA_FN SymMat<D> tensor() const {
    SymMat<D> s;
    for (int k = 0; k < SymMat<D>::size; ++k) s.c[k] = c[k] / factor(k);
    return s;
  }
};

/// Sums of one lane.
template <int D>
PIOLA_FN KernelSums<D, double> lane_of(KernelSums<D, Lanes> const& s, int l) {
  KernelSums<D, double> r;
  r.w = lane(s.w, l);
  r.w_volume = lane(s.w_volume, l);
  for (int a = 0; a < D; ++a) {
    r.wx[a] = lane(s.wx[a], l);
    r.g[a] = lane(s.g[a], l);
  }
  for (int c = 0; c < SymMat<D>::size; ++c) r.xg.c[c] = lane(s.xg.c[c], l);
  for (int c = 0; c < Record<D>::fields; ++c) {
    r.wf[c] = lane(s.wf[c], l);
    for (int a = 0; a < D; ++a) r.fg[c][a] = lane(s.fg[c][a], l);
  }
  return r;
}

/// Least-squares solution of A^T c = q without the directions that A does not see.
template <int D>
struct PseudoInverse {
  Mat<D> A;
  Eigen<D> e;
  double least;  ///< eigenvalues of A A^T below this are dropped

  /// `weakest`: threshold for eigenvalues of A A^T relative to the largest; `scale`: size of A without cancellation.
  PIOLA_FN PseudoInverse(Mat<D> const& of, double weakest, double scale) : A(of) {
    SymMat<D> N{};
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j)
        for (int k = 0; k < D; ++k) N(i, j) += A(i, k) * A(j, k);
    e = symmetric_eigen(N);
    double largest = 0;
    for (int k = 0; k < D; ++k) largest = maximum(largest, e.value[k]);
    constexpr double roundoff = 1e-20;
    least = maximum(weakest * largest, roundoff * scale * scale);
  }
  PIOLA_FN Vec<D> operator()(Vec<D> const& q) const {
    Vec<D> const b = A * q;
    Vec<D> c{};
    for (int k = 0; k < D; ++k)
      if (e.value[k] > least) c = c + (dot(e.vector[k], b) / e.value[k]) * e.vector[k];
    return c;
  }
};

/// Size of the second moment of the sources about their target.
template <int D>
PIOLA_FN double moment_size(KernelSums<D, double> const& sums) {
  double size = 0;
  for (int a = 0; a < D; ++a) size += sums.xg(a, a);
  return size;
}

/// Centroid form with a pseudo-inverse, for free components.
template <int D>
PIOLA_FN Estimate<D, double> estimate_free(KernelSums<D, double> const& sums) {
  Estimate<D, double> e;
  double const share = 1 / sums.w;
  Vec<D> const xb = share * sums.wx;
  Mat<D> A;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) A(a, b) = sums.xg(a, b) - xb[a] * sums.g[b];
  // Edges of lattices have 0.01; a direction that one layer of sources does not see is far below.
  constexpr double weakest = 0.002;
  PseudoInverse<D> const solve(A, weakest, moment_size<D>(sums));
  for (int c = 0; c < Record<D>::fields; ++c) {
    double const mean = share * sums.wf[c];
    e.gradient[c] = solve(sums.fg[c] - mean * sums.g);
    e.f[c] = mean - dot(e.gradient[c], xb);
  }
  return e;
}

/// Gradients about known values: grad f = A^-T sum (f_J - f_I) g_J with A about the target itself, (20).
template <int D>
PIOLA_FN void estimate_known(KernelSums<D, double> const& sums, double const (&known)[Record<D>::fields],
                             Vec<D> (&gradient)[Record<D>::fields]) {
  Mat<D> A;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) A(a, b) = sums.xg(a, b);
  // Nothing is extrapolated from a known value: every direction that the sources see is used.
  constexpr double weakest = 1e-8;
  PseudoInverse<D> const solve(A, weakest, moment_size<D>(sums));
  for (int c = 0; c < Record<D>::fields; ++c) gradient[c] = solve(sums.fg[c] - known[c] * sums.g);
}

/// Replaces prescribed parts of an estimate: values by the mean of both ends of the step, and gradients by those about
/// these values. Directions of velocity and rows of stress are orthonormal, so the other parts do not change.
template <int D>
struct PrescribedEstimate {
  static constexpr int n = Record<D>::stress;
  BoundaryItem const& item;

  PIOLA_FN void operator()(KernelSums<D, double> const& sums, Estimate<D, double>& e) const {
    double known[Record<D>::fields] = {};
    for (int h = 0; h < item.held; ++h)
      for (int a = 0; a < D; ++a) known[a] += mean_speed(h) * item.direction[h][a];
    Mandel<D> values{};
    for (int r = 0; r < item.rows; ++r)
      for (int c = 0; c < n; ++c) values.c[c] += 0.5 * (item.before[r] + item.after[r]) * item.row[r][c];
    SymMat<D> const stress = values.tensor();
    for (int c = 0; c < n; ++c) known[D + c] = stress.c[c];
    Vec<D> gradient[Record<D>::fields];
    estimate_known<D>(sums, known, gradient);
    for (int h = 0; h < item.held; ++h) replace_velocity(item.direction[h], known, gradient, e);
    for (int r = 0; r < item.rows; ++r) replace_stress(item.row[r], known, gradient, e);
  }
  PIOLA_FN double mean_speed(int h) const { return 0.5 * (item.speed_before[h] + item.speed_after[h]); }

 private:
  PIOLA_FN static void replace_velocity(double const* d, double const* known, Vec<D> const* gradient,
                                        Estimate<D, double>& e) {
    double change = 0;
    Vec<D> turn{};
    for (int a = 0; a < D; ++a) {
      change += d[a] * (known[a] - e.f[a]);
      turn = turn + d[a] * (gradient[a] - e.gradient[a]);
    }
    for (int a = 0; a < D; ++a) {
      e.f[a] += change * d[a];
      e.gradient[a] = e.gradient[a] + d[a] * turn;
    }
  }
  PIOLA_FN static void replace_stress(double const* row, double const* known, Vec<D> const* gradient,
                                      Estimate<D, double>& e) {
    double change = 0;
    Vec<D> turn{};
    for (int c = 0; c < n; ++c) {
      double const f = Mandel<D>::factor(c);
      change += row[c] * f * (known[D + c] - e.f[D + c]);
      turn = turn + (row[c] * f) * (gradient[D + c] - e.gradient[D + c]);
    }
    for (int c = 0; c < n; ++c) {
      double const f = Mandel<D>::factor(c);
      e.f[D + c] += change * row[c] / f;
      e.gradient[D + c] = e.gradient[D + c] + (row[c] / f) * turn;
    }
  }
};

/// Solves the leading n x n part of M a = b (rows of six).
PIOLA_FN bool solve_small(double const (&M)[36], double const (&b)[6], int n, double (&a)[6]) {
  double A[36];
  for (int k = 0; k < 36; ++k) A[k] = k / 6 < n && k % 6 < n ? M[k] : (k / 6 == k % 6 ? 1.0 : 0.0);
  // Unused rows are those of the identity, scaled so that they do not affect the ratio of pivots.
  double scale = 0;
  for (int k = 0; k < n; ++k) scale = maximum(scale, std::fabs(M[7 * k]));
  for (int k = n; k < 6; ++k) A[7 * k] = scale;
  for (int k = 0; k < 6; ++k) a[k] = k < n ? b[k] : 0;
  return n > 0 && solve_in_place<6>(A, a) > 1e-9;
}

/// Adds to L the part required by the rates of prescribed tractions: a_l along_l (x) normal_l such that each row of the
/// stress rate D:d becomes the prescribed one.
template <int D, class Law>
PIOLA_FN void add_missing_derivatives(Law const& law, double lateral, BoundaryItem const& item, double dt, Mat<D>& L) {
  double M[36] = {}, b[6] = {}, a[6] = {};
  int const n = item.rows;
  auto const row_of = [&](int r, Mat<D> const& G) {
    auto const rate = Mandel<D>::of(elastic_rate<D>(law, lateral, G).in_plane);
    return Mandel<D>::dot(item.row[r], rate.c);
  };
  for (int l = 0; l < n; ++l) {
    Mat<D> dyad;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) dyad(i, j) = item.along[l][i] * item.normal[l][j];
    for (int r = 0; r < n; ++r) M[6 * r + l] = row_of(r, dyad);
  }
  for (int r = 0; r < n; ++r) b[r] = (item.after[r] - item.before[r]) / dt - row_of(r, L);
  if (!solve_small(M, b, n, a)) return;
  for (int l = 0; l < n; ++l)
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) L(i, j) += a[l] * item.along[l][i] * item.normal[l][j];
}

/// The full step of a particle with prescribed values. Stress and velocity are imposed after it, see Impose.
template <int D, class Kernel, class Law>
struct BoundaryStep {
  Law law;
  Constants k;
  CrossSetPairTable pairs;
  double const* virtual_;
  double* real;
  WriteView out_of_plane, drift, displacement;
  View acceleration;
  BoundaryItem const* items;
  Index first, count;
  FailureSlot* failure;
  double dt;

  PIOLA_FN void operator()(Index i) const {
    using R = Record<D>;
    Lanes own[R::values];
    load_local<D>(real, i, own);
    auto const sums = sum_sources<D, Kernel>(pairs, virtual_, i, half_time_place<D>(k, own, drift, i, dt));
    for (int l = 0; l < lane_count && i + l < first + count; ++l) advance(i + l, lane_of<D>(sums, l));
  }

 private:
  PIOLA_FN void advance(Index i, KernelSums<D, double> const& sums) const {
    using R = Record<D>;
    BoundaryItem const& item = items[i - first];
    double* const own = real + i * R::stride;
    auto e = estimate_free<D>(sums);
    PrescribedEstimate<D>{item}(sums, e);
    Mat<D> L = velocity_gradient<D>(e);
    add_missing_derivatives<D>(law, k.lateral, item, dt, L);
    double specific_volume = own[R::volume] / (k.rho0 * k.kernel_volume);
    if (k.moving) specific_volume *= 1 + 0.5 * dt * trace(L);
    Vec<D> const force = divergence<D>(e);
    SymMat<D> sigma;
    for (int c = 0; c < R::stress; ++c) sigma.c[c] = e.f[D + c];
    auto const rate = stress_rate<D>(law, k, L, sigma);
    double size = 0;
    for (int c = 0; c < D; ++c) {
      double const load = k.loaded ? acceleration.scalar<double>(i, c) : 0;
      if (k.moving) own[R::x + c] += dt * e.f[c];
      drift.scalar(i, e.f[c], c);
      if (!k.moving) displacement.data[c * displacement.component_stride + i] += dt * e.f[c];
      own[R::v + c] += dt * (specific_volume * force[c] + load);
      size += own[R::v + c] * own[R::v + c];
    }
    if (k.moving) own[R::volume] = volume_after(own[R::volume], trace(L), dt);
    for (int c = 0; c < R::stress; ++c) {
      own[R::s + c] += dt * rate.in_plane.c[c];
      size += own[R::s + c] * own[R::s + c];
    }
    if constexpr (D == 2) out_of_plane.data[i] += dt * rate.across;
    if (!(size < 1e300)) exec::record(failure, i, 1);
  }
};

/// Sets prescribed velocities and stresses to their values at the end of the step.
template <int D>
struct Impose {
  double* real;
  BoundaryItem const* items;
  Index first;

  PIOLA_FN void operator()(Index number) const {
    using R = Record<D>;
    BoundaryItem const& item = items[number];
    double* const own = real + (first + number) * R::stride;
    for (int h = 0; h < item.held; ++h) {
      double change = item.speed_after[h];
      for (int a = 0; a < D; ++a) change -= item.direction[h][a] * own[R::v + a];
      for (int a = 0; a < D; ++a) own[R::v + a] += change * item.direction[h][a];
    }
    SymMat<D> s;
    for (int c = 0; c < R::stress; ++c) s.c[c] = own[R::s + c];
    Mandel<D> m = Mandel<D>::of(s);
    for (int r = 0; r < item.rows; ++r) {
      double const change = item.after[r] - Mandel<D>::dot(item.row[r], m.c);
      for (int c = 0; c < R::stress; ++c) m.c[c] += change * item.row[r][c];
    }
    s = m.tensor();
    for (int c = 0; c < R::stress; ++c) own[R::s + c] = s.c[c];
  }
};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
