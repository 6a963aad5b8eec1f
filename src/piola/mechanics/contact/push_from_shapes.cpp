// SPDX-License-Identifier: Apache-2.0
// Points of rigid shapes against the planes of bodies, where points of the bodies are too far apart to feel the shape.
#include "piola/exec/host_loops.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <limits>

namespace piola::contact {
namespace {

constexpr double closing_in_a_step = 0.1;  // of a spacing
constexpr double on_mirror = 1e-9;         // of a spacing

}  // namespace

/// Points of a shape that may be near the points of a body.
std::vector<ShapePoint> SurfaceContactSystem::shape_points_near(ShapePass const& pass,
                                                                std::vector<Index> const& of_body) const {
  RigidSurface const& rigid = rigids_[pass.rigid];
  double const reach = pass.rule.reach + skin_, size = reach_of(rigid);
  constexpr double far = std::numeric_limits<double>::infinity();
  ShapeRange range{{{far, far, far}}, {{-far, -far, -far}}};
  for (Index const k : of_body) {
    Vec<3> const arm = transpose(rigid.turn) * (planes_[at(k)].y - rigid.centre);
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

void SurfaceContactSystem::list_shape_points(std::vector<std::vector<Index>> const& of_body) {
  shape_runs_.clear();
  for (std::size_t p = 0; p < shape_passes_.size(); ++p) {
    ShapePass const& pass = shape_passes_[p];
    std::vector<Index> const& points = of_body[pass.body];
    std::vector<ShapePoint> const candidates = shape_points_near(pass, points);
    if (candidates.empty()) continue;
    RigidSurface const& rigid = rigids_[pass.rigid];
    double const reach = pass.rule.reach + skin_;
    std::vector<std::array<double, 3>> places;
    places.reserve(points.size());
    for (Index const k : points) places.push_back({planes_[at(k)].y[0], planes_[at(k)].y[1], planes_[at(k)].y[2]});
    CellGrid const grid(places, reach);
    for (ShapePoint const& point : candidates) {
      Vec<3> const y = rigid.centre + rigid.turn * point.arm;
      std::size_t const first = sources_.size();
      grid.visit({y[0], y[1], y[2]}, [&](Index j) {
        Index const source = points[at(j)];
        if (square_of(planes_[at(source)].y - y) < reach * reach && is_met(source, pass.rigid))
          sources_.push_back(source);
      });
      std::sort(sources_.begin() + static_cast<std::ptrdiff_t>(first), sources_.end());
      if (sources_.size() > first) shape_runs_.push_back({p, point, first, sources_.size()});
    }
  }
}

/// Behind a mirror plane of the body a point of a shape counts in its image; on the plane half of it is in front.
double SurfaceContactSystem::share_before_mirrors(ShapeRun const& run) const {
  std::size_t const body = shape_passes_[run.pass].body;
  double share = 1;
  for (SurfaceMirror const& mirror : mirrors_[body]) {
    double const before = mirror.side * (run.plane.y[mirror.axis] - mirror.at),
                 zero = on_mirror * surfaces_[body].spacing;
    share *= before > zero ? 1 : before < -zero ? 0 : 0.5;
  }
  return share;
}

/// The springs that a point of a shape hangs on bodies and on the shape.
void SurfaceContactSystem::note_spring_by(ShapeRun const& run, double area) {
  ShapePass const& pass = shape_passes_[run.pass];
  RigidSurface const& rigid = rigids_[pass.rigid];
  double const over = std::min(run.gap.gap, 0.0) / pass.rule.length,
               spring = pass.rule.stiffness * area * (1 + 3 * over * over);
  std::size_t nearest = run.first;
  for (std::size_t s = run.first; s < run.last; ++s) {
    shape_springs_[at(points_[at(sources_[s])].host)] += weights_[s] / run.gap.weight * spring;
    if (weights_[s] > weights_[nearest]) nearest = s;
  }
  gap_[at(sources_[nearest])] = std::min(gap_[at(sources_[nearest])], run.gap.gap);
  if (!(rigid.inverse_mass > 0)) return;
  bool const rubs = with_rigid(pass.body, pass.rigid).friction.any();
  sums_.springs_of_shape[pass.rigid] +=
      spring * (rubs ? rigid.mobility(run.plane.y) : rigid.mobility(run.plane.y, run.plane.n));
}

/// Forces between one point of a shape and the planes in its range.
void SurfaceContactSystem::push_by(ShapeRun const& run) {
  ShapePass const& pass = shape_passes_[run.pass];
  PairRule const& rule = pass.rule;
  RigidSurface const& rigid = rigids_[pass.rigid];
  double const dp = 2 * rule.length, area = run.point.area * share_before_mirrors(run);
  Fade const theta = fade(run.gap.tau2(), rule.fade_from, rule.fade_to);
  double const seen = theta.value * coverage(run.gap.weight).value, depth = -run.gap.gap;
  if (!(seen > 0) || !(area > 0)) return;
  note_spring_by(run, area);
  if (!(depth > 0)) return;
  totals_.deepest = std::max(totals_.deepest, depth / dp);
  note_deep(run.point.key, others() + run.pass, depth / dp, run.plane.n);
  Layer const psi = layer(-depth, rule.stiffness, rule.length);
  sums_.energy += area * psi.energy * seen;
  ++totals_.touched;
  auto const source_of = [&](Index k) -> Plane const& { return planes_[at(sources_[run.first + at(k)])]; };
  PointLoad const own =
      contact_loads(run.plane, area, run.gap, psi, theta, static_cast<Index>(run.last - run.first), source_of,
                    rule.reach, [&](Index s, PointLoad const& load) { add_load(sources_[run.first + at(s)], load); });
  Vec<3> const arm = run.plane.y - rigid.centre;
  sums_.resultant_on_rigid[pass.rigid].add(own.force, cross(arm, own.force) - cross(run.plane.n, own.by_normal));
  rub_by(run, -area * psi.slope * seen, area);
}

void SurfaceContactSystem::rub_by(ShapeRun const& run, double normal_force, double area) {
  ShapePass const& pass = shape_passes_[run.pass];
  RigidSurface const& rigid = rigids_[pass.rigid];
  FrictionLaw const& law = with_rigid(pass.body, pass.rigid).friction;
  if (!law.any()) return;
  Vec<3> jump = moved_from(last_pose_[pass.rigid], rigid, run.plane.y), n;
  slide_over(run.first, run.last, run.gap.weight, run.plane.y, jump, n);
  NormalContact const press{run.point.key, others() + run.pass, normal_force, pass.rule.stiffness * area, area};
  FrictionForce const rubbed = drag(press, law, rigid.turn, jump, n);
  sums_.resultant_on_rigid[pass.rigid].add(rubbed.force, cross(run.plane.y - rigid.centre, rubbed.force));
  rub_back(run.first, rubbed);
}

/// Gaps of the points of shapes.
void SurfaceContactSystem::place_shape_points() {
  weights_.resize(sources_.size());
  exec_host::parallel_for(static_cast<Index>(shape_runs_.size()), [&](Index k) {
    ShapeRun& run = shape_runs_[at(k)];
    ShapePass const& pass = shape_passes_[run.pass];
    RigidSurface const& rigid = rigids_[pass.rigid];
    run.plane = {rigid.centre + rigid.turn * run.point.arm, rigid.turn * run.point.normal};
    run.gap = blended_gap(
        run.plane, static_cast<Index>(run.last - run.first),
        [&](Index s) -> Plane const& { return planes_[at(sources_[run.first + at(s)])]; }, pass.rule.reach,
        &weights_[run.first]);
  });
}

void SurfaceContactSystem::push_from_shape_points() {
  if (shape_runs_.empty()) return;
  place_shape_points();
  shape_springs_.assign(at(hosts_.count()), 0);
  for (ShapeRun const& run : shape_runs_)
    if (run.gap.seen() && run.gap.gap < near * 2 * shape_passes_[run.pass].rule.length) push_by(run);
  note_shape_springs();
}

/// Springs of many points of a shape hang on one particle: their sum bounds the frequency that they add.
void SurfaceContactSystem::note_shape_springs() {
  double largest = 0;
  for (ShapeRun const& run : shape_runs_) {
    double here = 0;
    for (std::size_t s = run.first; s < run.last; ++s) {
      Index const source = sources_[s];
      here = std::max(here, 2.5 * shape_springs_[at(points_[at(source)].host)] * inverse_mass_of(source));
    }
    largest = std::max(largest, here);
  }
  if (!(largest > 0)) return;
  totals_.frequency2 += largest;
  for (std::size_t r = 0; r < rigids_.size(); ++r)
    if (rigids_[r].inverse_mass > 0) frequencies_[r].of_points += largest;
}

double SurfaceContactSystem::closing_step_of_shapes(std::vector<Vec<3>> const& v) const {
  double step = std::numeric_limits<double>::infinity();
  for (ShapeRun const& run : shape_runs_) {
    ShapePass const& pass = shape_passes_[run.pass];
    double const dp = 2 * pass.rule.length;
    if (!run.gap.seen() || !(run.gap.gap < near * dp)) continue;
    Vec<3> const own = rigids_[pass.rigid].velocity_at(run.plane.y);
    for (std::size_t s = run.first; s < run.last; ++s) {
      if (!(weights_[s] > 0)) continue;
      double const speed = dot(v[at(hosts_.self(points_[at(sources_[s])].host))] - own, planes_[at(sources_[s])].n);
      if (speed > 0) step = std::min(step, closing_in_a_step * dp / speed);
    }
  }
  return step;
}

}  // namespace piola::contact
