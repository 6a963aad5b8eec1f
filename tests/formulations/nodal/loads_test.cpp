// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/faces.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include <numbers>

namespace piola::testing {
namespace {

/// A pressure on a face, as build.cpp makes it.
void press(Assembly& a, ShapeSpec const& shape, Face const& face, double pressure, bool follows) {
  Load load;
  load.value = {Expression(std::to_string(pressure)), Expression("0"), Expression("0")};
  load.pressure = true;
  load.follows = follows;
  for (auto const& share : face_weights(shape, a.particles, a.particles.bodies[0], face)) {
    load.particles.push_back(share.particle);
    auto const id = static_cast<std::size_t>(share.particle);
    load.factor.push_back(share.area / (rubber().value[0] * a.particles.volume[id]));
    if (face.part == Face::Part::flat)
      load.normal = share.normal;
    else
      load.normals.push_back(share.normal);
  }
  a.loads.push_back(load);
}

/// x = s R X, R a rotation in the first two directions.
void swell(Assembly& a, double s, double angle) {
  double const c = s * std::cos(angle), r = s * std::sin(angle);
  int const D = a.particles.dimension;
  displace(a, [&](Point const& X) {
    Point u{(D == 1 ? s - 1 : c - 1) * X[0], 0, 0};
    if (D > 1) u = {(c - 1) * X[0] - r * X[1], r * X[0] + (c - 1) * X[1], 0};
    if (D > 2) u[2] = (s - 1) * X[2];
    return u;
  });
}

/// Pressure [Pa] of the law at the stretch s along all three axes.
double pressure_at(double s) {
  Mat<3> F = identity<3>();
  for (int c = 0; c < 3; ++c) F(c, c) = s;
  return -NeoHookean(rubber().value).pressure(F);
}

ShapeSpec box_shape(Cloud const& cloud) {
  ShapeSpec shape;
  shape.min = {-0.2, 0.1, 0};
  shape.max = {0.7, 1.3, 1.1};
  shape.particles = {4, 5, 6};
  shape.jitter = cloud.jitter;
  shape.seed = cloud.seed;
  return shape;
}

Assembly body_of(ShapeSpec const& shape) {
  ParticleSet set;
  fill(shape, "body", set);
  Assembly a = nodal_body(std::move(set));
  a.cfl = 0.1;
  return a;
}

TEST(NodalPressure, ThatFollowsAFaceHoldsASwollenAndTurnedBoxInBalance) {
  for (Cloud const& cloud : clouds()) {
    auto const shape = box_shape(cloud);
    Assembly a = body_of(shape);
    swell(a, 1.2, 0.9);
    double const without = largest(forces(a));
    for (int axis = 0; axis < 3; ++axis)
      for (bool const upper : {false, true}) press(a, shape, {axis, upper}, pressure_at(1.2), true);
    EXPECT_LT(largest(forces(a)), 1e-10 * without) << cloud.jitter << " " << cloud.seed;
    for (auto& load : a.loads) load.follows = false;
    EXPECT_GT(largest(forces(a)), 0.3 * without) << "a dead pressure does not turn";
  }
}

TEST(NodalPressure, OnCurvedFacesHoldsBallsAndTubesInBalance) {
  ShapeSpec ball;
  ball.kind = ShapeSpec::Kind::sphere;
  ball.placement = ShapeSpec::Placement::cell_centred;
  ball.radius = 1;
  ball.spacing = 0.25;
  ShapeSpec tube = ball;
  tube.kind = ShapeSpec::Kind::cylinder;
  tube.inner_radius = 0.3;
  tube.length = 1.5;
  tube.axis = 1;
  tube.spacing = 0.2;
  ShapeSpec disc = ball;
  disc.dimension = 2;
  disc.arrangement = ShapeSpec::Arrangement::rings;
  for (auto const& shape : {ball, tube, disc}) {
    Assembly a = body_of(shape);
    // In the plane nothing stretches across: the pressure of that state is what the law gives there.
    Mat<3> F = identity<3>();
    for (int c = 0; c < shape.dimension; ++c) F(c, c) = 1.1;
    Mat<3> const P = NeoHookean(rubber().value).first_piola(F);
    double const pressure = -P(0, 0) / (shape.dimension == 2 ? 1.1 : 1.1 * 1.1);
    swell(a, 1.1, shape.dimension == 3 ? 0 : 0.4);
    double const without = largest(forces(a));
    press(a, shape, {0, false, Face::Part::outer}, pressure, true);
    if (shape.kind == ShapeSpec::Kind::cylinder) {
      press(a, shape, {0, false, Face::Part::inner}, pressure, true);
      for (bool const upper : {false, true}) press(a, shape, {1, upper}, pressure, true);
    }
    EXPECT_LT(largest(forces(a)), 5e-3 * without) << shape.dimension << static_cast<int>(shape.kind);
  }
}

TEST(NodalTraction, OnACurvedFaceActsOnTheAreaOfTheExactSurface) {
  ShapeSpec tube;
  tube.kind = ShapeSpec::Kind::cylinder;
  tube.placement = ShapeSpec::Placement::cell_centred;
  tube.radius = 1;
  tube.length = 1;
  tube.spacing = 0.2;
  Assembly a = body_of(tube);
  press(a, tube, {0, false, Face::Part::outer}, 1000, false);
  a.loads[0].pressure = false;  // along x, everywhere the same
  double sum = 0;
  for (auto const& f : forces(a)) sum += f[0];
  EXPECT_NEAR(sum, 1000 * 2 * std::numbers::pi, 0.02 * 1000 * 2 * std::numbers::pi);
}

TEST(NodalPressure, ThatFollowsAFaceDoesTheWorkThatItBooks) {
  auto const shape = box_shape({0.2, 6});
  Assembly a = body_of(shape);
  press(a, shape, {0, true}, 4e5, true);
  press(a, shape, {1, false}, 2e5, true);
  give_velocity(a, [](Point const& X) { return Point{-10 * X[1], 10 * X[0], 0}; });
  auto const f = make_formulation(a);
  double const start = f->diagnose().total_energy();
  for (int k = 0; k < 200; ++k) f->step(k * 2e-4, 2e-4);
  auto const end = f->diagnose();
  EXPECT_GT(std::fabs(end.external_work), 0.1 * start);
  EXPECT_NEAR(end.total_energy() - end.external_work, start, 2e-3 * std::fabs(end.external_work));
}

TEST(NodalLoads, OfOneBodyLeaveTheOthersAlone) {
  auto const shape = box_shape({});
  ParticleSet set;
  fill(shape, "first", set);
  ShapeSpec beside = shape;
  beside.min[0] += 3;
  beside.max[0] += 3;
  fill(beside, "second", set);
  Assembly a = nodal_body(std::move(set));
  a.cfl = 0.1;
  press(a, shape, {0, true}, 1e5, true);
  auto const f = make_formulation(a);
  for (int k = 0; k < 20; ++k) f->step(k * 1e-4, 1e-4);
  auto const u = sample(*f, "Displacement", a.particles.X.size());
  auto const second = static_cast<std::size_t>(a.particles.bodies[1].first);
  EXPECT_GT(largest(Values(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(3 * second))), 1e-4);
  EXPECT_LT(largest(Values(u.begin() + static_cast<std::ptrdiff_t>(3 * second), u.end())), 1e-12);
}

}  // namespace
}  // namespace piola::testing
