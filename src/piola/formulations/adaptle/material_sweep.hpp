// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/axis_images.hpp"
#include "piola/formulations/adaptle/reference_pair_sums.hpp"

/// Sums over reference neighbours, first sweep. docs/theory/adaptle.md, "Sums over reference neighbours".
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Constants of the pairs of one body.
struct PairConstants {
  double damping, stiffness, rho0, alpha_c, beta, h, core, spacing;
  bool axisymmetric;
  PIOLA_FN explicit PairConstants(BodyConstants const& b)
      : damping(damping_of(b)),
        stiffness(stiffness_of(b)),
        rho0(b.rho0),
        alpha_c(b.alpha * b.c),
        beta(b.beta),
        h(b.reference_h),
        core(0.01 * h * h),
        spacing(b.spacing),
        axisymmetric(b.axisymmetric) {}
};

/// First sweep: F_a = I + sum_b V0_b (u_b - u_a) (x) G_ab, its rate with the velocities at half time (13), and
/// the forces between total-Lagrangian particles other than stress. With w = v_b - v_a and x = x_b - x_a:
///   viscosity   -V0_a V0_b s rho0 q (r.r + 0.01 h^2)/(x.x + 0.01 h^2) x,   q = (beta mu - alpha c) mu,
///               along the line of centres, half its power as heat on each side; as published: in the second sweep
///   damping     t_ab = zeta rho0 c h V0_a V0_b s (w - dF_a/dt r)/2, which is a's, with all its heat, w.t_ab
///   springs     t_ab = kappa V0_a V0_b s (u_b - u_a - (F_a - I) r)/2, from the energy
///               kappa/4 V0_a sum_b V0_b s |x - F_a r|^2: F_a is the best fit in just this measure, so that the energy
///               does not change with it; not with the sums as published
/// Of both the parts with F_b and its rate come with the second sweep: they have the form of the stress forces.
template <int D, MaterialForm Form>
struct DeformPairs {
  using R = MaterialRecord<D>;
  /// Springs and viscosity come together.
  static constexpr bool central = EquationSet{Form}.has_central_viscosity(),
                        kernel_part = EquationSet{Form}.has_kernel_part();
  static_assert(central == EquationSet{Form}.has_hourglass_stiffness());
  static constexpr int du = 0, dv = D * D, T = 2 * D * D, heat = T + D, stored = heat + 1, uW = central ? -1 : stored,
                       vW = uW + D, mu = stored + 1, sums = central ? mu + 1 : (kernel_part ? vW + D : stored),
                       extrema = central ? 1 : 0;
  static constexpr int first_component = 0, last_component = R::viscosity + 1;
  PairConstants b;

  template <class V>
  struct Own {
    Vec<D, V> u, v;
    V viscosity, radius;
  };
  template <class V>
  PIOLA_INLINE_FN static Own<V> own_at(RecordPlace const& p) {
    Own<V> own;
    for (int c = 0; c < D; ++c) {
      own.u[c] = load_local<V>(p, R::u + c);
      own.v[c] = load_local<V>(p, R::v + c);
    }
    own.viscosity = load_local<V>(p, R::viscosity);
    own.radius = load_local<V>(p, R::X);
    return own;
  }

  template <class V, class Fields>
  PIOLA_INLINE_FN void add(Lanes (&sum)[sums], Own<V> const& own, PairGeometry<D, Lanes> const& g,
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
    if constexpr (kernel_part) {
      Lanes const VW = f(R::volume) * g.kernel;
      for (int p = 0; p < D; ++p) {
        sum[uW + p] += VW * u[p];
        sum[vW + p] += VW * w[p];
      }
    }
    Lanes const least = minimum(f(R::viscosity), Lanes(own.viscosity));  // negative if one of both is
    Lanes const weight = select(least < 0.0, Lanes(0.0), Vs),
                of_both = D == 2 && b.axisymmetric ? both_rings(own, g, weight) : weight;
    if constexpr (central) {
      add_central(sum, own, g, u, w, weight, of_both, f(R::viscosity));
    } else {
      Lanes const pull = b.damping * of_both;
      for (int p = 0; p < D; ++p) sum[T + p] += pull * w[p];
      sum[heat] += 0.5 * b.damping * weight * dot(w, w);
    }
  }

 private:
  /// The weight of a force that both own: with the mean of their circles instead of the own one.
  template <class V>
  PIOLA_INLINE_FN Lanes both_rings(Own<V> const& own, PairGeometry<D, Lanes> const& g, Lanes const& weight) const {
    return 0.5 * weight * (1.0 + ring_radius(own.radius + g.r[0], b.spacing) / ring_radius(own.radius, b.spacing));
  }

  template <class V>
  PIOLA_INLINE_FN void add_central(Lanes (&sum)[sums], Own<V> const& own, PairGeometry<D, Lanes> const& g,
                                   Vec<D, Lanes> const& u, Vec<D, Lanes> const& w, Lanes const& weight,
                                   Lanes const& of_both, Lanes const& viscosity) const {
    Vec<D, Lanes> const x = g.r + u;
    Lanes const closing = select(weight > 0.0, minimum(dot(w, x), Lanes(0.0)), Lanes(0.0));
    Lanes const share = 1.0 / (dot(x, x) + b.core), speed = (b.h * closing) * share;
    sum[mu] = minimum(sum[mu], speed);
    Lanes const factor = 0.5 * (viscosity + own.viscosity);
    // For particles with equal stretch this is the J^-1 F^-T r of set (2) along principal directions.
    Lanes const push =
        (b.rho0 * (b.beta * speed - b.alpha_c) * speed) * ((dot(g.r, g.r) + b.core) * share) * (factor * of_both);
    Lanes const pull = b.damping * of_both, spring = b.stiffness * of_both;
    for (int p = 0; p < D; ++p) sum[T + p] += pull * w[p] + spring * u[p] - push * x[p];
    sum[stored] += 0.5 * (b.stiffness * weight) * dot(u, w);
    sum[heat] += 0.5 * ((b.damping * weight) * dot(w, w) - push * closing);
  }
};

/// From the sums of the first sweep to F, its rate, and the other results.
template <int D, MaterialForm Form>
struct Deform {
  using R = MaterialRecord<D>;
  using S = DeformPairs<D, Form>;
  MaterialTable table;
  Index particles;
  AxisGradients near_axis;
  double smallest_radius;
  Components phi, active, X, x, volume, thickness_half, K, N, gradient_mean;
  OwnComponents F, F_rate, gap, force, heat, hourglass, compression;
  S pairs;

  Deform(System const& s, MaterialTable const& of_body, BodyConstants const& body)
      : table(of_body),
        particles(s.particles),
        near_axis{of_body.axis,    s.particles,          read(s.field.X),
                  read(s.field.x), read(s.field.v_half), read(s.field.active)},
        smallest_radius(s.smallest_radius),
        phi(read(s.field.phi)),
        active(read(s.field.active)),
        X(read(s.field.X)),
        x(read(s.field.x)),
        volume(read(s.field.volume)),
        thickness_half(read(s.field.thickness_half)),
        K(read(s.field.K)),
        N(read(s.field.N)),
        gradient_mean(read(s.field.gradient_mean)),
        F(write(s.field.F)),
        F_rate(write(s.field.F_rate)),
        gap(write(s.field.gap)),
        force(write(s.field.force)),
        heat(write(s.field.heat)),
        hourglass(write(s.field.hourglass)),
        compression(write(s.field.compression)),
        pairs{PairConstants(body)} {}

  /// Whether F of a particle is needed; deleted particles keep theirs.
  PIOLA_FN bool operator()(Index i) const {
    return (table.part[i] & ReferenceRole::kinematic) != 0 && active.at(i) > 0;
  }

  /// marks: selected lanes.
  PIOLA_FN void operator()(Group g, Lanes const& marks, Lanes const (&a)[S::sums]) const {
    Index const i = g.first;
    PairConstants const& b = pairs.b;
    auto const wanted = marks > 0.0;
    Mat<3, Lanes> gradient = identity<3, Lanes>(), rate = 0.0 * gradient;
    set_gradients(i, a, gradient, rate);
    if constexpr (D == 2)
      if (b.axisymmetric) turn_around_axis(g, marks, gradient, rate);
    for (int c = 0; c < 9; ++c) {
      F.put(g, select(wanted, gradient.c[c], F.seen().template scalar<Lanes>(i, c)), c);
      F_rate.put(g, select(wanted, rate.c[c], F_rate.seen().template scalar<Lanes>(i, c)), c);
    }
    gap.put(g, select(wanted, Lanes(0.0), gap.seen().template scalar<Lanes>(i)));
    auto const lagrangian = wanted && !(phi.scalar<Lanes>(i) > 0.0);
    if (!any(lagrangian)) return;
    Lanes const weight = select(lagrangian, volume.scalar<Lanes>(i), Lanes(0.0));
    Lanes loss = a[S::heat], stored(0.0);
    if constexpr (S::central) stored = a[S::stored];
    for (int p = 0; p < D; ++p) {
      force.add(g, weight * a[S::T + p], p);
      for (int q = 0; q < D; ++q) {
        Lanes const first_moment = a[S::dv + p * D + q];
        loss = loss - (0.5 * b.damping) * rate(p, q) * first_moment;
        if constexpr (S::central)
          stored = stored - (0.5 * b.stiffness) * (gradient(p, q) - (p == q ? 1.0 : 0.0)) * first_moment;
      }
    }
    heat.add(g, weight * loss);
    hourglass.add(g, weight * stored);
    if constexpr (S::central)
      compression.put(g,
                      maximum(compression.seen().template scalar<Lanes>(i), select(lagrangian, -a[S::mu], Lanes(0.0))));
    Lanes const own = select(lagrangian, Lanes(1.0), Lanes(0.0));
    for (int l = 0; l < g.count; ++l)
      if (lane(own, l) > 0 && (table.part[i + l] & ReferenceRole::mixed) != 0) leave_out_others(i + l);
  }

 private:
  /// Adds what axisymmetric bodies have more: the correction near the axis, and the stretch of the circle.
  PIOLA_FN void turn_around_axis(Group g, Lanes const& marks, Mat<3, Lanes>& gradient, Mat<3, Lanes>& rate) const {
    if (near_axis.table.begin != nullptr) {
      Lanes u[4], v[4];
      near_axis(g, marks, u, v);
      for (int c = 0; c < 4; ++c) {
        gradient(c / 2, c % 2) += u[c];
        rate(c / 2, c % 2) += v[c];
      }
    }
    Lanes const from = X.scalar<Lanes>(g.first);
    gradient(2, 2) = select(from < smallest_radius, gradient(0, 0), x.scalar<Lanes>(g.first) / from);
  }

  PIOLA_FN void set_gradients(Index i, Lanes const (&a)[S::sums], Mat<3, Lanes>& gradient, Mat<3, Lanes>& rate) const {
    constexpr bool folded = EquationSet{Form}.stores_kernel();
    for (int l = 0; l < D; ++l)
      for (int p = 0; p < D; ++p) {
        Lanes u = a[S::du + p * D + l], v = a[S::dv + p * D + l];
        if constexpr (S::kernel_part) {
          Lanes const G = gradient_mean.scalar<Lanes>(i, l);
          u -= a[S::uW + p] * G;
          v -= a[S::vW + p] * G;
        }
        for (int q = 0; q < D; ++q) {
          Lanes const k = folded ? N.scalar<Lanes>(i, 3 * q + l) : K.scalar<Lanes>(i, SymMat<D>::at(q, l));
          gradient(p, q) += u * k;
          rate(p, q) += v * k;
        }
      }
    if constexpr (D < 3) gradient(2, 2) = thickness_half.scalar_or<Lanes>(i, 1.0);
  }

  /// Removes neighbours that are not total-Lagrangian from damping and springs, and computes their largest distance
  /// from the positions that the deformation gradient predicts.
  PIOLA_FN void leave_out_others(Index i) const {
    PairConstants const& b = pairs.b;
    RecordPlace const own = record_of<D>(table, EquationSet{Form}, i);
    Mat<3> const gradient = F.seen().template matrix<double>(i), rate = F_rate.seen().template matrix<double>(i);
    Lanes sum[D + 2], farthest = Lanes(0.0);
    for (auto& a : sum) a = Lanes(0.0);
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::A];
      load_listed<D>(table, EquationSet{Form}, k, particles, f);
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
          place += gradient(p, q) * r[q];
          speed += rate(p, q) * r[q];
        }
        Lanes const moved = place - r[p], away = u[p] - moved;
        square += away * away;
        sum[p] += weight * (b.damping * speed + b.stiffness * moved);
        sum[D] += weight * speed * w[p];
        sum[D + 1] += weight * moved * w[p];
      }
      farthest = maximum(farthest, select(weight > 0.0, square, Lanes(0.0)));
    }
    correct_for_others(i, sum, farthest);
  }

  /// Stores the results of leave_out_others(): sums of force, heat and hourglass power, and the squared distance.
  PIOLA_INLINE_FN void correct_for_others(Index i, Lanes const (&sum)[D + 2], Lanes const& farthest) const {
    PairConstants const& b = pairs.b;
    double a[whole(D + 2)];
    add_lanes(sum, a);
    double const V = volume.at(i);
    for (int p = 0; p < D; ++p) force.at(i, p) += 0.5 * V * a[p];
    heat.at(i) += 0.5 * b.damping * V * a[D];
    if constexpr (S::central) hourglass.at(i) += 0.5 * b.stiffness * V * a[D + 1];
    gap.at(i) = std::sqrt(largest_of(farthest)) / b.h;
  }
};

/// The first sweep over a body with lists, by slots.
template <int D, MaterialForm Form>
struct DeformLists {
  Deform<D, Form> end;

  PIOLA_FN void operator()(Range block, Index) const { each_in_lists<D, Form>(end.table, end.pairs, block, end, end); }
};

/// The first sweep over a body on a lattice, by lattice positions.
template <int D, MaterialForm Form>
struct DeformRows {
  Deform<D, Form> end;
  Index last;  ///< slot after the last of the body

  PIOLA_FN void operator()(Range block, Index) const {
    each_in_rows<D, Form>(end.table, end.pairs, block, last, end, end);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
