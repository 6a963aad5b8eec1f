// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/passes.hpp"
#include "piola/math/embedding.hpp"

/// Passes over the particles that supports hold and that loads act on, with velocity Verlet. Theory:
/// docs/theory/boundaries.md.
namespace piola::nodal::inline PIOLA_MACHINE {

/// The component of a vector field along a held direction.
template <int D>
PIOLA_FN double along(View const& field, HeldDirection const& h) {
  double sum = 0;
  for (int c = 0; c < D; ++c) sum += field.scalar<double>(h.slot, c) * h.direction[c];
  return sum;
}

/// Sets it. Along an axis to the very value.
template <int D>
PIOLA_FN void set_along(View const& from, WriteView const& to, HeldDirection const& h, double wanted) {
  double const change = wanted - along<D>(from, h);
  for (int c = 0; c < D; ++c) {
    bool const axis = h.direction[c] == 1;
    if (h.direction[c] != 0)
      to.scalar(h.slot, axis ? wanted : from.scalar<double>(h.slot, c) + change * h.direction[c], c);
  }
}

/// Before the first kick: the acceleration that takes the particle to the mean of the speeds at the ends of the step.
template <int D>
struct DriveDirections {
  double dt;
  HeldDirection* held;
  View v, a;
  WriteView a_out;

  PIOLA_FN void operator()(Index n) const {
    HeldDirection& h = held[n];
    double const mean = 0.5 * (h.before + h.after), wanted = 2 * (mean - along<D>(v, h)) / dt;
    h.impulse = h.mass * 0.5 * dt * (wanted - along<D>(a, h));
    h.first_impulse = h.impulse;
    h.work = h.impulse * mean;
    set_along<D>(a, a_out, h, wanted);
  }
};

/// After the second kick: the speed at the end. The reactions of both kicks do the work (r^n + r^(n+1)) / 2 times the
/// displacement.
template <int D>
struct ArriveAlongDirections {
  HeldDirection* held;
  View v;
  WriteView v_out;

  PIOLA_FN void operator()(Index n) const {
    HeldDirection& h = held[n];
    double const impulse = h.mass * (h.after - along<D>(v, h));
    h.impulse += impulse;
    h.work += impulse * 0.5 * (h.before + h.after);
    set_along<D>(v, v_out, h, h.after);
  }
};

/// The accelerations by pressures that follow the face, at the start or at the end of a step: along n da = cof F N dA
/// (Nanson), with F where the particle is. The shares of a face are exact for quadratic fields at particles, and so for
/// the area vectors of a quadratic deformation.
template <int D>
struct TurnLoads {
  static constexpr int values = Quadratic<D>::values, terms = Quadratic<D>::terms, second = Quadratic<D>::second,
                       width = Records<D>::width;
  bool at_end;
  LoadedParticle* loaded;
  ListSums<D> list;
  ReferenceView g, k;

  PIOLA_FN void operator()(Index n) const {
    LoadedParticle& p = loaded[n];
    double *const a = at_end ? p.after : p.before, *const follow = at_end ? p.follow_after : p.follow_before;
    double rows[D * width];
    list.of_motion(p.slot, rows);
    Mat<D> F;
    for (int c = 0; c < D; ++c) {
      double const* const T = rows + c * width;
      double H[second]{};
      for (int m = 1; m < values; ++m)
        for (int s = 0; s < second; ++s) H[s] += T[m] * k.template scalar<double>(p.slot, (m - 1) * second + s);
      for (int J = 0; J < D; ++J) {
        F(c, J) = T[values + J];
        for (int m = 0; m < values; ++m) F(c, J) += T[m] * g.template scalar<double>(p.slot, m * D + J);
        for (int K = 0; K < D; ++K) F(c, J) -= H[Quadratic<D>::at(J, K)] * p.centroid[K];
      }
    }
    Mat<3> const turned = cofactor(embed<D>(F));
    for (int c = 0; c < 9; ++c) p.turn[at_end][c] = turned.c[c];
    for (int c = 0; c < D; ++c)
      for (int d = 0; d < D; ++d) a[c] += turned(c, d) * follow[d];
  }
};

/// Adds the accelerations of the loads at the end of a step, and their work (b^n + b^(n+1)) / 2 times the displacement
/// dt v^(n+1/2).
template <int D>
struct AddLoads {
  double dt;
  LoadedParticle* loaded;
  View v, a;
  WriteView a_out;

  PIOLA_FN void operator()(Index n) const {
    LoadedParticle& p = loaded[n];
    p.work = 0;
    for (int c = 0; c < D; ++c) {
      p.work += 0.5 * dt * p.mass * (p.before[c] + p.after[c]) * v.scalar<double>(p.slot, c);
      a_out.scalar(p.slot, a.scalar<double>(p.slot, c) + p.after[c], c);
    }
  }
};

}  // namespace piola::nodal::inline PIOLA_MACHINE
