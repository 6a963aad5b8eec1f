// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/sums.hpp"
#include "piola/materials/laws.hpp"

/// The right-hand sides of the conservation laws at one point; T is double or lanes.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// L_ab = dv_a / dx_b [1/s].
template <int D, class T>
PIOLA_FN Mat<D, T> velocity_gradient(Estimate<D, T> const& e) {
  Mat<D, T> L;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) L(a, b) = e.gradient[a][b];
  return L;
}

/// (div sigma)_a = d sigma_ab / dx_b [Pa/m], for eq. (1).
template <int D, class T>
PIOLA_FN Vec<D, T> divergence(Estimate<D, T> const& e) {
  Vec<D, T> r;
  for (int a = 0; a < D; ++a) {
    r[a] = e.gradient[D + SymMat<D>::at(a, 0)][0];
    for (int b = 1; b < D; ++b) r[a] = r[a] + e.gradient[D + SymMat<D>::at(a, b)][b];
  }
  return r;
}

/// -S = omega.sigma - sigma.omega with omega = (L - L^T)/2, eqs. (2)-(4): effect of rotation on the stress.
template <int D, class T>
PIOLA_FN SymMat<D, T> turning(SymMat<D, T> const& sigma, Mat<D, T> const& L) {
  SymMat<D, T> r{};
  Mat<D, T> omega;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) omega(i, j) = 0.5 * (L(i, j) - L(j, i));
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      for (int k = 0; k < D; ++k) r(i, j) = r(i, j) + omega(i, k) * sigma(k, j) - sigma(i, k) * omega(k, j);
  return r;
}

/// A stress with its out-of-plane component, which a body of two dimensions stores separately.
template <int D, class T>
struct PlaneStress {
  SymMat<D, T> in_plane;
  T across;
};

/// Rate of deformation d = (L + L^T)/2 (5), (6) in three dimensions: missing directions are fixed (lateral = 0) or
/// contract so that they are free of stress.
template <int D, class T>
PIOLA_FN SymMat<3, T> rate_of_deformation(Mat<D, T> const& L, double lateral) {
  SymMat<3, T> d;
  for (int c = 0; c < 6; ++c) d.c[c] = T(0.0);
  T along = L(0, 0);
  for (int i = 0; i < D; ++i) {
    if (i > 0) along = along + L(i, i);
    for (int j = i; j < D; ++j) d(i, j) = 0.5 * (L(i, j) + L(j, i));
  }
  for (int i = D; i < 3; ++i) d(i, i) = -lateral * along;
  return d;
}

/// D : d, the Jaumann rate of the stress (2) [Pa/s].
template <int D, class Law, class T>
PIOLA_FN PlaneStress<D, T> elastic_rate(Law const& law, double lateral, Mat<D, T> const& L) {
  SymMat<3, T> const rate = law.stress_rate(rate_of_deformation<D>(L, lateral));
  PlaneStress<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) r.in_plane(i, j) = rate(i, j);
  r.across = rate(2, 2);
  return r;
}

/// dsigma/dt = D : d - S (2) [Pa/s]. The fixed configuration is geometrically linear and has no rotation.
template <int D, class Law, class T>
PIOLA_FN PlaneStress<D, T> stress_rate(Law const& law, Constants const& k, Mat<D, T> const& L,
                                       SymMat<D, T> const& sigma) {
  PlaneStress<D, T> r = elastic_rate<D>(law, k.lateral, L);
  if (!k.moving) return r;
  SymMat<D, T> const turn = turning(sigma, L);
  for (int c = 0; c < SymMat<D>::size; ++c) r.in_plane.c[c] = r.in_plane.c[c] + turn.c[c];
  return r;
}

/// Volume after a step with the volume rate tr L: the inverse of rho (1 - dt tr/2) / (1 + dt tr/2).
template <class T>
PIOLA_FN T volume_after(T const& volume, T const& rate, double dt) {
  return volume * (1.0 + 0.5 * dt * rate) / (1.0 - 0.5 * dt * rate);
}

/// The rotation of a spin (L - L^T)/2 over dt by Cayley's formula, (1 - W/2)^-1 (1 + W/2): orthogonal to round-off.
template <int D, class T>
PIOLA_FN Mat<D, T> cayley(Mat<D, T> const& L, double dt) {
  Mat<D, T> less = identity<D, T>(), more = identity<D, T>();
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      T const half = (0.25 * dt) * (L(i, j) - L(j, i));
      less(i, j) = less(i, j) - half;
      more(i, j) = more(i, j) + half;
    }
  return inverse(less) * more;
}

/// R s R^T.
template <int D, class T>
PIOLA_FN SymMat<D, T> turned(SymMat<D, T> const& s, Mat<D, T> const& R) {
  Mat<D, T> const Rs = R * s;
  SymMat<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      r(i, j) = Rs(i, 0) * R(j, 0);
      for (int k = 1; k < D; ++k) r(i, j) = r(i, j) + Rs(i, k) * R(j, k);
    }
  return r;
}

/// Jaumann rate over a step: half the strain, the rotation, the other half.
template <int D, class Law, class T>
PIOLA_FN void advance_stress(Law const& law, Constants const& k, Mat<D, T> const& L, double dt, SymMat<D, T>& s,
                             T& across) {
  PlaneStress<D, T> const rate = elastic_rate<D>(law, k.lateral, L);
  double const first = k.moving ? 0.5 * dt : dt;
  for (int c = 0; c < SymMat<D>::size; ++c) s.c[c] = s.c[c] + first * rate.in_plane.c[c];
  across = across + dt * rate.across;
  if (!k.moving) return;
  s = turned(s, cayley(L, dt));
  for (int c = 0; c < SymMat<D>::size; ++c) s.c[c] = s.c[c] + (0.5 * dt) * rate.in_plane.c[c];
}

/// L : D : L, twice the power density of a velocity gradient on its own stress per time [Pa/s2].
template <int D, class Law, class T>
PIOLA_FN T elastic_square(Law const& law, double lateral, Mat<D, T> const& L) {
  SymMat<3, T> const d = rate_of_deformation<D>(L, lateral), rate = law.stress_rate(d);
  T sum = d.c[0] * rate.c[0];
  for (int c = 1; c < 6; ++c) sum = sum + (c < 3 ? 1.0 : 2.0) * (d.c[c] * rate.c[c]);
  return sum;
}

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
