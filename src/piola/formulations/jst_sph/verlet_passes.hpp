// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/stress_passes.hpp"

/// Passes of the default scheme: velocity Verlet, stabilisation without rigid motion, filtered volumetric energy.
/// Derivation: docs/theory/jst-sph-filtered.md.
namespace piola::jst_sph::inline PIOLA_BACKEND {

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
    Vec<D, Lanes> const half = v.vector<D, Lanes>(i) + (0.5 * dt) * rate.vector<D, Lanes>(i);
    Vec<D, Lanes> const moved = x.vector<D, Lanes>(i) + dt * half;
    v_out.vector<D>(i, half);
    x_out.vector<D>(i, moved);
    add_motion<D>(V.scalar<Lanes>(i), k, moved, half, total);
  }
};

/// Evolved H and J: views without data for {p,F}.
struct CarriedGeometry {
  View H, J;
  WriteView H_out, J_out, increment;
  bool starting;  ///< the increment starts at the undeformed state
};

/// F^(n+1) = F^n + dt GRAD v^(n+1/2), its wave speed and volume ratio; and the argument of the second Laplacian,
///   L v' = L v + spin cross L x,  v' = v + spin cross (x - centre) + push: the motion without its rigid part.
/// H and J as unknowns follow (1c) and (1d), integrated exactly along the straight way from F^n to F^(n+1):
///   H^(n+1) = H^n + 1/2 (F^n + F^(n+1)) x dF,   J^(n+1) = J^n + det F^(n+1) - det F^n.
/// Records the first particle whose new F is inverted or not a number.
template <int D, bool Stabilised>
struct Deform {
  double dt;
  Constants k;
  bool small_strain;  ///< the law's volume ratio is 1 + tr e, not det F
  RigidRate without_rigid;
  ReferenceView C, V;
  View F_in, wave_speed_in;
  WriteView F, wave_speed, volume_ratio, w, rate;
  CarriedGeometry carried;
  View filter_scale, filter_input_before;
  WriteView filter_source;  ///< neighbour data of the first filter pass: g = d V J, or d V times the increment
  WriteView filter_input;   ///< look-ahead value of J, if that is filtered
  WriteView ratio_change;   ///< change of J in the step, for the energy balance
  FailureSlot* failure;

  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    Mat<D, Lanes> const old = F_in.matrix<D, Lanes>(i);
    Mat<D, Lanes> const gradient = raw_gradient<D>(in, i) * C.symmetric<D, Lanes>(i), step = dt * gradient;
    Mat<D, Lanes> const next = old + step;
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
    Lanes const seen = k.hourglass.bulk_ahead > 0 ? ratio_ahead(full, gradient, ratio) : ratio;
    Lanes const filtered = evolves_volume(k.variables) ? carry(i, old, step, ratio, seen) : seen;
    if (k.hourglass.bulk_ahead > 0) {
      filter_input.scalar(i, seen);
      ratio_change.scalar(i, ratio - volume_ratio_of(small_strain, embed<D>(old)));
    }
    if (k.kappa_filtered > 0) filter_source.scalar(i, filter_scale.scalar<Lanes>(i) * V.scalar<Lanes>(i) * filtered);
    if constexpr (Stabilised) stabilise(i, in, c);
  }

 private:
  /// Look-ahead value J* = J + (time ahead) H : GRAD v.
  PIOLA_FN Lanes ratio_ahead(Mat<3, Lanes> const& full, Mat<D, Lanes> const& gradient, Lanes const& ratio) const {
    Mat<3, Lanes> const dF = embed_rate<D>(gradient);
    return ratio + k.hourglass.bulk_ahead * (small_strain ? trace(dF) : contract(cofactor(full), dF));
  }

  /// The increment of J from the present volume ratio of F; from `seen` if the filter uses that.
  PIOLA_FN Lanes carry(Index i, Mat<D, Lanes> const& old, Mat<D, Lanes> const& step, Lanes const& ratio,
                       Lanes const& seen) const {
    Mat<3, Lanes> const before = embed<D>(old);
    if (k.variables == Variables::pFHJ) {
      Mat<3, Lanes> const dF = embed_rate<D>(step);
      carried.H_out.matrix<3>(i, carried.H.matrix<3, Lanes>(i) + tensor_cross(before + 0.5 * dF, dF));
    }
    Lanes increment = ratio - volume_ratio_of(small_strain, before);
    if (k.kappa_filtered > 0) {
      if (k.hourglass.bulk_ahead > 0) increment = seen - filter_input_before.scalar<Lanes>(i);
      if (carried.starting) increment = seen - 1.0;
      carried.increment.scalar(i, increment);
      return increment;
    }
    Lanes const J = carried.J.scalar<Lanes>(i) + increment;
    record_inverted(failure, i, J, 2);
    carried.J_out.scalar(i, J);
    return increment;
  }

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
/// kappa_local is the bulk modulus. H and J may be unknowns of their own; with the filter the evolved volume ratio is
/// the filtered one behind q.
template <int D, class Law>
struct WeightStress {
  Law law;
  Constants k;
  ReferenceView C, V;
  View F, volume_ratio, filtered_pressure, H, J;
  WriteView A;

  PIOLA_FN void operator()(Index i) const { fold(i, law_stress(i)); }
  /// As above, adding a stress to that of the law.
  PIOLA_FN void operator()(Index i, Mat<D, Lanes> const& more) const { fold(i, law_stress(i) + more); }

 private:
  PIOLA_FN Mat<D, Lanes> law_stress(Index i) const {
    return restrict_to<D>(stress(i, embed<D>(F.matrix<D, Lanes>(i))));
  }
  PIOLA_FN void fold(Index i, Mat<D, Lanes> const& P) const {
    A.matrix<D>(i, (V.scalar<Lanes>(i) * (1.0 / k.kernel_volume)) * (P * C.symmetric<D, Lanes>(i)));
  }
  PIOLA_FN Mat<3, Lanes> stress(Index i, Mat<3, Lanes> const& full) const {
    if constexpr (std::is_same_v<Law, SolidStress>)
      return law.first_piola(i, full);
    else
      return stress_of_geometry(i, full);
  }

  PIOLA_FN Mat<3, Lanes> stress_of_geometry(Index i, Mat<3, Lanes> const& full) const {
    bool const area = k.variables == Variables::pFHJ;
    if constexpr (Law::volumetric_split) {
      if (k.kappa_filtered > 0) {
        Lanes const p = acting_pressure(k, volume_ratio, filtered_pressure, i);
        if (area) return law.stress_with_pressure(full, H.matrix<3, Lanes>(i), determinant(full), p);
        return law.stress_with_pressure(full, p);
      }
    }
    if (area) return law.stress(full, H.matrix<3, Lanes>(i), J.scalar<Lanes>(i));
    if (evolves_volume(k.variables)) return law.stress(full, cofactor(full), J.scalar<Lanes>(i));
    return law.first_piola(full);
  }
};

/// Deform and WeightStress of a block in one pass, without a filter between them.
template <int D, bool Stabilised, class Law>
struct DeformAndWeightStress {
  Deform<D, Stabilised> deform;
  WeightStress<D, Law> stress;
  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
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

/// v_c = 0 and a_c = 0 at supports; the reaction is the value that is replaced.
struct HoldVelocity {
  double dt;
  bool trial;  ///< stores no reaction
  SupportComponent* supports;
  View v, rate;
  WriteView v_out, rate_out;
  PIOLA_FN void operator()(Index k) const {
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

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
