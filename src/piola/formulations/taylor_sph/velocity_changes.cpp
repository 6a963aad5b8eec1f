// SPDX-License-Identifier: Apache-2.0
// What others do to a body between its steps.
#include "piola/formulations/taylor_sph/body.hpp"
#include <algorithm>

namespace piola::taylor_sph {

std::array<double, 3> TaylorBody::place(Index i) const {
  std::array<double, 3> x = displacement(i);
  for (std::size_t c = 0; c < 3; ++c) x[c] += X_[at(i)][c];
  return x;
}

/// A free body must have the momentum that it is given.
void TaylorBody::add_velocities(Index i, std::array<double, 3> const& change) {
  std::array<double, 3> const x = place(i);
  double const m = mass_[at(i)];
  for (int c = 0; c < D(); ++c) record(i)[D() + 1 + c] += change[static_cast<std::size_t>(c)];
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t const a = (c + 1) % 3, b = (c + 2) % 3;
    momentum_[c] += m * change[c];
    momentum_[3 + c] += m * (x[a] * change[b] - x[b] * change[a]);
  }
}

/// Follows the loops of step.hpp: each replicated array, and the messages that carry these and the sums.
CommPattern TaylorBody::comm_pattern() const {
  bool const moving = state_.k.moving;
  int const flat = D() == 2 ? 1 : 0, at_rest = moving ? 0 : D(), stride = record_stride(D());
  double const real = static_cast<double>(particles()), cells = static_cast<double>(cells_.count());
  int const of_particle = stride + D() + flat + at_rest;
  // Positions of cells; sums of motion at the start and, if the body has supports, at the end.
  int const everywhere = (moving ? 1 : 0) + (free_ ? 1 : 2);
  CommPattern talk;
  talk.order = [](ParticleSet const& set, Body const& body, int) { return pencil_order(set, body); };
  talk.replicated_values = moving ? cells * stride : 0;
  if (options_.adjoint) {
    int const of_cell = D() * cells_.corners + stride + 1 + D() * D() + D() * state_.memory.patterns;
    talk.replicated_values += real * (stride + of_particle) + cells * of_cell;
    talk.collectives = everywhere + 4;  // forces, velocities, cells, stresses
    return talk;
  }
  talk.replicated_values += real * of_particle + cells * stride;
  talk.collectives = everywhere + 2 + (free_ && moving && options_.conserve ? 1 : 0);
  if (options_.hourglass > 0 && boxes_.count() > 0 && D() > 1) {
    int const patterns = D() == 2 ? 1 : 4, fields = D() + D() * (D() + 1) / 2;
    talk.replicated_values += real * stride + static_cast<double>(boxes_.count()) * patterns * fields;
    talk.collectives += 2;
  }
  return talk;
}

}  // namespace piola::taylor_sph
