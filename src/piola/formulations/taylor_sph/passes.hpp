// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/rates.hpp"

/// Operations on one particle in a step of Taylor-SPH; equations of Serroukh and Mabssout (2022), as corrected in
/// docs/theory/taylor-sph.md.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// Mean over the corners of the cells of the lanes that start at i of values per real particle.
template <int D>
PIOLA_FN Vec<D, Lanes> mean_of_corners(CellTable const& cells, View const& values, Index i) {
  Vec<D, Lanes> sum{};
  for (int k = 0; k < cells.corners; ++k) {
    Index const* const at =
        cells.corner + (static_cast<std::ptrdiff_t>(i / lane_count) * cells.corners + k) * lane_count;
    for (int c = 0; c < D; ++c) {
      double value[lane_count];
      for (int l = 0; l < lane_count; ++l) value[l] = values.scalar<double>(at[l], c);
      sum[c] = sum[c] + load<Lanes>(value);
    }
  }
  return (1.0 / cells.corners) * sum;
}

/// Real to virtual (21), half a step from interpolated values:
///   v_I^(n+1/2) = <v>_I + dt/2 ( div sigma / rho + b )_I,   s_I^(n+1/2) = <s>_I + dt/2 ( D:d - S )_I
/// and, in a moving body, the place and volume of half time.
template <int D, class Kernel, class Law>
struct HalfStep {
  Law law;
  Constants k;
  CrossSetPairTable pairs;
  CellTable cells;
  double const* real;
  double* virtual_;
  View acceleration;
  double dt;

  PIOLA_FN void operator()(Index i) const {
    using R = Record<D>;
    Lanes own[R::values];
    load_local<D>(virtual_, i, own);
    Vec<D, Lanes> x;
    for (int c = 0; c < D; ++c) x[c] = own[R::x + c];
    auto const sums = sum_sources<D, Kernel>(pairs, real, i, x);
    auto const e = estimate<D>(sums, k.form);
    Mat<D, Lanes> const L = velocity_gradient<D>(e);
    Vec<D, Lanes> a = divergence<D>(e);
    // 1 / rho, interpolated: Omega rho = V_kernel rho0 at every real particle.
    Lanes const specific_volume = sums.w_volume / (sums.w * (k.rho0 * k.kernel_volume));
    a = specific_volume * a;
    if (k.loaded) a = a + mean_of_corners<D>(cells, acceleration, i);
    SymMat<D, Lanes> sigma;
    for (int c = 0; c < R::stress; ++c) sigma.c[c] = e.f[D + c];
    auto const rate = stress_rate<D>(law, k, L, sigma);
    double const half = 0.5 * dt;
    if (k.moving) {
      for (int c = 0; c < D; ++c) own[R::x + c] = x[c] + half * e.f[c];
      own[R::volume] = own[R::volume] * (1.0 + half * trace(L));
    }
    for (int c = 0; c < D; ++c) own[R::v + c] = e.f[c] + half * a[c];
    for (int c = 0; c < R::stress; ++c) own[R::s + c] = sigma.c[c] + half * rate.in_plane.c[c];
    store_own<D>(own, i, virtual_);
  }
};

/// Position of a real particle at half time, relative to which the virtual particles are evaluated: it drifts as in the
/// last step. Its own velocity may contain a checkerboard that the virtual particles do not see and that must not move
/// it.
template <int D>
PIOLA_FN Vec<D, Lanes> half_time_place(Constants const& k, Lanes const (&own)[Record<D>::values],
                                       WriteView const& drift, Index i, double dt) {
  Vec<D, Lanes> x;
  for (int c = 0; c < D; ++c) {
    x[c] = own[Record<D>::x + c];
    if (k.moving) x[c] = x[c] + 0.5 * dt * load<Lanes>(drift.data + c * drift.component_stride + i);
  }
  return x;
}

/// Virtual to real (22), (23) for particles without prescribed values:
///   v_I^(n+1) = v_I^n + dt ( div sigma^(n+1/2) / rho + b ),   s_I^(n+1) = s_I^n + dt ( D:d - S )^(n+1/2)
///   x_I^(n+1) = x_I^n + dt <v^(n+1/2)>_I
template <int D, class Kernel, class Law>
struct FullStep {
  Law law;
  Constants k;
  CrossSetPairTable pairs;
  double const* virtual_;
  double* real;
  WriteView out_of_plane, drift, displacement;
  View acceleration;
  Index count;
  FailureSlot* failure;
  double dt;

  PIOLA_FN void operator()(Index i) const {
    using R = Record<D>;
    Lanes own[R::values];
    load_local<D>(real, i, own);
    auto const sums = sum_sources<D, Kernel>(pairs, virtual_, i, half_time_place<D>(k, own, drift, i, dt));
    auto const e = estimate<D>(sums, k.form);
    Mat<D, Lanes> const L = velocity_gradient<D>(e);
    // 1 / rho at half time.
    Lanes specific_volume = own[R::volume] / (k.rho0 * k.kernel_volume);
    if (k.moving) specific_volume = specific_volume * (1.0 + 0.5 * dt * trace(L));
    Vec<D, Lanes> a = specific_volume * divergence<D>(e);
    if (k.loaded) a = a + acceleration.vector<D, Lanes>(i);
    SymMat<D, Lanes> sigma;
    for (int c = 0; c < R::stress; ++c) sigma.c[c] = e.f[D + c];
    auto const rate = stress_rate<D>(law, k, L, sigma);
    if (k.moving) {
      for (int c = 0; c < D; ++c) {
        own[R::x + c] = own[R::x + c] + dt * e.f[c];
        drift.scalar(i, e.f[c], c);
      }
      own[R::volume] = volume_after(own[R::volume], trace(L), dt);
    }
    for (int c = 0; c < D && !k.moving; ++c)
      displacement.scalar(i, load<Lanes>(displacement.data + c * displacement.component_stride + i) + dt * e.f[c], c);
    Lanes size = own[R::volume];
    for (int c = 0; c < D; ++c) {
      own[R::v + c] = own[R::v + c] + dt * a[c];
      size = size + own[R::v + c] * own[R::v + c];
    }
    for (int c = 0; c < R::stress; ++c) {
      own[R::s + c] = own[R::s + c] + dt * rate.in_plane.c[c];
      size = size + own[R::s + c] * own[R::s + c];
    }
    store_own<D>(own, i, real);
    if constexpr (D == 2) out_of_plane.scalar(i, load<Lanes>(out_of_plane.data + i) + dt * rate.across);
    check(i, size);
  }

 private:
  PIOLA_FN void check(Index i, Lanes const& size) const {
    constexpr double largest = 1e300;
    if (!any(!(size < largest))) return;
    for (int l = 0; l < lane_count; ++l)
      if (i + l < count && !(lane(size, l) < largest)) exec::record(failure, i + l, 1);
  }
};

/// Maxima over each block of real particles.
template <int D>
struct LargestVolume {
  double const* real;
  Index last;
  double* partial;
  PIOLA_FN void operator()(Range b, Index k) const {
    double largest = 0;
    for (Index i = b.first; i < b.last && i < last; ++i)
      largest = maximum(largest, real[i * Record<D>::stride + Record<D>::volume]);
    partial[k] = largest;
  }
};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
