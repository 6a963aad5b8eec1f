// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/material_sweep.hpp"

/// Sums over reference neighbours, second sweep: terms with the stress and the deformation of neighbours.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Stress forces with t_ab = V0_b (A_a s r - a_a W), F_a += sum_b t_ab - t_ba. The own part is made of the constants
/// sum_b V0_b s r and sum_b V0_b W. A of total-Lagrangian particles carries their half of damping and springs, -(zeta
/// rho0 c h dF/dt + kappa (F - I)) V0/2, which is meant for total-Lagrangian neighbours alone. As published also
///   m_a m_b Pi/2 (J_a^-1 F_b^-T G_ba - J_b^-1 F_a^-T G_ab)
/// between total-Lagrangian particles, half its power as heat on each side.
template <int D, MaterialForm Form>
struct ForcePairs {
  using R = MaterialRecord<D>;
  static constexpr bool viscous = !EquationSet{Form}.has_central_viscosity(),
                        kernel_part = EquationSet{Form}.has_kernel_part();
  static constexpr int Q = 0, heat = D, mu = D + 1, sums = viscous ? mu + 1 : D, extrema = viscous ? 1 : 0;
  static constexpr int first_component = viscous ? R::u : R::X, last_component = R::values(EquationSet{Form});
  double alpha, beta, h, rho0, c, spacing;
  bool mixed;  ///< total-Lagrangian particles also receive the viscosity of Eulerian ones
  bool axisymmetric;

  template <class V>
  struct Own {
    Vec<D, V> u, v, n;
    V N[D * D], inverse_J, viscosity, radius;
    bool feels;  ///< whether there is viscosity
  };
  template <class V>
  PIOLA_INLINE_FN static auto own_at(RecordPlace const& p) {
    Own<V> own;
    if constexpr (viscous) {
      for (int k = 0; k < D; ++k) {
        own.u[k] = load_local<V>(p, R::u + k);
        own.v[k] = load_local<V>(p, R::v + k);
        own.n[k] = load_local<V>(p, R::n + k);
      }
      for (int k = 0; k < D * D; ++k) own.N[k] = load_local<V>(p, R::N + k);
      own.inverse_J = load_local<V>(p, R::inverse_J);
      own.viscosity = load_local<V>(p, R::viscosity);
      own.radius = load_local<V>(p, R::X);
      own.feels = any(own.viscosity > 0.0);
    }
    return own;
  }

  template <class V, class Fields>
  PIOLA_INLINE_FN void add(Lanes (&sum)[sums], Own<V> const& own, PairGeometry<D, Lanes> const& g,
                           Fields const& f) const {
    for (int p = 0; p < D; ++p) {
      Lanes reaction = f(R::A + p * D) * g.r[0];
      for (int q = 1; q < D; ++q) reaction += f(R::A + p * D + q) * g.r[q];
      sum[Q + p] += g.s * reaction;
      if constexpr (kernel_part) sum[Q + p] += f(R::a + p) * g.kernel;
    }
    if constexpr (viscous)
      if (own.feels) add_viscosity(sum, own, g, f);
  }

 private:
  /// Length of both circles.
  template <class V>
  PIOLA_INLINE_FN Lanes around(Own<V> const& own, PairGeometry<D, Lanes> const& g) const {
    return circle(ring_radius(own.radius, spacing) + ring_radius(own.radius + g.r[0], spacing));
  }

  template <class V, class Fields>
  PIOLA_INLINE_FN void add_viscosity(Lanes (&sum)[sums], Own<V> const& own, PairGeometry<D, Lanes> const& g,
                                     Fields const& f) const {
    Vec<D, Lanes> x, w;
    for (int k = 0; k < D; ++k) {
      x[k] = g.r[k] + (f(R::u + k) - own.u[k]);
      w[k] = f(R::v + k) - own.v[k];
    }
    Lanes const there = f(R::viscosity);
    Lanes const here(own.viscosity);
    Lanes closing = minimum(dot(w, x), Lanes(0.0));
    closing = select(g.s != 0.0, closing, Lanes(0.0));
    closing = select((mixed ? here : minimum(here, there)) < 0.0, Lanes(0.0), closing);
    if (!any(closing < 0.0)) return;
    auto const [speed, plain] =
        viscous_pair(alpha, beta, h, closing, dot(x, x), Lanes(2 * c), rho0 * (f(R::inverse_J) + own.inverse_J));
    sum[mu] = minimum(sum[mu], speed);
    Lanes const size = maximum(there, -1.0 * there);
    Lanes weight = (-0.5 * rho0) * (f(R::volume) * plain * (0.5 * (size + here)));
    if (D == 2 && axisymmetric) weight = weight * (0.5 * around(own, g));
    Lanes power = Lanes(0.0);
    for (int p = 0; p < D; ++p) {
      Lanes mine = Lanes(0.0), other = Lanes(0.0);
      for (int q = 0; q < D; ++q) {
        mine += own.N[p * D + q] * g.r[q];
        other += f(R::N + p * D + q) * g.r[q];
      }
      mine = g.s * mine;
      other = g.s * other;
      if constexpr (kernel_part) {
        mine -= own.n[p] * g.kernel;
        other += f(R::n + p) * g.kernel;
      }
      Lanes const extra = (rho0 * weight) * (own.inverse_J * other + f(R::inverse_J) * mine);
      sum[Q + p] += extra;
      power += extra * w[p];
    }
    sum[heat] += 0.5 * power;
  }
};

/// From the sums of the second sweep to forces.
template <int D, MaterialForm Form>
struct MaterialForces {
  using R = MaterialRecord<D>;
  using S = ForcePairs<D, Form>;
  MaterialTable table;
  Index particles;
  BodyConstants body;
  bool on_eulerian;  ///< Eulerian particles receive reactions
  AxisForces near_axis;
  Components phi, active, weight, F, F_rate, gradient_sum, kernel_sum;
  OwnComponents force, heat, compression;
  S pairs;

  MaterialForces(System const& s, MaterialTable const& of_body, BodyConstants const& b)
      : table(of_body),
        particles(s.particles),
        body(b),
        on_eulerian(s.settings.equations.has_reactions()),
        near_axis{of_body.axis, s.particles, read(s.field.section_stress), read(s.field.active)},
        phi(read(s.field.phi)),
        active(read(s.field.active)),
        weight(read(s.field.weight())),
        F(read(s.field.F)),
        F_rate(read(s.field.F_rate)),
        gradient_sum(read(s.field.gradient_sum)),
        kernel_sum(read(s.field.kernel_sum)),
        force(write(s.field.force)),
        heat(write(s.field.heat)),
        compression(write(s.field.compression)),
        pairs{b.alpha,       b.beta, b.reference_h, b.rho0, b.c, b.spacing, s.settings.equations.has_mixed_viscosity(),
              b.axisymmetric} {}

  /// Whether a particle takes part.
  PIOLA_FN bool operator()(Index i) const {
    return (table.part[i] & ReferenceRole::target) != 0 && active.at(i) > 0 && (on_eulerian || !(phi.at(i) > 0));
  }

  /// marks: lanes that take part.
  PIOLA_FN void operator()(Group g, Lanes const& marks, Lanes const (&a)[S::sums]) const {
    Index const i = g.first;
    Lanes own[S::last_component - R::A], extra[D];
    load_own_records<D>(table, EquationSet{Form}, g, R::A, own);
    hourglass_of_neighbours(g, marks, extra);
    auto const wanted = marks > 0.0;
    Lanes const V = weight.scalar<Lanes>(i);
    for (int p = 0; p < D; ++p) {
      Lanes total = V * (a[S::Q + p] + extra[p]);
      for (int q = 0; q < D; ++q) total += own[p * D + q] * gradient_sum.scalar<Lanes>(i, q);
      if constexpr (S::kernel_part) total -= own[R::a - R::A + p] * kernel_sum.scalar<Lanes>(i);
      force.add(g, select(wanted, total, Lanes(0.0)), p);
    }
    if constexpr (D == 2)
      if (near_axis.table.begin != nullptr) {
        Lanes extra_force[2];
        near_axis(g, marks, extra_force);
        for (int p = 0; p < 2; ++p) force.add(g, extra_force[p], p);
      }
    if constexpr (S::viscous) {
      heat.add(g, select(wanted, V * a[S::heat], Lanes(0.0)));
      compression.put(g, maximum(compression.seen().template scalar<Lanes>(i), select(wanted, -a[S::mu], Lanes(0.0))));
    }
  }

 private:
  /// Removes, for particles that are not total-Lagrangian, the damping and springs contained in A of their neighbours,
  /// over V0.
  PIOLA_FN void hourglass_of_neighbours(Group g, Lanes const& marks, Lanes (&extra)[D]) const {
    for (Lanes& value : extra) value = Lanes(0.0);
    auto const leaves = marks > 0.0 && phi.scalar<Lanes>(g.first) > 0.0;
    if (!(body.hourglass > 0 || body.hourglass_stiffness > 0) || !any(leaves)) return;
    Lanes const others = select(leaves, Lanes(1.0), Lanes(0.0));
    double of[D][lane_count]{};
    for (int l = 0; l < g.count; ++l) {
      if (!(lane(others, l) > 0)) continue;
      Vec<D> const one = hourglass_around(g.first + l);
      for (int p = 0; p < D; ++p) of[p][l] = one[p];
    }
    for (int p = 0; p < D; ++p) extra[p] = load<Lanes>(of[p]);
  }

  PIOLA_FN Vec<D> hourglass_around(Index i) const {
    double const damping = 0.5 * damping_of(body),
                 stiffness = EquationSet{Form}.has_hourglass_stiffness() ? 0.5 * stiffness_of(body) : 0;
    RecordPlace const own = record_of<D>(table, EquationSet{Form}, i);
    Lanes sum[D];
    for (auto& s : sum) s = Lanes(0.0);
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::A];
      load_listed<D>(table, EquationSet{Form}, k, particles, f);
      Lanes const s = load_gradients(gradients_of<Form>(table) + k);
      Lanes share = select(f[R::viscosity] > 0.0, f[R::volume] * s, Lanes(0.0));
      if (!any(share > 0.0)) continue;
      if (body.axisymmetric) share = share * circle(ring_radius(f[R::X], body.spacing));
      for (int q = 0; q < D; ++q) {
        Lanes const r = share * (f[R::X + q] - own[R::X + q]);
        for (int p = 0; p < D; ++p)
          sum[p] +=
              (damping * listed(F_rate, k, 3 * p + q) + stiffness * (listed(F, k, 3 * p + q) - (p == q ? 1.0 : 0.0))) *
              r;
      }
    }
    double a[whole(D)];
    add_lanes(sum, a);
    Vec<D> r;
    for (int p = 0; p < D; ++p) r[p] = a[p];
    return r;
  }

  /// A component of a tensor of listed neighbours; zero for fillers.
  PIOLA_FN Lanes listed(Components const& field, Offset k, int c) const {
    double values[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      Index const j = table.neighbour[k + l];
      double const sign = j > particles && turns(c / 3, c % 3) ? -1 : 1;
      values[l] = j != particles ? sign * field.at(source_of(j, particles), c) : 0;
    }
    return load<Lanes>(values);
  }
};

/// The second sweep over a body with lists, by slots.
template <int D, MaterialForm Form>
struct ForceLists {
  MaterialForces<D, Form> end;

  PIOLA_FN void operator()(Range block, Index) const { each_in_lists<D, Form>(end.table, end.pairs, block, end, end); }
};

/// The second sweep over a body on a lattice, by lattice positions.
template <int D, MaterialForm Form>
struct ForceRows {
  MaterialForces<D, Form> end;

  PIOLA_FN void operator()(Range block, Index) const {
    each_in_rows<D, Form>(end.table, end.pairs, block, end.body.last, end, end);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
