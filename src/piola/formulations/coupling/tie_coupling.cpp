// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/tie_coupling.hpp"
#include "piola/base/contracts.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <utility>

namespace piola {
namespace {

constexpr std::size_t numbers_of_impulse = 6;

std::array<double, 3> scaled(double factor, Vec<3> const& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }

/// Initial positions of particles [m], by index into SurfaceContactSystem::ids().
std::vector<Vec<3>> starts(Assembly const& whole, std::vector<std::int64_t> const& ids) {
  std::vector<Vec<3>> x;
  for (auto const id : ids) {
    auto const i = static_cast<std::size_t>(id);
    x.push_back({});
    for (std::size_t c = 0; c < 3; ++c)
      x.back()[static_cast<int>(c)] =
          whole.particles.X[i][c] + (whole.initial_displacement.empty() ? 0 : whole.initial_displacement[i][c]);
  }
  return x;
}

}  // namespace

TieCoupling::TieCoupling(Assembly const& whole, contact::SurfaceContactSystem& system)
    : ties_(whole.ties, whole.particles, whole.surfaces, system.hosts(), starts(whole, system.ids()), system.rigids()),
      impulses_(whole.ties.size()) {
  for (std::size_t row = 0; row < ties_.count(); ++row) exclude_pair(system, row, true);
}

void TieCoupling::exclude_pair(contact::SurfaceContactSystem& system, std::size_t row, bool out) const {
  auto const& hold = ties_.hold(row);
  system.exclude_pair(hold.body, hold.point, hold.other, out);
}

void TieCoupling::start(contact::SurfaceContactSystem& system, std::vector<Vec<3>> const& x,
                        std::vector<double> const& masses) {
  PIOLA_EXPECTS(x.size() == masses.size());
  if (!any()) return;
  std::vector<double> inverse;
  inverse.reserve(masses.size());
  for (double const m : masses) inverse.push_back(m > 0 ? 1 / m : 0);
  frequency2_ = ties_.frequency2(inverse);
  if (springs_.empty())  // not for rotated shapes, which differ by round-off
    for (std::size_t r = 0; r < system.rigids().size(); ++r)
      springs_.push_back(ties_.springs_of_shape(r, system.rigids()));
  if (!loaded_.empty()) ties_.restore(std::exchange(loaded_, {}));
  for (std::size_t row = 0; row < ties_.count(); ++row)
    if (ties_.has_failed(row)) exclude_pair(system, row, false);
  evaluate(system, x);
}

void TieCoupling::evaluate(contact::SurfaceContactSystem& system, std::vector<Vec<3>> const& x) {
  if (!any()) return;
  ties_.evaluate(system.hosts(), x, system.rigids());
  for (std::size_t r = 0; r < springs_.size(); ++r) system.tie_rigid(r, ties_.resultant_on_rigid(r), springs_[r]);
  for (std::size_t const row : ties_.released()) exclude_pair(system, row, false);
}

double TieCoupling::settled_frequency2() const {
  return frequency2_ + (springs_.empty() ? 0 : *std::max_element(springs_.begin(), springs_.end()));
}

void TieCoupling::transfer_energy(contact::SurfaceContactSystem const& system) {
  exec::ReproducibleSum stored;
  for (std::size_t const row : ties_.released())
    stored += system.stored_at(ties_.hold(row).body, ties_.hold(row).point, ties_.hold(row).other);
  handed_over_ += stored.value();
}

void TieCoupling::add_forces(std::vector<Vec<3>>& forces) const {
  for (Index const k : ties_.loaded_indices()) {
    auto const i = static_cast<std::size_t>(k);
    forces[i] = forces[i] + ties_.forces()[i];
  }
}

void TieCoupling::begin() { std::fill(impulses_.begin(), impulses_.end(), contact::Ties::Force{}); }

void TieCoupling::add_to_energy_balance(double half) {
  for (std::size_t tie = 0; tie < impulses_.size(); ++tie) {
    auto const& on = ties_.resultant_on_first(tie);
    impulses_[tie] = {impulses_[tie].force + half * on.force, impulses_[tie].moment + half * on.moment};
  }
}

void TieCoupling::report(Diagnostics& sum) const {
  if (!any()) return;
  auto const& now = ties_.totals();
  sum.more.emplace_back("tie_energy", now.energy);
  sum.more.emplace_back("tie_dissipation", now.heat - handed_over_);
  sum.more.emplace_back("tie_failed_fraction", now.failed);
}

void TieCoupling::add_actions(double scale, std::vector<Action>& all) const {
  for (std::size_t tie = 0; tie < impulses_.size(); ++tie)
    all.push_back({ties_.rules()[tie].name, scaled(scale, impulses_[tie].force), scaled(scale, impulses_[tie].moment)});
}

void TieCoupling::save(StateWriter& writer) const {
  if (!any()) return;
  std::vector<double> all = ties_.state();
  for (auto const& impulse : impulses_)
    for (Vec<3> const& a : {impulse.force, impulse.moment}) contact::put(all, a);
  all.push_back(handed_over_);
  writer.put("ties", all);
}

void TieCoupling::load(StateReader& reader) {
  if (!any()) return;
  std::vector<double> all(2 * ties_.count() + numbers_of_impulse * impulses_.size() + 1);
  reader.get("ties", all);
  contact::StateVector from(all);
  loaded_.clear();
  for (std::size_t k = 0; k < 2 * ties_.count(); ++k) loaded_.push_back(from.next());
  for (auto& impulse : impulses_) {
    from.take(impulse.force);
    from.take(impulse.moment);
  }
  handed_over_ = from.next();
}

}  // namespace piola
