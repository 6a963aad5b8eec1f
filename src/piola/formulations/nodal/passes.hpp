// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/lattice_sums.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/neighbours/record_gather.hpp"

/// Sweeps and moves of the nodal formulation: operations on one particle. Theory and symbols: docs/theory/nodal.md.
/// Pairs carry r = X_b - X_a in spacings and the weight s.
namespace piola::nodal::inline PIOLA_BACKEND {

/// The sweep that fills a block's scratch with sums of the motion: D rows (T_i, N_i),
///   T_a = sum_b s (x_b - x_a) (x) P(r)  (D x values),   N_a = sum_b s (x_b - x_a) (x) mu_b  (D x D).
template <int D>
struct SumMotion {
  using R = Records<D>;
  static constexpr int sums = D * R::used;
  ListSums<D> list;

  PIOLA_FN void operator()(Index i, exec::Scratch const& out) const {
    alignas(64) double rows[lane_count * D * R::width];
    Index row[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      row[l] = l;
      list.of_motion(i + l, rows + l * D * R::width);
    }
    for (int c = 0; c < D; ++c) {
      Lanes sum[R::used];
      load_records(rows + c * R::width, D * R::width, row, sum);
      for (int n = 0; n < R::used; ++n) store(sum[n], out.at(i, c * R::used + n));
    }
  }
};

/// As above for a lattice, a block at a time.
template <int D>
struct SumLatticeMotion {
  static constexpr int sums = D * LatticeSums<D>::used;
  LatticeSums<D> lattice;

  PIOLA_FN void operator()(Range b, exec::Scratch const& out) const { lattice.of_motion(b, out); }
};

/// x_c mu_J, which the first sweep over a lattice sums.
template <int D>
struct MultiplyByCorrections {
  View x, mu;
  WriteView products;

  PIOLA_FN void operator()(Index i) const { multiply<Lanes>(i); }
  template <class V>
  PIOLA_FN void multiply(Index i) const {
    for (int c = 0; c < D; ++c)
      for (int J = 0; J < D; ++J) products.scalar(i, V(x.scalar<V>(i, c) * mu.scalar<V>(i, J)), c * D + J);
  }
};

/// x_c mu_J of ghosts, computed locally instead of received.
template <int D>
struct MultiplyOthers {
  MultiplyByCorrections<D> pass;
  Index const* slots;
  PIOLA_FN void operator()(Index k) const { pass.template multiply<double>(slots[k]); }
};

/// m_a a_a = sum_b t_ab - sum_b t_ba,  t_ab = s (Y_a P(r_ab) + Z_a mu_b). The first sum, of the particle's own stress,
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

/// As above for a lattice, a block at a time.
template <int D>
struct SumLatticeForces {
  LatticeSums<D> lattice;
  ReferenceView mass;
  View a;
  WriteView a_out;

  PIOLA_FN void operator()(Range b, Index) const {
    alignas(64) double sums[exec::block_size];
    for (int c = 0; c < D; ++c) {
      lattice.of_stress(b, c, sums);
      for (Index i = b.first; i < b.last; i += lane_count) {
        Lanes const force = a.scalar<Lanes>(i, c) - load<Lanes>(sums + (i - b.first));
        a_out.scalar(i, Lanes(force / mass.scalar<Lanes>(i)), c);
      }
    }
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
