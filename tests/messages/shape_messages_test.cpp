// SPDX-License-Identifier: Apache-2.0
// Messages about impossible shapes.
#include "piola/model/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/setup/packed_bodies.hpp"
#include "piola/setup/packing_file.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::message_of;

std::string with_shape(std::string const& shape, std::string const& more = {}) {
  return "title = \"t\"\n[run]\nend = \"1 ms\"\n[[body]]\nname = \"part\"\nshape = { " + shape +
         " }\nmaterial = { law = \"neo_hookean\", density = 1100, youngs_modulus = 17e6, poissons_ratio = 0.3 }\n"
         "formulation = { name = \"nodal\" }\n" +
         more;
}

/// Expects each of these words in the message.
void expect_told(std::string const& shape, std::vector<std::string> const& words, std::string const& more = {}) {
  SCOPED_TRACE(shape);
  test::expect_words(message_of(with_shape(shape, more)), words);
}

TEST(ShapeMessages, GoodOnesSayNothing) {
  for (std::string const good :
       {"spacing = 0.2, arrangement = \"packed\", sphere = { centre = [0, 0, 0], radius = 1 }",
        "spacing = 0.2, arrangement = \"packed\", sphere = { centre = [0, 0], radius = 1, inner_radius = 0.4 }",
        "spacing = 0.2, torus = { centre = [0, 0, 0], radius = 1, tube_radius = 0.4, axis = \"x\" }",
        "spacing = 0.2, cone = { centre = [0, 0, 0], radius = 1, length = 2 }, arrangement = \"lattice\"",
        "spacing = 0.2, capsule = { from = [0, 0], to = [2, 1], radius = 0.5 }",
        "spacing = 0.2, extrude = { polygon = [[0, 0], [2, 0], [2, 1], [0, 1], [0, 0]], from = 0, to = \"1 m\" }",
        "spacing = 0.1, extrude = { polygon = [[0, 0], [2, 0], [0, 2]], holes = [[[0.4, 0.4], [0.8, 0.4], [0.4, 0.8]]] "
        "}",
        "spacing = 0.2, revolve = { polygon = [[0, 0], [1, 0], [0.5, 2], [0, 2]], axis = \"y\" }",
        "spacing = 0.2, formula = { inside = \"X^2 + Y^2 + Z^2 < 1\", min = [-1.1, -1.1, -1.1], max = [1.1, 1.1, 1.1] "
        "}",
        "spacing = 0.2, intersection = [{ sphere = { centre = [0, 0, 0], radius = 1 } }, { half_space = { point = [0, "
        "0, 0], normal = [0, 0, 2] } }]",
        "spacing = 0.2, box = { min = [0, 0, 0], max = [1, 1, 1] }, transform = { rotate = [{ angle = \"30 degree\" }, "
        "{ axis = [1, 0, 0], angle = 1 }], move = [1, 0, 0], scale = 2 }"})
    EXPECT_EQ(message_of(with_shape(good)), "") << good;
}

TEST(ShapeMessages, NumbersAndPartsThatCannotBe) {
  expect_told("spacing = 0.2, torus = { centre = [0, 0, 0], radius = 1, tube_radius = 1.5 }", {"tube_radius", "below"});
  expect_told("spacing = 0.2, cone = { centre = [0, 0, 0], radius = 0, length = 2 }", {"no radius above 0"});
  expect_told("spacing = 0.2, capsule = { from = [0, 0, 0], to = [0, 0, 0], radius = 1 }", {"no other place"});
  expect_told("spacing = 0.2, cone = { centre = [0, 0], radius = 1, length = 2 }", {"2 components", "allowed: 3"});
  expect_told("torus = { centre = [0, 0, 0], radius = 1, tube_radius = 0.4 }", {"spacing", "how fine"});
  expect_told("spacing = 0.2, difference = []", {"difference"});
  expect_told("spacing = 0.2, difference = [{ box = { min = [0, 0, 0], max = [1, 1, 1] } }, 5]", {"a table"});
  expect_told("spacing = 0.2, union = [{ boxx = {} }]", {"\"boxx\"", "did you mean \"box\""});
  expect_told(
      "spacing = 0.2, union = [{ sphere = { centre = [0, 0], radius = 1 } }, { sphere = { centre = [0, 0, 0], "
      "radius = 1 } }]",
      {"2D and in 3D"});
  expect_told("spacing = 0.2, half_space = { point = [0, 0, 0], normal = [1, 0, 0] }", {"has no end", "intersect"});
  expect_told(
      "spacing = 0.1, intersection = [{ sphere = { centre = [0, 0, 0], radius = 1 } }, { sphere = { centre = [9, "
      "0, 0], radius = 1 } }]",
      {"volume of 0 m^3", "check the parts"});
  expect_told("spacing = 1e-7, torus = { centre = [0, 0, 0], radius = 1, tube_radius = 0.4 }", {"larger spacing"});
  expect_told("spacing = 0.2, box = { min = [0, 0, 0], max = [1, 1, 1] }, transform = { rotate = 3 }", {"angle"});
  expect_told(
      "spacing = 0.2, box = { min = [0, 0], max = [1, 1] }, transform = { rotate = { axis = [1, 0, 0], angle = 1 } "
      "}",
      {"only in 3D"});
  expect_told("spacing = 0.2, box = { min = [0, 0, 0], max = [1, 1, 1] }, jitter = 0.1, arrangement = \"packed\"",
              {"jitter", "without transform and arrangement"});
}

TEST(ShapeMessages, PolygonsAndFormulas) {
  expect_told("spacing = 0.2, extrude = { polygon = [[0, 0], [1, 1], [1, 0], [0, 0.5]] }",
              {"meets", "order of the corners"});
  expect_told("spacing = 0.2, extrude = { polygon = [[0, 0], [1, 1], [2, 2]] }", {"without area"});
  expect_told("spacing = 0.2, extrude = { polygon = [[0, 0], [0, 0], [2, 2], [1, 0]] }", {"same as the corner before"});
  expect_told("spacing = 0.2, extrude = { polygon = [[0, 0], [2, 0], [0, 2]], from = 0 }", {"only one of from and to"});
  expect_told("spacing = 0.2, revolve = { polygon = [[-1, 0], [2, 0], [0, 2]] }", {"a radius has no sign"});
  std::string const box = "\", min = [-2, -2, -2], max = [2, 2, 2] }";
  expect_told("spacing = 0.2, formula = { inside = \"X^2 + Y^2" + box, {"one comparison"});
  expect_told("spacing = 0.2, formula = { inside = \"X^2 + Q < 1" + box, {"Q"});
  expect_told("spacing = 0.2, formula = { inside = \"X^2 + Y^2 < 1" + box, {"reaches out of its box"});
}

TEST(ShapeMessages, PatchesAreNamed) {
  std::string const ball = "spacing = 0.3, arrangement = \"packed\", sphere = { centre = [0, 0, 0], radius = 1 }";
  std::string const plain = "spacing = 0.3, sphere = { centre = [0, 0, 0], radius = 1 }";
  auto const load = [](std::string const& what) { return "[[load]]\nbody = \"part\"\n" + what + "\n"; };
  EXPECT_EQ(message_of(with_shape(ball, load("pressure = 1\npatch = \"outer\""))), "");
  expect_told(ball, {"no patch \"side\"", "allowed: outer", "piola check"}, load("pressure = 1\npatch = \"side\""));
  expect_told(plain, {"has no patches", "arrangement = \"packed\""}, load("pressure = 1\npatch = \"outer\""));
  expect_told(ball, {"has no face"}, load("pressure = 1\nface = \"outer\""));
  expect_told(ball, {"exclude each other"}, load("pressure = 1\npatch = \"outer\"\nface = \"+x\""));
  expect_told(ball, {"used only by a traction"}, load("acceleration = [0, 0, 1]\npatch = \"outer\""));
  expect_told(ball, {"\"where\" or \"patch\""}, "[[support]]\nbody = \"part\"\nfix = \"xyz\"\n");
}

TEST(ShapeMessages, SurfacesAreHeldWhereTheFormulationCan) {
  std::string const ball = "spacing = 0.3, arrangement = \"packed\", sphere = { centre = [0, 0, 0], radius = 1 }";
  auto const support = [](std::string const& what) { return "[[support]]\nbody = \"part\"\nfix = \"xyz\"\n" + what; };
  EXPECT_EQ(message_of(with_shape(ball, support("patch = \"outer\"\nhold = \"particles\""))), "");
  expect_told(ball, {"used only by a support on a patch"}, support("where = \"X < 0\"\nhold = \"surface\""));
  expect_told(ball, {"support.hold", "allowed: surface, particles"}, support("patch = \"outer\"\nhold = \"both\""));
  std::string const surface = support("patch = \"outer\"\nhold = \"surface\"");
  EXPECT_EQ(message_of(with_shape(ball, surface)), "");
  EXPECT_EQ(message_of(test::replaced(with_shape(ball, surface), "\"nodal\"", "\"jst_sph\"")),
            "case.toml:13:8: support.hold is \"surface\", which the formulation \"jst_sph\" cannot do (allowed: "
            "\"particles\"; \"surface\" with nodal) - change hold or body.formulation");
}

TEST(ShapeMessages, FilesThatAreNotThere) {
  expect_told("spacing = 0.2, mesh = { file = \"nothing.stl\", unit = \"mm\" }", {"nothing.stl"});
  expect_told("spacing = 0.2, mesh = { file = \"nothing.stl\" }", {"unit"});
  expect_told("spacing = 0.2, mesh = { file = \"nothing.stl\", unit = \"kg\" }", {"a unit of length"});
  expect_told("spacing = 0.2, mesh = { file = \"a.stl\", unit = \"mm\", repair = \"holes\" }", {"largest_hole"});
  expect_told("points = { file = \"nothing.csv\" }", {"nothing.csv"});
  expect_told("points = { file = \"nothing.csv\" }, spacing = 0.1", {"spacing", "as they stand in the file"});
}

TEST(ShapeMessages, FormulationsThatNeedALattice) {
  std::string text = with_shape("spacing = 0.3, arrangement = \"packed\", sphere = { centre = [0, 0], radius = 1 }");
  text.replace(text.find("nodal"), 5, "taylor_sph");
  text.replace(text.find("neo_hookean"), 11, "linear_elastic");
  EXPECT_NE(message_of(text).find("knows no packed clouds"), std::string::npos) << message_of(text);
}

TEST(PackingFiles, ComeBackAsTheyWereAndNeverDamaged) {
  testing::TemporaryFolder const folder;
  geometry::Packing const packing{{{1, 2, 3}, {4, 5, 6}}, 0.5, 0.25, 7};
  std::filesystem::path const path = folder.path() / packing_name("key");
  write_packing(path, "key", packing);
  auto const back = read_packing(path, "key");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->X, packing.X);
  EXPECT_EQ(back->volume, 0.5);
  EXPECT_EQ(back->spacing, 0.25);
  EXPECT_EQ(back->sweeps, 7);
  EXPECT_FALSE(read_packing(path, "other").has_value());
  std::string const whole = read_text_file(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string bad = whole;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    write_whole_file(path, bad);
    EXPECT_FALSE(read_packing(path, "key").has_value()) << i;
    write_whole_file(path, whole.substr(0, i));
    EXPECT_FALSE(read_packing(path, "key").has_value()) << i;
  }
}

TEST(PackingFiles, AreTakenInPlaceOfPacking) {
  testing::TemporaryFolder const folder;
  std::string const shape =
      "spacing = 0.3, cache = true, torus = { centre = [0, 0, 0], radius = 1, tube_radius = 0.4 }";
  std::filesystem::path const file = folder.path() / "case.toml";
  std::string const text = with_shape(shape, "[[support]]\nbody = \"part\"\nwhere = \"X > 0\"\nfix = \"x\"\n");
  write_whole_file(file, text);
  auto const sweeps = [&] {
    int count = 0;
    ReadLimits limits;
    limits.packing = [&](std::string const&, double) {
      ++count;
      return AfterSweep::go_on;
    };
    ParticleSet particles;
    read_case(file, {}, limits, &particles);
    EXPECT_GT(particles.size(), 50);
    return count;
  };
  EXPECT_GT(sweeps(), 0);
  EXPECT_EQ(sweeps(), 0);
}

}  // namespace
}  // namespace piola
