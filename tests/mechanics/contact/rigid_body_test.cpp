// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_body.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola::contact {
namespace {

/// A box with the moments of inertia 1, 2 and 3 kg m2.
RigidShape brick() {
  RigidShape shape;
  shape.kind = RigidShape::Kind::box;
  shape.free = true;
  shape.mass = 3;
  shape.half_lengths = {std::sqrt(2.0), 1, 1e-9};
  return shape;
}

double largest(Vec<3> const& a) { return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])}); }

TEST(Quaternion, TurnsAsItsMatrixDoes) {
  Quaternion const a = turn_about({{0, 0, 1}}, 0.5), b = turn_by({{0.3, -0.2, 0.6}});
  Mat<3> const product = matrix_of(a * b), factors = matrix_of(a) * matrix_of(b);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(product.c[k], factors.c[k], 1e-15);
  Vec<3> const vector = rotation_vector(b);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(vector[c], (Vec<3>{{0.3, -0.2, 0.6}})[c], 1e-15);
  EXPECT_NEAR(rotation_vector(turn_about({{0, 1, 0}}, 6))[1], 6 - 2 * M_PI, 1e-14) << "the short way";
  EXPECT_EQ(largest(rotation_vector({})), 0);
}

TEST(RigidMass, OfKnownShapes) {
  RigidShape s = brick();
  s.half_lengths = {1, 2, 3};
  EXPECT_DOUBLE_EQ(volume_of(s, 3), 48);
  EXPECT_DOUBLE_EQ(volume_of(s, 2), 8);
  EXPECT_DOUBLE_EQ(inertia_of(s, 3).moment[0], 13);
  EXPECT_DOUBLE_EQ(inertia_of(s, 2).moment[2], 5);
  s.kind = RigidShape::Kind::cylinder;
  s.radius = 2;
  s.axis = {0.6, 0, 0.8};
  EXPECT_DOUBLE_EQ(volume_of(s, 3), 8 * M_PI);
  PrincipalInertia const bar = inertia_of(s, 3);
  EXPECT_DOUBLE_EQ(bar.moment[0], 6);
  EXPECT_DOUBLE_EQ(bar.moment[1], 4);  // 3/4 r2 + l2/3
  EXPECT_DOUBLE_EQ(bar.axes(0, 0), 0.6);
  EXPECT_NEAR(determinant(bar.axes), 1, 1e-15);
  s.kind = RigidShape::Kind::sphere;
  EXPECT_DOUBLE_EQ(inertia_of(s, 3).moment[1], 4.8);
  EXPECT_DOUBLE_EQ(inertia_of(s, 2).moment[2], 6);
}

TEST(RigidMass, IsThatWhichIsGiven) {
  RigidShape s = brick();
  s.inertia = {{4, 3, 2, 0, 0, 0}};
  PrincipalInertia const plain = inertia_of(s, 3);
  for (int k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(plain.moment[k], 4 - k);
  EXPECT_EQ(inertia_of(s, 2).moment[2], 2);
  // Moments 1, 3 and 3.5; the first about (1, 1, 0).
  s.inertia = {{2, 2, 3.5, -1, 0, 0}};
  PrincipalInertia const turned = inertia_of(s, 3);
  double across = 0;
  for (int k = 0; k < 3; ++k) {
    Vec<3> const axis{{turned.axes(0, k), turned.axes(1, k), turned.axes(2, k)}};
    if (std::fabs(turned.moment[k] - 1) < 1e-14) across = std::fabs(axis[0] + axis[1]);
  }
  EXPECT_NEAR(across, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(turned.moment[0] + turned.moment[1] + turned.moment[2], 7.5, 1e-14);
}

// Euler's equations of a symmetric top, I1 = I2, without forces: its axis goes round L at the rate |L|/I1, and the part
// of the angular velocity across goes round the axis, as seen from the body, at (I3 - I1)/I1 times that along it.
TEST(RigidBody, PrecessesAsASymmetricTop) {
  RigidShape shape = brick();
  shape.inertia = {{2, 2, 3, 0, 0, 0}};  // of no box
  shape.angular_velocity = {Expression("0.8"), Expression("0"), Expression("4")};
  RigidBody top(shape, 3);
  EXPECT_NEAR(largest(top.spin - Vec<3>{{1.6, 0, 12}}), 0, 1e-14);
  double const rate = std::sqrt(dot(top.spin, top.spin)) / 2, along = 4 * (3 - 2) / 2.0;
  Vec<3> const pole = (1 / std::sqrt(dot(top.spin, top.spin))) * top.spin, axis{{0, 0, 1}};
  constexpr double dt = 1e-4;
  constexpr int steps = 10000;
  for (int k = 0; k < steps; ++k) top.drift(dt);
  double const angle = rate * dt * steps;
  Vec<3> const flat = axis - dot(axis, pole) * pole;
  Vec<3> const expected =
      dot(axis, pole) * pole + std::cos(angle) * flat + std::sin(angle) * cross(pole, flat);  // Rodrigues
  Mat<3> const R = matrix_of(top.turn);
  EXPECT_LT(largest(R * axis - expected), 1e-6);
  Vec<3> const own = transpose(R) * top.angular_velocity();
  EXPECT_LT(largest(own - Vec<3>{{0.8 * std::cos(along), 0.8 * std::sin(along), 4}}), 1e-6);
}

// About the middle axis, which flips again and again.
TEST(RigidBody, TumblesWithAllItsEnergyAndAngularMomentum) {
  RigidShape shape = brick();
  shape.angular_velocity = {Expression("1e-3"), Expression("1"), Expression("1e-3")};
  RigidBody body(shape, 3);
  ASSERT_NEAR(body.angular_velocity()[1], 1, 1e-15);
  double const energy = body.turning_energy();
  Vec<3> const L = body.spin;
  double worst = 0, lowest = 1;
  constexpr int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    body.drift(0.01);
    worst = std::max(worst, std::fabs(body.turning_energy() / energy - 1));
    lowest = std::min(lowest, (matrix_of(body.turn) * Vec<3>{{0, 1, 0}})[1]);
  }
  EXPECT_LT(worst, 1.5e-5);
  EXPECT_LT(lowest, -0.9) << "it has flipped";
  EXPECT_EQ(largest(body.spin - L), 0);
  Mat<3> const R = matrix_of(body.turn), unity = transpose(R) * R;
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(unity.c[k], k % 4 == 0 ? 1 : 0, 1e-14);
  for (int k = 0; k < steps; ++k) body.drift(-0.01);
  EXPECT_LT(largest(body.turn.v), 1e-10) << "steps of -dt undo steps of dt, up to rounding that grows at each flip";
}

TEST(RigidBody, SpinsOfBallsAndDiscsAreExact) {
  RigidShape ball = brick();
  ball.kind = RigidShape::Kind::sphere;
  ball.radius = 1;
  ball.angular_velocity = {Expression("0.3"), Expression("0.4"), Expression("1.2")};
  RigidBody body(ball, 3);
  for (int k = 0; k < 10; ++k) body.drift(0.1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rotation_vector(body.turn)[c], (Vec<3>{{0.3, 0.4, 1.2}})[c], 1e-14);
  ball.angular_velocity = {Expression(), Expression(), Expression("7")};
  RigidBody disc(ball, 2);
  for (int k = 0; k < 10; ++k) disc.drift(0.1);
  EXPECT_NEAR(disc.angle, 7, 1e-14);
  EXPECT_NEAR(disc.turn.v[2], std::sin(3.5), 1e-14);
}

TEST(RigidBody, KicksChangeMomentaUnlessDirectionsAreHeld) {
  RigidShape shape = brick();
  shape.held = {true, false, false};
  shape.velocity[0] = Expression("2");
  RigidBody body(shape, 3);
  body.kick({{3, 6, 9}}, {{1, 2, 3}});
  EXPECT_EQ(largest(body.velocity - Vec<3>{{2, 2, 3}}), 0);
  EXPECT_EQ(largest(body.spin - Vec<3>{{1, 2, 3}}), 0);
  shape.can_turn = false;
  RigidBody stiff(shape, 3);
  stiff.kick({}, {{1, 2, 3}});
  EXPECT_EQ(largest(stiff.angular_velocity()), 0);
  RigidBody flat(brick(), 2);
  flat.kick({{3, 3, 3}}, {{1, 2, 3}});
  EXPECT_EQ(largest(flat.velocity - Vec<3>{{1, 1, 0}}), 0);
  EXPECT_DOUBLE_EQ(flat.angular_velocity()[2], 1);
}

}  // namespace
}  // namespace piola::contact
