// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/viscosity.hpp"

/// Sums over reference neighbours as published: set (2) with plain gradients or with the correction (4), (5).
namespace piola::adaptle::inline PIOLA_MACHINE {

/// F_a = I + sum_b V0_b (u_b - u_a) (x) G_ab and its rate with the velocities of half time, eq. (13).
template <int D>
struct PublishedDeformSweep {
  using R = MotionRecord<D>;
  MaterialTable table;
  State const* state;
  Half const* half;
  BodyConstants const* body;
  int const* body_of;
  bool corrected;
  Deformation* out;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(table.kinematic[t]);
  }

 private:
  static constexpr int du = 0, dv = D * D, uW = 2 * D * D, vW = uW + D, count = vW + D;

  PIOLA_FN void visit(Index i) const {
    double const* own = table.motion + static_cast<std::ptrdiff_t>(i) * R::stride;
    if (!(state[i].alive > 0)) return;  // deleted: frozen
    Lanes sum[count];
    for (auto& a : sum) a = Lanes(0.0);
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::values];
      load_components<R::values>(table.motion, R::stride, table.neighbour + k, f);
      Vec<D, Lanes> const r = difference<D>(f, R::X, own), u = difference<D>(f, R::u, own),
                          v = difference<D>(f, R::v, own);
      Lanes const Vs = f[R::volume] * load<Lanes>(table.s + k);
      for (int p = 0; p < D; ++p) {
        Lanes const a = Vs * u[p], b = Vs * v[p];
        for (int q = 0; q < D; ++q) {
          sum[du + p * D + q] += a * r[q];
          sum[dv + p * D + q] += b * r[q];
        }
      }
      if (corrected) {
        Lanes const VW = f[R::volume] * load<Lanes>(table.W + k);
        for (int p = 0; p < D; ++p) {
          sum[uW + p] += VW * u[p];
          sum[vW + p] += VW * v[p];
        }
      }
    }
    double a[whole(count)];
    total(sum, a);
    Correction const& k = table.correction[i];
    Deformation& d = out[i];
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) {
        d.F[3 * p + q] = p == q ? 1 : 0;
        d.rate[3 * p + q] = 0;
      }
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q)
        for (int l = 0; l < D; ++l) {
          double const K = k.K[3 * q + l] / k.S, shift = k.G[l] / k.S;
          d.F[3 * p + q] += (a[du + p * D + l] - a[uW + p] * shift) * K;
          d.rate[3 * p + q] += (a[dv + p * D + l] - a[vW + p] * shift) * K;
        }
    if constexpr (D < 3) d.F[8] = half[i].thickness;
    d.gap = 0;
  }
};

/// Material forces of one target. With r = X_b - X_a, g = s r:
///   t_ab = V0_b (A_a g - a_a W),  F_a += sum_b t_ab - t_ba
///        + m_a m_b Pi/2 (J_a^-1 F_b^-T G_ba - J_b^-1 F_a^-T G_ab)
/// Eulerian particles have A = 0 in the owner form; a total-Lagrangian pair has its viscosity here.
template <int D>
struct PublishedMaterialSweep {
  using R = ForceRecord<D>;
  using N = ViscousRecord<D>;
  MaterialTable table;
  Settings settings;
  BodyConstants const* body;
  int const* body_of;
  Reference const* reference;
  State const* state;
  Deformation* deformation;
  Sums* sums;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(table.target[t]);
  }

 private:
  struct Accumulated {
    static constexpr int G = 0, W = D, Q = D + 1, T = 2 * D + 1, heat = 3 * D + 1, count = heat + 1;
    Lanes a[count];
    Lanes gap, mu;
  };

  PIOLA_FN void visit(Index i) const {
    if (!(state[i].alive > 0)) return;
    double const *own = table.force + static_cast<std::ptrdiff_t>(i) * R::stride,
                 *viscous = table.viscous + static_cast<std::ptrdiff_t>(i) * N::stride;
    BodyConstants const& b = body[body_of[i]];
    Accumulated sum;
    for (auto& a : sum.a) a = Lanes(0.0);
    sum.gap = sum.mu = Lanes(0.0);
    bool const lagrangian = !(own[R::phi] > 0), tethers = lagrangian && b.tether > 0 && b.adaptive;
    bool const printed = settings.interface_form == Interface::printed;
    if (printed && !lagrangian) return;
    for (Offset k = table.begin[i]; k < table.begin[i + 1]; k += lane_count) {
      Lanes f[R::values];
      load_components<R::values>(table.force, R::stride, table.neighbour + k, f);
      Lanes const s = load<Lanes>(table.s + k), W = load<Lanes>(table.W + k);
      Vec<D, Lanes> const r = difference<D>(f, R::X, own);
      Lanes const volume = f[R::volume], Vs = volume * s;
      sum.a[Accumulated::W] += volume * W;
      for (int p = 0; p < D; ++p) {
        sum.a[Accumulated::G + p] += Vs * r[p];
        Lanes reaction = Lanes(0.0);
        for (int q = 0; q < D; ++q) reaction += f[R::A + p * D + q] * r[q];
        sum.a[Accumulated::Q + p] += s * reaction + f[R::a + p] * W;
      }
      if (tethers && any(f[R::phi] > 0.0)) sum.gap = maximum(sum.gap, gap_of(f, r, own, deformation[i]));
      if (lagrangian && b.hourglass > 0) add_damping(i, k, own, f, r, s, b, sum);
      if (lagrangian) add_viscosity(k, own, viscous, f, r, s, W, b, printed, sum);
    }
    store(i, own, b, sum);
  }

  /// |x_b - x_a - F_a (X_b - X_a)|^2 of Eulerian neighbours, zero of others.
  PIOLA_FN static Lanes gap_of(Lanes const* f, Vec<D, Lanes> const& r, double const* own, Deformation const& d) {
    Lanes square = Lanes(0.0);
    for (int p = 0; p < D; ++p) {
      Lanes gap = f[R::x + p] - own[R::x + p];
      for (int q = 0; q < D; ++q) gap -= d.F[3 * p + q] * r[q];
      square += gap * gap;
    }
    return select(f[R::phi] > 0.0 && f[R::volume] > 0.0, square, Lanes(0.0));
  }

  /// Damping of what the velocity gradients of both ends do not explain, e = v_b - v_a - (dF_a/dt + dF_b/dt)/2 r:
  /// force on a  zeta rho0 c h V0_a V0_b s e, opposite on b, and half its power as heat on each. Linear motions have
  /// none.
  PIOLA_FN void add_damping(Index i, Offset k, double const* own, Lanes const* f, Vec<D, Lanes> const& r,
                            Lanes const& s, BodyConstants const& b, Accumulated& sum) const {
    constexpr int used = D == 3 ? 9 : 5;  // of the 3 x 3 rate, rows of three
    Lanes rate[used];
    load_components<used>(deformation->rate, sizeof(Deformation) / sizeof(double), table.neighbour + k, rate);
    double const* own_rate = deformation[i].rate;
    Lanes const weight = (b.hourglass * b.c * b.material_h) * s * select(f[R::phi] > 0.0, Lanes(0.0), f[R::volume]);
    Lanes power = Lanes(0.0);
    for (int p = 0; p < D; ++p) {
      Lanes e = f[R::v + p] - own[R::v + p];
      for (int q = 0; q < D; ++q) e -= 0.5 * (rate[3 * p + q] + own_rate[3 * p + q]) * r[q];
      Lanes const extra = weight * e;
      sum.a[Accumulated::T + p] += extra;
      power += extra * (f[R::v + p] - own[R::v + p]);
    }
    sum.a[Accumulated::heat] += 0.5 * power;
  }

  PIOLA_FN void add_viscosity(Offset k, double const* own, double const* viscous, Lanes const* f,
                              Vec<D, Lanes> const& r, Lanes const& s, Lanes const& W, BodyConstants const& b,
                              bool printed, Accumulated& sum) const {
    Vec<D, Lanes> const x = difference<D>(f, R::x, own), w = difference<D>(f, R::v, own);
    Lanes closing = minimum(dot(w, x), Lanes(0.0)) * select(s != 0.0, Lanes(1.0), Lanes(0.0));
    if (!printed) closing = select(f[R::phi] > 0.0, Lanes(0.0), closing);
    if (!any(closing < 0.0)) return;
    Lanes other[N::values];
    load_components<N::values>(table.viscous, N::stride, table.neighbour + k, other);
    auto const [mu, plain] = viscous_pair(b.alpha, b.beta, b.material_h, closing, dot(x, x),
                                          other[N::c] + viscous[N::c], other[N::rho] + viscous[N::rho]);
    sum.mu = maximum(sum.mu, -1.0 * mu);
    Lanes const pressure = plain * (0.5 * (other[N::viscosity] + viscous[N::viscosity]));
    Lanes const here = Lanes(viscous[N::inverse_J]), there = other[N::inverse_J];
    Lanes power = Lanes(0.0);
    for (int p = 0; p < D; ++p) {
      Lanes own_part = Lanes(0.0), other_part = Lanes(0.0);
      for (int q = 0; q < D; ++q) {
        own_part += viscous[N::N + p * D + q] * r[q];
        other_part += other[N::N + p * D + q] * r[q];
      }
      own_part = s * own_part - viscous[N::n + p] * W;
      other_part = s * other_part + other[N::n + p] * W;
      Lanes const extra = (-0.5 * b.rho0) * (f[R::volume] * pressure) * (here * other_part + there * own_part);
      sum.a[Accumulated::T + p] += extra;
      power += extra * w[p];
    }
    sum.a[Accumulated::heat] += 0.5 * power;
  }

  PIOLA_FN void store(Index i, double const* own, BodyConstants const& b, Accumulated const& sum) const {
    double a[whole(Accumulated::count)];
    total(sum.a, a);
    Sums& out = sums[i];
    double const mass = reference[i].mass, volume = reference[i].volume;
    for (int p = 0; p < D; ++p) {
      double force = volume * a[Accumulated::Q + p] - own[R::a + p] * a[Accumulated::W] + mass * a[Accumulated::T + p];
      for (int q = 0; q < D; ++q) force += own[R::A + p * D + q] * a[Accumulated::G + q];
      out.force[p] += force;
    }
    out.heat += mass * a[Accumulated::heat];
    double const mu = largest_of(sum.mu);
    out.compression = mu > out.compression ? mu : out.compression;
    if (!(own[R::phi] > 0)) deformation[i].gap = std::sqrt(largest_of(sum.gap)) / b.material_h;
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
