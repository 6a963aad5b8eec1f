// SPDX-License-Identifier: Apache-2.0
// Places with names, and bodies of several materials.
#include "piola/model/case_particles.hpp"
#include "piola/model/read_case.hpp"
#include "support/key_words.hpp"
#include "support/places.hpp"
#include "support/sample_case.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

std::string block(std::string const& regions, std::string const& more = "") {
  return "title = \"block\"\n[constants]\nL = \"2 m\"\n[run]\nend = \"1 ms\"\n" + regions +
         "\n[[body]]\nname = \"block\"\nshape = { spacing = \"25 cm\", arrangement = \"packed\", "
         "box = { min = [0, 0, 0], max = [2, 1, 1] } }\n"
         "material = { law = \"neo_hookean\", density = 1000, youngs_modulus = \"1 MPa\", poissons_ratio = 0.3 }\n"
         "formulation = { name = \"nodal\" }\ninitial_velocity = [\"X\", 0, 0]\n" +
         more;
}

void expect_problem(std::string const& text, std::string const& part) {
  test::expect_words(test::message_of(text), {part});
}

std::string const two_regions = R"(
[[region]]
name = "right"
where = "X > L/2"
[[region]]
name = "middle"
shape = { sphere = { centre = [1, 0.5, 0.5], radius = 0.45 } }
)";
std::string const material =
    "material = { law = \"neo_hookean\", density = 3000, youngs_modulus = \"4 MPa\", "
    "poissons_ratio = 0.3 }\n";

std::int64_t count(CaseSpec const& spec, std::size_t k) {
  ParticleSet const particles = make_particles(spec);
  std::int64_t n = 0;
  for (std::size_t i = 0; i < particles.X.size(); ++i) n += part_of(particles, i) == k ? 1 : 0;
  return n;
}

TEST(Regions, AreConditionsOfOtherFormulas) {
  CaseSpec const spec = read_case_text(block(two_regions, R"(
[[support]]
body = "block"
where = "right && !middle && depth < 0.2"
fix = "xyz"
)"),
                                       "case.toml");
  Expression const& where = *spec.supports[0].where;
  EXPECT_EQ(where({1.9, 0.1, 0.5}), 1);
  EXPECT_EQ(where({0.9, 0.1, 0.5}), 0) << "not on the right";
  EXPECT_EQ(where({1.2, 0.5, 0.5}), 0) << "in the middle";
  EXPECT_EQ(where({1.65, 0.5, 0.5}), 0) << "too deep";
}

TEST(Regions, MayUseRegionsBeforeThem) {
  CaseSpec const spec = read_case_text(block(two_regions + R"(
[[region]]
name = "both"
where = "right && middle"
)"),
                                       "case.toml");
  EXPECT_EQ(spec.regions[2].holds({1.1, 0.5, 0.5}), 1);
  EXPECT_EQ(spec.regions[2].holds({0.9, 0.5, 0.5}), 0);
}

TEST(Regions, DepthAndNormalAreThoseOfTheBody) {
  CaseSpec const spec = read_case_text(block("", R"(
[[probe]]
name = "skin"
body = "block"
kind = "average"
where = "depth < 0.3 && NX > 0.9"
quantities = ["velocity_x"]
)"),
                                       "case.toml");
  Expression const& where = *spec.probes[0].where;
  EXPECT_EQ(where({1.9, 0.5, 0.5}), 1);
  EXPECT_EQ(where({0.1, 0.5, 0.5}), 0);
  EXPECT_EQ(where({1.6, 0.5, 0.5}), 0);
}

TEST(Regions, AConstantOfTheUserKeepsItsName) {
  std::string text = block("", "[[load]]\nbody = \"block\"\nacceleration = [\"depth\", 0, 0]\n");
  text.replace(text.find("L = \"2 m\""), 9, "depth = 7");
  EXPECT_EQ(read_case_text(text, "case.toml").loads[0].value[0]({0.5, 0.5, 0.5}), 7);
}

TEST(Regions, NearASurfaceFromAFile) {
  CaseSpec const spec = read_case_text(block(R"(
[[region]]
name = "skin"
near = { file = ")" + testing::source_folder() +
                                             R"(/cases/geometry/meshes/bracket.stl", unit = "mm", within = "2 mm" }
)"),
                                       "case.toml");
  auto const& holds = spec.regions[0].holds;
  EXPECT_EQ(holds({1, 1, 1}), 0) << "a metre away";
  EXPECT_EQ(spec.regions[0].files.size(), 1U);
}

TEST(Regions, WhatIsWrongIsSaidAllAtOnce) {
  std::string const wrong = test::message_of(block(R"(
[[region]]
name = "depth"
where = "X > 1"
[[region]]
name = "L"
where = "X > 1"
[[region]]
name = "nothing"
[[region]]
name = "twice"
where = "X > 1"
shape = { box = { min = [0, 0, 0], max = [1, 1, 1] } }
[[region]]
name = "moves"
where = "X > t"
[[region]]
name = "gone"
near = { file = "none.stl", unit = "mm", within = 0 }
)"));
  for (std::string const part :
       {"region \"depth\" has the name of something else", "region \"L\" has the name of something else",
        "region needs one of where, shape, near (has none)", "region has 2 of where, shape, near", "depends on t",
        "region.near.within is 0"})
    EXPECT_NE(wrong.find(part), std::string::npos) << part << "\n" << wrong;
}

TEST(Regions, NearAFileThatIsNotThere) {
  expect_problem(block("[[region]]\nname = \"gone\"\nnear = { file = \"none.stl\", unit = \"mm\", within = 1 }\n"),
                 "none.stl");
}

TEST(Regions, OfOneNameAreRefused) {
  expect_problem(block("[[region]]\nname = \"a\"\nwhere = \"X > 1\"\n[[region]]\nname = \"a\"\nwhere = \"X > 1\"\n"),
                 "the name \"a\" is taken by another region");
}

TEST(Regions, AreNoNamesForDefinitions) {
  expect_problem(block(two_regions, "define = { right = \"X\" }\n"), "\"right\" is already a region");
}

TEST(Parts, AreSelectedByFormulas) {
  CaseSpec const spec =
      read_case_text(block(two_regions, "[[body.part]]\nwhere = \"right\"\n" + material), "case.toml");
  EXPECT_EQ(spec.bodies[0].parts[0].name, "part_1");
}

TEST(Parts, CutAPackedBodyAlongTheirSurface) {
  CaseSpec const spec = read_case_text(
      block(two_regions, "[[body.part]]\nname = \"core\"\nwhere = \"middle\"\n" + material), "case.toml");
  ParticleSet const particles = make_particles(spec);
  double const ball = 4.0 / 3 * 3.14159265358979 * 0.45 * 0.45 * 0.45;
  double of_core = 0, all = 0;
  for (std::size_t i = 0; i < particles.X.size(); ++i) {
    auto const& X = particles.X[i];
    double const r = std::hypot(X[0] - 1, X[1] - 0.5, X[2] - 0.5);
    bool const core = part_of(particles, i) == 1;
    EXPECT_EQ(core, r < 0.45);
    EXPECT_GT(std::fabs(r - 0.45), 0.3 * 0.25) << "a cell lies across";
    (core ? of_core : all) += particles.volume[i];
  }
  EXPECT_NEAR(of_core, ball, 5e-3 * ball);
  EXPECT_NEAR(all + of_core, 2, 1e-12);
}

TEST(Parts, TheFirstThatHoldsAParticleCounts) {
  CaseSpec const spec = read_case_text(block(two_regions, "[[body.part]]\nwhere = \"right\"\n" + material +
                                                              "[[body.part]]\nwhere = \"X > 0.5\"\n" + material),
                                       "case.toml");
  EXPECT_EQ(count(spec, 1), 64);
  EXPECT_EQ(count(spec, 2), 32);
  EXPECT_EQ(count(spec, 0), 32);
}

TEST(Parts, WhatIsWrongIsSaid) {
  expect_problem(block("", "[[body.part]]\nwhere = \"X > 5\"\n" + material), "selects no particle");
  expect_problem(block("", "[[body.part]]\nwhere = \"X > -5\"\n" + material), "leave nothing to its own material");
  expect_problem(
      block("", "[[body.part]]\nwhere = \"X > 1\"\n" + material + "[[body.part]]\nwhere = \"X > 1.5\"\n" + material),
      "has no particle that no part before it has");
  expect_problem(block("", "[[body.part]]\nwhere = \"X > t\"\n" + material), "depends on t");
  expect_problem(block("", "part = [ 3 ]\n"), "(allowed: a table) - write [[body.part]]");
  expect_problem(block("", "[[body.part]]\nwhere = \"X > 1\"\nmaterial = { law = \"elastic\", library = 3 }\n"),
                 "library");
}

}  // namespace
}  // namespace piola
