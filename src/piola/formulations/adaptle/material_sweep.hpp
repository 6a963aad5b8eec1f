// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/material_pairs.hpp"

/// Sums over reference neighbours, first sweep. docs/theory/adaptle.md, "Sums over reference neighbours".
namespace piola::adaptle::inline PIOLA_MACHINE {

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

/// First sweep: F_a = I + sum_b V0_b (u_b - u_a) (x) G_ab, its rate with the velocities of half time (13), and what
/// acts between total-Lagrangian particles beside stress. With w = v_b - v_a and x = x_b - x_a:
///   viscosity   -V0_a V0_b s rho0 q (r.r + 0.01 h^2)/(x.x + 0.01 h^2) x,   q = (beta mu - alpha c) mu,
///               along the line of centres, half its power as heat on each side; as published: in the second sweep
///   damping     t_ab = zeta rho0 c h V0_a V0_b s (w - dF_a/dt r)/2, which a owns with all its heat, w.t_ab
///   springs     t_ab = kappa V0_a V0_b s (u_b - u_a - (F_a - I) r)/2, from the energy
///               kappa/4 V0_a sum_b V0_b s |x - F_a r|^2: F_a is the best fit in just this measure, so that the energy
///               does not change with it; not with the sums as published
/// Of both the parts with F_b and its rate come with the second sweep: they have the form of the stress forces.
template <int D, MaterialForm Form>
struct DeformPairs {
  using R = MaterialRecord<D>;
  static constexpr bool published = is_published(Form), shifts = Form == MaterialForm::published;
  static constexpr int du = 0, dv = D * D, T = 2 * D * D, heat = T + D, stored = heat + 1, uW = published ? stored : -1,
                       vW = uW + D, mu = stored + 1, sums = published ? (shifts ? vW + D : stored) : mu + 1,
                       extrema = published ? 0 : 1;
  static constexpr int first_component = 0, last_component = R::viscosity + 1;
  PairConstants b;

  template <class V>
  struct Own {
    Vec<D, V> u, v;
    V viscosity;
  };
  template <class V>
  [[gnu::always_inline]] PIOLA_FN static Own<V> own_at(RecordPlace const& p) {
    Own<V> own;
    for (int c = 0; c < D; ++c) {
      own.u[c] = load_own<V>(p, R::u + c);
      own.v[c] = load_own<V>(p, R::v + c);
    }
    own.viscosity = load_own<V>(p, R::viscosity);
    return own;
  }

  template <class V, class Fields>
  [[gnu::always_inline]] PIOLA_FN void add(Lanes (&sum)[sums], Own<V> const& own, PairGeometry<D, Lanes> const& g,
                                           Fields const& f) const {
    Vec<D, Lanes> u, w;
    for (int c = 0; c < D; ++c) {
      u[c] = f(R::u + c) - own.u[c];
      w[c] = f(R::v + c) - own.v[c];
    }
    Lanes const Vs = f(R::volume) * g.s;
    for (int p = 0; p < D; ++p) {
      Lanes const a = Vs * u[p], c = Vs * w[p];
      for (int q = 0; q < D; ++q) {
        sum[du + p * D + q] += a * g.r[q];
        sum[dv + p * D + q] += c * g.r[q];
      }
    }
    if constexpr (shifts) {
      Lanes const VW = f(R::volume) * g.kernel;
      for (int p = 0; p < D; ++p) {
        sum[uW + p] += VW * u[p];
        sum[vW + p] += VW * w[p];
      }
    }
    Lanes const least = minimum(f(R::viscosity), Lanes(own.viscosity));  // negative where one of both is
    Lanes const weight = select(least < 0.0, Lanes(0.0), Vs);
    if constexpr (published) {
      Lanes const pull = b.damping * weight;
      for (int p = 0; p < D; ++p) sum[T + p] += pull * w[p];
      sum[heat] += 0.5 * pull * dot(w, w);
    } else {
      add_central(sum, own, g, u, w, weight, f(R::viscosity));
    }
  }

 private:
  template <class V>
  [[gnu::always_inline]] PIOLA_FN void add_central(Lanes (&sum)[sums], Own<V> const& own,
                                                   PairGeometry<D, Lanes> const& g, Vec<D, Lanes> const& u,
                                                   Vec<D, Lanes> const& w, Lanes const& weight,
                                                   Lanes const& viscosity) const {
    Vec<D, Lanes> const x = g.r + u;
    Lanes const closing = select(weight > 0.0, minimum(dot(w, x), Lanes(0.0)), Lanes(0.0));
    Lanes const share = 1.0 / (dot(x, x) + b.core), speed = (b.h * closing) * share;
    sum[mu] = minimum(sum[mu], speed);
    Lanes const factor = 0.5 * (viscosity + own.viscosity);
    // Between particles whose stretch is the same this is the J^-1 F^-T r of set (2) along principal directions.
    Lanes const push =
        (b.rho0 * (b.beta * speed - b.alpha_c) * speed) * ((dot(g.r, g.r) + b.core) * share) * (factor * weight);
    Lanes const pull = b.damping * weight, spring = b.stiffness * weight;
    for (int p = 0; p < D; ++p) sum[T + p] += pull * w[p] + spring * u[p] - push * x[p];
    sum[stored] += 0.5 * spring * dot(u, w);
    sum[heat] += 0.5 * (pull * dot(w, w) - push * closing);
  }
};

/// From the sums of the first sweep to F, its rate, and what else they hold.
template <int D, MaterialForm Form>
struct Deform {
  using R = MaterialRecord<D>;
  using S = DeformPairs<D, Form>;
  MaterialTable table;
  Index particles;
  State const* state;
  Half const* half;
  Reference const* reference;
  Deformation* out;
  Sums* sums;
  S pairs;

  template <class Totals>
  PIOLA_FN void store(Index i, RecordPlace const& own, Totals const& a) const {
    PairConstants const& b = pairs.b;
    Deformation& d = out[i];
    set_gradients(i, a, d);
    d.gap = 0;
    if (!(own[R::viscosity] > 0)) return;
    Sums& to = sums[i];
    double const volume = reference[i].volume;
    double heat = a[S::heat], stored = 0;
    if constexpr (!S::published) stored = a[S::stored];
    for (int p = 0; p < D; ++p) {
      to.force[p] += volume * a[S::T + p];
      for (int q = 0; q < D; ++q) {
        double const first_moment = a[S::dv + p * D + q];
        heat -= 0.5 * b.damping * d.rate[3 * p + q] * first_moment;
        if constexpr (!S::published) stored -= 0.5 * b.stiffness * (d.F[3 * p + q] - (p == q ? 1 : 0)) * first_moment;
      }
    }
    to.heat += volume * heat;
    to.hourglass += volume * stored;
    if constexpr (!S::published) to.compression = maximum(to.compression, -a[S::mu]);
    if ((table.part[i] & MaterialPart::mixed) != 0) leave_out_others(i, own, d, to);
  }

 private:
  template <class Totals>
  PIOLA_FN void set_gradients(Index i, Totals const& a, Deformation& d) const {
    for (int c = 0; c < 9; ++c) {
      d.F[c] = c % 4 == 0 ? 1 : 0;
      d.rate[c] = 0;
    }
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q)
        for (int l = 0; l < D; ++l) {
          double K, u = a[S::du + p * D + l], v = a[S::dv + p * D + l];
          if constexpr (S::published) {
            FoldedCorrection const& k = table.correction[i];
            K = k.N[3 * q + l];
            if constexpr (S::shifts) {
              u -= a[S::uW + p] * k.G[l];
              v -= a[S::vW + p] * k.G[l];
            }
          } else {
            K = table.moments[i].K[SymMat<D>::at(q, l)];
          }
          d.F[3 * p + q] += u * K;
          d.rate[3 * p + q] += v * K;
        }
    if constexpr (D < 3) d.F[8] = half[i].thickness;
  }

  /// Takes neighbours that are not total-Lagrangian out of damping and springs, and sees how far they have gone from
  /// where the deformation gradient would put them.
  PIOLA_FN void leave_out_others(Index i, RecordPlace const& own, Deformation& d, Sums& to) const {
    PairConstants const& b = pairs.b;
    Lanes sum[D + 2], gap = Lanes(0.0);
    for (auto& a : sum) a = Lanes(0.0);
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::A];
      load_listed<D>(table, S::published, k, particles, f);
      auto const other = f[R::viscosity] < 0.0;
      if (!any(other)) continue;
      Lanes const weight = select(other, f[R::volume] * load_gradients(gradients_of<Form>(table) + k), Lanes(0.0));
      Vec<D, Lanes> r, u, w;
      for (int p = 0; p < D; ++p) {
        r[p] = f[R::X + p] - own[R::X + p];
        u[p] = f[R::u + p] - own[R::u + p];
        w[p] = f[R::v + p] - own[R::v + p];
      }
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
    add_lanes(sum, a);
    double const volume = reference[i].volume;
    for (int p = 0; p < D; ++p) to.force[p] += 0.5 * volume * a[p];
    to.heat += 0.5 * b.damping * volume * a[D];
    if constexpr (!S::published) to.hourglass += 0.5 * b.stiffness * volume * a[D + 1];
    d.gap = std::sqrt(largest_of(gap)) / b.h;
  }
};

/// The first sweep over bodies with lists.
template <int D, MaterialForm Form>
struct DeformLists {
  Deform<D, Form> end;
  BodyConstants const* body;
  int const* body_of;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(end.table.kinematic[t]);
  }

 private:
  PIOLA_FN void visit(Index i) const {
    if (!(end.state[i].alive > 0)) return;  // deleted: frozen
    Deform<D, Form> here = end;
    here.pairs.b = PairConstants(body[body_of[i]]);
    RecordPlace const own = record_of<D>(here.table, is_published(Form), i);
    double a[whole(DeformPairs<D, Form>::sums + 1)];
    sum_listed<D, Form>(here.table, i, here.pairs, own, a);
    here.store(i, own, Column{a, 1});
  }
};

/// The first sweep over a body on a lattice, by places.
template <int D, MaterialForm Form>
struct DeformRows {
  Deform<D, Form> end;
  Index last;  ///< slot after the last of the body

  PIOLA_FN void operator()(Range block, Index) const {
    each_in_rows<D, Form>(end.table, end.pairs, block, last, MaterialPart::kinematic,
                          [&](Index i, RecordPlace const& own, Column const& a) {
                            if (end.state[i].alive > 0) end.store(i, own, a);  // deleted: frozen
                          });
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
