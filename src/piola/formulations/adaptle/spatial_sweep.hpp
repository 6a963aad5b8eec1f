// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/viscosity.hpp"

/// Sums over spatial neighbours: set (1) of the paper.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// One target of the spatial table.
struct SpatialTarget {
  Index slot;
  double const* own;
  Index const* list;
  Index length;
  double* result;  ///< SpatialResult; entries that a sweep of D dimensions does not write stay zero
  PIOLA_FN SpatialTarget(SpatialTable const& t, Index number)
      : slot(t.slot[t.target[number]]),
        own(t.record + static_cast<std::ptrdiff_t>(t.target[number]) * t.stride),
        list(t.list + static_cast<std::ptrdiff_t>(number) * t.capacity),
        length(t.length[number]),
        result(t.result + static_cast<std::ptrdiff_t>(t.target[number]) * SpatialResult::stride) {}
};

/// Forces, heat and velocity gradient of one spatial target. With r = x_b - x_a, g = s r:
///   t_ab = V_b (M_a g - m_a W)        the half force that a owns        (owner form)
///   F_a  = sum_b t_ab - t_ba
///        + m_a m_b Pi/2 (gt_ba - gt_ab) - m_a m_b f^n (R_b gt_ba - R_a gt_ab)
///   L_a  = sum_b V_b (v_b - v_a) (x) gt_ab
/// Heat is half the power of viscosity and artificial stress on the relative velocity; that of stress follows from L.
/// Total-Lagrangian particles have M = 0, so that the same sums serve mixed pairs. In the published interface only
/// Eulerian targets keep stress and viscosity.
template <int D, bool Corrected, bool Stressed, class Shape>
struct SpatialSweep {
  using R = SpatialRecord<D, Corrected>;
  SpatialTable table;
  Settings settings;
  BodyConstants const* body;
  int const* body_of;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(t);
  }

 private:
  struct Accumulated {
    static constexpr int G = 0, W = D, Q = D + 1, L = 2 * D + 1, LW = L + D * D, T = LW + D, heat = T + D,
                         artificial = heat + 1, count = heat + (Stressed ? 2 : 1);
    Lanes a[count];
    Lanes mu;
  };

  PIOLA_FN void visit(Index number) const {
    SpatialTarget const target(table, number);
    BodyConstants const& b = body[body_of[target.slot]];
    Kernel<D, Shape> const kernel(b.h);
    double const inverse_reference = 1 / kernel(b.spacing);
    Accumulated sum;
    Lanes const zeros = zeros_from(target.own[R::volume]);
    for (auto& a : sum.a) a = zeros;
    sum.mu = zeros;
    for (Index k = 0; k < target.length; k += lane_count) {
      constexpr int values = Corrected ? R::N : R::values(Stressed);
      Lanes f[values];
      load_components<values>(table.record, R::stride(Stressed), target.list + k, f);
      add_pairs(target.own, target.list + k, f, b, kernel, inverse_reference, sum);
    }
    store(target, sum);
  }

  PIOLA_INLINE_FN void add_pairs(double const* own, Index const* list, Lanes const* f, BodyConstants const& b,
                                 Kernel<D, Shape> const& kernel, double inverse_reference, Accumulated& sum) const {
    Vec<D, Lanes> const r = difference<D>(f, R::x, own), w = difference<D>(f, R::v, own);
    Lanes const square = dot(r, r);
    Lanes s, W;
    kernel.evaluate(square, s, W);
    Lanes const volume = f[R::volume], Vs = volume * s;
    bool const bears = bears_stress(own);
    for (int i = 0; i < D; ++i) {
      sum.a[Accumulated::G + i] += Vs * r[i];
      Lanes const weighted = Vs * w[i];
      for (int j = 0; j < D; ++j) sum.a[Accumulated::L + i * D + j] += weighted * r[j];
      if (bears) sum.a[Accumulated::Q + i] += reaction(f, r, s, W, i);
    }
    if constexpr (Corrected) {
      Lanes const VW = volume * W;
      sum.a[Accumulated::W] += VW;
      for (int i = 0; i < D; ++i) sum.a[Accumulated::LW + i] += VW * w[i];
    }
    Lanes const closing = dot(w, r);
    auto const [mu, plain] =
        viscous_pair(b.alpha, b.beta, b.h, closing, square, f[R::c] + own[R::c], f[R::rho] + own[R::rho]);
    sum.mu = minimum(sum.mu, mu);
    // One kernel type per pair: a total-Lagrangian pair has its viscosity in material sums.
    bool const here = own[R::viscosity] > 0;
    Lanes factor = 0.5 * (maximum(f[R::viscosity], -1.0 * f[R::viscosity]) + std::fabs(own[R::viscosity]));
    if (!here) factor = select(f[R::viscosity] > 0.0, factor, Lanes(0.0));
    if (!here && settings.equations.has_mixed_viscosity()) factor = Lanes(0.0);
    Lanes const pressure = plain * factor;
    Lanes stress_weight = Lanes(0.0);
    if constexpr (Stressed) {
      stress_weight =
          whole_power(W * inverse_reference, settings.exponent) * mixed_weight(own[R::viscosity], f[R::viscosity]);
    }
    if constexpr (Corrected) {
      if (Stressed || any(pressure > 0.0)) add_extra(own, list, f, r, w, s, W, pressure, stress_weight, sum);
    } else
      add_plain_extra(own, f, r, w, Vs, closing, pressure, stress_weight, sum);
  }

  /// Component i of M_b g + m_b W: minus t_ba over V_a.
  PIOLA_INLINE_FN static Lanes reaction(Lanes const* f, Vec<D, Lanes> const& r, Lanes const& s, Lanes const& W, int i) {
    Lanes sum = Lanes(0.0);
    for (int j = 0; j < D; ++j) sum += f[R::M + (Corrected ? i * D + j : SymMat<D>::at(i, j))] * r[j];
    sum = s * sum;
    if constexpr (Corrected) sum += f[R::m + i] * W;
    return sum;
  }

  /// Total-Lagrangian particles have reactions of Eulerian ones, or their stress forces from material sums alone.
  PIOLA_FN bool bears_stress(double const* own) const {
    return settings.equations.has_reactions() || own[R::viscosity] > 0;
  }

  PIOLA_INLINE_FN Lanes mixed_weight(double own, Lanes const& other) const {
    Lanes const here(own > 0 ? 1.0 : 0.0), there = select(other > 0.0, Lanes(1.0), Lanes(0.0));
    if (settings.mixed_stress == MixedStress::both) return maximum(here, there);
    if (settings.mixed_stress == MixedStress::eulerian_only) return here;
    return here * there;
  }

  /// As above with plain gradients, gt_ab = -gt_ba = g.
  PIOLA_INLINE_FN void add_plain_extra(double const* own, Lanes const* f, Vec<D, Lanes> const& r,
                                       Vec<D, Lanes> const& w, Lanes const& Vs, Lanes const& closing,
                                       Lanes const& pressure, Lanes const& stress_weight, Accumulated& sum) const {
    // Over V_a, like the sum Q, which uses the same record entry.
    Lanes const weight = own[R::rho] * f[R::rho] * Vs, push = weight * pressure;
    Lanes power = -1.0 * push * closing;
    for (int i = 0; i < D; ++i) sum.a[Accumulated::Q + i] -= push * r[i];
    if constexpr (Stressed) {
      Lanes const pull = weight * stress_weight;
      Lanes artificial = Lanes(0.0);
      for (int i = 0; i < D; ++i) {
        Lanes bracket = Lanes(0.0);
        for (int j = 0; j < D; ++j) {
          int const c = R::R + SymMat<D>::at(i, j);
          bracket += (f[c] + own[c]) * r[j];
        }
        Lanes const extra = pull * bracket;
        sum.a[Accumulated::Q + i] += extra;
        artificial += extra * w[i];
      }
      power += artificial;
      sum.a[Accumulated::artificial] += artificial;
    }
    sum.a[Accumulated::heat] += power;
  }

  /// Viscosity and artificial stress: force over m_a, and half its power on the relative velocity. Only these read the
  /// rest of the records.
  PIOLA_INLINE_FN void add_extra(double const* own, Index const* list, Lanes const* f, Vec<D, Lanes> const& r,
                                 Vec<D, Lanes> const& w, Lanes const& s, Lanes const& W, Lanes const& pressure,
                                 Lanes const& stress_weight, Accumulated& sum) const {
    constexpr int N = 0, n = R::n - R::N, tensor = R::R - R::N, values = R::values(Stressed) - R::N;
    Lanes rest[values];
    load_components<values>(table.record + R::N, R::stride(Stressed), list, rest);
    Lanes const mass = f[R::volume] * f[R::rho];
    Vec<D, Lanes> gt_ab, gt_ba;
    for (int i = 0; i < D; ++i) {
      Lanes here = Lanes(0.0), there = Lanes(0.0);
      for (int j = 0; j < D; ++j) {
        here += own[R::N + i * D + j] * r[j];
        there += rest[N + i * D + j] * r[j];
      }
      gt_ab[i] = s * here - own[R::n + i] * W;
      gt_ba[i] = -1.0 * (s * there + rest[n + i] * W);
    }
    Lanes power = Lanes(0.0), artificial = Lanes(0.0);
    for (int i = 0; i < D; ++i) {
      Lanes extra = (0.5 * pressure) * (gt_ba[i] - gt_ab[i]);
      if constexpr (Stressed) {
        Lanes bracket = Lanes(0.0);
        for (int j = 0; j < D; ++j)
          bracket += rest[tensor + SymMat<D>::at(i, j)] * gt_ba[j] - own[R::R + SymMat<D>::at(i, j)] * gt_ab[j];
        bracket = stress_weight * bracket;
        extra -= bracket;
        artificial -= mass * bracket * w[i];
      }
      extra = mass * extra;
      sum.a[Accumulated::T + i] += extra;
      power += extra * w[i];
    }
    sum.a[Accumulated::heat] += power;
    if constexpr (Stressed) sum.a[Accumulated::artificial] += artificial;
  }

  PIOLA_FN void store(SpatialTarget const& target, Accumulated const& sum) const {
    double a[whole(Accumulated::count)];
    total(sum.a, a);
    double const* own = target.own;
    double* const out = target.result;
    double const mass = own[R::volume] * own[R::rho];
    double const stress = bears_stress(own) ? 1 : 0;
    for (int i = 0; i < D; ++i) {
      double own_force = 0;
      for (int j = 0; j < D; ++j)
        own_force += own[R::M + (Corrected ? i * D + j : SymMat<D>::at(i, j))] * a[Accumulated::G + j];
      if constexpr (Corrected) own_force -= own[R::m + i] * a[Accumulated::W];
      double force = stress * own_force + own[R::volume] * a[Accumulated::Q + i];
      if constexpr (Corrected) force += mass * a[Accumulated::T + i];
      out[SpatialResult::force + i] = force;
      for (int j = 0; j < D; ++j) {
        double L = a[Accumulated::L + i * D + j];
        if constexpr (Corrected) {
          L = -a[Accumulated::LW + i] * own[R::n + j];
          for (int k = 0; k < D; ++k) L += a[Accumulated::L + i * D + k] * own[R::N + j * D + k];
        }
        out[SpatialResult::L + 3 * i + j] = L;
      }
    }
    double const half = 0.5 * (Corrected ? mass : own[R::volume]);
    out[SpatialResult::heat] = half * a[Accumulated::heat];
    if constexpr (Stressed) out[SpatialResult::artificial] = half * a[Accumulated::artificial];
    out[SpatialResult::compression] = maximum(largest_of(-1.0 * sum.mu), 0.0);
  }
};

/// Corrections (4), (5) of one spatial target, dropped if they would change a gradient by more than C_f, invert it, or
/// are singular.
template <int D, class Shape>
struct CorrectSpatial {
  using R = SpatialRecord<D, true>;
  SpatialTable table;
  Settings settings;
  BodyConstants const* body;
  int const* body_of;
  Correction* correction;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(t);
  }

 private:
  static constexpr int width = 1 + 2 * D + D * D;

  PIOLA_FN void visit(Index number) const {
    SpatialTarget const target(table, number);
    BodyConstants const& b = body[body_of[target.slot]];
    Kernel<D, Shape> const kernel(b.h);
    Lanes sum[width];
    Lanes const zeros = zeros_from(target.own[R::volume]);
    for (auto& a : sum) a = zeros;
    for (Index k = 0; k < target.length; k += lane_count) {
      Lanes f[R::volume + 1];
      load_components<R::volume + 1>(table.record, table.stride, target.list + k, f);
      Vec<D, Lanes> const r = difference<D>(f, R::x, target.own);
      Lanes s, W;
      kernel.evaluate(dot(r, r), s, W);
      Lanes const VW = f[R::volume] * W, Vs = f[R::volume] * s;
      sum[0] += VW;
      for (int i = 0; i < D; ++i) {
        Lanes const g = Vs * r[i];
        sum[1 + i] += g;
        sum[1 + D + i] += VW * r[i];
        for (int j = 0; j < D; ++j) sum[1 + 2 * D + i * D + j] += g * r[j];
      }
    }
    double a[whole(width)];
    total(sum, a);
    a[0] += target.own[R::volume] * kernel(0);
    Correction& out = correction[target.slot];
    out = {1, {}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    Correction trial = out;
    if (solve(a, trial) && admissible(target, trial, kernel, b.h)) out = trial;
  }

  /// The correction with the sums of visit(). Returns false if it is singular.
  PIOLA_INLINE_FN static bool solve(double const (&a)[whole(width)], Correction& trial) {
    Mat<D> A;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) A(i, j) = (a[0] * a[1 + 2 * D + i * D + j] - a[1 + i] * a[1 + D + j]) / (a[0] * a[0]);
    Mat<D> const K = inverse(A);
    double size = 0;
    for (double const k : K.c) size += k * k;
    if (!(size < 1e20)) return false;
    trial.S = a[0];
    for (int i = 0; i < D; ++i) {
      trial.G[i] = a[1 + i];
      for (int j = 0; j < D; ++j) trial.K[3 * i + j] = K(i, j);
    }
    return true;
  }

  PIOLA_FN bool admissible(SpatialTarget const& target, Correction const& k, Kernel<D, Shape> const& kernel,
                           double h) const {
    Mat<D> N;
    Vec<D> n{};
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        N(i, j) = k.K[3 * i + j] / k.S;
        n[i] += k.K[3 * i + j] * k.G[j] / (k.S * k.S);
      }
    Lanes neighbours = Lanes(0.0);
    for (Index first = 0; first < target.length; first += lane_count) {
      Lanes f[D];
      load_components<D>(table.record, table.stride, target.list + first, f);
      Vec<D, Lanes> const r = difference<D>(f, R::x, target.own);
      Lanes const square = dot(r, r);
      Lanes s, W, along = Lanes(0.0);
      kernel.evaluate(square, s, W);
      auto const inside = W > 0.0;
      neighbours += select(inside, Lanes(1.0), Lanes(0.0));
      auto refused = W < 0.0;
      for (int i = 0; i < D; ++i) {
        Lanes sum = Lanes(0.0);
        for (int j = 0; j < D; ++j) sum += N(i, j) * r[j];
        Lanes const corrected = s * sum - n[i] * W, plain = s * r[i];
        along += plain * corrected;
        Lanes const limit = select(r[i] * r[i] > 0.0025 * h * h, plain * plain, s * s * square);
        refused = refused || !(corrected * corrected <= settings.fallback * settings.fallback * limit);
      }
      refused = refused || (square < h * h && along < 0.0);
      if (any(inside && refused)) return false;
    }
    return sum_of_lanes(neighbours) >= 2;
  }
};

/// Folds the correction of each spatial target into its record.
template <int D>
struct FoldCorrection {
  using R = SpatialRecord<D, true>;
  SpatialTable table;
  Correction const* correction;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) {
      Index const i = table.target[t];
      double* own = table.record + static_cast<std::ptrdiff_t>(i) * table.stride;
      Correction const& k = correction[table.slot[i]];
      double M[SymMat<D>::size], N[D * D], n[D];
      for (int c = 0; c < SymMat<D>::size; ++c) M[c] = own[R::M + c];
      for (int p = 0; p < D; ++p) {
        n[p] = 0;
        for (int q = 0; q < D; ++q) {
          N[p * D + q] = k.K[3 * p + q] / k.S;
          n[p] += k.K[3 * p + q] * k.G[q] / (k.S * k.S);
        }
      }
      for (int p = 0; p < D; ++p) {
        own[R::m + p] = 0;
        own[R::n + p] = n[p];
        for (int q = 0; q < D; ++q) {
          own[R::m + p] += M[SymMat<D>::at(p, q)] * n[q];
          own[R::N + p * D + q] = N[p * D + q];
          double sum = 0;
          for (int l = 0; l < D; ++l) sum += M[SymMat<D>::at(p, l)] * N[l * D + q];
          own[R::M + p * D + q] = sum;
        }
      }
    }
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
