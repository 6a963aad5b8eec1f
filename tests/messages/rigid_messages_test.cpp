// SPDX-License-Identifier: Apache-2.0
// Messages about free and rotating rigid shapes: place, key, value, advice.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;
using test::mentions;
using test::mentions_each;
using test::message_of;
using test::replaced;
using test::sample_case;
using test::sample_with;

constexpr char const* ball = "sphere = { centre = [20, 0, 0], radius = 1 }\n";

// The sample has 22 lines, so that the motion starts in line 26.
std::string moving(std::string const& more, std::string const& shape = ball) {
  return message_of(sample_case() + "[[rigid]]\nname = \"stone\"\n" + shape + more + "\n");
}
std::string free(std::string const& more, std::string const& shape = ball) {
  return moving("motion = \"free\"\n" + more, shape);
}

TEST(RigidMessages, FreeShapesHaveAMass) {
  EXPECT_EQ(free("mass = \"2 kg\""), "");
  EXPECT_EQ(free("density = \"7.8 g/cm^3\""), "");
  EXPECT_EQ(free(""), "case.toml:26:10: a free rigid shape has no mass (allowed: mass or density) - give one of them");
  EXPECT_TRUE(mentions(free("mass = 1\ndensity = 2"),
                       {"case.toml:27:8:", "free rigid shape", "mass and density", "one of them"}));
  EXPECT_TRUE(mentions(free("mass = \"1 kg/m\""), {"case.toml:27:8: rigid.mass", "1 kg/m", "quantity in kg"}));
  EXPECT_EQ(free("mass = -1"), "case.toml:27:8: rigid.mass is -1 kg (allowed: above 0)");
  EXPECT_TRUE(mentions(free("mass = 1", "plane = { point = [0, -9, 0], normal = [0, 1, 0] }\n"),
                       {"case.toml:26:10:", "plane", "free", "sphere, cylinder, box", "box"}));
}

TEST(RigidMessages, FreeShapesStartWithAVelocity) {
  EXPECT_EQ(free("mass = 1\nvelocity = [\"5 m/s\", 0, 0]\nangular_velocity = [0, \"90 rad/s\", \"Omega\"]"), "");
  EXPECT_TRUE(mentions_each(
      free("mass = 1\nvelocity = [\"t\", \"X\", 0]\nangular_velocity = [1, 2]"),
      {{"case.toml:28:12: rigid.velocity[0]", "formula \"t\"", "uses t", "the constants", "start"},
       {"case.toml:28:12: rigid.velocity[1]", "formula \"X\"", "uses X", "t and the constants", "moves as one"},
       {"case.toml:29:20: rigid.angular_velocity", "list of 2", "list of 3"}}));
  EXPECT_TRUE(mentions_each(free("mass = 1\nfix = \"xq\"\nturns = false\nangular_velocity = [1, 0, 0]"),
                            {{"case.toml:28:7: rigid.fix", "xq", "letters xyz"},
                             {"case.toml:30:20: rigid.angular_velocity", "turns = false", "remove"}}));
  EXPECT_TRUE(mentions(free("mass = 1\ngravity = [0, \"1/t\", 0]"),
                       {"case.toml:28:11: rigid.gravity[1]", "1/t", "inf", "t = 0", "finite"}));
}

TEST(RigidMessages, MomentsOfInertiaAreThoseOfSomeBody) {
  std::string const mass = "mass = 1\ninertia = ";
  EXPECT_EQ(free(mass + "[1, 2, \"2.5 kg m^2\"]"), "");
  EXPECT_EQ(free(mass + "[[2, -1, 0], [-1, 2, 0], [0, 0, 3.5]]"), "");
  EXPECT_EQ(free(mass + "[1, 1, 2]"), "") << "a thin plate";
  EXPECT_EQ(
      free(mass + "[1, 2, 3.5]"),
      "case.toml:28:11: rigid.inertia has the principal moments 1, 2 and 3.5 kg m^2 (allowed: none above the sum of "
      "the others, as mass has no negative part)");
  EXPECT_TRUE(
      mentions(free(mass + "[1, 0, 1]"), {"case.toml:28:11: rigid.inertia", "principal moment 0 kg m^2", "above 0"}));
  EXPECT_TRUE(mentions(free(mass + "[[1, 2, 0], [2, 1, 0], [0, 0, 1]]"),
                       {"case.toml:28:11: rigid.inertia", "principal moment -1 kg m^2", "above 0"}));
  EXPECT_TRUE(mentions(free(mass + "[[2, 1, 0], [0, 2, 0], [0, 0, 3]]"),
                       {"case.toml:28:11: rigid.inertia", "1 in row 0", "0 in row 1", "symmetric"}));
  EXPECT_NE(free(mass + "[1, \"2 kg\", 1]").find("is not a quantity in kg m^2"), std::string::npos);
  EXPECT_NE(free(mass + "[1, 2]").find("rigid.inertia is a list of 2 (allowed: a list of 3)"), std::string::npos);
  EXPECT_NE(free(mass + "[[1, 0, 0], 2, 3]").find("rigid.inertia[1] is 2"), std::string::npos);
  EXPECT_TRUE(
      mentions(free(mass + "[1, 1, 1]\nturns = false"), {"case.toml:28:11: rigid.inertia", "turns = false", "remove"}));
  EXPECT_TRUE(mentions(moving("inertia = [1, 1, 1]"),
                       {"case.toml:26:11: rigid.inertia", "only with motion = \"free\"", "remove"}));
}

TEST(RigidMessages, OtherShapesAreFixedOrDriven) {
  EXPECT_EQ(moving("motion = \"fixed\""), "");
  EXPECT_EQ(moving("motion = \"driven\"\nangular_velocity = [\"sin(t)\", 0, 0]"), "");
  EXPECT_TRUE(mentions(moving("motion = \"fixed\"\nvelocity = [1, 0, 0]"),
                       {"case.toml:27:12: rigid.velocity", "only by shapes that move", "remove"}));
  EXPECT_TRUE(mentions(moving("motion = \"driven\""),
                       {"case.toml:23:1: rigid", "velocity", "driven", "add velocity", "angular_velocity"}));
  EXPECT_TRUE(mentions(moving("motion = \"loose\""),
                       {"case.toml:26:10: rigid.motion", "loose", "fixed, driven, free", "choose"}));
  EXPECT_TRUE(mentions_each(moving("mass = 1\ngravity = [0, 0, -9.81]\nturns = false"),
                            {{"case.toml:26:8: rigid.mass", "only with motion = \"free\"", "remove"},
                             {"case.toml:27:11: rigid.gravity", "only with motion = \"free\"", "remove"},
                             {"case.toml:28:9: rigid.turns", "only with motion = \"free\"", "remove"}}));
}

TEST(RigidMessages, FreeShapesNeedSurfacesAndPartners) {
  std::string const stone = std::string("[[rigid]]\nname = \"stone\"\nmotion = \"free\"\nmass = 1\n") + ball;
  std::string text = sample_with("neo_hookean", "elastic");
  text = replaced(text, R"(name = "jst_sph", variables = "pF", eps4_momentum = 0.125)", "name = \"adaptle\"");
  std::string const surfaces = "nodal, jst_sph, taylor_sph, or adaptle with description = \"total_lagrangian\"";
  expect_words(message_of(text + stone),
               {"free rigid shape \"stone\" apart from body \"column\"", surfaces, "change the body"});
  expect_words(message_of(sample_case() + stone + "[contact]\nlaw = \"none\"\n"),
               {"free rigid shape \"stone\" apart from body \"column\"", surfaces, "change the body"});
  // Contact between the two may be switched off if another body can touch the shape.
  std::string const other =
      "[[body]]\nname = \"plate\"\nshape = { box = { min = [-9, -3, -9], max = [9, -1, 9] }, "
      "particles = [9, 3, 9] }\nmaterial = { law = \"elastic\", density = 1000, youngs_modulus = "
      "1e7, poissons_ratio = 0.3 }\nformulation = { name = \"nodal\" }\n";
  expect_words(message_of(text + other + stone), {"law = \"none\" in [[contact]]"});
  std::string const alone = "[[contact]]\nbetween = [\"column\", \"stone\"]\nlaw = \"none\"\n";
  EXPECT_EQ(message_of(text + other + stone + alone), "");
  EXPECT_NE(message_of(text + stone + alone).find("nothing keeps the free rigid shape"), std::string::npos)
      << "the shape would touch no body";
  EXPECT_TRUE(mentions(message_of(sample_case() + replaced(stone, "stone", "column")),
                       {"case.toml:24:8:", "column", "taken by a body", "one name for one of them", "another name"}));
  std::string const wall = "[[rigid]]\nname = \"wall\"\n";
  EXPECT_EQ(message_of(sample_case() + stone + wall + "plane = { point = [22, 0, 0], normal = [-1, 0, 0] }\n"), "");
  EXPECT_EQ(
      message_of(sample_case() + stone + wall + "plane = { point = [20.5, 0, 0], normal = [-1, 0, 0] }\n"),
      "case.toml:28:1: the rigid shapes \"stone\" and \"wall\" start 500 mm inside each other (allowed: apart, or "
      "touching) - move one of them");
  std::string const crate =
      "[[rigid]]\nname = \"crate\"\nmotion = \"free\"\nmass = 1\nbox = { min = [30, 0, 0], max = "
      "[31, 1, 1] }\n";
  EXPECT_EQ(message_of(sample_case() + crate + wall + "box = { min = [40, 0, 0], max = [41, 1, 1] }\n"), "");
  EXPECT_EQ(message_of(sample_case() + crate + wall + "box = { min = [31, 0, 0], max = [41, 1, 1] }\n"), "");
  EXPECT_TRUE(mentions(message_of(sample_case() + crate + wall + "box = { min = [30.8, 0, 0], max = [41, 1, 1] }\n"),
                       {"case.toml:28:1:", "crate", "wall", "200 mm inside", "apart", "move"}));
}

}  // namespace
}  // namespace piola
