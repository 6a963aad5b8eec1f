// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_contact.hpp"
#include <algorithm>
#include <limits>

namespace piola::contact {
namespace {

/// Stiffness of the layer between a point and a rigid shape [Pa/m].
double layer_stiffness(ContactModel const& model, Index point, std::size_t rigid) {
  Surface const& surface = model.points.surface_of(point);
  return penalty_stiffness(1, model.definition.with_rigid(model.points[point].body, rigid).factor, surface.modulus,
                           surface.spacing);
}

/// Part of the area of a point that counts, by the cosine between its normal and the inward one of a shape. Points of a
/// side face at a right angle to a plane do not count; beside a slope the part is near the projected area.
struct Facing {
  double part, slope;
};

Facing facing(double cosine) {
  double const c = std::max(cosine, 0.0);
  return {c * c * (2 - c), c * (4 - 3 * c)};
}

/// Records the spring between a point and a free rigid shape, of a stiffness [N/m].
void record_spring(ContactModel const& model, std::size_t r, Index point, Vec<3> const& n, double stiffness,
                   ContactResultants& resultants) {
  RigidSurface const& rigid = model.rigids[r];
  if (!(rigid.inverse_mass > 0)) return;
  Vec<3> const& y = model.points.plane(point).y;
  double& of_points = resultants.own_frequencies(r).of_points;
  of_points = std::max(of_points, 2.5 * stiffness * model.points.inverse_mass(point));
  bool const slides = model.definition.with_rigid(model.points[point].body, r).friction.any();
  resultants.add_spring(r, stiffness * (slides ? rigid.mobility(y) : rigid.mobility(y, n)));
}

}  // namespace

void RigidContact::search(ContactModel const& model, double skin) {
  near_rigids_.clear();
  for (Index k = 0; k < model.points.count(); ++k) {
    double const reach = skin + near * model.points.surface_of(k).spacing;
    bool any = false;
    for (std::size_t r = 0; r < model.rigids.size() && !any && !model.points[k].image; ++r)
      any = model.tests(k, r) &&
            (faces_.has(k, r) || distance_from(model.rigids[r], model.points.plane(k).y).value < reach);
    if (any) near_rigids_.push_back(k);
  }
}

void RigidContact::mark(std::vector<char>& points) const {
  for (Index const k : near_rigids_) points[at(k)] = 1;
}

void RigidContact::evaluate(ContactModel& model, std::vector<Vec<3>> const& x, ContactState& state) {
  faces_.update(model, near_rigids_, x, state.passages);
  for (Index const k : near_rigids_)
    for (std::size_t r = 0; r < model.rigids.size(); ++r)
      if (model.tests(k, r)) evaluate(k, r, model, state);
}

void RigidContact::evaluate(Index k, std::size_t r, ContactModel& model, ContactState& state) const {
  double const area = model.points[k].area, spacing = model.points.surface_of(k).spacing, length = 0.5 * spacing;
  double const stiffness = layer_stiffness(model, k, r);
  ContactForces& forces = state.forces;
  Distance const d = faces_.distance(model, k, r);
  if (!(d.value < near * spacing)) return;
  double const in_lengths = std::min(d.value, 0.0) / length;
  record_spring(model, r, k, d.normal, stiffness * area * (1 + 3 * in_lengths * in_lengths), forces.resultants());
  forces.record_gap(k, d.value);
  forces.record_depth(std::max(-d.value, 0.0) / spacing);
  forces.record_frequency2(frequency2(stiffness, area, std::min(d.value, 0.0), length, model.points.inverse_mass(k)));
  if (!(d.value < 0)) return;
  std::size_t const object = model.definition.object_of(r);
  state.passages.record(k, object, -d.value / spacing, d.normal);
  Layer const psi = layer(d.value, stiffness, length);
  Plane const& plane = model.points.plane(k);
  Facing const face = facing(-dot(plane.n, d.normal));
  double const counted = area * face.part, by_cosine = area * psi.energy * face.slope;
  Vec<3> const f = (-counted * psi.slope) * d.normal +
                   by_cosine * normal_change(model.rigids[r], plane.y, d.normal, plane.n),
               by_normal = -by_cosine * d.normal;
  forces.add_contact(counted * psi.energy);
  forces.add_load(k, {f, by_normal, {}});
  state.friction.slide_on_rigid(model, {k, object, -counted * psi.slope, stiffness * area, counted}, r, d.normal,
                                forces);
  forces.resultants().add_on_rigid(r, -1.0 * f, cross(plane.n, by_normal) - cross(plane.y - model.rigids[r].centre, f));
}

double RigidContact::energy_of_any(ContactModel const& model, Index point, std::size_t r) const {
  Distance const d = faces_.distance(model, point, r);
  return model.points[point].area * facing(-dot(model.points.plane(point).n, d.normal)).part *
         layer(d.value, layer_stiffness(model, point, r), 0.5 * model.points.surface_of(point).spacing).energy;
}

double RigidContact::contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const {
  SurfacePoints const& points = model.points;
  double step = std::numeric_limits<double>::infinity();
  for (Index const k : near_rigids_)
    for (std::size_t r = 0; r < model.rigids.size(); ++r) {
      if (!model.tests(k, r)) continue;
      Distance const d = faces_.distance(model, k, r);
      double const spacing = points.surface_of(k).spacing;
      if (!(d.value < near * spacing)) continue;
      double const speed = -dot(v[at(points.particle(k))] - model.rigids[r].velocity_at(points.plane(k).y), d.normal);
      if (speed > 0) step = std::min(step, approach_in_a_step * spacing / speed);
    }
  return step;
}

}  // namespace piola::contact
