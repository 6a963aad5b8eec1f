// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/viscosity.hpp"

/// Sums over reference neighbours with the gradient G_ab = K_a s r, r = X_b - X_a, in the owner form: two sweeps, of
/// which the first does all that needs velocities. Momentum and energy close pair by pair. docs/theory/adaptle.md,
/// "Sums over reference neighbours".
namespace piola::adaptle::inline PIOLA_MACHINE {

/// s of the pairs as they are stored: doubles for plain gradients, floats where K makes up for the rounding.
template <class Gradient>
PIOLA_FN Gradient const* gradients_of(MaterialTable const& table) {
  if constexpr (std::is_same_v<Gradient, float>)
    return table.gradient;
  else
    return table.s;
}

/// First sweep: F_a = I + sum_b V0_b (u_b - u_a) (x) G_ab, its rate with the velocities of half time (13), and what
/// acts between total-Lagrangian particles beside stress. With w = v_b - v_a and x = x_b - x_a:
///   viscosity   -V0_a V0_b s rho0 q (r.r + 0.01 h^2)/(x.x + 0.01 h^2) x,   q = (beta mu - alpha c) mu,
///               along the line of centres, half its power as heat on each side
///   damping     t_ab = zeta rho0 c h V0_a V0_b s (w - dF_a/dt r)/2, which a owns with all its heat, w.t_ab
///   springs     t_ab = kappa V0_a V0_b s (u_b - u_a - (F_a - I) r)/2, from the energy
///               kappa/4 V0_a sum_b V0_b s |x - F_a r|^2: F_a is the best fit in just this measure, so that the energy
///               does not change with it
/// Of both the parts with F_b and its rate come with the second sweep: they have the form of the stress forces.
template <int D, class Gradient>
struct DeformSweep {
  using R = MaterialRecord<D>;
  MaterialTable table;
  State const* state;
  Half const* half;
  Reference const* reference;
  BodyConstants const* body;
  int const* body_of;
  Deformation* out;
  Sums* sums;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(table.kinematic[t]);
  }

 private:
  struct Accumulated {
    static constexpr int du = 0, dv = D * D, T = 2 * D * D, heat = T + D, stored = heat + 1, count = stored + 1;
    Lanes a[count];
    Lanes mu;
    bool eulerian = false;  ///< some neighbour is not total-Lagrangian
  };
  /// What pairs of one body share.
  struct PairConstants {
    double damping, stiffness, rho0, alpha_c, beta, h, core;
    PIOLA_FN explicit PairConstants(BodyConstants const& b)
        : damping(damping_of(b)),
          stiffness(stiffness_of(b)),
          rho0(b.rho0),
          alpha_c(b.alpha * b.c),
          beta(b.beta),
          h(b.material_h),
          core(0.01 * h * h) {}
  };

  PIOLA_FN void visit(Index i) const {
    if (!(state[i].alive > 0)) return;  // deleted: frozen
    double const* own = table.record + static_cast<std::ptrdiff_t>(i) * R::stride;
    PairConstants const constants(body[body_of[i]]);
    bool const lagrangian = own[R::viscosity] > 0;
    Accumulated sum;
    Lanes const zeros = zeros_from(own[R::volume]);
    for (auto& a : sum.a) a = zeros;
    sum.mu = zeros;
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::A];
      load_components<R::A>(table.record, R::stride, table.neighbour + k, f);
      add_pairs(own, f, load_gradients(gradients_of<Gradient>(table) + k), constants, lagrangian, sum);
    }
    store(i, own, constants, lagrangian, sum);
  }

  PIOLA_FN void add_pairs(double const* own, Lanes const* f, Lanes const& s, PairConstants const& b, bool lagrangian,
                          Accumulated& sum) const {
    Vec<D, Lanes> const r = difference<D>(f, R::X, own), u = difference<D>(f, R::u, own),
                        w = difference<D>(f, R::v, own);
    Lanes const Vs = f[R::volume] * s;
    for (int p = 0; p < D; ++p) {
      Lanes const a = Vs * u[p], c = Vs * w[p];
      for (int q = 0; q < D; ++q) {
        sum.a[Accumulated::du + p * D + q] += a * r[q];
        sum.a[Accumulated::dv + p * D + q] += c * r[q];
      }
    }
    if (!lagrangian) return;
    auto const other = f[R::viscosity] < 0.0;
    sum.eulerian = sum.eulerian || any(other);
    Lanes const weight = select(other, Lanes(0.0), Vs);
    Vec<D, Lanes> x;
    for (int p = 0; p < D; ++p) x[p] = r[p] + u[p];
    Lanes const closing = select(weight > 0.0, minimum(dot(w, x), Lanes(0.0)), Lanes(0.0));
    Lanes const share = 1.0 / (dot(x, x) + b.core), mu = (b.h * closing) * share;
    sum.mu = minimum(sum.mu, mu);
    Lanes const factor = 0.5 * (f[R::viscosity] + own[R::viscosity]);
    // Between particles whose stretch is the same this is the J^-1 F^-T r of set (2) along principal directions.
    Lanes const push = (b.rho0 * (b.beta * mu - b.alpha_c) * mu) * ((dot(r, r) + b.core) * share) * (factor * weight),
                pull = b.damping * weight, spring = b.stiffness * weight;
    for (int p = 0; p < D; ++p) sum.a[Accumulated::T + p] += pull * w[p] + spring * u[p] - push * x[p];
    sum.a[Accumulated::stored] += 0.5 * spring * dot(u, w);
    sum.a[Accumulated::heat] += 0.5 * (pull * dot(w, w) - push * closing);
  }

  PIOLA_FN void store(Index i, double const* own, PairConstants const& b, bool lagrangian,
                      Accumulated const& sum) const {
    double a[whole(Accumulated::count)];
    total(sum.a, a);
    MaterialCorrection const& k = table.moments[i];
    Deformation& d = out[i];
    for (int c = 0; c < 9; ++c) {
      d.F[c] = c % 4 == 0 ? 1 : 0;
      d.rate[c] = 0;
    }
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q)
        for (int l = 0; l < D; ++l) {
          double const K = k.K[SymMat<D>::at(q, l)];
          d.F[3 * p + q] += a[Accumulated::du + p * D + l] * K;
          d.rate[3 * p + q] += a[Accumulated::dv + p * D + l] * K;
        }
    if constexpr (D < 3) d.F[8] = half[i].thickness;
    d.gap = 0;
    if (!lagrangian) return;
    Sums& to = sums[i];
    double const volume = reference[i].volume;
    double heat = a[Accumulated::heat], stored = a[Accumulated::stored];
    for (int p = 0; p < D; ++p) {
      to.force[p] += volume * a[Accumulated::T + p];
      for (int q = 0; q < D; ++q) {
        heat -= 0.5 * b.damping * d.rate[3 * p + q] * a[Accumulated::dv + p * D + q];
        stored -= 0.5 * b.stiffness * (d.F[3 * p + q] - (p == q ? 1 : 0)) * a[Accumulated::dv + p * D + q];
      }
    }
    to.heat += volume * heat;
    to.hourglass += volume * stored;
    double const mu = largest_of(-1.0 * sum.mu);
    to.compression = mu > to.compression ? mu : to.compression;
    if (sum.eulerian) leave_out_others(i, own, b, d, to);
  }

  /// Takes neighbours that are not total-Lagrangian out of damping and springs, and sees how far they have gone from
  /// where the deformation gradient would put them.
  PIOLA_FN void leave_out_others(Index i, double const* own, PairConstants const& b, Deformation& d, Sums& to) const {
    Lanes sum[D + 2], gap = Lanes(0.0);
    for (auto& a : sum) a = Lanes(0.0);
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::A];
      load_components<R::A>(table.record, R::stride, table.neighbour + k, f);
      auto const other = f[R::viscosity] < 0.0;
      if (!any(other)) continue;
      Vec<D, Lanes> const r = difference<D>(f, R::X, own), u = difference<D>(f, R::u, own),
                          w = difference<D>(f, R::v, own);
      Lanes const weight = select(other, f[R::volume] * load_gradients(gradients_of<Gradient>(table) + k), Lanes(0.0));
      Lanes square = Lanes(0.0);
      for (int p = 0; p < D; ++p) {
        Lanes place = Lanes(0.0), speed = Lanes(0.0);
        for (int q = 0; q < D; ++q) {
          place += d.F[3 * p + q] * r[q];
          speed += d.rate[3 * p + q] * r[q];
        }
        Lanes const moved = place - r[p], away = u[p] - moved;
        square += away * away;
        sum[p] += weight * (b.damping * speed + b.stiffness * moved);
        sum[D] += weight * speed * w[p];
        sum[D + 1] += weight * moved * w[p];
      }
      gap = maximum(gap, select(weight > 0.0, square, Lanes(0.0)));
    }
    double a[whole(D + 2)];
    total(sum, a);
    double const volume = reference[i].volume;
    for (int p = 0; p < D; ++p) to.force[p] += 0.5 * volume * a[p];
    to.heat += 0.5 * b.damping * volume * a[D];
    to.hourglass += 0.5 * b.stiffness * volume * a[D + 1];
    d.gap = std::sqrt(largest_of(gap)) / b.h;
  }
};

/// Second sweep: stress forces with t_ab = V0_b A_a s r, F_a += sum_b t_ab - t_ba. The own part is A_a times the
/// constant sum_b V0_b s r. A of total-Lagrangian particles carries their half of damping and springs, -(zeta rho0 c h
/// dF/dt + kappa (F - I)) V0/2, which is meant for total-Lagrangian neighbours alone.
template <int D, class Gradient>
struct MaterialSweep {
  using R = MaterialRecord<D>;
  MaterialTable table;
  BodyConstants const* body;
  int const* body_of;
  Reference const* reference;
  State const* state;
  Deformation const* deformation;
  Sums* sums;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(table.target[t]);
  }

 private:
  PIOLA_FN void visit(Index i) const {
    if (!(state[i].alive > 0)) return;
    double const* own = table.record + static_cast<std::ptrdiff_t>(i) * R::stride;
    Lanes sum[D];
    for (auto& a : sum) a = Lanes(0.0);
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      constexpr int X = 0, A = R::A - R::X, values = A + D * D;
      Lanes f[values];
      load_components<values>(table.record + R::X, R::stride, table.neighbour + k, f);
      Vec<D, Lanes> const r = difference<D>(f, X, own + R::X);
      Lanes const s = load_gradients(gradients_of<Gradient>(table) + k);
      for (int p = 0; p < D; ++p) {
        Lanes reaction = f[A + p * D] * r[0];
        for (int q = 1; q < D; ++q) reaction += f[A + p * D + q] * r[q];
        sum[p] += s * reaction;
      }
    }
    BodyConstants const& b = body[body_of[i]];
    if (!(own[R::viscosity] > 0) && (b.hourglass > 0 || b.hourglass_stiffness > 0)) leave_out_hourglass(i, own, b, sum);
    double a[whole(D)];
    total(sum, a);
    double const volume = reference[i].volume;
    MaterialCorrection const& k = table.moments[i];
    for (int p = 0; p < D; ++p) {
      double force = volume * a[p];
      for (int q = 0; q < D; ++q) force += own[R::A + p * D + q] * k.G[q];
      sums[i].force[p] += force;
    }
  }

  /// Particles that are not total-Lagrangian do not feel the damping and the springs that come with A of their
  /// neighbours.
  PIOLA_FN void leave_out_hourglass(Index i, double const* own, BodyConstants const& b, Lanes (&sum)[D]) const {
    double const damping = 0.5 * damping_of(b), stiffness = 0.5 * stiffness_of(b);
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::A];
      load_components<R::A>(table.record, R::stride, table.neighbour + k, f);
      Lanes const s = load_gradients(gradients_of<Gradient>(table) + k),
                  weight = select(f[R::viscosity] > 0.0, f[R::volume] * s, Lanes(0.0));
      if (!any(weight > 0.0)) continue;
      Vec<D, Lanes> const r = difference<D>(f, R::X, own);
      constexpr int used = D == 3 ? 9 : 5;  // of the 3 x 3 tensors, rows of three
      constexpr auto stride = static_cast<int>(sizeof(Deformation) / sizeof(double));
      Lanes F[used], rate[used];
      load_components<used>(deformation->F, stride, table.neighbour + k, F);
      load_components<used>(deformation->rate, stride, table.neighbour + k, rate);
      for (int p = 0; p < D; ++p)
        for (int q = 0; q < D; ++q)
          sum[p] += weight * (damping * rate[3 * p + q] + stiffness * (F[3 * p + q] - (p == q ? 1.0 : 0.0))) * r[q];
    }
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
