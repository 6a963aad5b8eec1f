// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/verlet_passes.hpp"

/// Passes of the conservative scheme: an energy for the part of a deformation that gradients do not see, and its
/// viscous part. Derivation: docs/theory/jst-sph-conservative.md.
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// Divisor for empty slots: large enough to avoid overflow.
inline constexpr double no_volume = 1e-200;

/// Sums over the neighbours of the gradient, with e = x_b - x_a - (F_a + F_b) r / 2 and g = V (xi_0 + xi_1 W_iso / mu):
///   sum_b (g_a + g_b) s e,   sum_b (g_a + g_b) e (x) s r,   sum_b s e.e
/// Neighbours give x, F and g.
template <int D>
struct HourglassSums {
  static constexpr bool smooths = false;
  static constexpr int F = D, g = D + D * D;  // positions in a record
  static constexpr int fields = D + D * D + 1, outer_fields = 0;
  static constexpr int sums = fields;
  View gathered;

  template <class V>
  struct Own {
    Vec<D, V> x;
    Vec<D * D, V> F;
    V g;
  };
  template <class V>
  PIOLA_FN Own<V> own(Index a) const {
    return {gathered.vector<D, V>(a), gathered.vector<D * D, V>(a, F), gathered.scalar<V>(a, g)};
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_FN void pair(V* sum, O const& own, G const& geometry, V const* b) const {
    V const both = own.g + b[g];
    V square = V(0.0);
    for (int i = 0; i < D; ++i) {
      V e = b[i] - own.x[i];
      for (int j = 0; j < D; ++j) e = e - (own.F[i * D + j] + b[F + i * D + j]) * (0.5 * geometry.r[j]);
      square = square + e * e;
      e = both * e;
      sum[i] = sum[i] + geometry.s * e;
      for (int j = 0; j < D; ++j) sum[F + i * D + j] = sum[F + i * D + j] + e * geometry.sr[j];
    }
    sum[g] = sum[g] + geometry.s * square;
  }
  template <bool Masked, class O, class G, class V>
  PIOLA_FN void outer(V*, O const&, G const&, V const*) const {}
};

/// The sweep that fills a block's scratch with these sums.
template <int D, class Loader>
struct SumHourglass {
  static constexpr int sums = HourglassSums<D>::sums;
  Loader loader;
  HourglassSums<D> body;

  PIOLA_FN void operator()(Index i, exec::Scratch const& out) const {
    Lanes sum[sums];
    loader(i, body, sum);
    for (int c = 0; c < sums; ++c) store(sum[c], out.at(i, c));
  }
};

/// Energy of a change of shape alone, per volume [J/m^3]: the law's own isochoric part; for laws without one that of a
/// neo-Hookean solid with the same shear modulus. Solids in rate form, whose elastic strain is small, have none.
template <class Law>
PIOLA_FN Lanes shape_energy(Law const& law, Mat<3, Lanes> const& F) {
  if constexpr (std::is_same_v<Law, SolidStress>) {
    return Lanes(0.0);
  } else if constexpr (Law::volumetric_split) {
    return law.isochoric_energy(F);
  } else {
    Lanes const a = power_minus_third(determinant(F));
    return (0.5 * law.mu) * (a * a * contract(F, F) - 3.0);
  }
}

/// Its derivative with respect to F [Pa].
template <class Law>
PIOLA_FN Mat<3, Lanes> shape_stress(Law const& law, Mat<3, Lanes> const& F) {
  if constexpr (std::is_same_v<Law, SolidStress>) {
    return {};
  } else if constexpr (Law::volumetric_split) {
    return law.stress_with_pressure(F, Lanes(0.0));
  } else {
    Mat<3, Lanes> const H = cofactor(F);
    Lanes const J = F(0, 0) * H(0, 0) + F(0, 1) * H(0, 1) + F(0, 2) * H(0, 2);
    Lanes const a = power_minus_third(J), shear = law.mu * (a * a);
    return shear * F + (-(shear * contract(F, F)) / (3.0 * J)) * H;
  }
}

/// g = V (xi_0 + xi_1 W_iso / mu)
template <class Law>
PIOLA_FN Lanes hourglass_weight(Law const& law, HourglassConstants const& k, Lanes const& volume,
                                Mat<3, Lanes> const& F) {
  return volume * (k.stiffness + k.stiffening * shape_energy(law, F));
}

/// spin cross F, column by column.
template <int D>
PIOLA_FN Mat<D, Lanes> turned(double const (&spin)[3], Mat<D, Lanes> const& F) {
  Mat<D, Lanes> r;
  for (int j = 0; j < D; ++j) {
    Vec<D, Lanes> column;
    for (int i = 0; i < D; ++i) column[i] = F(i, j);
    column = turned<D>(spin, column);
    for (int i = 0; i < D; ++i) r(i, j) = column[i];
  }
  return r;
}

/// Inputs of hourglass forces: position and deformation gradient a time tau later, without the rigid motion,
///   x* = x + tau (v + spin cross (x - centre) + push),   F* = F + tau (GRAD v + spin cross F),
/// and g. Also the work of the forces at the step's start along the step, for the energy balance, with that of the
/// filtered pressure q, whose viscous part is accounted for in the same way.
template <int D, class Law>
struct LookAhead {
  Law law;
  double dt;
  Constants k;
  RigidRate without_rigid;
  ReferenceView C, V;
  View F, x, v, force, stress, q, ratio_change;
  WriteView ahead, work;

  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    using At = HourglassSums<D>;
    double const tau = k.hourglass.ahead;
    Mat<D, Lanes> const gradient = raw_gradient<D>(in, i) * C.symmetric<D, Lanes>(i), now = F.matrix<D, Lanes>(i);
    Vec<D, Lanes> const place = x.vector<D, Lanes>(i), velocity = v.vector<D, Lanes>(i);
    Vec<D, Lanes> arm = place, push;
    for (int c = 0; c < D; ++c) {
      arm[c] = place[c] - without_rigid.centre[c] - k.centre[c];
      push[c] = Lanes(without_rigid.push[c]);
    }
    ahead.vector<D>(i, place + tau * (velocity + turned<D>(without_rigid.spin, arm) + push));
    ahead.matrix<D>(i, now + tau * (gradient + turned<D>(without_rigid.spin, now)), At::F);
    ahead.scalar(i, hourglass_weight(law, k.hourglass, V.scalar<Lanes>(i), embed<D>(now)), At::g);
    Lanes done =
        dt * (k.rho0 * dot(force.vector<D, Lanes>(i), velocity) - contract(stress.matrix<D, Lanes>(i), gradient));
    if (k.hourglass.bulk_ahead > 0) done = done - q.scalar<Lanes>(i) * ratio_change.scalar<Lanes>(i);
    work.scalar(i, done);
  }
};

/// As above for the current state, for observers.
template <int D, class Law>
struct LookAtState {
  Law law;
  Constants k;
  ReferenceView V;
  View F, x;
  WriteView ahead;

  PIOLA_FN void operator()(Index i) const {
    using At = HourglassSums<D>;
    Mat<D, Lanes> const now = F.matrix<D, Lanes>(i);
    ahead.vector<D>(i, x.vector<D, Lanes>(i));
    ahead.matrix<D>(i, now, At::F);
    ahead.scalar(i, hourglass_weight(law, k.hourglass, V.scalar<Lanes>(i), embed<D>(now)), At::g);
  }
};

/// U_a / V_a = (mu / 4) (g_a / V_a) sum_b w e.e,  w = s / m.
template <int D>
struct StoreHourglassEnergy {
  Constants k;
  ReferenceView V;
  View ahead;
  WriteView energy;
  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    using At = HourglassSums<D>;
    Lanes const inverse_volume = 1.0 / maximum(V.scalar<Lanes>(i), Lanes(no_volume));
    energy.scalar(i,
                  k.hourglass.modulus * inverse_volume * ahead.scalar<Lanes>(i, At::g) * load<Lanes>(in.at(i, At::g)));
  }
};

/// Deform and LookAhead of a block in one pass.
template <int D, bool Stabilised, class Law>
struct DeformAndLookAhead {
  Deform<D, Stabilised> deform;
  LookAhead<D, Law> look;
  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    deform(i, in);
    look(i, in);
  }
};

/// From the hourglass sums to force and stress, the derivatives of their energy U = sum_a (mu / 4) g_a sum_b w e.e,
///   f_a = (mu / 2 V_a) sum_b (g_a + g_b) w e
///   P_a = -(mu / 4 V_a) sum_b (g_a + g_b) w e (x) r + (xi_1 / 4) (sum_b w e.e) P_iso,
/// here with x* and F* in e; and A of the whole stress. `work` grows by that of the forces of the step's end.
template <int D, class Law>
struct WeightStressAndHourglass {
  WeightStress<D, Law> weight;
  double dt;
  RigidRate without_rigid;
  View v, ahead, ratio_change, work_before;
  WriteView force, stress, work;

  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    using At = HourglassSums<D>;
    Constants const& k = weight.k;
    Lanes const volume = weight.V.template scalar<Lanes>(i);
    Lanes const scale = k.hourglass.modulus / maximum(volume, Lanes(no_volume));
    Vec<D, Lanes> f;
    for (int c = 0; c < D; ++c) f[c] = (2.0 / k.rho0) * scale * load<Lanes>(in.at(i, c));
    Mat<D, Lanes> const F = weight.F.template matrix<D, Lanes>(i);
    Mat<3, Lanes> const full = embed<D>(F);
    Mat<D, Lanes> P;
    for (int c = 0; c < D * D; ++c) P.c[c] = -(scale * load<Lanes>(in.at(i, At::F + c)));
    if constexpr (!std::is_same_v<Law, SolidStress>) {
      if (k.hourglass.stiffening > 0) {
        Lanes const share = (k.hourglass.modulus * k.hourglass.stiffening) * load<Lanes>(in.at(i, At::g));
        P = P + share * restrict_to<D>(shape_stress(weight.law, full));
      }
    }
    force.vector<D>(i, f);
    stress.matrix<D>(i, P);
    weight(i, P);
    Lanes done = work_before.scalar<Lanes>(i) + dt * power(i, f, P, F);
    if (k.hourglass.bulk_ahead > 0)
      done = done - weight.filtered_pressure.template scalar<Lanes>(i) * ratio_change.scalar<Lanes>(i);
    work.scalar(i, done);
  }

 private:
  /// LookAhead's F* contains the rate of F.
  PIOLA_FN Lanes power(Index i, Vec<D, Lanes> const& f, Mat<D, Lanes> const& P, Mat<D, Lanes> const& F) const {
    Mat<D, Lanes> rate;
    for (int c = 0; c < D * D; ++c)
      rate.c[c] = (1.0 / weight.k.hourglass.ahead) * (ahead.scalar<Lanes>(i, HourglassSums<D>::F + c) - F.c[c]);
    rate = rate - turned<D>(without_rigid.spin, F);
    return weight.k.rho0 * dot(f, v.vector<D, Lanes>(i)) - contract(P, rate);
  }
};

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
