// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/mechanics/prescribed_data.hpp"

/// Passes over the particles that supports drive and that loads act on. Theory: docs/theory/boundaries.md.
namespace piola::inline PIOLA_BACKEND {

/// The component of a vector field along a held direction.
template <int D>
PIOLA_FN double along(View const& field, PrescribedDirection const& h) {
  if (h.axis >= 0) return field.scalar<double>(h.slot, h.axis);
  double sum = 0;
  for (int c = 0; c < D; ++c) sum += field.scalar<double>(h.slot, c) * h.direction[c];
  return sum;
}

/// Adds `change` along the direction to a vector field.
template <int D>
PIOLA_FN void move_along(View const& from, WriteView const& to, PrescribedDirection const& h, double change) {
  for (int c = 0; c < D; ++c)
    if (h.direction[c] != 0) to.scalar(h.slot, from.scalar<double>(h.slot, c) + change * h.direction[c], c);
}

/// Sets the component along the direction; `now`: its present value.
template <int D>
PIOLA_FN void set_along(View const& from, WriteView const& to, PrescribedDirection const& h, double now,
                        double wanted) {
  if (h.axis >= 0)
    to.scalar(h.slot, wanted, h.axis);
  else
    move_along<D>(from, to, h, wanted - now);
}

/// Verlet, before the first kick: sets v^(n+1/2) = 1/2 (v^n + v^(n+1)) along the directions, by the acceleration that
/// leads to the prescribed position. `rate` keeps the acceleration by the forces alone; the difference is the reaction
/// r^n.
template <int D>
struct DriveDirections {
  double dt;
  PrescribedDirection* held;
  View v, rate;
  WriteView rate_out;

  PIOLA_FN void operator()(Index k) const {
    PrescribedDirection& h = held[k];
    double const now = along<D>(v, h), free = along<D>(rate, h);
    h.mean_speed = h.multiplied ? now + 0.5 * (h.speed - h.start_speed) : 0.5 * (now + h.speed);
    double const wanted = 2 * (h.mean_speed - now) / dt;
    h.at_start = 0.5 * dt * (wanted - free);
    h.work = h.mass * h.at_start * h.mean_speed;
    set_along<D>(rate, rate_out, h, free, wanted);
  }
};

/// Verlet, after the second kick: sets v^(n+1) along the directions; `rate` keeps the acceleration by the forces alone.
/// Together with DriveDirections the reactions do the work m/2 (r^n + r^(n+1)) (x^(n+1) - x^n).
template <int D>
struct ArriveAlongDirections {
  double dt;
  PrescribedDirection* held;
  View v, rate;
  WriteView v_out;

  PIOLA_FN void operator()(Index k) const {
    PrescribedDirection& h = held[k];
    double const now = along<D>(v, h), half = now - 0.5 * dt * along<D>(rate, h);
    double const speed = h.multiplied ? half + 0.5 * (h.speed - h.start_speed) : h.speed;
    h.at_end = speed - now;
    h.work += h.mass * h.at_end * h.mean_speed;
    set_along<D>(v, v_out, h, now, speed);
  }
};

/// The accelerations of the loads at the start or at the end of a step: a pressure p on a face acts along n da = cof F
/// N dA (Nanson).
template <int D>
PIOLA_FN void turn_load(LoadedParticle& p, bool at_end, Mat<3> const& cofactor_F) {
  double *const a = p.acting[at_end], *const dead = p.dead[at_end], *const follower = p.follower[at_end];
  for (int c = 0; c < 9; ++c) p.turn[at_end][c] = cofactor_F.c[c];
  for (int c = 0; c < D; ++c) {
    a[c] = dead[c];
    for (int d = 0; d < D; ++d) a[c] += cofactor_F(c, d) * follower[d];
  }
}

/// Adds the accelerations of the loads at the start or at the end of a step to the rate.
template <int D>
struct AddLoads {
  bool at_end;
  LoadedParticle const* loaded;
  View rate;
  WriteView rate_out;

  PIOLA_FN void operator()(Index k) const {
    LoadedParticle const& p = loaded[k];
    for (int c = 0; c < D; ++c) rate_out.scalar(p.slot, rate.scalar<double>(p.slot, c) + p.acting[at_end][c], c);
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
      p.work += (p.acting[0][c] + p.acting[1][c]) * (u.scalar<double>(p.slot, c) + w.scalar<double>(p.slot, c));
    p.work *= 0.25 * dt * p.mass;
  }
};

}  // namespace piola::inline PIOLA_BACKEND
