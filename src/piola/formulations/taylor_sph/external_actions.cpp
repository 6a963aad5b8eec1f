// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/external_actions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/mechanics/distribute_reactions.hpp"
#include "piola/mechanics/rigid_rate.hpp"
#include <algorithm>

namespace piola::taylor_sph {

ExternalActions::ExternalActions(Assembly const& assembly, Particles const& particles, Boundary& boundary,
                                 Backend const& backend, BodyState& state)
    : particles_(particles),
      boundary_(boundary),
      backend_(backend),
      state_(state),
      of_support_(assembly.supports.size()),
      of_load_(assembly.loads.size()) {}

void ExternalActions::set_initial_momentum() {
  Impulse const now = momentum();
  std::copy(now.linear.begin(), now.linear.end(), totals.momentum.begin());
  std::copy(now.angular.begin(), now.angular.end(), totals.momentum.begin() + 3);
}

Impulse ExternalActions::momentum() const {
  double now[MotionSums::size];
  backend_.motion(state_, now);
  Impulse r;
  for (int c = 0; c < 3; ++c) {
    r.linear[static_cast<std::size_t>(c)] = now[MotionSums::v + c];
    r.angular[static_cast<std::size_t>(c)] = now[MotionSums::moment + c];
  }
  return r;
}

/// Impulses of tractions and accelerations, and their moments, with the places of half time.
void ExternalActions::add_loads(double time, double dt, std::vector<HalfImpulse> const* tractions) {
  PIOLA_EXPECTS(dt >= 0);
  std::vector<ImpulseSum> of_load(of_load_.size());
  each_impulse(time, dt, tractions,
               [&](std::size_t load, std::array<double, 3> const& x, std::array<double, 3> const& impulse) {
                 of_load[load].add(x, impulse);
               });
  for (std::size_t load = 0; load < of_load.size(); ++load) {
    of_load_[load] = of_load[load].value();
    for (std::size_t c = 0; c < 3; ++c) {
      totals.momentum[c] += of_load_[load].linear[c];
      totals.momentum[3 + c] += of_load_[load].angular[c];
    }
  }
}

/// Calls add(load, place, impulse) for each loaded particle.
template <class F>
void ExternalActions::each_impulse(double time, double dt, std::vector<HalfImpulse> const* tractions, F const& add) {
  double const back = state_.k.moving ? -0.5 * dt : 0;
  boundary_.each_acceleration(time + 0.5 * dt, [&](std::size_t load, Index i, std::array<double, 3> a) {
    for (double& c : a) c *= dt * particles_.mass(i);
    add(load, particles_.drifted(i, back), a);
  });
  if (tractions != nullptr) {
    for (HalfImpulse const& half : *tractions) add(half.load, particles_.drifted(half.particle, back), half.impulse);
    return;
  }
  if (!boundary_.has_tractions()) return;
  move_surface(back);
  for (double const t : {time, time + dt})
    boundary_.each_traction(t, [&](std::size_t load, Index i, std::array<double, 3> f) {
      for (double& c : f) c *= 0.5 * dt;
      add(load, particles_.drifted(i, back), f);
    });
  move_surface(0);
}

/// Normals and areas of the surface as it is when it has drifted for a time.
void ExternalActions::move_surface(double ahead) {
  boundary_.move_surface([&](Index i) { return particles_.drifted(i, ahead); });
  boundary_.update_normals();
}

/// Interpolation between two sets of particles does not conserve momentum. The rigid motion that restores it is found
/// as for the projections of JST-SPH: momentum and moment of momentum at the end of the step are those of the start
/// plus the impulse of the loads.
void ExternalActions::conserve_momentum() {
  double now[MotionSums::size];
  backend_.motion(state_, now);
  RateSums sums;
  sums.volume = now[MotionSums::mass];
  for (int c = 0; c < 3; ++c) {
    auto const k = static_cast<std::size_t>(c);
    sums.x[c] = now[MotionSums::x + c];
    sums.f[c] = now[MotionSums::v + c] - totals.momentum[k];
    sums.moment[c] = now[MotionSums::moment + c] - totals.momentum[3 + k];
  }
  std::copy_n(now + MotionSums::xx, 6, sums.xx);
  RigidRate const g = balancing_rate(sums, particles_.dimension());
  double const rate[9] = {g.spin[0], g.spin[1],   g.spin[2],   g.push[0],  g.push[1],
                          g.push[2], g.centre[0], g.centre[1], g.centre[2]};
  backend_.add_rigid(state_, rate);
}

/// The scheme prescribes velocities and evaluates stress, so that no force of a support enters it. Supports receive the
/// part of the momentum change that loads do not explain. It is divided among several supports by the traction of the
/// stress on their surface; the rest is distributed as by a rigid motion of the held particles.
void ExternalActions::find_reactions(Impulse const& before, double dt) {
  of_support_.assign(of_support_.size(), {});
  if (!boundary_.has_supports()) return;
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
    BoundaryItem const& item = boundary_.item(k);
    if (item.held == 0) continue;
    std::array<double, 3> const x = particles_.x(particle), f = boundary_.force_on_sides(particle);
    for (int h = 0; h < item.held; ++h) {
      Direction const d{item.direction[h][0], item.direction[h][1], item.direction[h][2]};
      rows.push_back({static_cast<std::size_t>(item.support[h]), x, d, particles_.mass(particle)});
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

void ExternalActions::add_boundary_work(double dt) {
  double const before = totals.power;
  update_power();
  totals.work += 0.5 * dt * (before + totals.power);
}

void ExternalActions::add_momentum(Index particle, std::array<double, 3> const& change) {
  std::array<double, 3> const x = particles_.place(particle);
  double const m = particles_.mass(particle);
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t const a = (c + 1) % 3, b = (c + 2) % 3;
    totals.momentum[c] += m * change[c];
    totals.momentum[3 + c] += m * (x[a] * change[b] - x[b] * change[a]);
  }
}

void ExternalActions::add_to(Resultants& actions) const {
  for (std::size_t k = 0; k < actions.supports.size(); ++k) actions.supports[k].add(of_support_[k]);
  for (std::size_t k = 0; k < actions.loads.size(); ++k) actions.loads[k].add(of_load_[k]);
}

}  // namespace piola::taylor_sph
