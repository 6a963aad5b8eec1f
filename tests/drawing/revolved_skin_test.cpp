// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/revolved_skin.hpp"
#include "piola/drawing/reference_mesh.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/drawing/revolved_outline.hpp"
#include "piola/drawing/revolved_shapes.hpp"
#include "piola/drawing/vector_math.hpp"
#include "drawing/drawn_shapes.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace piola {
namespace {

using Placement = ShapeSpec::Placement;
constexpr double pi = std::numbers::pi;

struct Section {
  ParticleSet set;
  ReferenceMesh mesh;
  explicit Section(ShapeSpec const& shape) {
    set.dimension = 2;
    set.axisymmetric = true;
    fill(shape, "b", set);
    mesh = reference_mesh(set, set.bodies.front());
  }
  Skin skin() const { return make_skin(mesh, {mesh.X, {}}); }
  Skin swept(double degrees) const { return revolved(skin(), degrees, width_of_axis(mesh.X, mesh.spacing)); }
};

/// A half section of a cylinder of radius 1 and height 2, or with `low` of a tube.
ShapeSpec cylinder(Placement placement, double low = 0) {
  ShapeSpec shape = testing::drawn_box(4, placement, 2);
  shape.axisymmetric = true;
  shape.min = {low, 0, 0};
  shape.max = {low + 1, 2, 0};
  shape.particles = {4, 8, 1};
  return shape;
}

ShapeSpec disc(double centre) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.dimension = 2;
  shape.axisymmetric = true;
  shape.centre = {centre, 0, 0};
  shape.radius = 1;
  shape.spacing = 0.125;
  return shape;
}

double area(Skin const& skin, auto const& counts) {
  double sum = 0;
  for (SkinFacet const& f : skin.facets) {
    auto const at = [&](std::size_t c) { return skin.place[static_cast<std::size_t>(f.corner[c])]; };
    if (counts(f)) sum += length(cross(minus(at(1), at(0)), minus(at(2), at(0)))) / 2;
  }
  return sum;
}
double area(Skin const& skin) {
  return area(skin, [](SkinFacet const&) { return true; });
}

/// Whether each edge belongs to two triangles.
bool is_closed(Skin const& skin) {
  using Place = std::array<long, 3>;
  auto const place = [&](Index c) {
    Place p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = std::lround(1e7 * skin.place[static_cast<std::size_t>(c)][k]);
    return p;
  };
  std::map<std::array<Place, 2>, int> edges;
  for (SkinFacet const& f : skin.facets)
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<Place, 2> ends{place(f.corner[c]), place(f.corner[(c + 1) % 3])};
      std::sort(ends.begin(), ends.end());
      ++edges[ends];
    }
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [](auto const& e) { return e.second == 2; });
}

TEST(RevolvedSkin, OfARectangleIsACylinder) {
  constexpr double half = pi / 72;  // 72 segments
  double const side = 72 * 2 * std::sin(half) * 2, end = 36 * std::sin(2 * half);
  for (auto const placement : {Placement::on_boundary, Placement::cell_centred}) {
    Section const s(cylinder(placement));
    Skin const whole = s.swept(360), open = s.swept(270);
    EXPECT_NEAR(area(whole), side + 2 * end, 1e-6);
    EXPECT_NEAR(area(open), 0.75 * (side + 2 * end) + 2 * 2, 1e-6);
    EXPECT_TRUE(is_closed(whole));
    EXPECT_TRUE(is_closed(open));
    EXPECT_EQ(whole.inside.size(), s.mesh.count);
  }
}

TEST(RevolvedSkin, IsClosedForTubesBallsAndTori) {
  EXPECT_TRUE(is_closed(Section(cylinder(Placement::cell_centred, 0.5)).swept(360)));
  EXPECT_TRUE(is_closed(Section(disc(0)).swept(360)));
  EXPECT_TRUE(is_closed(Section(disc(0)).swept(90)));
  EXPECT_TRUE(is_closed(Section(disc(2)).swept(270)));
  EXPECT_NEAR(area(Section(disc(2)).swept(360)), 2 * pi * 2 * 2 * pi, 0.02 * 8 * pi * pi);
}

TEST(RevolvedSkin, HasTheNormalsOfABallAtItsPoles) {
  Skin const ball = Section(disc(0)).swept(360);
  for (SkinFacet const& f : ball.facets)
    for (std::size_t c = 0; c < 3; ++c) {
      Point3 const x = ball.place[static_cast<std::size_t>(f.corner[c])];
      EXPECT_GT(dot(f.normal[c], unit(x)), 0.98);
      bool const pole = x[0] == 0 && x[2] == 0;
      EXPECT_NEAR(pole ? std::abs(f.normal[c][1]) : 1, 1, 1e-12);
    }
}

TEST(RevolvedSkin, OfASectionInThePlaneMeetsItsMirrorImageOnTheAxis) {
  for (auto const placement : {Placement::on_boundary, Placement::cell_centred}) {
    Skin const skin = Section(cylinder(placement)).swept(0);
    EXPECT_NEAR(area(skin), 4, 1e-9);
    std::size_t const n = skin.place.size() / 2;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(skin.particle_of(i), i);
      EXPECT_EQ(skin.particle_of(i + n), i);
      EXPECT_EQ(skin.place[i][0], -skin.place[i + n][0]);
      EXPECT_EQ(skin.place[i][1], skin.place[i + n][1]);
    }
    EXPECT_EQ(std::count_if(skin.place.begin(), skin.place.end(), [](Point3 const& p) { return p[0] == 0; }), 16);
  }
}

RigidShape rigid(std::string const& name, RigidShape::Kind kind, Point3 const& centre) {
  RigidShape shape;
  shape.name = name;
  shape.kind = kind;
  shape.centre = centre;
  shape.axis = {0, 1, 0};
  shape.half_lengths = {0.5, 1, 0};
  shape.radius = 0.5;
  return shape;
}

TEST(RevolvedSkin, OfRigidShapesIsClosed) {
  Stage const stage{{-1, -1, -1}, {1, 1, 1}};
  RigidShape const ball = rigid("ball", RigidShape::Kind::sphere, {}),
                   plane = rigid("floor", RigidShape::Kind::plane, {}),
                   ring = rigid("ring", RigidShape::Kind::box, {2, 0, 0});
  for (RigidShape const& shape : {ball, plane, ring}) {
    EXPECT_TRUE(is_closed(revolved(shape, stage, 360))) << shape.name;
    EXPECT_TRUE(is_closed(revolved(shape, stage, 200))) << shape.name;
  }
  EXPECT_NEAR(area(revolved(ball, stage, 360)), pi, 0.01);
  for (Point3 const& p : revolved(plane, stage, 360).place) EXPECT_LE(p[1], 0);
  std::array const shapes{ball, plane, ring};
  auto const all = with_mirror_images(shapes);
  ASSERT_EQ(all.size(), 4U);  // one on the axis is drawn once
  EXPECT_EQ(all[3].centre[0], -2);
}

TEST(RevolvedOutline, HasTheEdgesOfACylinderWithoutItsAxis) {
  Section const s(cylinder(Placement::cell_centred));
  Projection const from_z{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  auto const plane = revolved_outline(s.mesh, 0, from_z);
  ASSERT_EQ(plane.size(), 2U);
  for (Polyline const& line : plane)
    for (std::size_t k = 0; k + 1 < line.size(); ++k) EXPECT_FALSE(line[k][0] == 0 && line[k + 1][0] == 0);
  auto const whole = revolved_outline(s.mesh, 360, from_z);
  EXPECT_EQ(whole.size(), 4U);  // two circles, and what is seen at the left and the right
}

TEST(Revolution, GivesBallsTheSizeOfTheirCell) {
  for (auto const placement : {Placement::on_boundary, Placement::cell_centred}) {
    Section const s(cylinder(placement));
    auto const radii = ball_radii_of_rings(s.set.volume, s.set.X.seen(), s.set.body);
    auto const& spacing = s.set.bodies.front().spacing;
    for (double const r : radii) EXPECT_NEAR(r, 0.72 * std::sqrt(spacing[0] * spacing[1]), 1e-9);
  }
}

TEST(Revolution, TakesTheAnglesOfASweep) {
  EXPECT_EQ(angles_of_sweep(0, 5), (std::vector<double>{0, 180}));
  EXPECT_EQ(angles_of_sweep(270, 90), (std::vector<double>{0, 90, 180, 270}));
  EXPECT_EQ(angles_of_sweep(3, 5).size(), 4U);
  std::array<Point3, 1> const points{{{2, 1, 0}}};
  RevolvedPoints const both = revolved({.points = points}, 0);
  EXPECT_EQ(both.points, (std::vector<Point3>{{2, 1, 0}, {-2, 1, 0}}));
}

}  // namespace
}  // namespace piola
