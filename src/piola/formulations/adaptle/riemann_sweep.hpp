// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/spatial_sweep.hpp"

namespace piola::adaptle::inline PIOLA_BACKEND {

/// Flux from the acoustic Riemann problem of each pair (the CON scheme that Mehra and Chaturvedi, J. Comput. Phys. 212,
/// 2006, compare, after Parshikov and Medin): along n = r/|r| and across it, with impedances Z = rho c_p and rho c_s,
///   t* = (Z_b t_a + Z_a t_b + Z_a Z_b (v_b - v_a)) / (Z_a + Z_b),   t = sigma n
///   v* = (Z_a v_a + Z_b v_b + t_b - t_a) / (Z_a + Z_b)
///   F_a = sum_b 2 V_a V_b t* |r| s,   L_a = sum_b 2 V_b (v* - v_a) (x) g
/// Heat is the power of the pair forces on v* - v_a. Uncorrected gradients; all particles Eulerian.
template <int D, class Shape>
struct RiemannSweep {
  using R = SpatialRecord<D, false>;
  SpatialTable table;
  BodyConstants const* body;
  int const* body_of;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(t);
  }

 private:
  static constexpr int F = 0, L = D, heat = D + D * D, count = heat + 1;

  PIOLA_FN void visit(Index number) const {
    SpatialTarget const target(table, number);
    double const* own = target.own;
    BodyConstants const& b = body[body_of[target.slot]];
    Kernel<D, Shape> const kernel(b.h);
    Lanes sum[count], mu = Lanes(0.0);
    for (auto& a : sum) a = Lanes(0.0);
    for (Index k = 0; k < target.length; k += lane_count) {
      constexpr int values = R::values(false);
      Lanes f[values];
      load_components<values>(table.record, table.stride, target.list + k, f);
      add(own, f, kernel, b, sum, mu);
    }
    double a[whole(count)];
    total(sum, a);
    double* const out = target.result;
    for (int i = 0; i < D; ++i) {
      out[SpatialResult::force + i] = own[R::volume] * a[F + i];
      for (int j = 0; j < D; ++j) out[SpatialResult::L + 3 * i + j] = a[L + i * D + j];
    }
    out[SpatialResult::heat] = own[R::volume] * a[heat];
    out[SpatialResult::compression] = largest_of(mu);
  }

  PIOLA_FN void add(double const* own, Lanes const* f, Kernel<D, Shape> const& kernel, BodyConstants const& b,
                    Lanes* sum, Lanes& mu) const {
    Vec<D, Lanes> const r = difference<D>(f, R::x, own), w = difference<D>(f, R::v, own);
    Lanes const square = dot(r, r), inverse_r = inverse_square_root(maximum(square, Lanes(1e-300)));
    Lanes s, W;
    kernel.evaluate(square, s, W);
    Lanes const volume = maximum(f[R::volume], Lanes(1e-300));
    Vec<D, Lanes> t_a, t_b;  // tractions on the plane across the pair
    for (int i = 0; i < D; ++i) {
      Lanes here = Lanes(0.0), there = Lanes(0.0);
      for (int j = 0; j < D; ++j) {
        here += own[R::M + SymMat<D>::at(i, j)] * r[j];
        there += f[R::M + SymMat<D>::at(i, j)] * r[j];
      }
      t_a[i] = here * (1 / own[R::volume]) * inverse_r;
      t_b[i] = there / volume * inverse_r;
    }
    Lanes const Z_a = Lanes(own[R::rho] * own[R::c]), Z_b = f[R::rho] * f[R::c], share = 1.0 / (Z_a + Z_b);
    Lanes const n_a = dot(t_a, r) * inverse_r, n_b = dot(t_b, r) * inverse_r, n_w = dot(w, r) * inverse_r;
    mu = maximum(mu, select(s > 0.0, -1.0 * minimum(n_w, Lanes(0.0)), Lanes(0.0)));
    Lanes const normal = share * (Z_b * n_a + Z_a * n_b + Z_a * Z_b * n_w), jump = share * (Z_b * n_w + n_b - n_a);
    Lanes power = Lanes(0.0);
    Lanes const area = 2.0 * f[R::volume] * s * square * inverse_r;
    for (int i = 0; i < D; ++i) {
      Lanes const n = r[i] * inverse_r;
      Lanes const ta = t_a[i] - n_a * n, tb = t_b[i] - n_b * n, tw = w[i] - n_w * n;
      Lanes const traction = normal * n + share * (Z_b * ta + Z_a * tb + b.shear_share * Z_a * Z_b * tw);
      Lanes const speed = jump * n + share * (Z_b * tw + (tb - ta) * (1 / b.shear_share));
      Lanes const force = area * traction;
      sum[F + i] += force;
      power += force * speed;
      Lanes const weighted = 2.0 * f[R::volume] * s * speed;
      for (int j = 0; j < D; ++j) sum[L + i * D + j] += weighted * r[j];
    }
    sum[heat] += power;
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
