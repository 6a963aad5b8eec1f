// SPDX-License-Identifier: Apache-2.0
// Points that are kept on their side of a thin rigid shape, and those that went through a surface all the same.
#include "piola/mechanics/contact/surface_contact.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola::contact {
namespace {

constexpr double way_in_a_step = 0.5;                     // of a spacing, past thin shapes
constexpr double opposite_normals = -0.5;                 // product of normals
constexpr double watched_depth = 0.5, counted_depth = 1;  // depths, in spacings

}  // namespace

SurfaceContactSystem::Kept const* SurfaceContactSystem::kept(Index point, std::size_t rigid) const {
  auto const found = std::lower_bound(kept_.begin(), kept_.end(), point, [&](Kept const& k, Index p) {
    return k.point != p ? k.point < p : k.rigid < rigid;
  });
  return found != kept_.end() && found->point == point && found->rigid == rigid ? &*found : nullptr;
}

/// How far a point is from a shape, seen from the side on which it is kept.
Distance SurfaceContactSystem::distance_on_side(Index point, std::size_t rigid) const {
  Kept const* const known = kept_.empty() ? nullptr : kept(point, rigid);
  return distance_from(rigids_[rigid], planes_[at(point)].y, known != nullptr ? known->sides : Sides{});
}

/// Finds the side of a point of a thin shape for this evaluation: that by which it came in, until it is out again.
void SurfaceContactSystem::keep_on_side(Index point, std::size_t r, std::vector<Vec<3>> const& x,
                                        std::vector<Kept>& now) {
  Point const& p = points_[at(point)];
  RigidSurface const& rigid = rigids_[r];
  Vec<3> const& y = planes_[at(point)].y;
  std::array<bool, 3> const& is_thin = thin_[p.body][r];
  Kept const* known = kept(point, r);
  Kept fresh{point, r, {}};
  if (known == nullptr) {
    auto const self = at(hosts_.self(p.host));
    // At the start the particle itself stands before the shape.
    Vec<3> before = x[self];
    bool const moved = dt_ > 0 && !last_x_.empty();
    if (moved) before = last_x_[self] + (has_friction_ ? last_F(p.host) : hosts_.F(p.host, last_x_)) * p.S;
    auto const sides = entered(rigid, y, moved ? last_pose_[r] : pose_of(rigid), before, is_thin);
    if (!sides) return;
    fresh.sides = *sides;
    known = &fresh;
  }
  if (distance_from(rigid, y, known->sides).value < 0) {
    now.push_back(*known);
    return;
  }
  if (beyond(rigid, y, known->sides) > 0) pass(p.body, surfaces_.size() + r);
}

void SurfaceContactSystem::pass(std::size_t of, std::size_t through) {
  auto const found =
      std::find_if(passed_.begin(), passed_.end(), [&](Passed const& p) { return p.of == of && p.through == through; });
  if (found != passed_.end())
    ++found->points;
  else
    passed_.push_back({of, through, 1});
}

void SurfaceContactSystem::note_deep(std::int64_t point, std::size_t with, double depth, Vec<3> const& normal) {
  if (depth > watched_depth) deep_.push_back({point, with, normal, depth > counted_depth});
}

/// Counts points that were deep behind a surface and are now in front of it or out of its range: they went through.
void SurfaceContactSystem::count_passed() {
  std::sort(deep_.begin(), deep_.end());
  for (Deep const& last : last_deep_) {
    auto const now = std::lower_bound(deep_.begin(), deep_.end(), last);
    // Another face of a box may be the nearest one, but not the opposite one.
    bool const there = now != deep_.end() && !(last < *now) && dot(now->normal, last.normal) > opposite_normals;
    if (there || !last.counts) continue;
    if (last.with < others())
      pass(points_[static_cast<std::size_t>(last.point)].body, last.with);
    else
      pass(surfaces_.size() + shape_passes_[last.with - others()].rigid, shape_passes_[last.with - others()].body);
  }
}

/// The step in which nothing gets from before the lists of a thin shape to behind it [s].
double SurfaceContactSystem::crossing_step(std::vector<Vec<3>> const& v) const {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; any_thin_ && k < points_.size(); ++k) {
    Point const& p = points_[k];
    auto const self = at(hosts_.self(p.host));
    for (std::size_t r = 0; r < rigids_.size(); ++r) {
      std::array<bool, 3> const& is_thin = thin_[p.body][r];
      if (!(is_thin[0] || is_thin[1] || is_thin[2]) || !is_met(static_cast<Index>(k), r)) continue;
      double const speed = std::sqrt(square_of(v[self] - rigids_[r].velocity_at(last_x_[self])));
      if (speed > 0) step = std::min(step, way_in_a_step * surfaces_[p.body].spacing / speed);
    }
  }
  return step;
}

}  // namespace piola::contact
