// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/stress_passes.hpp"

/// Passes of the scheme "filtered": velocity Verlet, stabilisation without rigid motion, filtered volumetric energy.
/// Derivation: docs/theory/jst-sph-filtered.md.
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// v^(n+1/2) = v^n + dt/2 a^n,  x^(n+1) = x^n + dt v^(n+1/2); and adds to the sums that give the rigid part of
/// the motion.
template <int D>
struct KickAndDrift {
  double dt;
  Constants k;
  ReferenceView V;
  View rate;
  View v, x;
  WriteView v_out, x_out;

  PIOLA_INLINE_FN void operator()(Index i, Lanes* total) const {
    Vec<D, Lanes> const half = v.vector<D, Lanes>(i) + (0.5 * dt) * rate.vector<D, Lanes>(i);
    Vec<D, Lanes> const moved = x.vector<D, Lanes>(i) + dt * half;
    v_out.vector<D>(i, half);
    x_out.vector<D>(i, moved);
    add_motion<D>(V.scalar<Lanes>(i), k, moved, half, total);
  }
};

/// F^(n+1) = F^n + dt GRAD v^(n+1/2), its wave speed and volume ratio; and the argument of the second Laplacian,
///   w = eps4 c h^3 V L v',  L v' = L v + spin cross L x
/// for the motion without its rigid part, v' = v + spin cross (x - centre) + push; and D2 = eps2 c h L v', written to
/// `rate`. Records the first particle whose new F is inverted or not a number.
template <int D>
struct Deform {
  double dt;
  Constants k;
  bool small_strain;  ///< the law's volume ratio is 1 + tr e, not det F
  RigidRate without_rigid;
  ReferenceView C, V;
  View F_in, wave_speed_in;  ///< the fields that F and wave_speed overwrite: the rate of F is not kept
  WriteView F, wave_speed, volume_ratio, w, rate;
  View filter_scale;
  WriteView filter_source;  ///< neighbour data of the first filter pass: g = d V J
  FailureSlot* failure;

  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    Mat<D, Lanes> const gradient = raw_gradient<D>(in, i) * C.symmetric<D, Lanes>(i);
    Mat<D, Lanes> const next = F_in.matrix<D, Lanes>(i) + dt * gradient;
    F.matrix<D>(i, next);
    Mat<3, Lanes> const full = embed<D>(next);
    Lanes const J = determinant(full);
    record_inverted(failure, i, J);
    Lanes c;
    if (k.exact_speed) {
      c = wave_speed_in.scalar<Lanes>(i);  // of the last step; ComputeWaveSpeed follows
    } else {
      c = estimated_wave_speed<D>(k, full);
      wave_speed.scalar(i, c);
    }
    Lanes const ratio = small_strain ? volume_ratio_of(true, full) : J;
    volume_ratio.scalar(i, ratio);
    if (k.kappa_filtered > 0) filter_source.scalar(i, filter_scale.scalar<Lanes>(i) * V.scalar<Lanes>(i) * ratio);
    stabilise(i, in, c);
  }

 private:
  PIOLA_INLINE_FN void stabilise(Index i, exec::Scratch const& in, Lanes const& c) const {
    Vec<D, Lanes> Lv, Lx;
    for (int j = 0; j < D; ++j) {
      Lv[j] = load<Lanes>(in.at(i, D * D + j));
      Lx[j] = load<Lanes>(in.at(i, D * D + D + j));
    }
    Vec<D, Lanes> const L = Lv + turned<D>(without_rigid.spin, Lx);
    double const h3 = k.h_min * k.h_min * k.h_min;
    w.vector<D>(i, (k.eps4 * h3) * (c * V.scalar<Lanes>(i)) * L);
    if (k.eps2 > 0) rate.vector<D>(i, ((k.eps2 * k.h_min) * c) * L);
  }
};

/// A_a = (V_a / V_kernel) P C_a with P from F and, with filtered volumetric energy, the pressure
/// p = kappa_local (J - 1) + q.
template <int D, class Law>
struct WeightStress {
  Law law;
  Constants k;
  ReferenceView C, V;
  View F, volume_ratio, filtered_pressure;
  WriteView A;

  PIOLA_INLINE_FN void operator()(Index i) const {
    Mat<D, Lanes> const P = restrict_to<D>(stress(i, embed<D>(F.matrix<D, Lanes>(i))));
    A.matrix<D>(i, (V.scalar<Lanes>(i) * (1.0 / k.kernel_volume)) * (P * C.symmetric<D, Lanes>(i)));
  }

 private:
  PIOLA_INLINE_FN Mat<3, Lanes> stress(Index i, Mat<3, Lanes> const& full) const {
    if constexpr (Law::volumetric_split) {
      if (k.kappa_filtered > 0) {
        Lanes const p = k.kappa_local * (volume_ratio.scalar<Lanes>(i) - 1.0) + filtered_pressure.scalar<Lanes>(i);
        return law.stress_with_pressure(full, p);
      }
    }
    return law.first_piola(full);
  }
};

/// Deform and WeightStress of a block in one pass, without a filter between them.
template <int D, class Law>
struct DeformAndWeightStress {
  Deform<D> deform;
  WeightStress<D, Law> stress;
  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    deform(i, in);
    stress(i);
  }
};

/// a^(n+1) = (D - T) / rho0 + the rigid rate that balances it;  v^(n+1) = v^(n+1/2) + dt/2 a^(n+1).
template <int D>
struct Kick {
  double dt;
  RigidRate rigid;
  View rate, v, x;
  WriteView rate_out, v_out;

  PIOLA_INLINE_FN void operator()(Index i) const {
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

/// v_c = 0 and a_c = 0 at supports; the reaction is the value that is replaced.
struct HoldVelocity {
  double dt;
  bool trial;  ///< stores no reaction
  SupportComponent* supports;
  View v, rate;
  WriteView v_out, rate_out;
  PIOLA_INLINE_FN void operator()(Index k) const {
    SupportComponent& s = supports[k];
    if (!trial) {
      s.at_start = 0.5 * dt * s.removed;
      s.at_end = -v.scalar<double>(s.slot, s.component);
      s.removed = -rate.scalar<double>(s.slot, s.component);
    }
    v_out.scalar(s.slot, 0.0, s.component);
    rate_out.scalar(s.slot, 0.0, s.component);
  }
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
