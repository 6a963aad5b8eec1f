// SPDX-License-Identifier: Apache-2.0
// Messages about invalid rigid shapes, contact rules and round bodies: place, key, value, advice.
#include "piola/formulations/registry.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;
using test::mentions;
using test::mentions_each;
using test::message_of;
using test::sample_case;
using test::sample_with;

// The sample has 22 lines, so that what is added starts in line 23.
std::string with(std::string const& more) { return message_of(sample_case() + more); }
std::string rigid(std::string const& more) { return with("[[rigid]]\nname = \"wall\"\n" + more + "\n"); }
std::string contact(std::string const& more) { return with("[contact]\n" + more + "\n"); }

/// The sample with another shape, which starts in column 9 of line 9.
std::string shaped(std::string const& shape, std::string const& formulation = "jst_sph") {
  std::string text =
      sample_with(R"(box = { min = ["-0.5 m", 0, "-50 cm"], max = [0.5, "6 m", 0.5] }, particles = [5, 25, 5])", shape);
  if (formulation != "jst_sph")
    text = test::replaced(text, R"(name = "jst_sph", variables = "pF", eps4_momentum = 0.125)",
                          "name = \"" + formulation + "\"");
  return text;
}

TEST(ContactMessages, FormulationsWithoutContactSayWhoKnowsIt) {
  FormulationInfo const other{"other", {}, {}, {}, {}};
  EXPECT_TRUE(mentions(refusal(other, "contact"), {"formulation", "\"other\"", "no contact", "contact in"}));
  for (char const* who : {"nodal", "jst_sph", "taylor_sph", "adaptle"})
    EXPECT_NE(refusal(other, "contact").find(who), std::string::npos) << who;
}

std::string two(std::string const& a, std::string const& b, std::string const& more) {
  auto const body = [](std::string const& name, std::string const& at, std::string const& formulation) {
    std::string const law = formulation == "adaptle"   ? "elastic"
                            : formulation == "jst_sph" ? "neo_hookean"
                                                       : "linear_elastic";
    return "[[body]]\nname = \"" + name + "\"\nshape = { box = { min = [0, " + at + "], max = [1, 1" + at +
           "] }, spacing = 0.1 }\nmaterial = { law = \"" + law +
           "\", density = 1, youngs_modulus = 1, poissons_ratio = 0.3 }\nformulation = { name = \"" + formulation +
           "\" }\n";
  };
  return message_of("title = \"T\"\n[run]\nend = 1\n" + body("a", "0", a) + body("b", "20", b) + more);
}

// Asked for and not there: refused, with the body that is in the way.
TEST(ContactMessages, FrictionNeedsTwoSurfaces) {
  std::string const friction = "[contact]\nfriction = 0.3\n";
  EXPECT_EQ(two("nodal", "jst_sph", friction), "");
  EXPECT_EQ(two("taylor_sph", "nodal", friction), "");
  EXPECT_EQ(two("adaptle", "nodal", ""), "") << "contact by the colour function";
  EXPECT_TRUE(mentions(two("adaptle", "nodal", friction),
                       {"case.toml:15:12: contact.friction", "nothing to act on", "body \"a\" has no surface",
                        "adaptle", "failed = \"delete\"", "nodal, jst_sph, taylor_sph", "remove it"}));
  EXPECT_EQ(two("adaptle", "nodal", "[[contact]]\nbetween = [\"a\", \"b\"]\nscale = 2\n"), "");
  expect_words(two("adaptle", "nodal", "[[contact]]\nbetween = [\"a\", \"b\"]\nfriction = 0.1\n"),
               {"contact.between: body \"a\"", "no surface"});
  EXPECT_NE(two("adaptle", "adaptle", "[contact]\nself = true\n").find("contact.self has nothing to act on"),
            std::string::npos);
  EXPECT_NE(two("adaptle", "nodal", "[contact]\nself = true\n").find("contact.self has nothing to act on: body \"a\""),
            std::string::npos);
}

// Bodies that nothing keeps apart are refused, unless the case excludes contact between them.
TEST(ContactMessages, WhatCannotMeetIsRefused) {
  std::string const skew = "[[mirror]]\nbody = \"a\"\nface = \"-x\"\nantisymmetric = true\n";
  EXPECT_EQ(two("jst_sph", "nodal", skew),
            "case.toml:8:15: body \"a\": nothing keeps it apart from \"b\" (it has antisymmetric mirror planes), so "
            "that they would pass through one another (allowed: nodal, jst_sph, taylor_sph and total-Lagrangian "
            "adaptle, without antisymmetric mirrors) - change the body; or say contact = \"none\", or law = \"none\" "
            "in [[contact]] between them, if they are not to be in contact");
  EXPECT_EQ(two("jst_sph", "nodal", skew + "[contact]\nlaw = \"none\"\n"), "");
  EXPECT_EQ(two("jst_sph", "nodal", skew + "[[contact]]\nbetween = [\"b\", \"a\"]\nlaw = \"none\"\n"), "");
}

// Kernel sums hold free surfaces free of stress.
TEST(ContactMessages, KernelSumsOfTaylorHaveNoContact) {
  std::string const kernel_sums = "taylor_sph\", exchange = \"kernel_sums",
                    fixed = "taylor_sph\", configuration = \"fixed";
  expect_words(two(kernel_sums, "nodal", ""), {"body \"a\": nothing keeps it apart from \"b\"", "kernel sums"});
  EXPECT_NE(two("nodal", fixed, "").find("body \"b\": nothing keeps it apart from \"a\""), std::string::npos);
  EXPECT_EQ(two(fixed + "\", exchange = \"adjoint", "nodal", ""), "");
  EXPECT_EQ(two(fixed, "nodal", "[contact]\nlaw = \"none\"\n"), "");
  EXPECT_NE(two(fixed, "nodal", "[[tie]]\nname = \"glue\"\nbetween = [\"a\", \"b\"]\n")
                .find("cannot hold body \"a\": kernel sums"),
            std::string::npos);
}

// A plane of symmetry is one of all bodies in contact there.
TEST(ContactMessages, BodiesThatMeetShareTheirMirrors) {
  auto const mirror = [](std::string const& body, std::string const& face) {
    return "[[mirror]]\nbody = \"" + body + "\"\nface = \"" + face + "\"\n";
  };
  EXPECT_EQ(two("jst_sph", "jst_sph", mirror("a", "-x") + mirror("b", "-x")), "");
  EXPECT_EQ(two("jst_sph", "jst_sph", mirror("a", "-y")), "") << "the other one stays on its side";
  EXPECT_EQ(two("jst_sph", "jst_sph", mirror("a", "-x")),
            "case.toml:16:8: the mirror plane of body \"a\", x = 0 m, touches body \"b\", which is no mirror there "
            "(allowed: bodies in contact have the same mirror planes, or stay off them) - give both the mirror, or "
            "neither");
  EXPECT_NE(two("jst_sph", "jst_sph", mirror("b", "-y")).find("cuts through body \"a\""), std::string::npos);
  expect_words(two("jst_sph", "jst_sph",
                   mirror("a", "-x") + mirror("b", "-x") +
                       "[[rigid]]\nname = \"stone\"\nmotion = \"free\"\nmass = 1\n"
                       "sphere = { centre = [0.5, 50], radius = 1 }\n"),
               {"free rigid shape \"stone\"", "touch body \"a\"", "mirror planes"});
}

TEST(ContactMessages, ABarCannotTouchItself) {
  auto const bar = [](std::string const& more) {
    return message_of(
        "title = \"T\"\n[run]\nend = 1\n[[body]]\nname = \"bar\"\nshape = { box = { min = [0], max = [1] }, spacing = "
        "0.1 }\nmaterial = { law = \"neo_hookean\", density = 1, youngs_modulus = 1, poissons_ratio = 0.3 }\n"
        "formulation = { name = \"jst_sph\" }\n[[rigid]]\nname = \"wall\"\nplane = { point = [-1], normal = [1] }\n" +
        more);
  };
  EXPECT_EQ(bar("[contact]\nscale = 2\n"), "");
  EXPECT_TRUE(mentions(bar("[contact]\nself = true\n"), {"case.toml:13:8: contact.self", "1D", "2D, 3D", "remove"}));
}

TEST(ContactMessages, FrictionIsANumberThatIsNotNegative) {
  EXPECT_EQ(contact("friction = 0"), "");
  EXPECT_TRUE(mentions(contact("friction = -0.1"), {"case.toml:24:12: contact.friction", "-0.1", "from 0 to 10"}));
  EXPECT_NE(contact("law = \"none\"\nfriction = 0.1").find("is used only by the law"), std::string::npos);
}

std::string pairs(std::string const& more) {
  return with("[[rigid]]\nname = \"wall\"\nplane = { point = [0, -1, 0], normal = [0, 1, 0] }\n[[contact]]\n" + more +
              "\n");
}

TEST(ContactMessages, PairsNameWhatIsThere) {
  EXPECT_EQ(pairs("between = [\"column\", \"wall\"]\nfriction = 0.3"), "");
  EXPECT_EQ(pairs("friction = 0.2\n[[contact]]\nbetween = [\"column\", \"column\"]"), "");
  EXPECT_TRUE(mentions(pairs("between = [\"column\", \"wal\"]"),
                       {"case.toml:27:11: contact.between", "wal", "column, wall", "did you mean \"wall\""}));
  EXPECT_TRUE(mentions(pairs("between = [\"wall\", \"wall\"]"),
                       {"case.toml:27:11: contact.between", "two rigid shapes", "name a body"}));
  EXPECT_NE(pairs("between = [\"column\"]").find("case.toml:27:11: contact.between"), std::string::npos);
  expect_words(pairs("between = [\"column\", \"wall\"]\n[[contact]]\nbetween = [\"wall\", \"column\"]"),
               {"case.toml:29:11: contact.between", "second time"});
  EXPECT_NE(pairs("friction = 0.1\n[[contact]]\nfriction = 0.2").find("a second [[contact]] without between"),
            std::string::npos);
}

TEST(ContactMessages, PairsHaveKeysOfTheirOwn) {
  std::string const pair = "between = [\"column\", \"wall\"]\n";
  EXPECT_TRUE(mentions(pairs(pair + "closing_speed = 1"),
                       {"case.toml:28:17: contact.closing_speed", "not for a pair", "remove"}));
  EXPECT_NE(pairs(pair + "law = \"linear\"").find("contact.law of a pair is neither"), std::string::npos);
  EXPECT_NE(pairs(pair + "law = \"none\"\nfriction = 0.1").find("is used only by the law"), std::string::npos);
  EXPECT_NE(pairs("law = \"none\"\n[[contact]]\n" + pair).find("contact.law is \"none\" for all"), std::string::npos);
  EXPECT_EQ(message_of("contact = \"none\"\n" + sample_case()), "");
  EXPECT_TRUE(mentions(message_of("contact = \"off\"\n" + sample_case()),
                       {"case.toml:1:11: contact", "\"off\"", "contact = { ... }", "[[contact]]", "\"none\""}));
}

TEST(ContactMessages, RigidShapesWithoutContactPushNobody) {
  EXPECT_TRUE(mentions(message_of("contact = \"none\"\n" + sample_case() +
                                  "[[rigid]]\nname = \"wall\"\nplane = { point = [0, -1, 0], normal = [0, 1, 0] }\n"),
                       {"case.toml:24:1:", "wall", "no contact", "contact.law is \"none\"", "remove one"}));
}

TEST(ContactMessages, FrictionAtRestNeedsASpeed) {
  EXPECT_EQ(contact("friction = 0.2\nstatic_friction = 0.3\ndecay_speed = \"1 cm/s\""), "");
  EXPECT_TRUE(mentions(contact("static_friction = 0.3"),
                       {"case.toml:23:1: contact", "decay_speed", "static_friction", "add decay_speed = \"10 mm/s\""}));
  EXPECT_TRUE(mentions(contact("friction = 0.4\nstatic_friction = 0.3\ndecay_speed = 1"),
                       {"case.toml:25:19: contact.static_friction", "0.3", "at least friction", "0.4"}));
  EXPECT_NE(contact("decay_speed = 1").find("is used only with static_friction"), std::string::npos);
  EXPECT_NE(contact("shear_limit = \"1 MPa\"").find("is used only with friction"), std::string::npos);
}

TEST(ContactMessages, PairsOfAdaptleAreItsOwn) {
  std::string const pair =
      "[[contact]]\nbetween = [\"column\", \"wall\"]\nfriction = 0.3\n[[rigid]]\nname = \"wall\"\n"
      "plane = { point = [0, -1, 0], normal = [0, 1, 0] }\n";
  std::string text = sample_with("neo_hookean", "elastic");
  text = test::replaced(text, R"(name = "jst_sph", variables = "pF", eps4_momentum = 0.125)",
                        R"(name = "adaptle", description = "total_lagrangian")");
  EXPECT_NE(message_of(text + pair).find("adaptle keeps apart by a contact of its own"), std::string::npos);
  text = test::replaced(text, "total_lagrangian", "adaptive");
  EXPECT_NE(message_of(text + pair).find("has no surface by which others could push it"), std::string::npos);
}

TEST(ContactMessages, TheLawOfSurfacesNeedsSurfaces) {
  std::string text = sample_with("neo_hookean", "elastic");
  text = test::replaced(text, R"(name = "jst_sph", variables = "pF", eps4_momentum = 0.125)",
                        R"(name = "adaptle", description = "total_lagrangian")");
  std::string const law = "[contact]\nlaw = \"surface\"\nfriction = 0.2\n";
  EXPECT_EQ(message_of(text + law), "");
  EXPECT_TRUE(mentions(message_of(test::replaced(text, "total_lagrangian", "adaptive") + law),
                       {"case.toml:24:7: contact.law", "\"surface\"", "column", "keeps none", "total_lagrangian",
                        "failed = \"delete\"", "law or description"}));
}

TEST(ContactMessages, RigidShapesAreOfOneKind) {
  EXPECT_TRUE(mentions(rigid(""), {"case.toml:23:1: rigid", "plane, sphere, cylinder, box", "none", "add"}));
  EXPECT_TRUE(
      mentions(rigid("sphere = { centre = [0, 0, 0], radius = 1 }\nplane = { point = [0, 0, 0], normal = [0, 1, 0] }"),
               {"case.toml:23:1: rigid", "2 of plane, sphere, cylinder, box", "keep one"}));
  EXPECT_TRUE(mentions(rigid("cone = 1\nsphere = { centre = [0, 0, 0], radius = 1 }"),
                       {"case.toml:25:1:", "cone", "rigid", "name, plane", "turns", "choose"}));
  EXPECT_TRUE(mentions(with("[[rigid]]\nplane = { point = [0, -1, 0], normal = [0, 1, 0] }\n"),
                       {"case.toml:23:1: rigid", "\"name\"", "columns", "add name"}));
}

TEST(ContactMessages, RigidShapesHaveSoundNumbers) {
  EXPECT_TRUE(mentions_each(rigid("plane = { point = [0, -1], normal = [0, 0, 0] }"),
                            {{"case.toml:25:19: rigid.plane.point", "2 components", "3"},
                             {"case.toml:25:37: rigid.plane.normal", "zero", "any other length", "direction"}}));
  EXPECT_TRUE(mentions(rigid("sphere = { centre = [0, 0, 0], radius = \"-1 mm\" }"),
                       {"case.toml:25:41: rigid.sphere.radius", "-0.001 m", "from 1e-15 to 1e+15"}));
  EXPECT_TRUE(mentions_each(rigid("cylinder = { centre = [0, 0, 0], radius = 1 }"),
                            {{"case.toml:25:12: rigid.cylinder", "\"axis\"", "direction", "add axis"},
                             {"case.toml:25:12: rigid.cylinder", "\"length\"", "add length = \"1 m\""}}));
  EXPECT_TRUE(mentions(rigid("box = { min = [0, 0, 0], max = [1, 0, 1] }"),
                       {"case.toml:25:32: rigid.box.max[1]", "0 m", "above min", "0 m"}));
  EXPECT_TRUE(mentions(
      rigid("box = { min = [0, 0, 0], centre = [1, 0, 1] }"),
      {"case.toml:25:7: rigid.box", "min and max", "centre and lengths", "one of the two pairs", "box = { min"}));
  EXPECT_TRUE(mentions(rigid("box = { lengths = [1, 0, 1], centre = [1, 0, 1] }"),
                       {"case.toml:25:23: rigid.box.lengths[1]", "0 m", "from 1e-15 to 1e+15"}));
}

TEST(ContactMessages, RigidShapesMoveAsOne) {
  EXPECT_TRUE(mentions(
      rigid("plane = { point = [0, -1, 0], normal = [0, 1, 0] }\nvelocity = [\"X\", \"Omega*L*t\", 0]"),
      {"case.toml:26:12: rigid.velocity[0]", "formula \"X\"", "uses X", "t and the constants", "moves as one"}));
}

TEST(ContactMessages, EachLawHasItsNumbers) {
  EXPECT_TRUE(
      mentions(contact("law = \"lineer\""), {"case.toml:24:7: contact.law", "lineer",
                                             "kernel, linear, published, surface, none", "did you mean \"linear\""}));
  EXPECT_TRUE(mentions(contact("stiffness = 1"),
                       {"case.toml:24:13: contact.stiffness", "only by the law \"published\"", "remove"}));
  EXPECT_TRUE(mentions(contact("law = \"published\""),
                       {"case.toml:23:1: contact", "stiffness", "Pa/m^3", "add stiffness = \"1e16 Pa/m^3\""}));
  EXPECT_TRUE(mentions_each(contact("law = \"published\"\nstiffness = -1\nclosing_speed = 5"),
                            {{"case.toml:25:13: contact.stiffness", "-1 Pa/m^3", "above 0"},
                             {"case.toml:26:17: contact.closing_speed", "only by the law \"kernel\"", "remove"}}));
  EXPECT_TRUE(mentions(contact("law = \"linear\"\nexponent = 4"),
                       {"case.toml:25:12: contact.exponent", "only by the law \"kernel\" or \"published\"", "remove"}));
  EXPECT_TRUE(mentions(contact("law = \"none\"\nscale = 2"),
                       {"case.toml:25:9: contact.scale",
                        "only by the law \"kernel\", \"linear\", \"published\" or \"surface\"", "remove"}));
}

TEST(RoundBodyMessages, ArrangementsAreForDiscs) {
  EXPECT_TRUE(mentions(
      message_of(shaped("sphere = { centre = [0, 0, 0], radius = 1, arrangement = \"rings\" }, spacing = 0.2")),
      {"case.toml:9:68: body.shape.sphere.arrangement", "rings", "3D: lattice", "discs"}));
  EXPECT_TRUE(
      mentions(message_of(shaped("sphere = { centre = [0, 0, 0], radius = 1, inner_radius = 1 }, spacing = 0.2")),
               {"case.toml:9:69: body.shape.sphere.inner_radius", "1 m", "below radius", "1 m"}));
}

}  // namespace
}  // namespace piola
