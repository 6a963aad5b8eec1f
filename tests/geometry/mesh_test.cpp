// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh.hpp"
#include "piola/base/text.hpp"
#include "mesh_shapes.hpp"
#include "support/key_words.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace piola {
namespace {

using namespace geometry;
using namespace testing;
using test::expect_words;

std::vector<std::string> names_of(std::vector<Patch> const& patches) {
  std::vector<std::string> names;
  for (Patch const& p : patches) names.push_back(p.name);
  return names;
}

std::vector<double> patch_areas(Solid const& solid, double edge) {
  std::vector<SurfacePiece> pieces;
  solid.cut_surface(edge, pieces);
  std::vector<double> areas(solid.patches().size());
  for (SurfacePiece const& p : pieces) areas.at(p.patch) += std::sqrt(dot(p.area, p.area));
  return areas;
}

TEST(Mesh, OfEveryFormatIsTheSameCube) {
  Shape const cube = unit_cube();
  for (auto const& [name, bytes] : {std::pair{"a.stl", stl_text(cube)}, std::pair{"b.STL", stl_binary(cube)},
                                    std::pair{"c.obj", obj_text(cube)}, std::pair{"d.ply", ply_text(cube)}}) {
    MeshReport report;
    auto const solid = mesh_from_bytes(bytes, name, {.scale = 1e-3}, report);
    ASSERT_TRUE(solid) << name << all_of(report.problems);
    EXPECT_EQ(report.corners, 8);
    EXPECT_EQ(report.faces, 12);
    EXPECT_EQ(report.shells, 1);
    EXPECT_TRUE(report.notes.empty()) << all_of(report.notes);
    EXPECT_NEAR(*solid->exact_volume(), 1e-9, 1e-24);
    EXPECT_NEAR(report.area, 6e-6, 1e-20);
    EXPECT_NEAR(solid->bounds().max[1], 1e-3, 1e-18);
    EXPECT_NEAR(solid->at({{5e-4, 5e-4, 2e-4}}).distance, -2e-4, 1e-18);
    EXPECT_EQ(names_of(solid->patches()), (std::vector<std::string>{"1", "2", "3", "4", "5", "6"}));
  }
}

TEST(Mesh, OfAPillarHasASideAndTwoEnds) {
  MeshReport report;
  auto const solid = solid_of(pillar(48), report);
  ASSERT_TRUE(solid) << all_of(report.problems);
  ASSERT_EQ(solid->patches().size(), 3u);
  auto areas = patch_areas(*solid, 0.1);
  std::sort(areas.begin(), areas.end());
  double const step = std::numbers::pi / 48, end = 48 * std::sin(step) * std::cos(step);
  EXPECT_NEAR(areas[0], end, 1e-6);  // coordinates are in single precision
  EXPECT_NEAR(areas[1], end, 1e-6);
  EXPECT_NEAR(areas[2], 48 * 2 * std::sin(step) * 2, 1e-6);
  EXPECT_NEAR(*solid->exact_volume(), 2 * end, 1e-6);
}

TEST(Mesh, OfAPillarWithFewSidesHasAPatchForEach) {
  MeshReport report;
  EXPECT_EQ(solid_of(pillar(8), report)->patches().size(), 10u);
  EXPECT_EQ(solid_of(pillar(8), report, {.feature_angle = 1})->patches().size(), 3u);
}

TEST(Mesh, PiecesAreShortAndTheirVectorAreasClose) {
  MeshReport report;
  auto const solid = solid_of(round_ball(3), report);
  std::vector<SurfacePiece> pieces;
  solid->cut_surface(0.05, pieces);
  double area = 0, moment = 0;
  Vec<3> sum{};
  for (SurfacePiece const& p : pieces) {
    area += std::sqrt(dot(p.area, p.area));
    sum = sum + p.area;
    moment += dot(p.X, p.area);
    EXPECT_LE(std::sqrt(dot(p.area, p.area)), 0.5 * 0.05 * 0.05);
  }
  EXPECT_NEAR(area, report.area, 1e-12 * area);
  EXPECT_LE(std::sqrt(dot(sum, sum)), 1e-12 * area);
  EXPECT_NEAR(moment / 3, *solid->exact_volume(), 1e-12);  // divergence theorem; linear on every piece, so exact
}

TEST(Mesh, OfAnObjFileHasItsGroupsAsPatches) {
  std::string text;
  Shape const cube = unit_cube();
  for (auto const& X : cube.X) text += fmt::format("v {} {} {}\n", X[0], X[1], X[2]);
  text += "g left end\nf 1 5 7 3\ng 2-bore\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\ng rest\nf 1 3 4 2\nf 5 6 8 7\n";
  MeshReport report;
  auto const solid = mesh_from_bytes(text, "cube.obj", {}, report);
  ASSERT_TRUE(solid) << all_of(report.problems);
  EXPECT_EQ(report.faces, 12);
  auto const names = names_of(solid->patches());
  ASSERT_EQ(names.size(), 3u) << joined(names);
  EXPECT_EQ(names[0].substr(0, 4), "left");
  EXPECT_EQ(names[1], "_2_bore");
  EXPECT_EQ(names[2], "rest");
  EXPECT_EQ(patch_areas(*solid, 0.3).size(), 3u);
  EXPECT_NEAR(patch_areas(*solid, 0.3)[1], 3, 1e-14);
}

TEST(Mesh, OfAnObjFileHasItsMaterialsAsPatches) {
  std::string text = "mtllib missing.mtl\n" + obj_text(unit_cube());
  text.insert(text.find("f "), "usemtl steel\n");
  text += "usemtl steel\n";
  text.insert(text.rfind("f "), "usemtl brass\n");
  MeshReport report;
  auto const solid = mesh_from_bytes(text, "cube.obj", {}, report);
  ASSERT_TRUE(solid) << all_of(report.problems);
  EXPECT_EQ(names_of(solid->patches()), (std::vector<std::string>{"steel", "brass"}));
}

TEST(Mesh, OfATextStlHasItsSolidsAsPatches) {
  Shape bottom = unit_cube(), rest = bottom;
  bottom.face.erase(bottom.face.begin(), bottom.face.begin() + 10);
  rest.face.resize(10);
  MeshReport report;
  auto const solid = mesh_from_bytes(stl_text(bottom, "lid") + stl_text(rest, "walls"), "cube.stl", {}, report);
  ASSERT_TRUE(solid) << all_of(report.problems);
  EXPECT_EQ(names_of(solid->patches()), (std::vector<std::string>{"lid", "walls"}));
}

TEST(Mesh, CutsHollowPolygonsIntoTriangles) {
  // An L, extruded: its two ends are polygons with six corners, one of them turned inward.
  std::string text;
  double const outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (double const z : {0.0, 1.0})
    for (auto const& p : outline) text += fmt::format("v {} {} {}\n", p[0], p[1], z);
  text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
  for (int k = 0; k < 6; ++k) text += fmt::format("f {} {} {} {}\n", k + 1, (k + 1) % 6 + 1, (k + 1) % 6 + 7, k + 7);
  MeshReport report;
  auto const solid = mesh_from_bytes(text, "l.obj", {}, report);
  ASSERT_TRUE(solid) << all_of(report.problems);
  EXPECT_NEAR(*solid->exact_volume(), 3, 1e-14);
  EXPECT_NEAR(report.area, 2 * 3 + 8, 1e-13);
  EXPECT_NEAR(solid->at({{1.5, 1.5, 0.5}}).distance, 0.5, 1e-15);
}

TEST(Mesh, IsTurnedWhenThatIsWanted) {
  Shape shape = unit_cube();
  shape.add(cuboid({{0.25, 0.25, 0.25}}, {{0.75, 0.75, 0.75}}));  // a cavity that looks outward
  for (std::size_t f = 0; f < shape.face.size(); f += 3) std::swap(shape.face[f][0], shape.face[f][1]);
  MeshReport report;
  auto const solid = solid_of(shape, report, {.repair = MeshOptions::Repair::orient});
  ASSERT_TRUE(solid) << all_of(report.problems);
  EXPECT_GT(report.mended, 0);
  EXPECT_EQ(report.shells, 2);
  EXPECT_NEAR(*solid->exact_volume(), 1 - 0.125, 1e-14);
}

TEST(Mesh, WithHolesTakesTheSideFromRays) {
  Shape ball = round_ball(4);
  ball.face.erase(ball.face.begin() + 100);
  MeshReport report;
  auto const solid = solid_of(ball, report, {.repair = MeshOptions::Repair::holes, .largest_hole = 0.2});
  ASSERT_TRUE(solid) << all_of(report.problems);
  EXPECT_EQ(report.open, 3);
  EXPECT_FALSE(solid->exact_volume());
  for (double const r : {0.0, 0.3, 0.6, 0.9}) {
    EXPECT_LT(solid->at({{r, 0.01, 0.02}}).distance, 0);
    EXPECT_LT(solid->at({{-0.03, -r, 0.02}}).distance, 0);
    EXPECT_GT(solid->at({{1.1, r, 0.2}}).distance, 0);
  }
}

TEST(Mesh, RemarksOnUnitsThinWallsAndDistantOrigins) {
  MeshReport wide, thin, offset, good;
  ASSERT_TRUE(solid_of(unit_cube(), wide, {.scale = 1000, .spacing = 1e-3}));
  expect_words(all_of(wide.notes), {"part.stl: the mesh is 1000 m wide", "1e+06 spacings", "unit"});
  ASSERT_TRUE(solid_of(cuboid({{0, 0, 0}}, {{1, 1, 0.125}}), thin, {.spacing = 0.0625}));
  EXPECT_NE(all_of(thin.notes).find("a wall is only 125 mm thick, which is 2 spacings"), std::string::npos)
      << all_of(thin.notes);
  ASSERT_TRUE(solid_of(cuboid({{4096, 0, 0}}, {{4097, 1, 1}}), offset));
  EXPECT_NE(all_of(offset.notes).find("from the origin"), std::string::npos) << all_of(offset.notes);
  ASSERT_TRUE(solid_of(unit_cube(), good, {.spacing = 0.1}));
  EXPECT_EQ(all_of(good.notes), "");
}

TEST(Mesh, MayBeHuge) {
  MeshReport report;
  auto const solid = solid_of(cuboid({{-1e30, -1e30, -1e30}}, {{1e30, 1e30, 1e30}}), report);
  ASSERT_TRUE(solid) << all_of(report.problems);
  EXPECT_NEAR(solid->at({{0, 0, 0}}).distance, -1e30, 1e24);
  EXPECT_NEAR(*solid->exact_volume(), 8e90, 1e84);
}

}  // namespace
}  // namespace piola
