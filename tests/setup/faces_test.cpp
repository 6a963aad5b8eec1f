// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/faces.hpp"
#include "piola/setup/cracks.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace piola {
namespace {

ShapeSpec box(int dimension, std::array<int, 3> particles, ShapeSpec::Placement placement) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.max = {0.3, 1.7, 0.9};
  shape.particles = particles;
  shape.placement = placement;
  return shape;
}

double area_of(ShapeSpec const& shape, Face const& face) {
  ParticleSet set;
  fill(shape, "body", set);
  double area = 0;
  for (std::int64_t const id : face_particles(set, set.bodies[0], face)) area += face_area(shape, set, id, face);
  return area;
}

TEST(Faces, AreNamedBySignAndAxis) {
  EXPECT_EQ(face_text({}, {0, false}), "-x");
  EXPECT_EQ(face_text({}, {2, true}), "+z");
}

TEST(Faces, TributaryAreasSumToTheFaceInEveryDimension) {
  std::array<double, 3> const length{0.3, 1.7, 0.9};
  for (auto const placement : {ShapeSpec::Placement::on_boundary, ShapeSpec::Placement::cell_centred}) {
    for (auto const particles : {std::array{4, 7, 5}, std::array{2, 3, 1}}) {
      for (int dimension = 1; dimension <= 3; ++dimension) {
        for (int axis = 0; axis < dimension; ++axis) {
          double exact = 1;
          for (int d = 0; d < dimension; ++d) exact *= d == axis ? 1 : length[static_cast<std::size_t>(d)];
          for (bool const upper : {false, true})
            EXPECT_NEAR(area_of(box(dimension, particles, placement), {axis, upper}), exact, 1e-14 * exact);
        }
      }
    }
  }
}

TEST(Faces, TheOutermostLayerIsTheFace) {
  ShapeSpec const shape = box(3, {3, 4, 5}, ShapeSpec::Placement::on_boundary);
  ParticleSet set;
  fill(shape, "first", set);
  fill(shape, "second", set);
  auto const ids = face_particles(set, set.bodies[1], {1, true});
  ASSERT_EQ(ids.size(), 15u);
  for (std::int64_t const id : ids) {
    EXPECT_GE(id, 60);
    EXPECT_EQ(set.X[static_cast<std::size_t>(id)][1], 1.7);
  }
}

struct Total {
  double area = 0;
  std::array<double, 3> resultant{};  ///< of a pressure of 1 Pa
};
Total total_of(ShapeSpec const& shape, Face const& face) {
  ParticleSet set;
  fill(shape, "body", set);
  Total t;
  for (FaceWeight const& share : face_weights(shape, set, set.bodies[0], face)) {
    EXPECT_GT(share.area, 0);
    t.area += share.area;
    for (std::size_t c = 0; c < 3; ++c) t.resultant[c] -= share.area * share.normal[c];
  }
  return t;
}
void expect_closed(ShapeSpec const& shape, Face const& face, double area) {
  Total const t = total_of(shape, face);
  EXPECT_NEAR(t.area, area, 1e-13 * area);
  for (double const f : t.resultant) EXPECT_NEAR(f, 0, 1e-13 * area);
}

TEST(Faces, CurvedOnesHaveTheExactAreaAndNoResultantOfAPressure) {
  constexpr double pi = std::numbers::pi, R = 0.7, r = 0.31, L = 0.9;
  Face const outer{0, false, Face::Part::outer}, inner{0, false, Face::Part::inner};
  EXPECT_EQ(face_text({}, outer), "outer");
  EXPECT_EQ(face_text({}, inner), "inner");
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.centre = {0.3, -2, 1};
  shape.radius = R;
  shape.inner_radius = r;
  shape.spacing = 0.1;
  for (shape.dimension = 2; shape.dimension <= 3; ++shape.dimension) {
    auto const area = [&](double radius) { return shape.dimension == 2 ? 2 * pi * radius : 4 * pi * radius * radius; };
    expect_closed(shape, outer, area(R));
    expect_closed(shape, inner, area(r));
  }
  shape.dimension = 2;
  shape.arrangement = ShapeSpec::Arrangement::rings;
  expect_closed(shape, outer, 2 * pi * R);
  expect_closed(shape, inner, 2 * pi * r);
  shape.inner_radius = 0;
  expect_closed(shape, outer, 2 * pi * R);
  shape = {};
  shape.kind = ShapeSpec::Kind::cylinder;
  shape.radius = R;
  shape.inner_radius = r;
  shape.length = L;
  shape.spacing = 0.1;
  for (int axis = 0; axis < 3; ++axis)
    for (auto const placement : {ShapeSpec::Placement::on_boundary, ShapeSpec::Placement::cell_centred}) {
      shape.axis = axis;
      shape.placement = placement;
      expect_closed(shape, outer, 2 * pi * R * L);
      expect_closed(shape, inner, 2 * pi * r * L);
      for (bool const upper : {false, true}) {
        Total const end = total_of(shape, {axis, upper});
        EXPECT_NEAR(end.area, pi * (R * R - r * r), 1e-13);
        EXPECT_NEAR(end.resultant[static_cast<std::size_t>(axis)], (upper ? -1 : 1) * pi * (R * R - r * r), 1e-13);
      }
    }
}

// The upper half of a ball feels p pi R^2, as a plane through its middle would.
TEST(Faces, HalfOfABallBearsThePressureOfItsSection) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.radius = 1;
  shape.spacing = 0.08;
  ParticleSet set;
  fill(shape, "body", set);
  double up = 0;
  for (FaceWeight const& share : face_weights(shape, set, set.bodies[0], {0, false, Face::Part::outer}))
    if (share.normal[2] > 0) up += share.area * share.normal[2];
  EXPECT_NEAR(up / std::numbers::pi, 1, 0.02);
}

// A crack from the middle of the face -x, whose particle there becomes two.
TEST(Faces, TheFacesOfACrackShareTheAreaWhereItOpens) {
  ShapeSpec const shape = box(2, {7, 5, 1}, ShapeSpec::Placement::on_boundary);
  ParticleSet set;
  fill(shape, "body", set);
  open_crack(set, 0, {0, 0.85, 0}, {0.15, 0.85, 0});
  auto const ids = face_particles(set, set.bodies[0], {0, false});
  ASSERT_EQ(ids.size(), 6u);
  double area = 0;
  for (std::int64_t const id : ids) area += face_area(shape, set, id, {0, false});
  EXPECT_NEAR(area, 1.7, 1e-15);
  EXPECT_DOUBLE_EQ(face_area(shape, set, ids.back(), {0, false}), 1.7 / 8);
}

TEST(Faces, AreasAreHalvedAtEdgesAndQuarteredAtCorners) {
  ShapeSpec const shape = box(3, {3, 4, 5}, ShapeSpec::Placement::on_boundary);
  ParticleSet set;
  fill(shape, "body", set);
  double const cell = 0.15 * (0.9 / 4);
  auto const ids = face_particles(set, set.bodies[0], {1, false});
  EXPECT_DOUBLE_EQ(face_area(shape, set, ids[0], {1, false}), cell / 4);  // corner
  EXPECT_DOUBLE_EQ(face_area(shape, set, ids[1], {1, false}), cell / 2);  // edge
  EXPECT_DOUBLE_EQ(face_area(shape, set, ids[4], {1, false}), cell);      // inside
}

}  // namespace
}  // namespace piola
