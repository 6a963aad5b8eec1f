// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/cell_passes.hpp"
#include "piola/formulations/taylor_sph/rates.hpp"

/// The hourglass filter damps patterns of velocity and of stress in a box of the lattice that its centre does not see:
/// the corner values without their linear part. Linear fields stay unchanged on any shape of box (as the hourglass
/// vectors of Flanagan and Belytschko 1981), and so do fields of one coordinate.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// Patterns of signs over the corners of a box: products of two or three of the coordinates' signs.
template <int D>
struct Patterns {
  static constexpr int count = D == 1 ? 0 : D == 2 ? 1 : 4;
  static constexpr int corners = 1 << D;
  static constexpr int mask[4] = {3, 6, 5, 7};  // coordinates whose signs are multiplied
  static constexpr double sign(int pattern, int corner) {
    int bits = corner & mask[pattern], odd = 0;
    for (int number = mask[pattern]; number != 0; number &= number - 1) ++odd;
    for (; bits != 0; bits &= bits - 1) ++odd;
    return odd % 2 != 0 ? -1 : 1;
  }
};

/// Amplitudes of the patterns in one box per lane:  (1/n) sum_c h_c ( f_c - grad f . x_c ), grad f from the mean edges.
template <int D>
struct MeasurePatterns {
  HourglassTable table;
  double const* real;

  PIOLA_FN void operator()(Index i) const {
    using R = Record<D>;
    using P = Patterns<D>;
    constexpr double n = P::corners;
    Lanes slope[R::fields][D]{}, amplitude[R::fields][P::count]{}, x_amplitude[D][P::count]{};
    Mat<D, Lanes> edge;
    for (int k = 0; k < P::corners; ++k) {
      Lanes f[R::values];
      load_records(real, R::stride,
                   table.corner + (static_cast<std::ptrdiff_t>(i / lane_count) * P::corners + k) * lane_count, f);
      for (int a = 0; a < D; ++a) {
        double const sign = ((k >> a & 1) != 0 ? 2 : -2) / n;
        for (int c = 0; c < R::fields; ++c) slope[c][a] = slope[c][a] + sign * f[R::v + c];
        for (int c = 0; c < D; ++c) edge(a, c) = edge(a, c) + sign * f[R::x + c];
      }
      for (int p = 0; p < P::count; ++p) {
        double const sign = P::sign(p, k) / n;
        for (int c = 0; c < R::fields; ++c) amplitude[c][p] = amplitude[c][p] + sign * f[R::v + c];
        for (int c = 0; c < D; ++c) x_amplitude[c][p] = x_amplitude[c][p] + sign * f[R::x + c];
      }
    }
    Mat<D, Lanes> const inverse_edge = inverse(edge);
    for (int c = 0; c < R::fields; ++c) {
      Vec<D, Lanes> gradient;
      for (int b = 0; b < D; ++b) {
        gradient[b] = inverse_edge(b, 0) * slope[c][0];
        for (int a = 1; a < D; ++a) gradient[b] = gradient[b] + inverse_edge(b, a) * slope[c][a];
      }
      for (int p = 0; p < P::count; ++p) {
        Lanes a = amplitude[c][p];
        for (int b = 0; b < D; ++b) a = a - gradient[b] * x_amplitude[b][p];
        for (int l = 0; l < lane_count; ++l)
          table.pattern[(static_cast<std::ptrdiff_t>(i + l) * P::count + p) * R::fields + c] = lane(a, l);
      }
    }
  }
};

/// Removes the fraction `eps` of the mean pattern of the boxes around a particle from its velocity and stress; sums the
/// removed energy, per block.
template <int D, class Law>
struct DampPatterns {
  Law law;
  Constants k;
  HourglassTable table;
  double* real;
  View mass, out_of_plane;
  Index first, count;
  double* partial;

  PIOLA_FN void operator()(Range b, Index block) const {
    double loss = 0;
    for (Index i = b.first; i < b.last && i < first + count; ++i) loss += damp(i);
    partial[block] = loss;
  }

 private:
  PIOLA_FN double damp(Index i) const {
    using R = Record<D>;
    using P = Patterns<D>;
    double sum[R::fields] = {};
    int boxes = 0;
    for (int e = 0; e < P::corners; ++e) {
      Index const entry = table.box_of[static_cast<std::ptrdiff_t>(i) * P::corners + e];
      if (entry < 0) continue;
      ++boxes;
      double const* const pattern =
          table.pattern + static_cast<std::ptrdiff_t>(entry / P::corners) * P::count * R::fields;
      for (int p = 0; p < P::count; ++p)
        for (int c = 0; c < R::fields; ++c) sum[c] += P::sign(p, entry % P::corners) * pattern[p * R::fields + c];
    }
    if (2 * boxes < P::corners) return 0;
    double* const f = real + i * R::stride + R::v;
    double const before = energy(i, f);
    for (int c = 0; c < D; ++c) f[c] -= k.hourglass * sum[c] / boxes;
    return before - energy(i, f);
  }
  PIOLA_FN double energy(Index i, double const* f) const {
    double square = 0;
    for (int c = 0; c < D; ++c) square += f[c] * f[c];
    SymMat<3> s{};
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) s(a, b) = f[D + SymMat<D>::at(a, b)];
    if (D == 2) s(2, 2) = out_of_plane.scalar<double>(i);
    double const m = mass.scalar<double>(i);
    double const volume = real[i * Record<D>::stride + Record<D>::volume] / k.kernel_volume * m / k.rho0;
    return 0.5 * m * square + volume * law.energy_of_stress(s);
  }
};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
