// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/entry_faces.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace piola::contact {
namespace {

constexpr double way_in_a_step = 0.5;  // of a spacing, past thin shapes

}  // namespace

EntryFaces::Entry const* EntryFaces::find(Index point, std::size_t rigid) const {
  auto const found = std::lower_bound(entries_.begin(), entries_.end(), point, [&](Entry const& e, Index p) {
    return e.point != p ? e.point < p : e.rigid < rigid;
  });
  return found != entries_.end() && found->point == point && found->rigid == rigid ? &*found : nullptr;
}

Distance EntryFaces::distance(ContactModel const& model, Index point, std::size_t rigid) const {
  Entry const* const known = entries_.empty() ? nullptr : find(point, rigid);
  return distance_from(model.rigids[rigid], model.points.plane(point).y, known != nullptr ? known->sides : Sides{});
}

void EntryFaces::update(ContactModel& model, std::vector<Index> const& near_rigids, std::vector<Vec<3>> const& x,
                        Passages& passages) {
  std::vector<Entry> now;
  for (Index const k : near_rigids)
    for (std::size_t r = 0; model.definition.any_thin() && r < model.rigids.size(); ++r)
      if (model.definition.is_thin(model.points[k].body, r) && model.tests(k, r))
        update_point(model, k, r, x, now, passages);
  std::swap(entries_, now);
}

void EntryFaces::update_point(ContactModel& model, Index point, std::size_t r, std::vector<Vec<3>> const& x,
                              std::vector<Entry>& now, Passages& passages) const {
  std::size_t const body = model.points[point].body;
  RigidSurface const& rigid = model.rigids[r];
  Vec<3> const& y = model.points.plane(point).y;
  Entry const* known = find(point, r);
  Entry fresh{point, r, {}};
  if (known == nullptr) {
    // At the start the particle itself stands before the shape.
    bool const moved = model.dt > 0 && !model.points.last_x().empty();
    Vec<3> const before = moved ? model.points.last_position(point) : x[at(model.points.particle(point))];
    auto const sides =
        entered(rigid, y, moved ? model.last_poses[r] : pose_of(rigid), before, model.definition.thin_axes(body, r));
    if (!sides) return;
    fresh.sides = *sides;
    known = &fresh;
  }
  if (distance_from(rigid, y, known->sides).value < 0) {
    now.push_back(*known);
    return;
  }
  if (beyond(rigid, y, known->sides) > 0) passages.add(body, model.definition.object_of(r));
}

void EntryFaces::save(std::vector<double>& all) const {
  all.push_back(static_cast<double>(entries_.size()));
  for (Entry const& e : entries_) {
    all.insert(all.end(), {static_cast<double>(e.point), static_cast<double>(e.rigid)});
    all.insert(all.end(), e.sides.begin(), e.sides.end());
  }
}

void EntryFaces::load(StateVector& from) {
  entries_.clear();
  for (auto n = from.count(); n > 0; --n) {
    Entry e{static_cast<Index>(from.next()), from.count(), {}};
    for (int& side : e.sides) side = static_cast<int>(from.next());
    entries_.push_back(e);
  }
}

double crossing_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) {
  double step = std::numeric_limits<double>::infinity();
  SurfacePoints const& points = model.points;
  for (Index k = 0; model.definition.any_thin() && k < points.count(); ++k) {
    auto const self = at(points.particle(k));
    for (std::size_t r = 0; r < model.rigids.size(); ++r) {
      if (!model.definition.is_thin(points[k].body, r) || !model.allows(k, r)) continue;
      double const speed = std::sqrt(square_of(v[self] - model.rigids[r].velocity_at(points.last_x()[self])));
      if (speed > 0) step = std::min(step, way_in_a_step * points.surface_of(k).spacing / speed);
    }
  }
  return step;
}

}  // namespace piola::contact
