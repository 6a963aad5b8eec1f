// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/shape_point_contact.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <array>
#include <limits>

namespace piola::contact {
namespace {

constexpr double on_mirror = 1e-9;  // of a spacing

/// Points of a shape that may be near the points of a body.
std::vector<ShapePoint> shape_points_near(ContactModel const& model, ShapePass const& pass,
                                          std::vector<Index> const& of_body, double skin) {
  RigidSurface const& rigid = model.rigids[pass.rigid];
  double const reach = pass.rule.reach + skin, size = reach_of(rigid);
  constexpr double far = std::numeric_limits<double>::infinity();
  ShapeRange range{{{far, far, far}}, {{-far, -far, -far}}};
  for (Index const k : of_body) {
    Vec<3> const arm = transpose(rigid.turn) * (model.points.plane(k).y - rigid.centre);
    for (int c = 0; c < 3; ++c) {
      range.low[c] = std::min(range.low[c], arm[c] - reach);
      range.high[c] = std::max(range.high[c], arm[c] + reach);
    }
  }
  for (int c = rigid.dimension; c < 3; ++c) range.low[c] = range.high[c] = 0;
  for (int c = 0; c < rigid.dimension; ++c)
    if (range.low[c] > size || range.high[c] < -size) return {};
  return pass.points.within(range);
}

}  // namespace

void ShapePointContact::search(ContactModel const& model, std::vector<std::vector<Index>> const& of_body, double skin) {
  ranges_.clear();
  sources_.clear();
  std::vector<ShapePass> const& passes = model.definition.shape_passes();
  for (std::size_t p = 0; p < passes.size(); ++p) {
    ShapePass const& pass = passes[p];
    std::vector<Index> const& points = of_body[pass.body];
    std::vector<ShapePoint> const candidates = shape_points_near(model, pass, points, skin);
    if (candidates.empty()) continue;
    RigidSurface const& rigid = model.rigids[pass.rigid];
    double const reach = pass.rule.reach + skin;
    std::vector<std::array<double, 3>> places;
    places.reserve(points.size());
    for (Index const k : points) places.push_back(array_of(model.points.plane(k).y));
    CellGrid const grid(places, reach);
    for (ShapePoint const& point : candidates) {
      Vec<3> const y = rigid.centre + rigid.turn * point.arm;
      std::size_t const first = sources_.size();
      grid.visit(array_of(y), [&](Index j) {
        Index const source = points[at(j)];
        if (square_of(model.points.plane(source).y - y) < reach * reach && model.allows(source, pass.rigid))
          sources_.push_back(source);
      });
      std::sort(sources_.begin() + static_cast<std::ptrdiff_t>(first), sources_.end());
      if (sources_.size() > first) ranges_.push_back({p, point, first, sources_.size()});
    }
  }
}

void ShapePointContact::mark(std::vector<char>& points) const {
  for (Index const k : sources_) points[at(k)] = 1;
}

/// Weight of a point of a shape: 1 in front of a mirror plane of the body, 1/2 on it, and 0 behind it, where its image
/// counts.
double ShapePointContact::weight_at_mirrors(ContactModel const& model, Range const& range) const {
  std::size_t const body = model.definition.shape_passes()[range.pass].body;
  double weight = 1;
  for (SurfaceMirror const& mirror : mirrors_[body]) {
    double const before = mirror.side * (range.plane.y[mirror.axis] - mirror.at),
                 zero = on_mirror * model.points.surfaces()[body].spacing;
    weight *= before > zero ? 1 : before < -zero ? 0 : 0.5;
  }
  return weight;
}

/// Records the springs of a point of a shape on bodies and on the shape.
void ShapePointContact::record_springs(ContactModel const& model, Range const& range, double area,
                                       ContactForces& forces) {
  ShapePass const& pass = model.definition.shape_passes()[range.pass];
  RigidSurface const& rigid = model.rigids[pass.rigid];
  double const over = std::min(range.gap.gap, 0.0) / pass.rule.length,
               spring = pass.rule.stiffness * area * (1 + 3 * over * over);
  std::size_t nearest = range.first;
  for (std::size_t s = range.first; s < range.last; ++s) {
    springs_[at(model.points[sources_[s]].host)] += weights_[s] / range.gap.weight * spring;
    if (weights_[s] > weights_[nearest]) nearest = s;
  }
  forces.record_gap(sources_[nearest], range.gap.gap);
  if (!(rigid.inverse_mass > 0)) return;
  bool const slides = model.definition.with_rigid(pass.body, pass.rigid).friction.any();
  Plane const& plane = range.plane;
  forces.resultants().add_spring(pass.rigid,
                                 spring * (slides ? rigid.mobility(plane.y) : rigid.mobility(plane.y, plane.n)));
}

/// Forces between one point of a shape and the planes in its range.
void ShapePointContact::evaluate(Range const& range, ContactModel& model, ContactState& state) {
  ShapePass const& pass = model.definition.shape_passes()[range.pass];
  PairRule const& rule = pass.rule;
  ContactForces& forces = state.forces;
  Gap const& gap = range.gap;
  Plane const& plane = range.plane;
  double const dp = 2 * rule.length,
               area = range.point.area * weight_at_mirrors(model, range) * pass.around(plane.y[0]);
  Fade const theta = fade(gap.tau2(), rule.fade_from, rule.fade_to);
  double const seen = theta.value * coverage(gap.weight).value, depth = -gap.gap;
  if (!(seen > 0) || !(area > 0)) return;
  record_springs(model, range, area, forces);
  if (!(depth > 0)) return;
  std::size_t const with = model.definition.objects() + range.pass;
  forces.record_depth(depth / dp);
  state.passages.record(range.point.key, with, depth / dp, plane.n);
  Layer const psi = layer(-depth, rule.stiffness, rule.length);
  forces.add_contact(area * psi.energy * seen);
  Index const* const sources = &sources_[range.first];
  PointLoad const own = contact_loads(
      plane, area, gap, psi, theta, range.count(),
      [&](Index s) -> Plane const& { return model.points.plane(sources[s]); }, rule.reach,
      [&](Index s, PointLoad const& load) { forces.add_load(sources[s], load); });
  Vec<3> const arm = plane.y - model.rigids[pass.rigid].centre;
  forces.resultants().add_on_rigid(pass.rigid, own.force, cross(arm, own.force) - cross(plane.n, own.by_normal));
  NearPlanes const planes{
      {sources, range.last - range.first}, {&weights_[range.first], range.last - range.first}, gap.weight};
  state.friction.slide_shape_point(
      model, {range.point.key, with, -area * psi.slope * seen, rule.stiffness * area, area}, plane.y, planes, forces);
}

void ShapePointContact::find_gaps(ContactModel const& model) {
  weights_.resize(sources_.size());
  exec_host::parallel_for(static_cast<Index>(ranges_.size()), [&](Index k) {
    Range& range = ranges_[at(k)];
    ShapePass const& pass = model.definition.shape_passes()[range.pass];
    RigidSurface const& rigid = model.rigids[pass.rigid];
    Index const* const sources = &sources_[range.first];
    range.plane = {rigid.centre + rigid.turn * range.point.arm, rigid.turn * range.point.normal};
    range.gap = blended_gap(
        range.plane, range.count(), [&](Index s) -> Plane const& { return model.points.plane(sources[s]); },
        pass.rule.reach, &weights_[range.first]);
  });
}

void ShapePointContact::evaluate(ContactModel& model, ContactState& state) {
  if (ranges_.empty()) return;
  find_gaps(model);
  springs_.assign(at(model.points.hosts().count()), 0);
  for (Range const& range : ranges_)
    if (range.gap.seen() && range.gap.gap < near * 2 * model.definition.shape_passes()[range.pass].rule.length)
      evaluate(range, model, state);
  add_frequencies(model, state.forces);
}

/// Springs of many points of a shape act on one particle: their sum bounds the frequency that they add.
void ShapePointContact::add_frequencies(ContactModel const& model, ContactForces& forces) const {
  double largest = 0;
  for (Index const source : sources_)
    largest = std::max(largest, 2.5 * springs_[at(model.points[source].host)] * model.points.inverse_mass(source));
  if (!(largest > 0)) return;
  forces.add_frequency2(largest);
  for (std::size_t r = 0; r < model.rigids.size(); ++r)
    if (model.rigids[r].inverse_mass > 0) forces.resultants().own_frequencies(r).of_points += largest;
}

double ShapePointContact::contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const {
  SurfacePoints const& points = model.points;
  double step = std::numeric_limits<double>::infinity();
  for (Range const& range : ranges_) {
    ShapePass const& pass = model.definition.shape_passes()[range.pass];
    double const dp = 2 * pass.rule.length;
    if (!range.gap.seen() || !(range.gap.gap < near * dp)) continue;
    Vec<3> const own = model.rigids[pass.rigid].velocity_at(range.plane.y);
    for (std::size_t s = range.first; s < range.last; ++s) {
      if (!(weights_[s] > 0)) continue;
      double const speed = dot(v[at(points.particle(sources_[s]))] - own, points.plane(sources_[s]).n);
      if (speed > 0) step = std::min(step, approach_in_a_step * dp / speed);
    }
  }
  return step;
}

}  // namespace piola::contact
