// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/skin.hpp"
#include "piola/drawing/feature_lines.hpp"
#include "piola/drawing/vector_math.hpp"
#include "drawing/drawn_shapes.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Subject {
  ParticleSet set;
  ReferenceMesh mesh;
  std::vector<Point3> x;
  explicit Subject(ShapeSpec const& shape) {
    set.dimension = shape.dimension;
    fill(shape, "b", set);
    mesh = reference_mesh(set, set.bodies.front());
    x = mesh.X;
  }
  Configuration now() const { return {x, {}}; }
  Skin skin() const { return make_skin(mesh, now()); }
};

using testing::drawn_box;

ShapeSpec cylinder() { return testing::drawn_cylinder(1, 3, 0.2); }
ShapeSpec disc() { return testing::drawn_rings(1, 0.1); }

double area(Skin const& skin) {
  double sum = 0;
  for (SkinFacet const& f : skin.facets) {
    auto const at = [&](std::size_t c) { return skin.place[static_cast<std::size_t>(f.corner[c])]; };
    sum += length(cross(minus(at(1), at(0)), minus(at(2), at(0)))) / 2;
  }
  return sum;
}

/// The volume within a closed surface whose facets are seen from outside against the clock.
double volume(Skin const& skin) {
  double sum = 0;
  for (SkinFacet const& f : skin.facets) {
    auto const at = [&](std::size_t c) { return skin.place[static_cast<std::size_t>(f.corner[c])]; };
    sum += dot(at(0), cross(at(1), at(2))) / 6;
  }
  return sum;
}

TEST(Skin, IsTheSurfaceOfABox) {
  for (auto const placement : {ShapeSpec::Placement::on_boundary, ShapeSpec::Placement::cell_centred}) {
    Subject const s(drawn_box(4, placement));
    EXPECT_NEAR(area(s.skin()), 7, 1e-9);
    EXPECT_NEAR(volume(s.skin()), 1, 1e-9);
    auto const inside = s.skin().inside;
    EXPECT_TRUE(std::all_of(inside.begin(), inside.end(), [](auto i) { return i != 0; }));
  }
}

TEST(Skin, FillsABodyOfTwoDimensions) {
  for (auto const placement : {ShapeSpec::Placement::on_boundary, ShapeSpec::Placement::cell_centred})
    EXPECT_NEAR(area(Subject(drawn_box(4, placement, 2)).skin()), 2, 1e-9);
  EXPECT_NEAR(area(Subject(disc()).skin()), pi, 0.01 * pi) << "triangles between rings";
}

TEST(Skin, ReachesTheSurfaceOfARoundBody) {
  Subject const s(cylinder());
  Skin const skin = s.skin();
  EXPECT_NEAR(area(skin), 2 * pi + 6 * pi, 0.03 * 8 * pi);
  EXPECT_NEAR(volume(skin), 3 * pi, 0.04 * 3 * pi);
  for (SkinFacet const& f : skin.facets)
    for (Index const c : f.corner) {
      Point3 const& x = skin.place[static_cast<std::size_t>(c)];
      double const across = std::abs(std::hypot(x[0], x[1]) - 1), along = std::min(std::abs(x[2]), std::abs(x[2] - 3));
      EXPECT_LT(std::min(across, along), 0.01 * 0.2);
    }
}

TEST(Skin, FollowsALinearMotion) {
  Subject s(drawn_box(4, ShapeSpec::Placement::cell_centred));
  Mat<3> F = identity<3>();
  F(0, 1) = 0.7;
  F(1, 1) = 1.5;
  F(2, 0) = -0.3;
  for (Point3& x : s.x) {
    Vec<3> const y = F * Vec<3>{{x[0], x[1], x[2]}};
    x = {y[0], y[1], y[2]};
  }
  Skin const skin = s.skin();
  EXPECT_NEAR(volume(skin), 1.5, 1.5e-3);
  Mat<3> const fitted = fitted_gradient(s.mesh, s.now(), 17);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(fitted.c[k], F.c[k], 1e-3);
}

TEST(Skin, HasNormalsThatAreSmoothButForEdges) {
  Subject const s(cylinder());
  Skin const skin = s.skin();
  for (SkinFacet const& f : skin.facets)
    for (std::size_t c = 0; c < 3; ++c) {
      Point3 const& x = skin.place[static_cast<std::size_t>(f.corner[c])];
      bool const end = std::abs(f.normal[c][2]) > 0.5;
      double const outward =
          end ? f.normal[c][2] * (x[2] > 1.5 ? 1 : -1) : f.normal[c][0] * x[0] + f.normal[c][1] * x[1];
      EXPECT_GT(outward, 0.93) << x[0] << " " << x[1] << " " << x[2];
    }
}

TEST(Skin, OpensWhereParticlesHaveParted) {
  Subject s(drawn_box(4, ShapeSpec::Placement::on_boundary));
  double const half = 1, step = 2.0 / 15;
  std::size_t moved = 0;
  for (Point3& x : s.x)
    if (x[0] > half) {
      x[0] += 2 * step;  // so that edges are three times as long
      ++moved;
    }
  ASSERT_EQ(moved, s.x.size() / 2);
  EXPECT_NEAR(volume(s.skin()), 1, 1e-9) << "both parts end half a cell beyond their last particles";
  EXPECT_NEAR(area(s.skin()), 7 + 2 * 0.5, 1e-9) << "two faces more";
}

TEST(Skin, LosesNoMaterialAtAnObliqueTear) {
  for (auto const placement : {ShapeSpec::Placement::on_boundary, ShapeSpec::Placement::cell_centred}) {
    Subject s(drawn_box(8, placement, 2));
    for (Point3& x : s.x)
      if (x[0] + 0.7 * x[1] > 1.31) x = plus(x, 3 * s.mesh.spacing, {1, 0.7, 0});
    ASSERT_GT(torn_cells(s.mesh, s.now(), {}).size(), 8U);
    Skin const skin = s.skin();
    double alone = 0;  // what belongs to no whole cell is a ball
    for (std::size_t i = 0; i < s.x.size(); ++i) alone += skin.inside[i] == 0 ? s.set.volume[i] : 0;
    EXPECT_LT(alone, 0.01);
    EXPECT_NEAR(area(skin) + alone, 2, 1e-3) << "teeth of one side fit the gaps of the other";
  }
}

TEST(Skin, LeavesNoGapWhereNothingHasOpened) {
  Subject const s(drawn_box(4, ShapeSpec::Placement::cell_centred));
  std::vector<std::uint8_t> loose(s.x.size(), 0);
  for (std::size_t i = 0; i < loose.size(); ++i) loose[i] = s.x[i][0] > 1;  // Eulerian now, and where they were
  Skin const skin = make_skin(s.mesh, {s.x, loose});
  EXPECT_NEAR(volume(skin), 0.5, 1e-9) << "the half that is whole, up to the middle between it and the other";
}

/// The places under a linear motion.
void move(Subject& s, Mat<3> const& F) {
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    Vec<3> const y = F * Vec<3>{{s.mesh.X[i][0], s.mesh.X[i][1], s.mesh.X[i][2]}};
    s.x[i] = {y[0], y[1], y[2]};
  }
}

TEST(Skin, StaysClosedWhereMaterialFlows) {
  Mat<3> F = identity<3>();
  F(0, 0) = 4;
  F(1, 1) = F(2, 2) = 0.5;
  ShapeSpec packed = drawn_box(4, ShapeSpec::Placement::cell_centred);
  Subject lattice(packed), simplices(packed);
  simplices.set.bodies.front().off_lattice = true;  // Delaunay's cells, the flat ones among them
  for (std::size_t i = 0; i < simplices.set.X.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      simplices.set.X[i][c] += 0.02 * simplices.mesh.spacing * std::sin(7.0 * static_cast<double>(i * (c + 1)));
  simplices.mesh = reference_mesh(simplices.set, simplices.set.bodies.front());
  for (Subject* s : {&lattice, &simplices}) {
    move(*s, F);
    EXPECT_TRUE(torn_cells(s->mesh, s->now(), {}).empty()) << s->mesh.cells.corners;
    EXPECT_NEAR(volume(s->skin()), 1, 0.02) << "outer corners follow what is drawn out, too";
  }
  Mat<3> open = F;
  open(1, 1) = 1.1;  // 2.2 times the volume: no metal and no rubber, but a gap
  move(lattice, open);
  EXPECT_EQ(torn_cells(lattice.mesh, lattice.now(), {}).size(), static_cast<std::size_t>(lattice.mesh.cells.count()));
}

TEST(Skin, OpensWhereOneParticleFliesOff) {
  Subject s(drawn_box(4, ShapeSpec::Placement::on_boundary));
  s.x.back() = plus(s.x.back(), 2 * s.mesh.spacing, {1, 1, 1});
  EXPECT_EQ(torn_cells(s.mesh, s.now(), {}), std::vector<Index>{s.mesh.cells.count() - 1}) << "the cell at the corner";
}

TEST(Skin, OpensWhereItIsShearedOff) {
  Subject s(drawn_box(4, ShapeSpec::Placement::on_boundary));
  auto const sheared = [&](double by) {
    Mat<3> F = identity<3>();
    F(0, 1) = by;
    move(s, F);
    return s.now();
  };
  EXPECT_TRUE(torn_cells(s.mesh, sheared(7.5), {}).empty()) << "keeps its volume";
  auto const torn = torn_cells(s.mesh, sheared(8.5), {});
  EXPECT_EQ(torn.size(), static_cast<std::size_t>(s.mesh.cells.count()));
  EXPECT_EQ(torn_cells(s.mesh, sheared(7.5), torn), torn) << "as it was";
  EXPECT_TRUE(torn_cells(s.mesh, sheared(5.5), torn).empty());
}

TEST(Skin, LeavesOutWhatHasLostItsNeighbours) {
  Subject const s(drawn_box(3, ShapeSpec::Placement::on_boundary));
  std::vector<std::uint8_t> loose(s.x.size(), 0);
  for (std::size_t i = 0; i < loose.size(); ++i) loose[i] = s.x[i][0] > 1.5;
  Skin const skin = make_skin(s.mesh, {s.x, loose});
  for (std::size_t i = 0; i < loose.size(); ++i) EXPECT_EQ(skin.inside[i] != 0, loose[i] == 0) << i;
  for (SkinFacet const& f : skin.facets)
    for (Index const c : f.corner) EXPECT_EQ(loose[static_cast<std::size_t>(c)], 0);
}

TEST(Skin, TakesPlacesThatAreNoNumbers) {
  Subject s(drawn_box(3, ShapeSpec::Placement::on_boundary));
  s.x[40][1] = std::numeric_limits<double>::quiet_NaN();
  Skin const skin = s.skin();
  EXPECT_EQ(skin.inside[40], 0);
  for (SkinFacet const& f : skin.facets)
    for (Index const c : f.corner) EXPECT_TRUE(finite(skin.place[static_cast<std::size_t>(c)]));
}

TEST(Skin, IsMissingWhereThereAreNoCells) {
  ShapeSpec one = drawn_box(1, ShapeSpec::Placement::on_boundary);
  one.particles = {1, 1, 1};
  EXPECT_TRUE(Subject(one).skin().facets.empty());
  ShapeSpec layer = drawn_box(4, ShapeSpec::Placement::on_boundary);
  layer.particles = {5, 5, 1};
  Subject const s(layer);
  EXPECT_TRUE(s.skin().facets.empty());
  EXPECT_EQ(s.skin().inside, std::vector<std::uint8_t>(25, 0)) << "all of them are balls";
}

TEST(Section, HasTheAreaOfTheCrossSection) {
  Subject const s(drawn_box(4, ShapeSpec::Placement::cell_centred));
  Skin const skin = s.skin();
  Point3 const normal = unit({1, 0.5, 0.2});
  std::vector<double> beyond;
  for (Point3 const& x : skin.place) beyond.push_back(dot(minus(x, {1, 0.5, 0.25}), normal));
  double sum = 0;
  for (auto const& corners : section(s.mesh, skin, beyond)) {
    std::array<Point3, 3> x{};
    for (std::size_t c = 0; c < 3; ++c) {
      auto const &a = skin.place[static_cast<std::size_t>(corners[c].particle[0])],
                 &b = skin.place[static_cast<std::size_t>(corners[c].particle[1])];
      x[c] = plus(a, corners[c].share, minus(b, a));
      EXPECT_NEAR(dot(minus(x[c], {1, 0.5, 0.25}), normal), 0, 1e-12);
    }
    sum += length(cross(minus(x[1], x[0]), minus(x[2], x[0]))) / 2;
  }
  EXPECT_NEAR(sum, 0.5 / normal[0], 1e-9) << "that of the face across, seen obliquely";
}

TEST(FeatureLines, AreTheTwelveEdgesOfABox) {
  Subject const s(drawn_box(4, ShapeSpec::Placement::cell_centred));
  ASSERT_EQ(s.mesh.lines.size(), 12U);
  double sum = 0;
  for (Polyline const& line : s.mesh.lines) sum += distance(line.front(), line.back());
  EXPECT_NEAR(sum, 4 * 3.5, 1e-9);
}

TEST(FeatureLines, AreTheRimsOfACylinderAndTheBoundaryOfADisc) {
  double length_of_rims = 0;
  for (Polyline const& line : Subject(cylinder()).mesh.lines)
    for (std::size_t k = 0; k + 1 < line.size(); ++k) length_of_rims += distance(line[k], line[k + 1]);
  EXPECT_NEAR(length_of_rims, 4 * pi, 0.05 * 4 * pi);
  auto const lines = Subject(disc()).mesh.lines;
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
}

TEST(FeatureLines, HaveTheSidesOfACylinderWhereTheViewerSeesThem) {
  Subject const s(cylinder());
  double along = 0;
  for (Polyline const& line : silhouette(s.mesh, {0, 1, 0}))
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      along += std::abs(line[k + 1][2] - line[k][2]);
      EXPECT_GT(std::abs(line[k][0]), 0.9) << "left and right";
    }
  EXPECT_NEAR(along, 2 * 3, 0.1);
  EXPECT_TRUE(silhouette(Subject(drawn_box(4, ShapeSpec::Placement::cell_centred)).mesh, {0, 1, 0}).empty());
}

TEST(Stretches, AreBounded) {
  Mat<3> F = identity<3>();
  F(0, 0) = 10;
  F(1, 1) = 0.01;
  F(0, 1) = 0.2;
  Mat<3> const bounded = with_bounded_stretches(F, 1.0 / 3, 4);
  Vec<3> const e{{1, 0, 0}};
  Vec<3> const image = bounded * e;
  EXPECT_NEAR(std::sqrt(dot(image, image)), 4, 0.01);
  double const det = bounded(0, 0) * bounded(1, 1) - bounded(0, 1) * bounded(1, 0);
  EXPECT_NEAR(det, 4.0 / 3, 1e-6);
  EXPECT_EQ(with_bounded_stretches(identity<3>(), 0.3, 4).c[0], 1);
}

TEST(Skin, DoesNotFlickerWhereMaterialPartsAndComesBack) {
  Subject s(drawn_box(2, ShapeSpec::Placement::cell_centred, 2));
  auto const stretched = [&](double stretch) {
    s.x = s.mesh.X;
    for (Point3& p : s.x)
      if (p[0] > 1) p[0] += (stretch - 1) * s.mesh.spacing;
    return s.now();
  };
  EXPECT_TRUE(torn_cells(s.mesh, stretched(2.3), {}).empty());
  auto const torn = torn_cells(s.mesh, stretched(2.6), {});
  ASSERT_FALSE(torn.empty());
  EXPECT_EQ(torn_cells(s.mesh, stretched(2.3), torn), torn) << "between the two bounds it stays as it was";
  EXPECT_TRUE(torn_cells(s.mesh, stretched(1.9), torn).empty()) << "rubber that has come back is whole";
  Configuration now = stretched(2.3);
  EXPECT_NEAR(area(make_skin(s.mesh, now)), 2 + 1.3 * s.mesh.spacing, 1e-3);
  now.torn = torn;
  // Half a cell at each side, stretched as the neighbours of its last particles are: by (1 + 2.3) / 2.
  EXPECT_NEAR(area(make_skin(s.mesh, now)), 2 + 0.65 * s.mesh.spacing, 1e-3);
  std::vector<std::uint8_t> loose(s.x.size(), 0);
  loose[0] = 1;
  now = s.now();
  now.loose = loose;
  EXPECT_EQ(torn_cells(s.mesh, now, {}), std::vector<Index>{0});
}

}  // namespace
}  // namespace piola
