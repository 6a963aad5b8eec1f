// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/cell_failure.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/nodal/failing_cells.hpp"
#include "piola/formulations/nodal/field_set_up.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

/// Contact takes the motion of a surface point from the particles within this distance, in spacings.
constexpr double host_reach = 1.6;
/// Least volume ratio that an Eulerian cell starts with.
constexpr double least_converted = 0.1;
/// Particles within this distance from one of a broken cell may be in contact with those of other pieces, in spacings.
constexpr double beside_crack = 1.5;

}  // namespace

CellFailure::CellFailure(NodalBody& body, Backend const& backend)
    : body_(body), backend_(backend), fragments_(body), eulerian_(body) {
  if (!body_.reference().refits) return;
  near_crack_.resize(static_cast<std::size_t>(body_.slots()));
  lost_.resize(near_crack_.size());
  body_.on_crushed([this](std::vector<Index> const& slots) { crush(slots); });
}

double& CellFailure::value(Index slot, int of) const {
  return value_at(body_.state().history, slot, Fields::failure_value(of, body_.state().dimension));
}

/// Whether the stress of a cell follows from its gradients.
bool CellFailure::needs_gradients(Index slot) const { return !body_.is_eulerian(slot); }

/// The condition that a cell gets if its gradients do not serve any more.
CellCondition CellFailure::next_condition(Index slot) const {
  return body_.is_broken(slot) ? CellCondition::detached : CellCondition::broken;
}

/// The changes that all ranks have found, in ascending order, the last condition of each slot.
CellFailure::Changes CellFailure::over_ranks(Changes found) const {
  if (body_.shared()) {
    std::vector<Index> mine;
    for (Refits::Change const& change : found)
      mine.insert(mine.end(), {change.slot, static_cast<Index>(change.condition)});
    found.clear();
    auto const all = comm::alltoall(std::vector<std::vector<Index>>(static_cast<std::size_t>(comm::size()), mine));
    for (std::vector<Index> const& of_rank : all)
      for (std::size_t k = 0; k < of_rank.size(); k += 2)
        found.push_back({of_rank[k], static_cast<CellCondition>(of_rank[k + 1])});
  }
  std::sort(found.begin(), found.end(), [](auto const& a, auto const& b) {
    return a.slot != b.slot ? a.slot < b.slot : a.condition > b.condition;
  });
  auto const last =
      std::unique(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.slot == b.slot; });
  found.erase(last, found.end());
  return found;
}

/// Stores the condition of a local cell. A detached or Eulerian cell is at rest in its reference shape.
void CellFailure::put(Refits::Change const& change) const {
  auto const& s = body_.state();
  int const D = s.dimension;
  if (change.slot < body_.own().first || change.slot >= body_.own().last) return;
  bool const was_broken = body_.is_broken(change.slot);
  value(change.slot, FailureLayout::condition) = value_of(change.condition);
  if (change.condition == CellCondition::opening) return;
  if (s.has.converts) {
    if (!was_broken) make_eulerian(s, change.slot, std::max(volume_ratio_at(s, change.slot), least_converted));
    return;
  }
  if (change.condition != CellCondition::detached) return;
  value(change.slot, FailureLayout::volume_factor) = 1;
  value(change.slot, FailureLayout::refitted) = 0;
  value_at(s.history, change.slot, HistoryLayout::pressure) = 0;
  value_at(s.history, change.slot, HistoryLayout::shock_pressure) = 0;
  put_reference_shape(s.history, change.slot, D);
}

/// Copies the sums of gradients of a local cell, which the set-up data have, to the fields.
void CellFailure::put_gradients(Index slot) const {
  auto const& s = body_.state();
  auto const& r = body_.reference();
  int const D = s.dimension, second = Fields::second(D);
  copy_at(r.own, s.own, D + second, slot);
  copy_at(r.k, s.k, Fields::terms(D) * second, slot);
  if (s.has.axisymmetric) copy_at(r.hoop, s.hoop, static_cast<int>(HoopSums::size), slot);
}

/// Marks the particles around a detached one.
void CellFailure::lose_surfaces(Index detached) {
  for (Index const slot : body_.reference().refits->near(detached, host_reach)) {
    char& lost = lost_[static_cast<std::size_t>(slot)];
    lost_count_ += lost != 0 ? 0 : 1;
    lost = 1;
  }
}

CellFailure::Changes CellFailure::set(Changes const& changes) {
  for (Refits::Change const& change : changes) {
    bool const breaks = change.condition != CellCondition::opening;
    if (breaks && body_.state().has.converts && body_.reference().refits->is_intact(change.slot))
      eulerian_.add(change.slot);
    put(change);
    if (!breaks) continue;
    if (change.condition == CellCondition::detached) lose_surfaces(change.slot);
    for (Index const slot : body_.reference().refits->near(change.slot, beside_crack)) fragments_.add(slot);
  }
  Refits::Found const found = body_.reference().refits->set(changes);
  for (Index const slot : found.changed) {
    put_gradients(slot);
    near_crack_[static_cast<std::size_t>(slot)] = 1;
    value(slot, FailureLayout::refitted) = 1;
  }
  Changes more;
  for (Index const slot : found.unsolvable)
    if (needs_gradients(slot)) more.push_back({slot, next_condition(slot)});
  changed_.insert(changed_.end(), found.changed.begin(), found.changed.end());
  return more;
}

/// Takes over the gradients that have changed, and computes the accelerations with them.
void CellFailure::take_over() {
  FailureSlot failure;
  BodyState state = body_.state();
  state.failure = &failure;
  state.refits = true;
  backend_.step(state, 0);
}

bool CellFailure::propagate(Changes changes) {
  bool any = false;
  changed_.clear();
  for (changes = over_ranks(std::move(changes)); !changes.empty(); changes = over_ranks(std::move(changes))) {
    any = true;
    Changes more = set(changes);
    take_over();
    for (Index const slot : changed_)
      if (needs_gradients(slot) && value(slot, FailureLayout::refitted) > 0)
        more.push_back({slot, next_condition(slot)});
    changes = std::move(more);
  }
  return any;
}

void CellFailure::begin_step(double dt) const {
  fragments_.kick(0.5 * dt);
  eulerian_.kick(0.5 * dt);
}

bool CellFailure::end_step(double dt, bool failed) {
  if (!failed) eulerian_.advance(dt);
  eulerian_.kick(0.5 * dt);
  bool const changed = !failed && body_.reference().refits && propagate(find_failing(body_, near_crack_));
  if (changed || crushed_) eulerian_.join();
  crushed_ = false;
  find_contact();
  fragments_.kick(0.5 * dt);
  return changed;
}

void CellFailure::find_contact() {
  fragments_.evaluate();
  body_.set_fragment_energy(fragments_.energy());
}

void CellFailure::crush(std::vector<Index> const& slots) {
  Changes changes;
  for (Index const slot : slots) changes.push_back({slot, next_condition(slot)});
  crushed_ = propagate(std::move(changes)) || crushed_;
}

void CellFailure::save(StateWriter& writer, std::string const& name) const {
  if (!body_.reference().refits) return;
  writer.put_sized(name + "_size", name, fragments_.state());
  writer.put_sized(name + "_motion_size", name + "_motion", eulerian_.state());
}

void CellFailure::load(StateReader& reader, std::string const& name) {
  if (!body_.reference().refits) return;
  Changes changes;
  for (Index i = body_.own().first; i < body_.own().last; ++i)
    if (body_.condition(i) != CellCondition::intact) changes.push_back({i, body_.condition(i)});
  changes = over_ranks(std::move(changes));
  if (!changes.empty()) set(changes);
  for (Index i = body_.own().first; i < body_.own().last; ++i) value(i, FailureLayout::refitted) = 0;
  fragments_.load(reader.get_sized(name + "_size", name));
  find_contact();
  eulerian_.load(reader.get_sized(name + "_motion_size", name + "_motion"));
}

}  // namespace piola::nodal
