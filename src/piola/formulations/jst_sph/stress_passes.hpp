// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/passes.hpp"
#include "piola/materials/laws.hpp"

/// From the first sums of a Runge-Kutta stage, scheme "paper" or displacement variables, to the input of the second
/// sweep: geometry, stress, stabilisation.
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// Records the lanes whose volume ratio is not positive, or NaN. Code 1: det F, code 2: the evolved J.
PIOLA_INLINE_FN void record_inverted(FailureSlot* failure, Index i, Lanes const& J, int code = 1) {
  auto const good = J > 0.0;
  if (!any(!good)) return;
  for (int l = 0; l < lane_count; ++l)
    if (!(lane(J, l) > 0)) exec::record(failure, i + l, code);
}

/// Views of H and J if these are evolved; otherwise without data.
struct EvolvedGeometry {
  View H, H_star, J, J_n;
  WriteView H_out, J_out, J_n_out;
};

/// Smallest principal stretch of a D-dimensional body, squared. In one dimension two stretches are 1, and the smallest
/// of a double root would have the square root of the round-off.
template <int D>
PIOLA_INLINE_FN Lanes smallest_stretch_squared_in(Mat<3, Lanes> const& F) {
  if constexpr (D == 1) return minimum(F(0, 0) * F(0, 0), Lanes(1.0));
  return smallest_stretch_squared(F);
}

/// The authors' estimate of c_p: c_p0 / lambda_min.
template <int D>
PIOLA_INLINE_FN Lanes estimated_wave_speed(Constants const& k, Mat<3, Lanes> const& F) {
  return k.c_p0 / square_root(maximum(smallest_stretch_squared_in<D>(F), Lanes(1e-12)));
}

/// c_p of a particle: the estimate, or from the largest modulus of the law in the principal directions (step 2 of
/// Algorithm 1). At least the shear wave speed at rest, because laws that soften under compression lose their modulus
/// there.
template <int D, class Law>
PIOLA_FN Lanes wave_speed_of(Law const& law, Constants const& k, Mat<3, Lanes> const& F) {
  if (!k.exact_speed) return estimated_wave_speed<D>(k, F);
  Vec<3, Lanes> const l = principal_stretches_squared(F);
  Lanes const modulus = maximum(law.largest_modulus(l[0], l[1], l[2]), Lanes(law.mu));
  return square_root((1.0 / k.rho0) * modulus);
}

/// From the first sums to the input of the second sweep:
///   F_dot_a = (sum_b s (v_b - v_a) (x) r) C_a,  H_dot = F x F_dot,  J_dot = H : F_dot       (33)
///   A_a = (V_a / V_kernel) P(F, H, J) C_a                             (12), folded for (29c)
///   w_a = L f_a,  f = v, and J where it is stabilised                                       (37), (38)
///   D2_a = eps2 c_a h L f_a, written to `rate` and `J_rate`           (36)
///   stage 1: F* = F^n + dt F_dot;  stage 2: F^(n+1) = 1/2 (F^n + F* + dt F_dot*)            (43)
/// and the same for H and J. For displacement variables F_a = (sum_b s (x_b - x_a) (x) r) C_a instead (34).
/// Records the first particle whose new F is inverted or not a number.
template <int D, class Law>
struct UpdateStress {
  Law law;
  int smoothed;  ///< sums L f: none, those of v (D), or also that of J (D + 1)
  Constants k;
  StageUpdate stage;
  ReferenceView C, V;
  View wave_speed, F_n, F_star;
  EvolvedGeometry evolved;
  WriteView F_out, A, w, rate, J_rate, wave_speed_next;
  FailureSlot* failure;

  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    Mat<D, Lanes> const gradient = raw_gradient<D>(in, i) * C.symmetric<D, Lanes>(i);
    Lanes const volume = V.scalar<Lanes>(i);
    Mat<D, Lanes> const F = deform(i, gradient, volume);
    Mat<D, Lanes> const P = restrict_to<D>(stress(i, embed<D>(F), gradient));
    A.matrix<D>(i, (volume * (1.0 / k.kernel_volume)) * (P * C.symmetric<D, Lanes>(i)));
    if (smoothed > 0) stabilise(i, in);
  }

 private:
  /// Returns the F at which stress is evaluated; stores the F of the stage and derived values.
  PIOLA_INLINE_FN Mat<D, Lanes> deform(Index i, Mat<D, Lanes> const& gradient, Lanes const& volume) const {
    Mat<D, Lanes> F = gradient;
    // Empty slots must stay finite: their values meet zero weights.
    for (int c = 0; c < D; ++c) F(c, c) = select(volume > 0.0, F(c, c), Lanes(1.0));
    Mat<D, Lanes> next = F;
    if (k.variables != Variables::displacement) {
      Mat<D, Lanes> const old = F_n.matrix<D, Lanes>(i);
      F = stage.second ? F_star.matrix<D, Lanes>(i) : old;
      next = F + stage.dt * gradient;
      if (stage.second) next = 0.5 * (old + next);
    }
    F_out.matrix<D>(i, next);
    Mat<3, Lanes> const full = embed<D>(next);
    record_inverted(failure, i, determinant(full));
    if (stage.second) wave_speed_next.scalar(i, wave_speed_of<D>(law, k, full));
    return F;
  }

  PIOLA_INLINE_FN Mat<3, Lanes> stress(Index i, Mat<3, Lanes> const& F, Mat<D, Lanes> const& gradient) const {
    return evolves_volume(k.variables) ? stress_of_evolved(i, F, gradient) : law.first_piola(F);
  }

  /// P of evolved F, H and J, which the stage advances.
  PIOLA_INLINE_FN Mat<3, Lanes> stress_of_evolved(Index i, Mat<3, Lanes> const& F,
                                                  Mat<D, Lanes> const& gradient) const {
    Mat<3, Lanes> const F_dot = embed_rate<D>(gradient);
    Mat<3, Lanes> H;
    if (k.variables == Variables::pFHJ) {
      Mat<3, Lanes> const old = evolved.H.matrix<3, Lanes>(i);
      H = stage.second ? evolved.H_star.matrix<3, Lanes>(i) : old;
      Mat<3, Lanes> next = H + stage.dt * tensor_cross(F, F_dot);
      if (stage.second) next = 0.5 * (old + next);
      evolved.H_out.matrix<3>(i, next);
    } else {
      H = cofactor(F);
    }
    // The volume ratio of a law of small strain is 1 + tr e, whose rate has H = I.
    Lanes const J = evolved.J.scalar<Lanes>(i), J_dot = Law::small_strain ? trace(F_dot) : contract(H, F_dot);
    Lanes next = J + stage.dt * J_dot;
    if (stage.second)
      next = 0.5 * (evolved.J_n.scalar<Lanes>(i) + next);
    else
      evolved.J_n_out.scalar(i, J);
    evolved.J_out.scalar(i, next);
    record_inverted(failure, i, next, 2);
    return law.stress(F, H, J);
  }

  PIOLA_INLINE_FN void stabilise(Index i, exec::Scratch const& in) const {
    Lanes const c = wave_speed.scalar<Lanes>(i);
    for (int j = 0; j < D + 1; ++j) {
      if (j >= smoothed) break;
      double const eps2 = j < D ? k.eps2 : k.eps2_J;
      Lanes const Lf = load<Lanes>(in.at(i, D * D + j));
      w.scalar(i, Lf, j);
      if (!(eps2 > 0)) continue;
      Lanes const harmonic = (eps2 * k.h_min) * c * Lf;
      if (j < D)
        rate.scalar(i, harmonic, j);
      else
        J_rate.scalar(i, harmonic);
    }
  }
};

/// The p-wave speed of every particle from its F.
template <int D, class Law>
struct ComputeWaveSpeed {
  Law law;
  Constants k;
  View F;
  WriteView wave_speed;
  PIOLA_INLINE_FN void operator()(Index i) const {
    wave_speed.scalar(i, wave_speed_of<D>(law, k, embed<D>(F.matrix<D, Lanes>(i))));
  }
};

/// The wave speed of every particle of a body.
template <int D>
void compute_wave_speed(BodyState const& body) {
  with_law(body.material, [&](auto const& law) {
    exec::for_each(body.slots, ComputeWaveSpeed<D, std::decay_t<decltype(law)>>{law, body.constants, read(body.F),
                                                                                write(body.wave_speed)});
  });
}

/// F_a = (sum_b s (x_b - x_a) (x) r) C_a  (34): the deformation gradient of the positions.
template <int D>
struct StoreDeformation {
  ReferenceView C;
  WriteView F;
  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    F.matrix<D>(i, raw_gradient<D>(in, i) * C.symmetric<D, Lanes>(i));
  }
};

/// J = next + weight of the step (D(J) - its mean), the mean being the projection that conserves sum V J (51).
struct AdvanceVolume {
  double time, mean;
  View next, rate;
  WriteView J;
  FailureSlot* failure;
  PIOLA_INLINE_FN void operator()(Index i) const {
    Lanes const value = next.scalar<Lanes>(i) + time * (rate.scalar<Lanes>(i) - mean);
    record_inverted(failure, i, value, 2);
    J.scalar(i, value);
  }
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
