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
void TaylorBody::push(Index i, std::array<double, 3> const& change) {
  std::array<double, 3> const x = place(i);
  double const m = mass_[at(i)];
  for (int c = 0; c < D(); ++c) record(i)[D() + 1 + c] += change[static_cast<std::size_t>(c)];
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t const a = (c + 1) % 3, b = (c + 2) % 3;
    momentum_[c] += m * change[c];
    momentum_[3 + c] += m * (x[a] * change[b] - x[b] * change[a]);
  }
}

/// By the loops of step.hpp.
std::optional<Talk> TaylorBody::talk() const {
  if (!options_.adjoint) return std::nullopt;
  int const flat = D() == 2 ? 1 : 0, at_rest = state_.k.moving ? 0 : D(), patterns = state_.memory.patterns;
  int const stride = record_stride(D()), corners = cells_.corners;
  Talk talk;
  talk.order = [](ParticleSet const& set, Body const& body, int) { return pencil_order(set, body); };
  double const real = static_cast<double>(particles()), cells = static_cast<double>(cells_.count());
  talk.to_all = real * (2 * stride + 2 * D() + flat + at_rest) +
                cells * (D() * corners + stride + 1 + D() * D() + D() * patterns + (state_.k.moving ? stride : 0));
  // Inside and surface are told one after the other, component by component; momentum, work, energy, failures; cells.
  talk.collectives = 2 * (2 + 2 * D() + flat + at_rest) + (free_ ? 2 : 4) + 5 + 1 + 4 + (patterns > 0 ? 1 : 0) +
                     (state_.k.moving ? 2 : 0);
  return talk;
}

}  // namespace piola::taylor_sph
