// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/passages.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <utility>

namespace piola::contact {
namespace {

constexpr double opposite_normals = -0.5;                 // product of normals
constexpr double watched_depth = 0.5, counted_depth = 1;  // depths, in spacings

}  // namespace

void Passages::begin() {
  std::swap(deep_, last_deep_);
  deep_.clear();
}

void Passages::record(std::int64_t point, std::size_t with, double depth, Vec<3> const& normal) {
  if (depth > watched_depth) deep_.push_back({point, with, normal, depth > counted_depth});
}

void Passages::count(ContactModel const& model) {
  std::sort(deep_.begin(), deep_.end());
  std::size_t const objects = model.definition.objects();
  for (DeepPoint const& last : last_deep_) {
    auto const now = std::lower_bound(deep_.begin(), deep_.end(), last);
    // Another face of a box may be the nearest one, but not the opposite one.
    bool const there = now != deep_.end() && !(last < *now) && dot(now->normal, last.normal) > opposite_normals;
    if (there || !last.counts) continue;
    if (last.with < objects) {
      add(model.points[static_cast<Index>(last.point)].body, last.with);
      continue;
    }
    ShapePass const& pass = model.definition.shape_passes()[last.with - objects];
    add(model.definition.object_of(pass.rigid), pass.body);
  }
}

void Passages::add(std::size_t of, std::size_t through) {
  auto const found =
      std::find_if(passed_.begin(), passed_.end(), [&](Passed const& p) { return p.of == of && p.through == through; });
  if (found != passed_.end())
    ++found->points;
  else
    passed_.push_back({of, through, 1});
}

void Passages::save(std::vector<double>& all) const {
  all.push_back(static_cast<double>(deep_.size()));
  for (DeepPoint const& d : deep_) {
    all.insert(all.end(), {static_cast<double>(d.point), static_cast<double>(d.with), d.counts ? 1.0 : 0.0});
    put(all, d.normal);
  }
  all.push_back(static_cast<double>(passed_.size()));
  for (Passed const& p : passed_)
    all.insert(all.end(), {static_cast<double>(p.of), static_cast<double>(p.through), static_cast<double>(p.points)});
}

void Passages::load(StateVector& from) {
  deep_.clear();
  for (auto n = from.count(); n > 0; --n) {
    DeepPoint d{static_cast<std::int64_t>(from.next()), from.count(), {}, from.next() > 0};
    from.take(d.normal);
    deep_.push_back(d);
  }
  passed_.clear();
  for (auto n = from.count(); n > 0; --n)
    passed_.push_back({from.count(), from.count(), static_cast<std::int64_t>(from.next())});
}

}  // namespace piola::contact
