// SPDX-License-Identifier: Apache-2.0
// Messages about what axisymmetric cases cannot have.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

struct Sample {
  std::string shape = "box = { min = [0, 0], max = [1, 2] }, spacing = 0.25";
  std::string formulation = "name = \"nodal\"";
  std::string of_body = "initial_velocity = [\"X\", \"-1\"]";
  std::string more = "";
};

std::string answer_to(Sample const& sample) {
  return test::message_of(
      "title = \"t\"\ngeometry = \"axisymmetric\"\n[run]\nend = \"1 ms\"\n[[body]]\nname = \"bar\"\nshape = { " +
      sample.shape +
      " }\nmaterial = { law = \"neo_hookean\", density = 1100, youngs_modulus = 17e6, "
      "poissons_ratio = 0.3 }\nformulation = { " +
      sample.formulation + " }\n" + sample.of_body + "\n" + sample.more);
}

void expect_answer(Sample const& sample, std::vector<std::string> const& words) {
  test::expect_words(answer_to(sample), words);
}

TEST(AxisymmetryMessages, GoodCasesSayNothing) {
  EXPECT_EQ(answer_to({}), "");
  EXPECT_EQ(answer_to({.shape = "sphere = { centre = [0, 3], radius = 1 }, spacing = 0.2"}), "");
  EXPECT_EQ(answer_to({.shape = "sphere = { centre = [2, 0], radius = 1 }, spacing = 0.2"}), "");
  EXPECT_EQ(answer_to({.more = "[[rigid]]\nname = \"wall\"\nplane = { point = [0, -1], normal = [0, 1] }\n"}), "");
  EXPECT_EQ(answer_to({.more = "[[rigid]]\nname = \"punch\"\nbox = { min = [0, 3], max = [1, 4] }\nmotion = \"free\"\n"
                               "density = 7800\nvelocity = [0, -1]\n"}),
            "");
  EXPECT_EQ(answer_to({.more = "[[load]]\nbody = \"bar\"\nface = \"+x\"\npressure = \"1 kPa\"\n"}), "");
}

TEST(AxisymmetryMessages, ShapesBeyondTheAxisAndInOtherDimensions) {
  expect_answer({.shape = "box = { min = [-1, 0], max = [1, 2] }, spacing = 0.25"}, {"bar", "x = -1 m", "one half"});
  expect_answer({.shape = "box = { min = [0, 0, 0], max = [1, 1, 1] }, spacing = 0.25",
                 .of_body = "initial_velocity = [0, 0, 0]"},
                {"not in 2D", "half sections"});
  expect_answer({.shape = "sphere = { centre = [0.5, 0], radius = 1 }, spacing = 0.2"},
                {"500 mm", "radius 1 m", "move the centre"});
  expect_answer({.shape = "sphere = { centre = [0, 0], radius = 1, arrangement = \"rings\" }, spacing = 0.2"},
                {"arrangement", "circles in the section", "packed"});
}

TEST(AxisymmetryMessages, FormulationsAndTheirAssumptions) {
  expect_answer({.formulation = "name = \"jst_sph\""}, {"jst_sph", "axisymmetric bodies", "nodal"});
  expect_answer({.formulation = "name = \"nodal\", assumption = \"plane_stress\""}, {"assumption", "leave it out"});
  expect_answer({.formulation = "name = \"nodal\", pressure = \"implicit\""}, {"pressure", "explicit"});
}

TEST(AxisymmetryMessages, HolesAlongAnotherLineThanTheAxis) {
  std::string const probe = "[[probe]]\nname = \"p\"\nbody = \"bar\"\nkind = \"hole\"\nslab_from = 0\nslab_to = 1\n";
  EXPECT_EQ(answer_to({.more = probe + "at = [0, 1]\naxis = \"y\"\n"}), "");
  expect_answer({.more = probe + "at = [0, 1]\naxis = \"x\"\n"}, {"\"p\"", "axis = \"y\"", "at = [0, ...]"});
  expect_answer({.more = probe + "at = [1, 1]\naxis = \"y\"\n"}, {"\"p\"", "axis = \"y\"", "at = [0, ...]"});
}

TEST(AxisymmetryMessages, ShapesThatCannotBeReadHideNoDimension) {
  std::string const answer =
      answer_to({.shape = "bax = { min = [0, 0], max = [1, 2] }, spacing = 0.25",
                 .more = "[[support]]\nbody = \"bar\"\nwhere = \"X > 0.9\"\nfix = \"y\"\nvelocity = [0, 1]\n"});
  EXPECT_NE(answer.find("bax"), std::string::npos);
  EXPECT_EQ(answer.find("a list of"), std::string::npos) << answer;
}

TEST(AxisymmetryMessages, MotionAndLoadsAcrossTheAxis) {
  expect_answer({.of_body = "initial_velocity = [\"1\", \"0\"]"},
                {"initial_velocity[0]", "1 m/s", "on the axis", "multiply it by X"});
  expect_answer({.more = "[[load]]\nbody = \"bar\"\nacceleration = [\"9.81\", \"0\"]\n"}, {"along the radius", "to 0"});
  expect_answer({.more = "[[load]]\nbody = \"bar\"\nface = \"-x\"\npressure = \"1 kPa\"\n"}, {"-x", "no area"});
  expect_answer({.more = "[[mirror]]\nbody = \"bar\"\nface = \"+x\"\n"}, {"mirror", "normal to the radius", "remove"});
}

TEST(AxisymmetryMessages, ProbesThatTurnAboutTheAxis) {
  expect_answer({.more = "[[probe]]\nname = \"turn\"\nbody = \"bar\"\nkind = \"twist\"\naxis = \"z\"\n"},
                {"\"turn\"", "around the axis", "point"});
}

TEST(AxisymmetryMessages, RigidShapesThatAreNoBodiesOfRevolution) {
  auto const rigid = [](std::string const& shape) {
    return Sample{.more = "[[rigid]]\nname = \"r\"\n" + shape + "\n"};
  };
  expect_answer(rigid("plane = { point = [3, 0], normal = [-1, 0] }"), {"\"r\"", "not normal to the axis", "across"});
  expect_answer(rigid("sphere = { centre = [0.2, -3], radius = 1 }"), {"\"r\"", "nearer to the axis", "move it"});
  expect_answer(rigid("sphere = { centre = [0, -3], radius = 1 }\nvelocity = [1, 0]"), {"along the radius", "to 0"});
  expect_answer(rigid("sphere = { centre = [0, -3], radius = 1 }\nangular_velocity = [1]"), {"turns", "leave it out"});
}

}  // namespace
}  // namespace piola
