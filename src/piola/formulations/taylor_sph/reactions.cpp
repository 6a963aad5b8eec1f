// SPDX-License-Identifier: Apache-2.0
// What supports and loads do to a body: their impulses in the last step.
#include "piola/formulations/taylor_sph/body.hpp"
#include "piola/mechanics/distribute_reactions.hpp"

namespace piola::taylor_sph {
/// Momentum and moment of momentum of the body.
Impulse TaylorBody::momentum() {
  double now[MotionSums::size];
  backend_->motion(state_, now);
  Impulse r;
  for (int c = 0; c < 3; ++c) {
    r.linear[static_cast<std::size_t>(c)] = now[MotionSums::v + c];
    r.angular[static_cast<std::size_t>(c)] = now[MotionSums::moment + c];
  }
  return r;
}

/// The scheme prescribes velocities and evaluates stress, so that no force of a support enters it. Supports receive the
/// part of the momentum change that loads do not explain. It is divided among several supports by the traction of the
/// stress on their surface; the rest is distributed as by a rigid motion of the held particles.
void TaylorBody::find_reactions(Impulse const& before, double dt) {
  of_support_.assign(of_support_.size(), {});
  if (free_) return;
  Impulse rest = momentum();
  auto const take_out = [&](Impulse const& i) {
    for (std::size_t c = 0; c < 3; ++c) {
      rest.linear[c] -= i.linear[c];
      rest.angular[c] -= i.angular[c];
    }
  };
  take_out(before);
  for (Impulse const& load : of_load_) take_out(load);
  std::vector<SupportRow> rows;
  std::vector<ImpulseSum> of_support(of_support_.size());
  for (std::size_t k = 0; k < boundary_.particles().size(); ++k) {
    Index const particle = boundary_.particles()[k];
    BoundaryItem const& item = state_.items[k];
    if (item.held == 0) continue;
    std::array<double, 3> const x = this->x(particle), f = boundary_.force_on_sides(particle, record_stress(particle));
    for (int h = 0; h < item.held; ++h) {
      Direction const d{item.direction[h][0], item.direction[h][1], item.direction[h][2]};
      rows.push_back({static_cast<std::size_t>(item.support[h]), x, d, mass_[at(particle)]});
      Direction impulse = d;
      for (double& c : impulse) c *= dt * dot(f, d);
      of_support[rows.back().support].add(x, impulse);
    }
  }
  if (rows.empty()) return;
  for (std::size_t s = 0; s < of_support.size(); ++s) of_support_[s] = of_support[s].value();
  for (Impulse const& support : of_support_) take_out(support);
  share_out(rows, rest, of_support_);
}

void TaylorBody::add_actions(Resultants& actions) const {
  for (std::size_t k = 0; k < actions.supports.size(); ++k) actions.supports[k].add(of_support_[k]);
  for (std::size_t k = 0; k < actions.loads.size(); ++k) actions.loads[k].add(of_load_[k]);
}

}  // namespace piola::taylor_sph
