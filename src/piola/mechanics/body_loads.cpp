// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/body_loads.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <utility>

namespace piola {
namespace {

constexpr Index no_place = -1;

}  // namespace

BodyLoads::BodyLoads(int dimension, std::vector<Load> const& loads) : D_(dimension), impulses_(loads.size()) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  for (Load const& load : loads) {
    loads_.push_back({load});
    LoadOnBody& on = loads_.back();
    on.particles.clear();
    on.factor.clear();
    on.normals.clear();
    on.steady = is_steady(load.value);
    steady_ = steady_ && on.steady;
    named_ = named_ || !load.name.empty();
  }
}

void BodyLoads::add(std::size_t load, LoadedPlace const& place) {
  PIOLA_EXPECTS(load < loads_.size() && place.slot >= 0);
  auto const slot = static_cast<std::size_t>(place.slot);
  if (slot >= place_of_slot_.size()) place_of_slot_.resize(slot + 1, no_place);
  if (place_of_slot_[slot] == no_place) {
    place_of_slot_[slot] = static_cast<Index>(loaded_.size());
    loaded_.push_back({place.slot, place.mass});
  }
  LoadItem item{static_cast<std::size_t>(place_of_slot_[slot]), place.factor, place.X, place.normal, {}};
  if (loads_[load].steady) item.steady = acceleration_by(loads_[load].value, place.normal, place.factor, place.X, 0);
  loads_[load].items.push_back(item);
}

void BodyLoads::keep(Range own) {
  std::vector<std::size_t> place;
  std::vector<LoadedParticle> kept;
  for (LoadedParticle const& p : loaded_) {
    place.push_back(kept.size());
    if (is_local(own, p.slot)) kept.push_back(p);
  }
  for (LoadOnBody& load : loads_) {
    std::erase_if(load.items, [&](LoadItem const& item) { return !is_local(own, loaded_[item.place].slot); });
    for (LoadItem& item : load.items) item.place = place[item.place];
  }
  loaded_ = std::move(kept);
  place_of_slot_ = {};
}

int BodyLoads::ended(double time) const {
  int count = 0;
  for (auto const& l : loads_) count += has_ended(l.until, time) ? 1 : 0;
  return count;
}

/// For the undeformed face.
Direction BodyLoads::acceleration(LoadOnBody const& load, LoadItem const& item, double time) {
  return load.steady ? item.steady : acceleration_by(load.value, item.normal, item.factor, item.X, time);
}

/// At an end of the step, turned with the face where the load follows it.
Direction BodyLoads::acting(LoadOnBody const& load, LoadItem const& item, bool at_end) const {
  Direction const a = acceleration(load, item, at_end ? ended_ : begun_);
  if (!load.follows) return a;
  double const* const turn = loaded_[item.place].turn[at_end];
  Direction turned{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c)
    for (std::size_t d = 0; d < static_cast<std::size_t>(D_); ++d) turned[c] += turn[3 * c + d] * a[d];
  return turned;
}

/// Adds the loads that act in the step, as they are at one of its ends.
void BodyLoads::add_loads(int side) {
  for (auto const& load : loads_) {
    if (has_ended(load.until, begun_)) continue;
    for (auto const& item : load.items) {
      Direction const a = acceleration(load, item, side == 0 ? begun_ : ended_);
      LoadedParticle& p = loaded_[item.place];
      double* const part = load.follows ? p.follower[side] : p.dead[side];
      for (std::size_t c = 0; c < 3; ++c) part[c] += a[c];
    }
  }
}

void BodyLoads::evaluate(bool continues) {
  for (auto& p : loaded_)
    for (auto* const part : {p.dead, p.follower})
      for (int c = 0; c < 3; ++c) {
        part[0][c] = continues ? part[1][c] : 0;
        part[1][c] = 0;
      }
  if (!continues) add_loads(0);
  add_loads(1);
  for (auto& p : loaded_) std::copy_n(&p.dead[0][0], 6, &p.acting[0][0]);  // unless a pass rotates follower loads
}

void BodyLoads::begin_step(FieldRef const& x, double time, double end_time, bool changed, bool continues) {
  begun_ = time;
  ended_ = end_time;
  if (changed || !steady_) evaluate(continues);
  if (!named_) return;
  loaded_start_.clear();
  for (auto const& p : loaded_) loaded_start_.push_back(point_at(x, p.slot, D_));
}

void BodyLoads::end_step(FieldRef const& x, std::optional<Range> const& own) {
  PIOLA_EXPECTS(!named_ || loaded_start_.size() == loaded_.size());
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    LoadOnBody const& load = loads_[l];
    if (load.name.empty() || has_ended(load.until, begun_)) continue;
    for (auto const& item : load.items) {
      LoadedParticle const& p = loaded_[item.place];
      if (!is_local(own, p.slot)) continue;
      Point first = acting(load, item, false), second = acting(load, item, true);
      for (std::size_t c = 0; c < 3; ++c) {
        double const half = static_cast<int>(c) < D_ ? 0.5 * (ended_ - begun_) * p.mass : 0;
        first[c] *= half;
        second[c] *= half;
      }
      impulses_[l].add(loaded_start_[item.place], first);
      impulses_[l].add(point_at(x, p.slot, D_), second);
    }
  }
}

void BodyLoads::remove_ended(FieldRef const& rate) const {
  for (auto const& load : loads_) {
    if (has_ended(load.until, begun_) || !has_ended(load.until, ended_)) continue;
    for (auto const& item : load.items) {
      Direction const a = acting(load, item, true);
      for (int c = 0; c < D_; ++c) value_at(rate, loaded_[item.place].slot, c) -= a[static_cast<std::size_t>(c)];
    }
  }
}

bool BodyLoads::follows() const {
  return std::any_of(loads_.begin(), loads_.end(), [](auto const& l) { return l.follows && !l.items.empty(); });
}

}  // namespace piola
