// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/adjoint_cell_passes.hpp"

/// The adjoint exchange on the real particles; see adjoint_cell_passes.hpp.
namespace piola::taylor_sph::inline PIOLA_BACKEND {

/// Virtual to real, minus the adjoint of the gradient:  m dv = -dt sum_J force_Ji + dt f_i, then prescribed speeds.
/// `drift` becomes the mean velocity of the step. Sums the external work, per block.
template <int D>
struct AdvanceVelocities {
  Constants k;
  CellsAround around;
  CellState state;
  double* real;
  View mass, acceleration;
  WriteView drift;
  BoundaryItem const* items;  ///< of the particles from `first` on, or nullptr
  Index first, last;          ///< number of particles in the range
  double* partial;
  double dt;

  PIOLA_FN void operator()(Range b, Index block) const {
    double work = 0;
    for (Index i = b.first; i < b.last && i < last; ++i) work += advance(i);
    partial[block] = work;
  }

 private:
  PIOLA_FN double advance(Index i) const {
    using R = Record<D>;
    double* const v = real + static_cast<std::ptrdiff_t>(i) * R::stride + R::v;
    double const m = mass.scalar<double>(i);
    double force[D] = {}, impulse[D];
    for (Index e = around.begin[i]; e < around.begin[i + 1]; ++e)
      for (int c = 0; c < D; ++c) force[c] -= state.force[static_cast<std::ptrdiff_t>(around.entry[e]) * D + c];
    double before[D];
    for (int c = 0; c < D; ++c) {
      before[c] = v[c];
      impulse[c] = k.loaded ? dt * m * acceleration.scalar<double>(i, c) : 0;
      v[c] += (dt * force[c] + impulse[c]) / m;
    }
    if (items != nullptr) prescribe_velocity(items[i - first], m, v, impulse);
    double work = 0;
    for (int c = 0; c < D; ++c) {
      double const mean = 0.5 * (before[c] + v[c]);
      drift.scalar(i, mean, c);
      work += impulse[c] * mean;
    }
    return work;
  }
  PIOLA_FN static void prescribe_velocity(BoundaryItem const& item, double m, double* v, double* impulse) {
    for (int h = 0; h < item.held; ++h) {
      double change = item.speed_after[h];
      for (int a = 0; a < D; ++a) change -= item.direction[h][a] * v[a];
      for (int a = 0; a < D; ++a) {
        v[a] += change * item.direction[h][a];
        impulse[a] += m * change * item.direction[h][a];
      }
    }
  }
};

/// Stresses and positions of the real particles: L_i = sum_J V_J L_J / (n W_i), W_i = sum_J V_J / n, the adjoint of the
/// mean over corners and exact for linear velocities. Sums W L:D:L, per block.
template <int D, class Law>
struct AdvanceStresses {
  Law law;
  Constants k;
  CellsAround around;
  CellState state;
  int corners;
  double const* virtual_;
  double* real;
  WriteView out_of_plane, displacement;
  View drift;
  Index last;
  FailureSlot* failure;
  double* partial;
  double dt;

  PIOLA_FN void operator()(Range b, Index block) const {
    double sum = 0;
    for (Index i = b.first; i < b.last && i < last; ++i) sum += advance(i);
    partial[block] = sum;
  }

 private:
  PIOLA_FN double advance(Index i) const {
    using R = Record<D>;
    Mat<D> L{};
    double volume = 0;
    for (Index e = around.begin[i]; e < around.begin[i + 1]; ++e) {
      auto const cell = static_cast<std::ptrdiff_t>(around.entry[e] / corners);
      volume += virtual_[cell * R::stride + R::volume];
      for (int c = 0; c < D * D; ++c) L.c[c] += state.gradient[cell * D * D + c];
    }
    for (int c = 0; c < D * D; ++c) L.c[c] /= volume;
    double* const own = real + static_cast<std::ptrdiff_t>(i) * R::stride;
    SymMat<D> s;
    for (int c = 0; c < R::stress; ++c) s.c[c] = own[R::s + c];
    double across = D == 2 ? out_of_plane.data[i] : 0;
    advance_stress<D>(law, k, L, dt, s, across);
    double size = 0;
    for (int c = 0; c < R::stress; ++c) {
      own[R::s + c] = s.c[c];
      size += s.c[c] * s.c[c];
    }
    if constexpr (D == 2) out_of_plane.data[i] = across;
    for (int c = 0; c < D; ++c) {
      double const mean = drift.scalar<double>(i, c);
      if (k.moving)
        own[R::x + c] += dt * mean;
      else
        displacement.data[c * displacement.component_stride + i] += dt * mean;
      size += own[R::v + c] * own[R::v + c];
    }
    if (!(size < 1e300)) exec::record(failure, i, 1);
    return volume / corners * elastic_square<D>(law, k.lateral, L);
  }
};

/// Volumes of the real particles from those of their cells, in the form of the records.
template <int D>
struct GatherVolumes {
  Constants k;
  CellsAround around;
  int corners;
  double const* virtual_;
  double* real;
  View mass;
  Index last;

  PIOLA_FN void operator()(Range b, Index) const {
    using R = Record<D>;
    for (Index i = b.first; i < b.last && i < last; ++i) {
      double volume = 0;
      for (Index e = around.begin[i]; e < around.begin[i + 1]; ++e)
        volume += virtual_[static_cast<std::ptrdiff_t>(around.entry[e] / corners) * R::stride + R::volume];
      real[static_cast<std::ptrdiff_t>(i) * R::stride + R::volume] =
          volume / corners * k.kernel_volume * k.rho0 / mass.scalar<double>(i);
    }
  }
};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
