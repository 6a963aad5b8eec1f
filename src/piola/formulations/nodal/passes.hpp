// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/lanes_of_field.hpp"
#include "piola/formulations/nodal/lattice_sums.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/neighbours/record_gather.hpp"

/// Sweeps and moves of the nodal formulation: operations on one particle. Theory and symbols: docs/theory/nodal.md.
/// Pairs of a list have r = X_b - X_a in spacings, the weight s, and gradients G.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Sums of the motion of a group of lanes: per component c, F_cJ and then H_cn. In 2D three more, the hoop stretch of
/// axisymmetric bodies.
template <int D>
struct MotionSums {
  static constexpr int numbers = D + Quadratic<D>::second, hoop_sums = D * numbers, sums = hoop_sums + (D == 2 ? 3 : 0);
};

/// The sweep that fills a block's scratch with F_a and H_a, see MotionSums:
///   F_a = sum_b (x_b - x_a) (x) G_ab,   H_a = T_a k_a,   T_a = sum_b s (x_b - x_a) (x) p(r).
template <int D>
struct SumMotion : MotionSums<D> {
  using R = Records<D>;
  ListSums<D> list;
  ReferenceView k, hoop;  ///< hoop: no data unless the body is axisymmetric
  View x;

  PIOLA_FN SumMotion(ListSums<D> const& sums_of_list, ReferenceView const& to_second, ReferenceView const& to_hoop,
                     View const& position)
      : list(sums_of_list), k(to_second), hoop(to_hoop), x(position) {}
  PIOLA_FN void operator()(Index i, exec::Scratch const& out) const {
    constexpr int second = Quadratic<D>::second;
    alignas(64) double rows[lane_count * D * R::width];
    Index row[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      row[l] = l;
      list.of_motion(i + l, rows + l * D * R::width);
    }
    LanesOfField const to_H = lanes_of(k, i);
    for (int c = 0; c < D; ++c) {
      Lanes T[R::used], H[second];
      load_records(rows + c * R::width, D * R::width, row, T);
      for (int n = 0; n < second; ++n) H[n] = T[0] * to_H[n];
      for (int m = 1; m < R::terms; ++m)
        for (int n = 0; n < second; ++n) H[n] = H[n] + T[m] * to_H[m * second + n];
      for (int J = 0; J < D; ++J) store(T[R::terms + J], out.at(i, c * SumMotion::numbers + J));
      for (int n = 0; n < second; ++n) store(H[n], out.at(i, c * SumMotion::numbers + D + n));
      if constexpr (D == 2)
        if (c == 0 && hoop.stored.data != nullptr) put_hoop(i, T, out);
    }
  }

 private:
  /// T: sums of the radial motion.
  PIOLA_INLINE_FN void put_hoop(Index i, Lanes const (&T)[R::used], exec::Scratch const& out) const {
    LanesOfField const of = lanes_of(hoop, i);
    Lanes const r = x.scalar<Lanes>(i);
    for (int n = 0; n < static_cast<int>(HoopSums::numbers); ++n) {
      Lanes eta = r * of[static_cast<int>(HoopSums::of_radius) + n];
      for (int l = 0; l < R::terms; ++l) eta = eta + T[l] * of[l * static_cast<int>(HoopSums::numbers) + n];
      store(eta, out.at(i, SumMotion::hoop_sums + n));
    }
  }
};

/// As above for a lattice.
template <int D>
struct SumLatticeMotion : MotionSums<D> {
  LatticeSums<D> lattice;

  PIOLA_FN explicit SumLatticeMotion(LatticeSums<D> const& sums_of_lattice) : lattice(sums_of_lattice) {}
  PIOLA_FN void operator()(Index i, exec::Scratch const& out) const {
    for (int c = 0; c < D; ++c) {
      Lanes sum[SumLatticeMotion::numbers];
      lattice.of_motion(i, c, sum);
      for (int n = 0; n < SumLatticeMotion::numbers; ++n) store(sum[n], out.at(i, c * SumLatticeMotion::numbers + n));
    }
  }
};

/// m_a a_a = sum_b t_ab - sum_b t_ba,  t_ab = V_a (P_a G_ab + Q_a K_ab). The first sum, of the particle's own stress,
/// is in `a` already.
template <int D>
struct SumForces {
  ListSums<D> list;
  ReferenceView mass;
  View a;
  WriteView a_out;

  PIOLA_FN void operator()(Index i) const {
    double sum[D][lane_count];
    for (int l = 0; l < lane_count; ++l) {
      Vec<D> const f = list.of_stress(i + l);
      for (int c = 0; c < D; ++c) sum[c][l] = f[c];
    }
    Lanes const per_mass = 1.0 / mass.scalar<Lanes>(i);
    for (int c = 0; c < D; ++c) a_out.scalar(i, Lanes(per_mass * (a.scalar<Lanes>(i, c) - load<Lanes>(sum[c]))), c);
  }
};

/// As above for a lattice.
template <int D>
struct SumLatticeForces {
  LatticeSums<D> lattice;
  ReferenceView mass;
  View a;
  WriteView a_out;

  PIOLA_FN void operator()(Index i) const {
    Vec<D, Lanes> const of_neighbours = lattice.of_stress(i);
    Lanes const per_mass = 1.0 / mass.scalar<Lanes>(i);
    for (int c = 0; c < D; ++c) a_out.scalar(i, Lanes(per_mass * (a.scalar<Lanes>(i, c) - of_neighbours[c])), c);
  }
};

/// v^(n+1/2) = v^n + dt/2 a^n,  x^(n+1) = x^n + dt v^(n+1/2).
template <int D>
struct KickAndDrift {
  double dt;
  View a, v, x;
  WriteView v_out, x_out;

  PIOLA_FN void operator()(Index i) const {
    Vec<D, Lanes> const half = v.vector<D, Lanes>(i) + (0.5 * dt) * a.vector<D, Lanes>(i);
    v_out.vector<D>(i, half);
    x_out.vector<D>(i, x.vector<D, Lanes>(i) + dt * half);
  }
};

/// v^(n+1) = v^(n+1/2) + dt/2 a^(n+1).
template <int D>
struct Kick {
  double dt;
  View a, v;
  WriteView v_out;

  PIOLA_FN void operator()(Index i) const {
    v_out.vector<D>(i, v.vector<D, Lanes>(i) + (0.5 * dt) * a.vector<D, Lanes>(i));
  }
};

/// Saves x, v and a, or restores them.
template <int D>
struct CopyMotion {
  View x, v, a;
  WriteView x_out, v_out, a_out;
  int from, to;  ///< index of the first component of x to read and to write: v and a follow

  PIOLA_FN void operator()(Index i) const {
    x_out.vector<D>(i, x.vector<D, Lanes>(i));
    v_out.vector<D>(i, v.vector<D, Lanes>(i, from), to);
    a_out.vector<D>(i, a.vector<D, Lanes>(i, 2 * from), 2 * to);
  }
};

/// Saves the least J, or restores it.
struct CopyLeast {
  View from;
  WriteView to;
  int from_component, to_component;

  PIOLA_FN void operator()(Index i) const { to.scalar(i, from.scalar<Lanes>(i, from_component), to_component); }
};

/// Copies all values of a field.
struct CopyValues {
  View from;
  WriteView to;
  int values;

  PIOLA_FN void operator()(Index i) const {
    for (int c = 0; c < values; ++c) to.scalar(i, from.scalar<Lanes>(i, c), c);
  }
};

/// Largest change of a block.
struct LargestChange {
  View change;
  double* partial;
  PIOLA_FN void operator()(Range b, Index k) const {
    double most = 0;
    for (Index i = b.first; i < b.last; ++i) {
      double const here = change.scalar<double>(i);
      if (here > most) most = here;  // false for NaN, in slots without a particle
    }
    partial[k] = most;
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
