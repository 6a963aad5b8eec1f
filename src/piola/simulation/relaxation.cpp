// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/relaxation.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace piola {

Relaxation::Relaxation(RunSpec const& run) : rate_(run.damping), relax_(run.relax), limit_(run.rest) {}

void Relaxation::start(Formulation& formulation) const {
  if (relax_) formulation.damp(0);
}

bool Relaxation::after_step(Formulation& formulation, double dt) {
  if (rate_ > 0) formulation.damp(std::exp(-rate_ * dt));
  if (!relax_) return false;
  double const before = kinetic_;
  kinetic_ = formulation.kinetic_energy();
  if (from_rest_) {
    from_rest_ = false;
    double const residual = std::sqrt(2 * kinetic_) / dt;
    largest_ = std::max(largest_, residual);
    rest_.residual = largest_ > 0 ? residual / largest_ : 0;
    // Before the first stop the bodies may be about to be loaded.
    rest_.reached = rest_.stops > 0 && rest_.residual <= limit_;
    if (rest_.reached) stop(formulation);
  } else if (kinetic_ < before) {
    stop(formulation);
  }
  return rest_.reached;
}

void Relaxation::stop(Formulation& formulation) {
  formulation.damp(0);
  ++rest_.stops;
  from_rest_ = true;
  kinetic_ = 0;
}

void Relaxation::save(StateWriter& writer) const {
  writer.put("relaxation", std::array{rest_.reached ? 1.0 : 0.0, rest_.residual, static_cast<double>(rest_.stops),
                                      from_rest_ ? 1.0 : 0.0, kinetic_, largest_});
}

void Relaxation::load(NamedState& reader, Moment const&) {
  std::array<double, 6> v{};
  reader.get("relaxation", v);
  rest_ = {v[0] != 0, v[1], std::lround(v[2])};
  from_rest_ = v[3] != 0;
  kinetic_ = v[4];
  largest_ = v[5];
}

}  // namespace piola
