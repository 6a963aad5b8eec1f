// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/boundary_conditions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/materials/laws.hpp"
#include <limits>
#include <map>
#include <set>

namespace piola::jst_sph {
namespace {

/// Whether a support does nothing but hold components at rest for the whole run.
bool is_plain(Support const& s) {
  return s.frame == Support::Frame::axes && !s.velocity && s.until == std::numeric_limits<double>::infinity();
}

int axis_of(Direction const& d) { return d[0] == 1 ? 0 : d[1] == 1 ? 1 : 2; }

std::vector<Support> connected(std::vector<Support> supports, std::vector<Support> const& mirrors) {
  supports.insert(supports.end(), mirrors.begin(), mirrors.end());
  return supports;
}

}  // namespace

Boundary::Boundary(Assembly const& assembly, std::size_t body, SlotOrder const& order,
                   std::vector<Support> const& mirrors, std::optional<Cloud> cloud)
    : body_(assembly.particles.bodies[body]),
      D_(assembly.particles.dimension),
      cloud_(std::move(cloud)),
      driven_(D_, connected(assembly.supports, mirrors), assembly.loads, cloud_.has_value()) {
  PIOLA_EXPECTS(body < assembly.particles.bodies.size());
  with_law(assembly.materials[body], [&](auto const& law) { rho0_ = law.rho0; });
  std::vector<Index> slot_of(static_cast<std::size_t>(body_.last - body_.first));
  for (Index i = 0; i < order.particles; ++i)
    slot_of[static_cast<std::size_t>(order.id[static_cast<std::size_t>(i)] - body_.first)] = i;
  take_supports(assembly, connected(assembly.supports, mirrors), slot_of);
  take_loads(assembly, slot_of);
  plain_of_all_ = plain_.size();
  for (std::size_t k = 0; k < plain_of_all_; ++k) plain_owner_[k].number = k;
}

void Boundary::distribute(Range own) {
  own_ = own;
  driven_.keep(own);
  std::vector<SupportComponent> mine;
  std::vector<SingleOwner> owners;
  for (std::size_t k = 0; k < plain_.size(); ++k) {
    if (!is_local(own, plain_[k].slot)) continue;
    mine.push_back(plain_[k]);
    owners.push_back(plain_owner_[k]);
  }
  plain_ = std::move(mine);
  plain_owner_ = std::move(owners);
}

double Boundary::mass_of(Assembly const& assembly, std::int64_t id) const {
  return rho0_ * assembly.particles.volume[static_cast<std::size_t>(id)];
}

/// One component of a particle is held once; the support named last answers for it, mirrors only if no other does.
void Boundary::add_plain(SupportComponent const& component, SingleOwner const& owner, std::size_t& place,
                         bool is_mirror) {
  if (place == 0) {
    plain_.push_back(component);
    plain_owner_.push_back(owner);
    place = plain_.size();
  } else if (!is_mirror) {
    plain_owner_[place - 1] = owner;
  }
}

void Boundary::take_supports(Assembly const& assembly, std::vector<Support> const& supports,
                             std::vector<Index> const& slot_of) {
  auto const slot_at = [&](std::int64_t id) { return slot_of[static_cast<std::size_t>(id - body_.first)]; };
  std::set<std::int64_t> moved;                        // particles with supports that are more than plain
  std::map<std::pair<Index, int>, std::size_t> plain;  // places of components in plain_, from 1 on
  for (auto const& support : supports)
    for (auto const id : support.particles)
      if (has(id) && (cloud_ || !is_plain(support))) moved.insert(id);
  driven_.add_supports(
      supports, [&](std::int64_t id) { return moved.contains(id); },
      [&](std::int64_t id) {
        auto const at = static_cast<std::size_t>(id);
        auto position = assembly.particles.X[at];
        for (std::size_t c = 0; c < 3 && !assembly.initial_displacement.empty(); ++c)
          position[c] += assembly.initial_displacement[at][c];
        return BodyBoundary::PrescribedParticle{slot_at(id), assembly.particles.X[at], mass_of(assembly, id), position};
      });
  for (std::size_t s = 0; s < supports.size(); ++s) {
    auto const directions = directions_of(supports[s], D_);
    for (auto const id : supports[s].particles)
      for (auto const& d : directions)
        if (has(id) && !moved.contains(id))
          add_plain({slot_at(id), axis_of(d), 0, 0, 0, 0}, {s, mass_of(assembly, id)}, plain[{slot_at(id), axis_of(d)}],
                    s >= assembly.supports.size());
  }
}

void Boundary::take_loads(Assembly const& assembly, std::vector<Index> const& slot_of) {
  for (std::size_t l = 0; l < assembly.loads.size(); ++l) {
    Load const& load = assembly.loads[l];
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      auto const id = load.particles[k];
      if (!has(id)) continue;
      driven_.add_load(l, {slot_of[static_cast<std::size_t>(id - body_.first)], mass_of(assembly, id), load.factor[k],
                           assembly.particles.X[static_cast<std::size_t>(id)],
                           load.pressure ? std::optional(load.normal_of(k)) : std::nullopt});
    }
  }
}

void Boundary::attach(BodyState& state) {
  for (auto& s : plain_) {
    s.position = value_at(state.x, s.slot, s.component);
    value_at(state.v, s.slot, s.component) = 0;
  }
  state.boundary.supports = plain_.data();
  state.boundary.support_count = static_cast<Index>(plain_.size());
  begin_step(state, 0, 0);
  driven_.start(state.v);
  if (multipliers_) multipliers_->enforce(state, {MultiplierCall::When::start, 0});
}

void Boundary::begin_step(BodyState& state, double time, double dt) {
  PIOLA_EXPECTS(dt >= 0);
  bool const changed = driven_.begin_step(state.x, time, dt);
  if (cloud_ && changed) multipliers_.emplace(driven_.held(), *cloud_);
  if (multipliers_) multipliers_->reset_impulses();
  state.boundary.held = driven_.held().data();
  state.boundary.held_count = static_cast<Index>(driven_.held().size());
  state.boundary.multipliers = multipliers_ ? &*multipliers_ : nullptr;
  state.boundary.enforce = [](Multipliers& multipliers, BodyState& body, MultiplierCall const& call) {
    multipliers.enforce(body, call);
  };
  state.boundary.loaded = driven_.loaded().data();
  state.boundary.loaded_count = static_cast<Index>(driven_.loaded().size());
  plain_start_.clear();
  for (auto const& s : plain_) plain_start_.push_back(point_at(state.x, s.slot, D_));
}

void Boundary::end_step(BodyState& state) {
  for (std::size_t k = 0; k < plain_.size(); ++k) {
    SupportComponent const& s = plain_[k];
    std::array<double, 3> before{}, after{};
    before[static_cast<std::size_t>(s.component)] = plain_owner_[k].mass * s.at_start;
    after[static_cast<std::size_t>(s.component)] = plain_owner_[k].mass * s.at_end;
    driven_.add_impulse(plain_owner_[k].support, plain_start_[k], before);
    driven_.add_impulse(plain_owner_[k].support, point_at(state.x, s.slot, D_), after);
  }
  driven_.end_step(state.x, *state.external_work);
  if (state.constants.integrator != Integrator::verlet) return;
  driven_.remove_ended(state.rate);
  for (SupportComponent& s : plain_) {
    double& rate = value_at(state.rate, s.slot, s.component);
    s.removed -= rate;
    rate = 0;
  }
}

void Boundary::add_resultants_to(Resultants& actions) const {
  driven_.add_resultants_to(actions);
  for (std::size_t k = 0; multipliers_ && k < multipliers_->impulses().size() && k < actions.supports.size(); ++k)
    actions.supports[k].add(multipliers_->impulses()[k]);
}

std::vector<double> Boundary::state() const {
  std::vector<double> removed(plain_of_all_);
  for (std::size_t k = 0; k < plain_.size(); ++k) removed[plain_owner_[k].number] = plain_[k].removed;
  if (own_) comm::allreduce_or(removed);
  return removed;
}

void Boundary::restore(std::vector<double> const& state) {
  for (std::size_t k = 0; k < plain_.size(); ++k) plain_[k].removed = state[plain_owner_[k].number];
}

}  // namespace piola::jst_sph
