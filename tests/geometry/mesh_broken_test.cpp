// SPDX-License-Identifier: Apache-2.0
#include "piola/base/units.hpp"
#include "mesh_shapes.hpp"
#include "support/key_words.hpp"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <unistd.h>

namespace piola {
namespace {

using test::expect_words;

using namespace geometry;
using namespace testing;

class BrokenMesh : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string problems_of_file(std::string const& name, MeshOptions const& options = {}) {
    MeshReport report;
    EXPECT_EQ(read_mesh(folder_ / name, options, report), nullptr);
    return all_of(report.problems);
  }
  std::string problems_of(std::string const& name, std::string const& bytes, MeshOptions const& options = {}) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return problems_of_file(name, options);
  }
  std::string problems_of(Shape const& shape, MeshOptions const& options = {}) {
    return problems_of("part.stl", stl_binary(shape), options);
  }

  std::filesystem::path const folder_ =
      std::filesystem::temp_directory_path() / ("piola-meshes-" + std::to_string(::getpid()));
};

TEST_F(BrokenMesh, ThatIsGoodInAFileIsRead) {
  std::ofstream(folder_ / "good.stl", std::ios::binary) << stl_binary(unit_cube());
  MeshReport report;
  EXPECT_NE(read_mesh(folder_ / "good.stl", {}, report), nullptr) << all_of(report.problems);
}

TEST_F(BrokenMesh, IsNotThere) {
  expect_words(problems_of_file("no.stl"), {"no.stl: there is no such file"});
  std::filesystem::create_directory(folder_ / "box.stl");
  expect_words(problems_of_file("box.stl"), {"box.stl: is a folder"});
  expect_words(problems_of("nothing.stl", ""), {"nothing.stl: is empty"});
  expect_words(problems_of("blank.obj", "  \n \n"), {"blank.obj: is empty"});
}

TEST_F(BrokenMesh, IsTooLarge) {
  std::ofstream(folder_ / "large.stl") << "x";
  std::filesystem::resize_file(folder_ / "large.stl", 2'100'000'000);  // without content, takes no room
  expect_words(problems_of_file("large.stl"), {"large.stl: has 2.1 GB (allowed: 2 GB)", "coarser"});
}

TEST_F(BrokenMesh, IsOfAnotherFormat) {
  expect_words(problems_of("part.step", "ISO-10303-21;"), {"\".step\"", "allowed: .stl, .obj, .ply"});
  expect_words(problems_of("part", "solid"), {"no format"});
  expect_words(problems_of("part.stl", "hello"), {"part.stl: is no STL file"});
  expect_words(problems_of("part.ply", "hello"), {"part.ply: is no PLY file"});
  // The reader would look for ever for the line that ends the header.
  std::string ply = ply_text(unit_cube());
  ply.replace(ply.find("\nend_header"), 1, ")");
  expect_words(problems_of("part.ply", ply), {"part.ply: is no PLY file"});
}

TEST_F(BrokenMesh, WasCutOff) {
  std::string const whole = stl_binary(unit_cube());
  expect_words(problems_of("part.stl", whole.substr(0, 84 + 7 * 50 + 3)),
               {"promises 12 faces", "room for 7", "cut off"});
  std::string const text = stl_text(unit_cube());
  expect_words(problems_of("part.stl", text.substr(0, text.size() / 2)), {"endsolid", "cut off"});
  std::string const ply = ply_text(unit_cube());
  EXPECT_NE(problems_of("part.ply", ply.substr(0, ply.size() - 40)), "");
}

TEST_F(BrokenMesh, HasNoFaces) {
  expect_words(problems_of("part.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), {"part.obj: ", "export"});
  expect_words(problems_of("part.stl", stl_binary({})), {"part.stl: ", "export"});
}

TEST_F(BrokenMesh, HasCornersThatAreNoNumbers) {
  Shape cube = unit_cube();
  cube.X[3][1] = std::numeric_limits<double>::quiet_NaN();
  expect_words(problems_of(cube), {"corners are no finite numbers", "the first is corner"});
  cube.X[3][1] = std::numeric_limits<double>::infinity();
  expect_words(problems_of(cube), {"corners are no finite numbers"});
}

TEST_F(BrokenMesh, NamesCornersThatItDoesNotHave) {
  std::string text = ply_text(unit_cube());
  text.replace(text.rfind("3 4"), 5, "3 4 9");
  expect_words(problems_of("part.ply", text), {"name corners that the file does not have"});
}

TEST_F(BrokenMesh, IsOpen) {
  Shape cube = unit_cube();
  cube.face.resize(10);
  std::string const text = problems_of(cube, {.scale = 1e-3});
  expect_words(text, {"part.stl: 4 open edges", "none", "hole is 1.414 mm across, near (",
                      "close the surface in the CAD program, or set repair = \"holes\""});
  expect_words(problems_of(cube, {.scale = 1e-3, .repair = MeshOptions::Repair::holes, .largest_hole = 1e-3}),
               {"4 open edges, the longest hole is 1.414 mm across", "(allowed: 1 mm)"});
}

TEST_F(BrokenMesh, HasEdgesOfManyFaces) {
  Shape cube = unit_cube();
  cube.face.push_back(cube.face.front());
  expect_words(problems_of(cube), {"edges used by more than two faces (allowed: two)", "the longest 1.414 m"});
  expect_words(problems_of(unit_cube().add(cuboid({{1, 1, 0}}, {{2, 2, 1}}))), {"1 edge used by more than two faces"});
}

/// Corners that each face has for itself, moved by up to `gap` [units of the file].
Shape torn_apart(Shape const& whole, double gap) {
  Shape torn;
  for (auto const& f : whole.face) {
    int const first = static_cast<int>(torn.X.size());
    for (int k = 0; k < 3; ++k) {
      Vec<3> X = whole.X[f[k]];
      X[(first + k) % 3] += gap * ((first / 3 + k) % 3 - 1) / 2;
      torn.X.push_back(X);
    }
    torn.face.push_back({first, first + 1, first + 2});
  }
  return torn;
}

TEST_F(BrokenMesh, HasCornersThatNearlyCoincide) {
  Shape const torn = torn_apart(round_ball(2), 1e-3);
  for (auto const& [name, bytes] : {std::pair{"a.stl", stl_text(torn)}, std::pair{"b.stl", stl_binary(torn)},
                                    std::pair{"c.obj", obj_text(torn)}, std::pair{"d.ply", ply_text(torn)}}) {
    std::string const text = problems_of(name, bytes, {.scale = 1e-3});
    expect_words(text, {"open edges", "set merge = \"", "nearly coincide"});
    std::size_t const at = text.find("merge = \"") + 9;
    Quantity const distance = read_quantity(text.substr(at, text.find('"', at) - at), "m");
    EXPECT_FALSE(distance.problem) << text;
    MeshReport report;
    MeshOptions const merging{.scale = 1e-3, .merge = distance.value};
    auto const solid = mesh_from_bytes(bytes, name, merging, report);
    ASSERT_NE(solid, nullptr) << text << all_of(report.problems);
    EXPECT_EQ(report.corners, static_cast<std::int64_t>(round_ball(2).X.size()));
    EXPECT_EQ(report.faces, static_cast<std::int64_t>(torn.face.size()));
    expect_words(all_of(report.notes), {"corners are merged with others less than"});
    // Corners moved by at most half the gap of 1e-3 of a radius.
    MeshReport whole;
    auto const exact = mesh_from_bytes(stl_binary(round_ball(2)), "whole.stl", {.scale = 1e-3}, whole);
    EXPECT_NEAR(report.volume, whole.volume, 3 * 0.5e-3 * whole.volume);
  }
}

// A true hole stays one, whatever is merged.
TEST_F(BrokenMesh, HasHolesThatMergingDoesNotClose) {
  Shape ball = round_ball(2);
  ball.face.pop_back();
  EXPECT_EQ(problems_of(ball).find("merge"), std::string::npos);
  EXPECT_EQ(problems_of(torn_apart(ball, 1e-3)).find("set merge"), std::string::npos);
  expect_words(problems_of(torn_apart(ball, 1e-3), {.merge = 3e-3}), {"3 open edges"});
}

TEST_F(BrokenMesh, IsMendedOfNeedlessFaces) {
  Shape cube = unit_cube();
  cube.face.push_back(cube.face[2]);                                         // twice
  cube.face.push_back({cube.face[5][0], cube.face[5][2], cube.face[5][1]});  // twice, turned
  cube.face.push_back(cube.face[5]);
  cube.X.push_back({{0, 0, 0.5}});
  cube.face.push_back({0, 4, 8});  // without area, on an edge
  expect_words(problems_of(cube), {"used by more than two faces", "set repair = \"faces\""});
  MeshReport report;
  MeshOptions const faces{.repair = MeshOptions::Repair::faces};
  ASSERT_NE(solid_of(cube, report, faces), nullptr) << all_of(report.problems);
  EXPECT_EQ(report.twice, 3);
  EXPECT_EQ(report.without_area, 1);
  EXPECT_EQ(report.faces, 12);
  EXPECT_DOUBLE_EQ(report.volume, 1);
  expect_words(all_of(report.notes), {"3 faces that stand twice are removed", "1 faces without area are removed"});
  MeshReport good;
  ASSERT_NE(solid_of(unit_cube(), good, faces), nullptr);
  EXPECT_EQ(good.notes, std::vector<std::string>{}) << "nothing to mend, nothing to say";
}

TEST_F(BrokenMesh, IsMendedOfWallsBetweenPartsAndOfSecondSides) {
  MeshOptions const faces{.repair = MeshOptions::Repair::faces};
  Shape two = unit_cube().add(cuboid({{1, 0, 0}}, {{2, 1, 1}}));  // the diagonals of both walls agree
  expect_words(problems_of(two), {"used by more than two faces", "set repair = \"faces\""});
  MeshReport report;
  ASSERT_NE(solid_of(two, report, faces), nullptr) << all_of(report.problems);
  EXPECT_EQ(report.twice, 4);
  EXPECT_DOUBLE_EQ(report.volume, 2);
  Shape both = unit_cube();
  both.add(unit_cube().turn());
  MeshReport sides;
  ASSERT_NE(solid_of(both, sides, faces), nullptr) << all_of(sides.problems);
  EXPECT_EQ(sides.twice, 12);
  EXPECT_DOUBLE_EQ(sides.volume, 1);
}

TEST_F(BrokenMesh, HasTurnedFaces) {
  Shape cube = unit_cube();
  std::swap(cube.face[4][0], cube.face[4][1]);
  expect_words(problems_of(cube), {"3 edges between faces of opposite orientation", "repair = \"orient\""});
}

TEST_F(BrokenMesh, IsInsideOut) {
  expect_words(problems_of(unit_cube().turn()), {"inside out", "-1 m^3", "repair = \"orient\""});
}

TEST_F(BrokenMesh, PassesThroughItself) {
  expect_words(problems_of(unit_cube().add(cuboid({{0.5, 0.5, 0.5}}, {{1.5, 1.5, 1.5}}))),
               {"passes through itself", "unclear what is inside", "near ("});
  // A small peg that reaches into the body: only its own faces tell.
  expect_words(problems_of(unit_cube().add(cuboid({{0.4, 0.4, 0.98}}, {{0.45, 0.45, 1.02}}))),
               {"passes through itself"});
  expect_words(problems_of(unit_cube().add(cuboid({{0.25, 0.25, 0.25}}, {{0.75, 0.75, 0.75}}))),
               {"turned the wrong way"});
}

TEST_F(BrokenMesh, IsToldAllAtOnce) {
  Shape cube = unit_cube();
  std::swap(cube.face[4][0], cube.face[4][1]);
  cube.face.push_back(cube.face[8]);
  cube.face.erase(cube.face.begin());
  MeshReport report;
  EXPECT_EQ(solid_of(cube, report), nullptr);
  EXPECT_EQ(report.problems.size(), 3u) << all_of(report.problems);
}

TEST_F(BrokenMesh, EveryCutAndChangedByteIsSurvived) {
  Shape const shape = corner_tetrahedron();
  for (auto const& [name, bytes] : {std::pair{"a.stl", stl_text(shape)}, std::pair{"b.stl", stl_binary(shape)},
                                    std::pair{"c.obj", obj_text(shape)}, std::pair{"d.ply", ply_text(shape)}})
    for (std::size_t i = 0; i < bytes.size(); i += 7)
      for (std::string const& variant :
           {bytes.substr(0, i), std::string(bytes).replace(i, 1, "~"), std::string(bytes).replace(i, 1, "9")}) {
        MeshReport report;
        bool const read = mesh_from_bytes(variant, name, {.time_limit = 0.5}, report) != nullptr;
        EXPECT_EQ(read, report.problems.empty()) << name << " " << i;
      }
}

}  // namespace
}  // namespace piola
