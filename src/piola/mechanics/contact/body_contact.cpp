// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/body_contact.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/mechanics/contact/bounding_box.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace piola::contact {
namespace {

/// Opposing normals have a negative product; until lists are rebuilt they rotate by no more than this margin allows.
constexpr double largest_cosine = 0.8;

/// Whether two points that are near each other can be in contact: those of one body not across its own thickness or
/// corners.
bool can_touch(ContactModel const& model, Index target, Index source) {
  SurfacePoints const& points = model.points;
  SurfacePoints::Point const &a = points[target], &b = points[source];
  if (a.body != b.body) return true;
  return dot(points.plane(target).n, points.plane(source).n) < largest_cosine &&
         !model.definition.are_neighbours(a.body, a.host, b.host);
}

/// Share of a full face in front of a point, 0 to 1.
double seen_by(PairRule const& rule, Gap const& gap) {
  return fade(gap.tau2(), rule.fade_from, rule.fade_to).value * coverage(gap.weight).value;
}

}  // namespace

void BodyContact::search(ContactModel const& model, std::vector<std::vector<Index>> const& of_body, double skin) {
  ranges_.clear();
  sources_.clear();
  for (std::size_t b = 0; b < of_body.size(); ++b)
    if (!of_body[b].empty()) search_body(model, b, of_body[b], skin);
}

/// Lists the planes of body b near each point that can be in contact with it.
void BodyContact::search_body(ContactModel const& model, std::size_t b, std::vector<Index> const& of_body,
                              double skin) {
  SurfacePoints const& points = model.points;
  BoundingBox box;
  std::vector<std::array<double, 3>> places;
  places.reserve(of_body.size());
  for (Index const k : of_body) {
    Vec<3> const& y = points.plane(k).y;
    box.add(y);
    places.push_back(array_of(y));
  }
  auto const reach = [&](Index k) {
    SurfacePoints::Point const& p = points[k];
    return model.definition.pair(p.body, b).is_active && !p.image ? model.definition.rule(p.body, b).reach + skin
                                                                  : -1.0;
  };
  double largest = 0;
  for (Index k = 0; k < points.count(); ++k)
    if (double const r = reach(k); r > 0 && box.holds(points.plane(k).y, r)) largest = std::max(largest, r);
  if (!(largest > 0)) return;
  CellGrid const grid(places, largest);
  for (Index k = 0; k < points.count(); ++k) {
    double const r = reach(k);
    Vec<3> const& y = points.plane(k).y;
    if (!(r > 0) || model.definition.is_removed(k) || model.definition.is_excluded(k, b) || !box.holds(y, r)) continue;
    std::size_t const first = sources_.size();
    grid.visit(array_of(y), [&](Index j) {
      Index const source = of_body[at(j)];
      if (square_of(points.plane(source).y - y) < r * r && can_touch(model, k, source)) sources_.push_back(source);
    });
    std::sort(sources_.begin() + static_cast<std::ptrdiff_t>(first), sources_.end());
    if (sources_.size() > first) ranges_.push_back({k, b, first, sources_.size()});
  }
}

void BodyContact::mark(std::vector<char>& points) const {
  for (Range const& range : ranges_) points[at(range.target)] = 1;
  for (Index const k : sources_) points[at(k)] = 1;
}

/// Largest inverse mass of the planes of a range that have weight [1/kg]. The list may contain others.
double BodyContact::largest_inverse_mass(SurfacePoints const& points, Range const& range) const {
  double inverse = 0;
  for (std::size_t s = range.first; s < range.last; ++s)
    if (weights_[s] > 0) inverse = std::max(inverse, points.inverse_mass(sources_[s]));
  return inverse;
}

void BodyContact::find_gaps(ContactModel const& model) {
  SurfacePoints const& points = model.points;
  gaps_.resize(ranges_.size());
  weights_.resize(sources_.size());
  exec_host::parallel_for(static_cast<Index>(ranges_.size()), [&](Index k) {
    Range const& range = ranges_[at(k)];
    Index const* const sources = &sources_[range.first];
    gaps_[at(k)] = blended_gap(
        points.plane(range.target), range.count(), [&](Index s) -> Plane const& { return points.plane(sources[s]); },
        model.definition.rule(points[range.target].body, range.body).reach, &weights_[range.first]);
  });
}

void BodyContact::carry_energies(ContactModel const& model) {
  if (ranges_.empty()) return;
  find_gaps(model);
  carries_ = true;
  carried_.clear();
  for (std::size_t k = 0; k < ranges_.size(); ++k)
    if (gaps_[k].seen())
      carried_[{static_cast<Index>(ranges_[k].body), ranges_[k].target}] = energy_per_area(model, ranges_[k], gaps_[k]);
}

/// Sets depths after planes were removed: each point keeps the energy of carry_energies(), or none if it had none.
void BodyContact::set_offsets(ContactModel const& model) {
  if (!std::exchange(carries_, false)) return;
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    if (!gaps_[k].seen()) continue;
    Range const& range = ranges_[k];
    PairRule const& rule = model.definition.rule(model.points[range.target].body, range.body);
    auto const body = static_cast<Index>(range.body);
    auto const before = carried_.find({body, range.target});
    double const energy = before == carried_.end() ? 0 : before->second, seen = seen_by(rule, gaps_[k]);
    if (seen > 0)
      offsets_.set(body, range.target, gaps_[k].gap, gap_of_layer(energy / seen, rule.stiffness, rule.length));
  }
  carried_.clear();
}

/// Energy stored per area of a target [J/m2].
double BodyContact::energy_per_area(ContactModel const& model, Range const& range, Gap const& gap) const {
  PairRule const& rule = model.definition.rule(model.points[range.target].body, range.body);
  double const pushing = offsets_.pushing_now(static_cast<Index>(range.body), range.target, gap.gap);
  return layer(pushing, rule.stiffness, rule.length).energy * seen_by(rule, gap);
}

void BodyContact::evaluate(ContactModel& model, ContactState& state) {
  find_gaps(model);
  set_offsets(model);
  for (std::size_t k = 0; k < ranges_.size(); ++k)
    if (gaps_[k].seen()) evaluate(ranges_[k], gaps_[k], model, state);
}

/// Forces between one target and the planes that it sees.
void BodyContact::evaluate(Range const& range, Gap const& gap, ContactModel& model, ContactState& state) {
  SurfacePoints const& points = model.points;
  ContactForces& forces = state.forces;
  SurfacePoints::Point const& target = points[range.target];
  PairRule const& rule = model.definition.rule(target.body, range.body);
  double const dp = 2 * rule.length, pushing = offsets_.pushing(static_cast<Index>(range.body), range.target, gap.gap);
  if (!(gap.gap < near * dp)) return;
  Fade const theta = fade(gap.tau2(), rule.fade_from, rule.fade_to);
  double const seen = theta.value * coverage(gap.weight).value;
  if (!(seen > 0)) return;
  forces.record_gap(range.target, gap.gap);
  forces.record_depth(std::max(-gap.gap, 0.0) / dp);
  // For both passes, C_s Mbar / dpbar.
  forces.record_frequency2(frequency2(2 * rule.stiffness, target.area, std::min(gap.gap, 0.0), rule.length,
                                      largest_inverse_mass(points, range) + points.inverse_mass(range.target)));
  if (!(gap.gap < 0)) return;
  Plane const& plane = points.plane(range.target);
  state.passages.record(range.target, range.body, -gap.gap / dp, plane.n);
  Layer const psi = layer(pushing, rule.stiffness, rule.length);
  forces.add_contact(target.area * psi.energy * seen);
  Index const* const sources = &sources_[range.first];
  PointLoad const own = contact_loads(
      plane, target.area, gap, psi, theta, range.count(),
      [&](Index s) -> Plane const& { return points.plane(sources[s]); }, rule.reach,
      [&](Index s, PointLoad const& load) { forces.add_load(sources[s], load); });
  forces.add_load(range.target, own);
  NearPlanes const planes{
      {sources, range.last - range.first}, {&weights_[range.first], range.last - range.first}, gap.weight};
  state.friction.slide_on_body(
      model,
      {range.target, range.body, -target.area * psi.slope * seen, rule.stiffness * target.area, 0.5 * target.area},
      planes, forces);
  forces.resultants().add_between(target.body, range.body, plane.y, own.force);
}

double BodyContact::energy_of(ContactModel const& model, Index point, std::size_t body) const {
  for (std::size_t k = 0; k < ranges_.size(); ++k)
    if (ranges_[k].target == point && ranges_[k].body == body && gaps_[k].seen())
      return model.points[point].area * energy_per_area(model, ranges_[k], gaps_[k]);
  return 0;
}

double BodyContact::contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const {
  SurfacePoints const& points = model.points;
  double step = std::numeric_limits<double>::infinity();
  for (Range const& range : ranges_) {
    PairRule const& rule = model.definition.rule(points[range.target].body, range.body);
    for (std::size_t s = range.first; s < range.last; ++s) {
      Plane const &a = points.plane(range.target), &b = points.plane(sources_[s]);
      if (!(dot(a.n, b.n) < 0) || !(square_of(a.y - b.y) < rule.reach * rule.reach)) continue;
      double const speed = -dot(v[at(points.particle(range.target))] - v[at(points.particle(sources_[s]))], b.n);
      if (speed > 0) step = std::min(step, approach_in_a_step * 2 * rule.length / speed);
    }
  }
  return step;
}

}  // namespace piola::contact
