// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_body.hpp"
#include "piola/base/contracts.hpp"

namespace piola::contact {
namespace {

Vec<3> column(Mat<3> const& A, int k) { return {{A(0, k), A(1, k), A(2, k)}}; }

}  // namespace

RigidBody::RigidBody(RigidShape const& shape, int dimension)
    : centre{{shape.centre[0], shape.centre[1], shape.centre[2]}},
      dimension_(dimension),
      mass_(shape.mass),
      inertia_(inertia_of(shape, dimension)),
      held_(shape.held),
      can_turn_(shape.can_turn) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(mass_ > 0);
  Vec<3> rate;
  for (int c = 0; c < 3; ++c) {
    velocity[c] = shape.velocity[static_cast<std::size_t>(c)]({});
    rate[c] = shape.angular_velocity[static_cast<std::size_t>(c)]({});
  }
  if (!can_turn_) return;
  for (int k = dimension == 3 ? 0 : 2; k < 3; ++k) {
    Vec<3> const axis = column(inertia_.axes, k);
    spin = spin + (inertia_.moment[k] * dot(axis, rate)) * axis;
  }
}

Mat<3> RigidBody::inverse_inertia() const {
  Mat<3> sum;
  if (!can_turn_) return sum;
  Mat<3> const axes = matrix_of(turn) * inertia_.axes;
  for (int k = dimension_ == 3 ? 0 : 2; k < 3; ++k) {
    Vec<3> const axis = column(axes, k);
    sum = sum + (1 / inertia_.moment[k]) * outer(axis, axis);
  }
  return sum;
}

Vec<3> RigidBody::angular_velocity() const { return inverse_inertia() * spin; }

Vec<3> RigidBody::free_part(Vec<3> impulse) const {
  for (int c = 0; c < 3; ++c)
    if (c >= dimension_ || held_[static_cast<std::size_t>(c)]) impulse[c] = 0;
  return impulse;
}

double RigidBody::kick(Vec<3> const& impulse, Vec<3> const& moment) {
  Vec<3> const before = velocity, used = free_part(impulse);
  velocity = velocity + (1 / mass_) * used;
  if (can_turn_) spin = dimension_ == 3 ? spin + moment : Vec<3>{{0, 0, spin[2] + moment[2]}};
  return 0.5 * dot(used - impulse, before + velocity);
}

void RigidBody::turn_about_own_axis(int k, double h) {
  Vec<3> const axis = matrix_of(turn) * column(inertia_.axes, k);
  turn = turn_about(axis, h * dot(spin, axis) / inertia_.moment[k]) * turn;
}

void RigidBody::drift(double h) {
  centre = centre + h * velocity;
  if (!can_turn_) return;
  if (dimension_ < 3) {
    angle += h * spin[2] / inertia_.moment[2];
    turn = turn_about({{0, 0, 1}}, angle);
    return;
  }
  Vec<3> const& I = inertia_.moment;
  if (I[0] == I[1] && I[1] == I[2]) {  // for a ball every axis is principal
    turn = of_unit_length(turn_by((h / I[0]) * spin) * turn);
    return;
  }
  constexpr struct {
    int axis;
    double share;
  } parts[] = {{2, 0.5}, {1, 0.5}, {0, 1}, {1, 0.5}, {2, 0.5}};
  for (auto const& part : parts) turn_about_own_axis(part.axis, part.share * h);
  turn = of_unit_length(turn);
}

}  // namespace piola::contact
