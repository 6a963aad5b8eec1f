// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/passes.hpp"

/// Passes over the particles that supports drive and that loads act on. Theory: docs/theory/boundaries.md.
namespace piola::jst_sph::inline PIOLA_MACHINE {

/// The component of a vector field along a held direction.
template <int D>
PIOLA_FN double along(View const& field, HeldDirection const& h) {
  if (h.axis >= 0) return field.scalar<double>(h.slot, h.axis);
  double sum = 0;
  for (int c = 0; c < D; ++c) sum += field.scalar<double>(h.slot, c) * h.direction[c];
  return sum;
}

/// Adds `change` along the direction to a vector field.
template <int D>
PIOLA_FN void move_along(View const& from, WriteView const& to, HeldDirection const& h, double change) {
  for (int c = 0; c < D; ++c)
    if (h.direction[c] != 0) to.scalar(h.slot, from.scalar<double>(h.slot, c) + change * h.direction[c], c);
}

/// Sets the component along the direction, which is `now`.
template <int D>
PIOLA_FN void set_along(View const& from, WriteView const& to, HeldDirection const& h, double now, double wanted) {
  if (h.axis >= 0)
    to.scalar(h.slot, wanted, h.axis);
  else
    move_along<D>(from, to, h, wanted - now);
}

/// What is prescribed of a particle: its velocity; with multipliers its acceleration (step 8 of Algorithm 1 for rates),
/// as they then correct the velocity.
///
/// TVD Runge-Kutta, after a stage: the velocity of t^(n+1), and in stage 1 x^(n+1) = x^n + dt/2 (v^n + v^(n+1)).
/// The reactions r of the stages are rates of velocity as those of forces; work m/2 (r + r*) (x^(n+1) - x^n).
template <int D>
struct HoldDirections {
  StageUpdate stage;
  HeldDirection* held;
  View v, v_n, x;
  WriteView v_out, x_out;

  PIOLA_FN void operator()(Index k) const {
    HeldDirection& h = held[k];
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

/// Verlet, before the first kick: v^(n+1/2) = 1/2 (v^n + v^(n+1)) along the directions, by the acceleration that takes
/// the particle there. `rate` holds what the forces alone would do; the difference is the reaction r^n.
template <int D>
struct DriveDirections {
  double dt;
  HeldDirection* held;
  View v, rate;
  WriteView rate_out;

  PIOLA_FN void operator()(Index k) const {
    HeldDirection& h = held[k];
    double const now = along<D>(v, h), free = along<D>(rate, h);
    h.mean_speed = h.multiplied ? now + 0.5 * (h.speed - h.start_speed) : 0.5 * (now + h.speed);
    double const wanted = 2 * (h.mean_speed - now) / dt;
    h.at_start = 0.5 * dt * (wanted - free);
    h.work = h.mass * h.at_start * h.mean_speed;
    set_along<D>(rate, rate_out, h, free, wanted);
  }
};

/// Verlet, after the second kick: v^(n+1) along the directions; `rate` keeps what the forces alone would do. Together
/// with DriveDirections the reactions do the work m/2 (r^n + r^(n+1)) (x^(n+1) - x^n).
template <int D>
struct ArriveAlongDirections {
  double dt;
  HeldDirection* held;
  View v, rate;
  WriteView v_out;

  PIOLA_FN void operator()(Index k) const {
    HeldDirection& h = held[k];
    double const now = along<D>(v, h), half = now - 0.5 * dt * along<D>(rate, h);
    double const speed = h.multiplied ? half + 0.5 * (h.speed - h.start_speed) : h.speed;
    h.at_end = speed - now;
    h.work += h.mass * h.at_end * h.mean_speed;
    set_along<D>(v, v_out, h, now, speed);
  }
};

/// The accelerations of the loads at the start or at the end of a step. A pressure p on a face acts along n da = cof F
/// N dA (Nanson).
template <int D>
struct TurnLoads {
  bool at_end;
  LoadedParticle* loaded;
  View F;

  PIOLA_FN void operator()(Index k) const {
    LoadedParticle& p = loaded[k];
    double *const a = at_end ? p.after : p.before, *const dead = p.dead[at_end], *const follow = p.follow[at_end];
    Mat<D> part;
    for (int c = 0; c < D * D; ++c) part.c[c] = F.scalar<double>(p.slot, c);
    Mat<3> const cofactor_F = cofactor(embed<D>(part));
    for (int c = 0; c < D; ++c) {
      a[c] = dead[c];
      for (int d = 0; d < D; ++d) a[c] += cofactor_F(c, d) * follow[d];
    }
  }
};

/// Adds the accelerations of the loads at the start or at the end of a step to the rate.
template <int D>
struct AddLoads {
  bool at_end;
  LoadedParticle const* loaded;
  View rate;
  WriteView rate_out;

  PIOLA_FN void operator()(Index k) const {
    LoadedParticle const& p = loaded[k];
    double const* const a = at_end ? p.after : p.before;
    for (int c = 0; c < D; ++c) rate_out.scalar(p.slot, rate.scalar<double>(p.slot, c) + a[c], c);
  }
};

/// Work m/2 (b^n + b^(n+1)).(x^(n+1) - x^n) of the loads, with x^(n+1) - x^n = dt/2 (u + w).
template <int D>
struct WorkOfLoads {
  double dt;
  LoadedParticle* loaded;
  View u, w;

  PIOLA_FN void operator()(Index k) const {
    LoadedParticle& p = loaded[k];
    p.work = 0;
    for (int c = 0; c < D; ++c)
      p.work += (p.before[c] + p.after[c]) * (u.scalar<double>(p.slot, c) + w.scalar<double>(p.slot, c));
    p.work *= 0.25 * dt * p.mass;
  }
};

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
