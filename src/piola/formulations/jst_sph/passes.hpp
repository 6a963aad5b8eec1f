// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/math/embedding.hpp"
#include "piola/math/stretch.hpp"
#include "piola/mechanics/rigid_rate.hpp"
#include "piola/neighbours/loaders.hpp"

/// Passes of JST-SPH: operations on one particle. Equation numbers: Lee, Gil, Greto, Kulasegaram, Bonet (2016), as
/// corrected in docs/theory/jst-sph.md. Notation of neighbours/pair_table_views.hpp: r = X_b - X_a, raw gradient s r,
/// Laplacian weight l.
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// First sums over neighbours: raw velocity gradient and first Laplacians.
///   sum_b s (u_b - u_a) (x) r            (raw form of eqs. 21, 33a, 34)
///   sum_b l~ (f_b - f_a),  l~ = l + alpha_a.r + beta_a r.r          (A.1, A.2)
/// f are the first `Smoothed` of the gathered values: none; u; u and J (D + 1 values); u and x (2 D values).
template <int D, int Smoothed>
struct FirstSums {
  static constexpr bool smooths = false;
  static constexpr int fields = Smoothed > D ? Smoothed : D, outer_fields = Smoothed;
  static constexpr int sums = D * D + Smoothed;
  View gathered;              ///< u, and J or x
  ReferenceView alpha, beta;  ///< corrections of the Laplacian

  template <class V>
  struct Own {
    Vec<fields, V> u;
    Vec<D, V> alpha;
    V beta;
  };
  template <class V>
  PIOLA_INLINE_FN Own<V> own(Index a) const {
    Own<V> r{gathered.vector<fields, V>(a), {}, V(0.0)};
    if constexpr (Smoothed > 0) {
      r.alpha = alpha.vector<D, V>(a);
      r.beta = beta.scalar<V>(a);
    }
    return r;
  }

  template <bool Masked, class O, class G, class V>
  PIOLA_INLINE_FN void pair(V* sum, O const& own, G const& g, V const* u_b) const {
    for (int i = 0; i < D; ++i) {
      V const du = u_b[i] - own.u[i];
      for (int j = 0; j < D; ++j) sum[i * D + j] = sum[i * D + j] + du * g.sr[j];
    }
    if constexpr (Smoothed > 0) outer<Masked>(sum, own, g, u_b);
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_INLINE_FN void outer(V* sum, O const& own, G const& g, V const* u_b) const {
    V l = g.l + own.beta * g.r2;
    for (int i = 0; i < D; ++i) l = l + own.alpha[i] * g.r[i];
    if constexpr (Masked) l = g.weight * l;
    for (int i = 0; i < outer_fields; ++i) sum[D * D + i] = sum[D * D + i] + l * (u_b[i] - own.u[i]);
  }
};

/// The sweep that fills a block's scratch with FirstSums.
template <int D, int Smoothed, class Loader>
struct DifferentiateVelocity {
  static constexpr int sums = FirstSums<D, Smoothed>::sums;
  Loader loader;
  FirstSums<D, Smoothed> body;

  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& out) const {
    Lanes sum[sums];
    loader(i, body, sum);
    for (int c = 0; c < sums; ++c) store(sum[c], out.at(i, c));
  }
};

/// spin cross a for a spin of three components.
template <int D>
PIOLA_INLINE_FN Vec<D, Lanes> turned(double const (&spin)[3], Vec<D, Lanes> const& a) {
  Vec<D, Lanes> r;
  if constexpr (D == 3) {
    r = {{spin[1] * a[2] - spin[2] * a[1], spin[2] * a[0] - spin[0] * a[2], spin[0] * a[1] - spin[1] * a[0]}};
  } else if constexpr (D == 2) {
    r = {{-spin[2] * a[1], spin[2] * a[0]}};
  } else {
    r[0] = 0.0 * a[0];
  }
  return r;
}

/// The raw velocity gradient from the first sweep, in scratch.
template <int D>
PIOLA_INLINE_FN Mat<D, Lanes> raw_gradient(exec::Scratch const& in, Index i) {
  Mat<D, Lanes> raw;
  for (int c = 0; c < D * D; ++c) raw.c[c] = load<Lanes>(in.at(i, c));
  return raw;
}

/// Second sums over neighbours: internal force and second Laplacian.
///   sum_b s A_b r                                                      (29c) without the particle's own part
///   literal: sum_b (l + alpha_a.r + beta_a r.r) (w_b - w_a);   adjoint: sum_b (l - alpha_b.r + beta_b r.r) w_b
/// of `Smoothed` values w: those of the momentum (D), and that of J (D + 1).
template <int D, Biharmonic B, int Smoothed>
struct SecondSums {
  static constexpr bool smooths = false;
  static constexpr bool adjoint = B == Biharmonic::adjoint, laplacian = B != Biharmonic::none;
  static constexpr int outer_fields = adjoint ? Smoothed + D + 1 : laplacian ? Smoothed : 0;  // w, and alpha beta
  static constexpr int fields = outer_fields + D * D;                                         // then A
  static constexpr int sums = D + (laplacian ? Smoothed : 0);
  View gathered;
  ReferenceView alpha, beta;

  template <class V>
  struct Own {
    Vec<Smoothed, V> w;
    Vec<D, V> alpha;
    V beta;
  };
  template <class V>
  PIOLA_INLINE_FN Own<V> own(Index a) const {
    if constexpr (B == Biharmonic::literal)
      return {gathered.vector<Smoothed, V>(a), alpha.vector<D, V>(a), beta.scalar<V>(a)};
    else
      return {{}, {}, V(0.0)};
  }

  template <bool Masked, class O, class G, class V>
  PIOLA_INLINE_FN void pair(V* sum, O const& own, G const& g, V const* f) const {
    V const* const A = f + outer_fields;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) sum[i] = sum[i] + A[i * D + j] * g.sr[j];
    if constexpr (laplacian) outer<Masked>(sum, own, g, f);
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_INLINE_FN void outer(V* sum, O const& own, G const& g, V const* f) const {
    V l = g.l;
    if constexpr (adjoint) {
      l = l + f[Smoothed + D] * g.r2;
      for (int i = 0; i < D; ++i) l = l - f[Smoothed + i] * g.r[i];
    } else {
      l = l + own.beta * g.r2;
      for (int i = 0; i < D; ++i) l = l + own.alpha[i] * g.r[i];
    }
    if constexpr (Masked) l = g.weight * l;
    for (int i = 0; i < Smoothed; ++i) sum[D + i] = sum[D + i] + (adjoint ? l * f[i] : l * (f[i] - own.w[i]));
  }
};

/// A Runge-Kutta stage, eq. (43).
struct StageUpdate {
  double dt;
  bool second;  ///< second Runge-Kutta stage
};

/// Number of components of an angular momentum.
template <int D>
inline constexpr int spins = D == 3   ? 3
                             : D == 2 ? 1
                                      : 0;

/// x cross f, D = 3: a vector; D = 2: its component out of the plane.
template <int D, class T>
PIOLA_INLINE_FN void add_moment(T* sum, T const& weight, Vec<D, T> const& x, Vec<D, T> const& f) {
  if constexpr (D == 3) {
    Vec<3, T> const m = cross(x, f);
    for (int c = 0; c < 3; ++c) sum[c] = sum[c] + weight * m[c];
  } else if constexpr (D == 2) {
    sum[0] = sum[0] + weight * (x[0] * f[1] - x[1] * f[0]);
  }
}

/// Indices of the sums for the rigid part of a motion; x are arms from `centre`.
template <int D>
struct MotionTotals {
  static constexpr int x = 0;                     // sum V x
  static constexpr int xx = x + D;                // sum V x (x) x
  static constexpr int v = xx + SymMat<D>::size;  // sum V v
  static constexpr int moment_v = v + D;          // sum V x cross v
  static constexpr int size = moment_v + spins<D>;
};

/// Adds position x and velocity v of a particle to the sums.
template <int D>
PIOLA_INLINE_FN void add_motion(Lanes const& volume, Constants const& k, Vec<D, Lanes> const& x, Vec<D, Lanes> const& v,
                                Lanes* total) {
  using At = MotionTotals<D>;
  Vec<D, Lanes> arm = x;
  for (int c = 0; c < D; ++c) arm[c] = x[c] - k.centre[c];
  for (int c = 0; c < D; ++c) {
    Lanes const Vx = volume * arm[c];
    total[At::x + c] = total[At::x + c] + Vx;
    total[At::v + c] = total[At::v + c] + volume * v[c];
    for (int d = c; d < D; ++d) {
      int const at = At::xx + SymMat<D>::at(c, d);
      total[at] = total[at] + Vx * arm[d];
    }
  }
  add_moment<D>(total + At::moment_v, volume, arm, v);
}

/// The sums of a constant motion.
template <int D>
struct SumMotion {
  Constants k;
  ReferenceView V;
  View x, v;
  PIOLA_INLINE_FN void operator()(Index i, Lanes* total) const {
    add_motion<D>(V.scalar<Lanes>(i), k, x.vector<D, Lanes>(i), v.vector<D, Lanes>(i), total);
  }
};

/// Indices of the sums of SumForces for the projections and the energy balance: after those of the motion.
template <int D>
struct ForceTotals : MotionTotals<D> {
  static constexpr int T = MotionTotals<D>::size;            // sum V a_T,  a_T = -T / rho0
  static constexpr int moment_T = T + D;                     // sum V x cross a_T
  static constexpr int stabilisation = moment_T + spins<D>;  // sum V a_D,  a_D = D / rho0
  static constexpr int moment_stabilisation = stabilisation + D;
  static constexpr int power_T = moment_stabilisation + spins<D>;  // sum V v.a_T
  static constexpr int power_stabilisation = power_T + 1;          // sum V v.a_D
  static constexpr int J_rate = power_stabilisation + 1;           // sum V D(J)
  static constexpr int size = J_rate + 1;
};

/// Rate of velocity from internal force and stabilisation, before projection; and the sums that projections need.
///   -T_a = (V_kernel / V_a) [ sum_b s A_b r + A_a G_a ]               (29c), (32)
///   D4_a = -eps4 c_a h^3 L w_a   or   -(1 / V_a) [ sum_b ... - w_a sum_b l~_ab ]   (37b) or its adjoint form
/// and D(J) in the same way, where J is stabilised (38). The sum over all particles of V T vanishes identically.
template <int D, Biharmonic B, int Smoothed, class Loader>
struct SumForces {
  using Body = SecondSums<D, B, Smoothed>;
  using At = ForceTotals<D>;
  Loader loader;
  Body body;
  Constants k;
  View A, w;
  ReferenceView V, weight, G, diagonal;
  View wave_speed, x, v;
  WriteView rate;
  View rate_in;      ///< D2 of UpdateStress or Deform
  WriteView J_rate;  ///< D(J); without data unless Smoothed > D
  View J_rate_in;    ///< D2 of J

  PIOLA_INLINE_FN void operator()(Index i, Lanes* total) const {
    Lanes sum[Body::sums];
    loader(i, body, sum);
    auto const volume = V.scalar<Lanes>(i);
    Lanes const inverse_volume = 1.0 / maximum(volume, Lanes(1e-300));
    Vec<D, Lanes> force = A.matrix<D, Lanes>(i) * G.vector<D, Lanes>(i);
    for (int c = 0; c < D; ++c) force[c] = force[c] + sum[c];
    Vec<D, Lanes> const a_T = ((k.kernel_volume / k.rho0) * inverse_volume) * force;
    Vec<D, Lanes> const a_D = stabilisation(i, sum, inverse_volume);
    rate.vector<D>(i, a_T + a_D);
    add(i, weight.scalar<Lanes>(i), a_T, a_D, total);
    if constexpr (Body::laplacian && Smoothed > D) {
      Lanes D_J = biharmonic(i, sum, inverse_volume, D);
      if (k.eps2_J > 0) D_J = D_J + J_rate_in.scalar<Lanes>(i);
      J_rate.scalar(i, D_J);
      total[At::J_rate] = total[At::J_rate] + weight.scalar<Lanes>(i) * D_J;
    }
  }

 private:
  PIOLA_INLINE_FN Vec<D, Lanes> stabilisation(Index i, Lanes const* sum, Lanes const& inverse_volume) const {
    Vec<D, Lanes> a;
    for (int c = 0; c < D; ++c) {
      a[c] = Lanes(0.0);
      if constexpr (Body::laplacian) {
        a[c] = biharmonic(i, sum, inverse_volume, c);
        if (k.eps2 > 0) a[c] = a[c] + rate_in.scalar<Lanes>(i, c);
      }
    }
    return a;
  }
  /// D4 of smoothed value c.
  PIOLA_INLINE_FN Lanes biharmonic(Index i, Lanes const* sum, Lanes const& inverse_volume, int c) const {
    Lanes const L = sum[D + c];
    if constexpr (Body::adjoint) return -(inverse_volume * (L - w.scalar<Lanes>(i, c) * diagonal.scalar<Lanes>(i)));
    double const eps4 = c < D ? k.eps4 : k.eps4_J;
    return -((eps4 * k.h_min * k.h_min * k.h_min) * wave_speed.scalar<Lanes>(i) * L);
  }

  PIOLA_INLINE_FN void add(Index i, Lanes const& volume, Vec<D, Lanes> const& a_T, Vec<D, Lanes> const& a_D,
                           Lanes* total) const {
    Vec<D, Lanes> const place = x.vector<D, Lanes>(i), velocity = v.vector<D, Lanes>(i);
    add_motion<D>(volume, k, place, velocity, total);
    Vec<D, Lanes> arm = place;
    for (int c = 0; c < D; ++c) {
      arm[c] = place[c] - k.centre[c];
      total[At::T + c] = total[At::T + c] + volume * a_T[c];
      total[At::stabilisation + c] = total[At::stabilisation + c] + volume * a_D[c];
    }
    add_moment<D>(total + At::moment_T, volume, arm, a_T);
    add_moment<D>(total + At::moment_stabilisation, volume, arm, a_D);
    total[At::power_T] = total[At::power_T] + volume * dot(velocity, a_T);
    total[At::power_stabilisation] = total[At::power_stabilisation] + volume * dot(velocity, a_D);
  }
};

/// v* = v^n + dt a, x^(n+1) = x^n + dt/2 (v^n + v*)   or   v^(n+1) = 1/2 (v^n + v* + dt a)     (43), (47), (49)
/// with a = (D - T) / rho0 + spin cross arm + push, arms being x^n in stage 1 and x^(n+1) in stage 2 (45).
template <int D>
struct AdvanceMomentum {
  StageUpdate stage;
  RigidRate rigid;
  Variables variables;
  View rate, v, v_n, x;
  WriteView v_out, v_n_out, x_out, u_out;

  PIOLA_INLINE_FN void operator()(Index i) const {
    Vec<D, Lanes> const old_x = x.vector<D, Lanes>(i), now = v.vector<D, Lanes>(i);
    Vec<D, Lanes> a = rate.vector<D, Lanes>(i);
    add_rigid(old_x, a);
    Vec<D, Lanes> next = now + stage.dt * a;
    if (stage.second) {
      next = 0.5 * (v_n.vector<D, Lanes>(i) + next);
      if (variables == Variables::displacement) u_out.vector<D>(i, old_x);
    } else {
      v_n_out.vector<D>(i, now);
      x_out.vector<D>(i, old_x + (0.5 * stage.dt) * (now + next));
      if (variables == Variables::displacement) u_out.vector<D>(i, old_x + stage.dt * now);
    }
    v_out.vector<D>(i, next);
  }

 private:
  PIOLA_INLINE_FN void add_rigid(Vec<D, Lanes> const& x_a, Vec<D, Lanes>& a) const {
    Vec<D, Lanes> arm = x_a;
    for (int c = 0; c < D; ++c) arm[c] = x_a[c] - rigid.centre[c];
    for (int c = 0; c < D; ++c) a[c] = a[c] + rigid.push[c];
    if constexpr (D > 1) a = a + turned<D>(rigid.spin, arm);
  }
};

/// Largest wave speed of each block; reduced by the caller.
struct LargestWaveSpeed {
  View wave_speed;
  double* partial;
  PIOLA_INLINE_FN void operator()(Range b, Index k) const {
    Lanes largest(0.0);
    for (Index i = b.first; i < b.last; i += lane_count) largest = maximum(largest, wave_speed.scalar<Lanes>(i));
    double most = 0;
    for (int l = 0; l < lane_count; ++l) most = maximum(most, lane(largest, l));
    partial[k] = most;
  }
};

/// Holds the supported components: v_c = 0 and x_c at the position of the support (step 8 of Algorithm 1).
struct HoldSupports {
  bool second;  ///< second Runge-Kutta stage
  SupportComponent* supports;
  View v;
  WriteView v_out, x;
  PIOLA_INLINE_FN void operator()(Index k) const {
    SupportComponent& s = supports[k];
    auto const now = v.scalar<double>(s.slot, s.component);
    (second ? s.at_end : s.at_start) = (second ? -1 : -0.5) * now;
    v_out.scalar(s.slot, 0.0, s.component);
    x.scalar(s.slot, s.position, s.component);
  }
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
