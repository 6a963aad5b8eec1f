// SPDX-License-Identifier: Apache-2.0
// What others do to a body between its steps.
#include "piola/formulations/taylor_sph/body.hpp"

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

}  // namespace piola::taylor_sph
