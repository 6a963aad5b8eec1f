// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/passes.hpp"
#include "piola/mechanics/boundary_passes.hpp"

/// Passes for supported and loaded particles, in addition to those of mechanics/. Theory: docs/theory/boundaries.md.
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// Imposes the prescribed velocity of a particle; with multipliers its acceleration (step 8 of Algorithm 1 for rates),
/// as they then correct the velocity.
///
/// TVD Runge-Kutta, after a stage: the velocity of t^(n+1), and in stage 1 x^(n+1) = x^n + dt/2 (v^n + v^(n+1)). The
/// reactions r of the stages are rates of velocity, like those of forces; work m/2 (r + r*) (x^(n+1) - x^n).
template <int D>
struct HoldDirections {
  StageUpdate stage;
  PrescribedDirection* held;
  View v, v_n, x;
  WriteView v_out, x_out;

  PIOLA_FN void operator()(Index k) const {
    PrescribedDirection& h = held[k];
    double const now = along<D>(v, h), start = along<D>(v_n, h);
    double const speed = h.multiplied ? start + (h.speed - h.start_speed) : h.speed, change = speed - now;
    set_along<D>(v, v_out, h, now, speed);
    if (stage.second) {
      h.at_end = change;
      h.work += h.mass * change * h.mean_speed;  // r* dt / 2 = change
      return;
    }
    h.at_start = 0.5 * change;
    h.mean_speed = 0.5 * (start + speed);
    h.work = 0.5 * h.mass * change * h.mean_speed;  // r dt = change
    if (h.at_rest && h.axis >= 0)
      x_out.scalar(h.slot, h.position, h.axis);
    else
      move_along<D>(x, x_out, h, 0.5 * stage.dt * change);
  }
};

/// The accelerations of the loads at the start or at the end of a step, with the deformation gradients of that time.
template <int D>
struct TurnLoads {
  bool at_end;
  LoadedParticle* loaded;
  View F;

  PIOLA_FN void operator()(Index k) const {
    Mat<D> part;
    for (int c = 0; c < D * D; ++c) part.c[c] = F.scalar<double>(loaded[k].slot, c);
    turn_load<D>(loaded[k], at_end, cofactor(embed<D>(part)));
  }
};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
