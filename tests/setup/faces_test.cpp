// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/faces.hpp"
#include "piola/setup/cracks.hpp"
#include <gtest/gtest.h>

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
  EXPECT_EQ(face_text({0, false}), "-x");
  EXPECT_EQ(face_text({2, true}), "+z");
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
