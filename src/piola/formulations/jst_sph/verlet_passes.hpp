// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/passes.hpp"

/// Passes of the default scheme: velocity Verlet, stabilisation without rigid motion, filtered volumetric energy.
/// Derivation: docs/theory/jst-sph-default.md.
namespace piola::jst_sph::inline PIOLA_MACHINE {

/// Positions in the sums of KickAndDrift; x are arms from `centre`.
template <int D>
struct MotionTotals {
  static constexpr int x = 0;                     // sum V x
  static constexpr int xx = x + D;                // sum V x (x) x
  static constexpr int v = xx + SymMat<D>::size;  // sum V v
  static constexpr int moment_v = v + D;          // sum V x cross v
  static constexpr int size = moment_v + spins<D>;
};

/// v^(n+1/2) = v^n + dt/2 a^n,  x^(n+1) = x^n + dt v^(n+1/2); and the sums that give the rigid part of the motion.
template <int D>
struct KickAndDrift {
  double dt;
  Constants k;
  ReferenceView V;
  View rate;
  View v, x;
  WriteView v_out, x_out;

  PIOLA_FN void operator()(Index i, Lanes* total) const {
    using At = MotionTotals<D>;
    Vec<D, Lanes> const half = v.vector<D, Lanes>(i) + (0.5 * dt) * rate.vector<D, Lanes>(i);
    Vec<D, Lanes> const moved = x.vector<D, Lanes>(i) + dt * half;
    v_out.vector<D>(i, half);
    x_out.vector<D>(i, moved);
    Lanes const volume = V.scalar<Lanes>(i);
    Vec<D, Lanes> arm = moved;
    for (int c = 0; c < D; ++c) arm[c] = moved[c] - k.centre[c];
    for (int c = 0; c < D; ++c) {
      Lanes const Vx = volume * arm[c];
      total[At::x + c] = total[At::x + c] + Vx;
      total[At::v + c] = total[At::v + c] + volume * half[c];
      for (int d = c; d < D; ++d) {
        int const at = At::xx + SymMat<D>::at(c, d);
        total[at] = total[at] + Vx * arm[d];
      }
    }
    add_moment<D>(total + At::moment_v, volume, arm, half);
  }
};

/// F^(n+1) = F^n + dt GRAD v^(n+1/2), its wave speed and volume ratio; and what the second Laplacian is applied to,
///   L v' = L v + spin cross L x,  v' = v + spin cross (x - centre) + push: the motion without its rigid part.
/// Records the first particle whose new F is inverted or not a number.
template <int D, int Laplacians>
struct Deform {
  double dt;
  Constants k;
  bool small_strain;  ///< the law's volume ratio is 1 + tr e, not det F
  RigidRate without_rigid;
  ReferenceView C, V;
  View F_in;
  WriteView F, wave_speed, volume_ratio, w, rate;
  FailureSlot* failure;

  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    Mat<D, Lanes> const next = F_in.matrix<D, Lanes>(i) + dt * (raw_gradient<D>(in, i) * C.symmetric<D, Lanes>(i));
    F.matrix<D>(i, next);
    Mat<3, Lanes> const full = embed<D>(next);
    Lanes const J = determinant(full);
    auto const good = J > 0.0;
    if (any(!good)) record_inverted(failure, i, J);
    Lanes const c = k.c_p0 / square_root(maximum(smallest_stretch_squared(full), Lanes(1e-12)));
    wave_speed.scalar(i, c);
    volume_ratio.scalar(i, small_strain ? trace(full) - 2.0 : J);
    if constexpr (Laplacians == 2) stabilise(i, in, c);
  }

 private:
  PIOLA_FN void stabilise(Index i, exec::Scratch const& in, Lanes const& c) const {
    Vec<D, Lanes> Lv, Lx;
    for (int j = 0; j < D; ++j) {
      Lv[j] = load<Lanes>(in.at(i, D * D + j));
      Lx[j] = load<Lanes>(in.at(i, D * D + D + j));
    }
    Vec<D, Lanes> const L = Lv + turned<D>(without_rigid.spin, Lx);
    double const h3 = k.h_min * k.h_min * k.h_min;
    Lanes const factor = k.biharmonic == Biharmonic::adjoint ? (k.eps4 * h3) * (c * V.scalar<Lanes>(i)) : Lanes(1.0);
    w.vector<D>(i, factor * L);
    if (k.eps2 > 0) rate.vector<D>(i, ((k.eps2 * k.h_min) * c) * L);
  }
};

/// A_a = (V_a / V_kernel) P C_a with P from F and the pressure p = kappa_local (J - 1) + q; without filter q = 0 and
/// kappa_local is the bulk modulus.
template <int D, class Law>
struct WeightStress {
  Law law;
  Constants k;
  ReferenceView C, V;
  View F, volume_ratio, filtered_pressure;
  WriteView A;

  PIOLA_FN void operator()(Index i) const {
    Lanes p = k.kappa_local * (volume_ratio.scalar<Lanes>(i) - 1.0);
    if (k.kappa_filtered > 0) p = p + filtered_pressure.scalar<Lanes>(i);
    Mat<D, Lanes> const P = restrict_to<D>(law.stress_with_pressure(embed<D>(F.matrix<D, Lanes>(i)), p));
    A.matrix<D>(i, (V.scalar<Lanes>(i) * (1.0 / k.kernel_volume)) * (P * C.symmetric<D, Lanes>(i)));
  }
};

/// Deform and WeightStress of a block in one go, where no filter stands between them.
template <int D, int Laplacians, class Law>
struct DeformAndWeightStress {
  Deform<D, Laplacians> deform;
  WeightStress<D, Law> stress;
  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    deform(i, in);
    stress(i);
  }
};

/// sum_{b != a} W_ab g_b
struct FilterSums {
  static constexpr bool smooths = true;
  static constexpr int fields = 1, outer_fields = 1, sums = 1;
  View gathered;
  struct Nothing {};
  template <class V>
  PIOLA_FN Nothing own(Index) const {
    return {};
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_FN void pair(V* sum, O const&, G const& g, V const* f) const {
    if constexpr (Masked)
      sum[0] = sum[0] + (g.weight * g.kernel) * f[0];
    else
      sum[0] = sum[0] + g.kernel * f[0];
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_FN void outer(V* sum, O const& own, G const& g, V const* f) const {
    pair<Masked>(sum, own, g, f);
  }
};

/// One pass of the filter S, symmetric and doubly stochastic in the tributary volumes:
///   (S f)_a = f_a (1 - sum_{b != a} s_ab V_b) + sum_{b != a} s_ab V_b f_b,   s_ab = d_a W_ab d_b,
/// of an input that is given as f and, for neighbours, as g = d V f; the output in both forms.
template <class Loader>
struct Smooth {
  Loader loader;
  FilterSums body;
  ReferenceView V;
  View f, d, sum;
  WriteView f_out, g_out;

  PIOLA_FN void operator()(Index i) const {
    Lanes total[1];
    loader(i, body, total);
    Lanes const scaling = d.scalar<Lanes>(i);
    Lanes const smooth = f.scalar<Lanes>(i) * (1.0 - sum.scalar<Lanes>(i)) + scaling * total[0];
    f_out.scalar(i, smooth);
    g_out.scalar(i, scaling * V.scalar<Lanes>(i) * smooth);
  }
};

/// g = d V f, what the first filter pass reads at neighbours.
struct PrepareFilter {
  ReferenceView V;
  View f, d;
  WriteView g;
  PIOLA_FN void operator()(Index i) const { g.scalar(i, d.scalar<Lanes>(i) * V.scalar<Lanes>(i) * f.scalar<Lanes>(i)); }
};

/// q = kappa_f (Jf - 1) and g = d V q.
struct Compress {
  double kappa_filtered;
  ReferenceView V;
  View filtered_ratio, d;
  WriteView q, g;
  PIOLA_FN void operator()(Index i) const {
    Lanes const pressure = kappa_filtered * (filtered_ratio.scalar<Lanes>(i) - 1.0);
    q.scalar(i, pressure);
    g.scalar(i, d.scalar<Lanes>(i) * V.scalar<Lanes>(i) * pressure);
  }
};

/// a^(n+1) = (D - T) / rho0 + the rigid rate that balances it;  v^(n+1) = v^(n+1/2) + dt/2 a^(n+1).
template <int D>
struct Kick {
  double dt;
  RigidRate rigid;
  View rate, v, x;
  WriteView rate_out, v_out;

  PIOLA_FN void operator()(Index i) const {
    Vec<D, Lanes> arm = x.vector<D, Lanes>(i), push;
    for (int c = 0; c < D; ++c) {
      arm[c] = arm[c] - rigid.centre[c];
      push[c] = Lanes(rigid.push[c]);
    }
    Vec<D, Lanes> const a = rate.vector<D, Lanes>(i) + push + turned<D>(rigid.spin, arm);
    rate_out.vector<D>(i, a);
    v_out.vector<D>(i, v.vector<D, Lanes>(i) + (0.5 * dt) * a);
  }
};

/// v_c = 0 and a_c = 0 where a support holds.
struct HoldVelocity {
  SupportComponent const* supports;
  WriteView v, rate;
  PIOLA_FN void operator()(Index k) const {
    SupportComponent const& s = supports[k];
    v.scalar(s.slot, 0.0, s.component);
    rate.scalar(s.slot, 0.0, s.component);
  }
};

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
