// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/solids_of_revolution.hpp"
#include "piola/geometry/primitives.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <gtest/gtest.h>
#include <memory>
#include <numbers>

namespace piola {
namespace {

constexpr double pi = std::numbers::pi;

ShapeSpec section(std::array<double, 3> low, std::array<double, 3> high, ShapeSpec::Placement placement) {
  ShapeSpec shape;
  shape.dimension = 2;
  shape.axisymmetric = true;
  shape.min = low;
  shape.max = high;
  shape.particles = {5, 7, 1};
  shape.placement = placement;
  return shape;
}
ShapeSpec disc(double centre, double spacing, double inner = 0) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.dimension = 2;
  shape.axisymmetric = true;
  shape.centre = {centre, 0.3, 0};
  shape.radius = 1;
  shape.inner_radius = inner;
  shape.spacing = spacing;
  return shape;
}
ShapeSpec packed_disc(double centre, double spacing) {
  ShapeSpec shape = disc(centre, spacing);
  shape.kind = ShapeSpec::Kind::solid;
  shape.arrangement = ShapeSpec::Arrangement::packed;
  shape.solid = geometry::ball({{centre, 0.3, 0}}, 1, 0, 2);
  shape.solid_particles = std::make_shared<SolidParticles>();
  shape.volume = pi;
  cut_at_axis(shape);
  return shape;
}

ParticleSet filled(ShapeSpec const& shape) {
  ParticleSet set;
  set.axisymmetric = true;
  fill(shape, "body", set);
  return set;
}
double volume_of(ParticleSet const& set) {
  double sum = 0;
  for (double const v : set.volume) sum += v;
  return sum;
}
double area_of(ShapeSpec const& shape, Face const& face) {
  ParticleSet const set = filled(shape);
  double sum = 0;
  for (FaceWeight const& weight : face_weights(shape, set, set.bodies[0], face)) sum += weight.area;
  return sum;
}

TEST(SolidsOfRevolution, CylindersAndTubesHaveTheirVolumesAndAreas) {
  for (auto const placement : {ShapeSpec::Placement::on_boundary, ShapeSpec::Placement::cell_centred})
    for (double const low : {0.0, 0.7}) {
      ShapeSpec const shape = section({low, 0.2, 0}, {2, 3.2, 0}, placement);
      double const end = pi * (4 - low * low);
      EXPECT_NEAR(volume_of(filled(shape)), 3 * end, 1e-12);
      EXPECT_NEAR(area_of(shape, {1, true}), end, 1e-12);
      EXPECT_NEAR(area_of(shape, {1, false}), end, 1e-12);
      EXPECT_NEAR(area_of(shape, {0, true}), 4 * pi * 3, 1e-12);
      EXPECT_NEAR(area_of(shape, {0, false}), 2 * pi * low * 3, 1e-12);
    }
}

TEST(SolidsOfRevolution, JitterLeavesVolumesAndAreasAsTheyAre) {
  ShapeSpec shape = section({0, 0, 0}, {2, 3, 0}, ShapeSpec::Placement::cell_centred);
  shape.jitter = 0.3;
  EXPECT_NEAR(volume_of(filled(shape)), 12 * pi, 1e-12);
  EXPECT_NEAR(area_of(shape, {1, true}), 4 * pi, 1e-12);
}

TEST(SolidsOfRevolution, BallsAreCutAtTheAxisAndTouchNothingBeyond) {
  for (double const spacing : {0.1, 2.0 / 21}) {  // beside the axis, and on it
    ShapeSpec const ball = disc(0, spacing);
    ParticleSet const set = filled(ball);
    double least = 1;
    for (auto const& X : set.X.seen()) least = std::min(least, X[0]);
    EXPECT_NEAR(least, spacing == 0.1 ? 0.05 : 0, 1e-12);
    EXPECT_NEAR(volume_of(set) / (4 * pi / 3), 1, 0.02) << "a staircase";
    EXPECT_NEAR(area_of(ball, {0, false, Face::Part::outer}), 4 * pi, 1e-12);
  }
  EXPECT_NEAR(volume_of(filled(disc(0, 0.05, 0.5))) / (4 * pi / 3 * 0.875), 1, 0.02);
  EXPECT_NEAR(volume_of(filled(disc(3, 0.05))) / (2 * pi * 3 * pi), 1, 0.02);
  EXPECT_NEAR(area_of(disc(3, 0.1), {0, false, Face::Part::outer}), 2 * pi * 3 * 2 * pi, 1e-9);
}

TEST(SolidsOfRevolution, PackedBallsHaveTheExactVolumeAndSurface) {
  ShapeSpec const ball = packed_disc(0, 0.2);
  ParticleSet const set = filled(ball);
  for (auto const& X : set.X.seen()) EXPECT_GT(X[0], 0);
  EXPECT_NEAR(volume_of(set), 4 * pi / 3, 1e-3);
  double surface = 0;
  for (PatchWeight const& part : patch_weights(ball, set, set.bodies[0])) surface += part.area;
  EXPECT_NEAR(surface, 4 * pi, 2e-2);
  EXPECT_NEAR(volume_of(filled(packed_disc(2, 0.2))), 2 * pi * 2 * pi, 1e-2);
}

TEST(SolidsOfRevolution, CellsHaveTheVolumesAndCentroidsOfRings) {
  ShapeSpec shape = section({0, 0, 0}, {2, 3, 0}, ShapeSpec::Placement::on_boundary);
  for (double const jitter : {0.0, 0.3}) {
    shape.jitter = jitter;
    ParticleSet const set = filled(shape);
    auto const cells = measure_cells(set, set.bodies[0]).cell;
    // int 2 pi R (1, R, Z, RR, RZ, ZZ) over the section
    std::array<double, 6> sum{};
    for (std::size_t a = 0; a < cells.size(); ++a) {
      double const V = cells[a].volume, R = set.X[a][0] + cells[a].centroid[0], Z = set.X[a][1] + cells[a].centroid[1];
      std::array const part{V,
                            V * R,
                            V * Z,
                            V * (R * R + cells[a].spread[0]),
                            V * (R * Z + cells[a].spread[5]),
                            V * (Z * Z + cells[a].spread[1])};
      for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += part[m];
    }
    std::array const exact{12 * pi, 16 * pi, 18 * pi, 24 * pi, 24 * pi, 36 * pi};
    for (std::size_t m = 0; m < sum.size(); ++m) EXPECT_NEAR(sum[m], exact[m], 1e-11) << m;
  }
}

}  // namespace
}  // namespace piola
