// SPDX-License-Identifier: Apache-2.0
// Messages about ties: place, key, value, advice.
#include "piola/model/case_particles.hpp"
#include "piola/simulation/build.hpp"
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

/// Two squares of 10 mm, one on the other; a tie starts in line 13.
std::string stack(std::string const& tie, std::string const& upper_min = "\"10 mm\"",
                  std::string const& upper_max = "\"20 mm\"") {
  return R"toml(title = "Stack"
[run]
end = "1 ms"
[[body]]
name = "lower"
shape = { box = { min = [0, 0], max = ["10 mm", "10 mm"] }, spacing = "1 mm", placement = "cell_centred" }
material = { law = "neo_hookean", density = 1000, youngs_modulus = "1 GPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
[[body]]
name = "upper"
shape = { box = { min = [0, )toml" +
         upper_min + R"toml(], max = ["10 mm", )toml" + upper_max +
         R"toml(] }, spacing = "1 mm", placement = "cell_centred" }
material = { law = "neo_hookean", density = 1000, youngs_modulus = "1 GPa", poissons_ratio = 0.3 }
formulation = { name = "jst_sph" }
[[tie]]
)toml" + tie;
}
std::string reported(std::string const& tie) { return message_of(stack(tie)); }
std::string const both = "between = [\"lower\", \"upper\"]\n";

TEST(TieMessages, ATieNamesTwoBodies) {
  EXPECT_EQ(reported(both), "");
  EXPECT_TRUE(mentions(reported(""), {"case.toml:14:1: tie", "between", "names of two bodies", "add between"}));
  EXPECT_TRUE(mentions(reported("between = [\"lower\"]"), {"case.toml:15:11: tie.between", "list of 1", "list of 2"}));
  EXPECT_TRUE(mentions(reported("between = [\"lower\", \"uper\"]"),
                       {"case.toml:15:21: tie.between[1]", "uper", "lower, upper", "did you mean \"upper\""}));
  EXPECT_TRUE(mentions(reported("between = [\"lower\", \"lower\"]"),
                       {"case.toml:15:11: tie.between", "\"lower\" twice", "two bodies", "another body"}));
}

TEST(TieMessages, ConditionsAreNumbers) {
  EXPECT_NE(reported(both + "where = \"log(X - 1)\"").find("tie.where"), std::string::npos);
  EXPECT_NE(reported(both + "where = \"q > 1\"").find("tie.where"), std::string::npos);
}

/// The stack on a rigid floor at a height.
std::string on_floor(std::string const& between, std::string const& height = "0", std::string const& more = "") {
  return stack("between = " + between + "\n" + more + "[[rigid]]\nname = \"floor\"\nplane = { point = [0, " + height +
               "], normal = [0, 1] }\n[[rigid]]\nname = \"ball\"\nsphere = { centre = [\"5 mm\", \"30 mm\"], radius = "
               "\"3 mm\" }\nmotion = \"free\"\nmass = 1\n");
}

TEST(TieMessages, RigidShapesHoldBodies) {
  EXPECT_EQ(message_of(on_floor("[\"lower\", \"floor\"]")), "");
  EXPECT_EQ(message_of(on_floor("[\"floor\", \"lower\"]")), "");
  EXPECT_TRUE(mentions(message_of(on_floor("[\"floor\", \"ball\"]")),
                       {"case.toml:15:11: tie.between", "two rigid shapes", "two bodies", "name a body"}));
  EXPECT_TRUE(
      mentions(message_of(on_floor("[\"lower\", \"flor\"]")),
               {"case.toml:15:21: tie.between[1]", "flor", "lower, upper, floor, ball", "did you mean \"floor\""}));
  EXPECT_TRUE(mentions(message_of(on_floor("[\"lower\", \"floor\"]", "\"-0.7 mm\"")),
                       {"case.toml:15:11:", "tie_0", "holds nothing", "lower", "floor", "0.7 spacings apart",
                        "half a spacing", "touch"}));
  EXPECT_NE(message_of(on_floor("[\"floor\", \"lower\"]", "0", "strength = \"20 MPa\"\ntoughness = \"100 J/m^2\"\n"))
                .find("the tie \"tie_0\" is too soft for its strength"),
            std::string::npos);
}

TEST(TieMessages, BodiesWithAContactOfTheirOwnAreHeldBySurfaces) {
  std::string const solid =
      "material = { law = \"elastic\", density = 7800, youngs_modulus = \"200 GPa\", poissons_ratio = 0.3 }\n"
      "formulation = { name = \"adaptle\", description = \"total_lagrangian\" }\n[[body]]\nname = \"upper\"";
  std::string const rubber =
      "material = { law = \"neo_hookean\", density = 1000, youngs_modulus = \"1 GPa\", poissons_ratio = 0.3 }\n"
      "formulation = { name = \"nodal\" }\n[[body]]\nname = \"upper\"";
  std::string const text = replaced(on_floor("[\"lower\", \"floor\"]"), rubber, solid);
  expect_words(message_of(text), {"case.toml:15:11: the tie \"tie_0\"", "body \"lower\"", "adaptle",
                                  "contact by surfaces", "set contact.law = \"surface\""});
  EXPECT_EQ(message_of(text + "[contact]\nlaw = \"surface\"\n"), "");
}

TEST(TieMessages, NamesOfColumnsAreTheirOwn) {
  EXPECT_TRUE(mentions(reported("name = \"glue\"\n" + both + "[[tie]]\nname = \"glue\"\n" + both),
                       {"case.toml:18:8:", "glue", "taken by another tie", "another name"}));
}

TEST(TieMessages, LawsOfFailureAreWhole) {
  EXPECT_TRUE(mentions(reported(both + "strength = \"1 MPa\""),
                       {"case.toml:14:1: tie", "toughness", "energy", "area", "add toughness = \"100 J/m^2\""}));
  EXPECT_TRUE(mentions_each(reported(both + "toughness = 100\nshear_weight = 2"),
                            {{"case.toml:16:13: tie.toughness", "only by a tie with a strength", "remove"},
                             {"case.toml:17:16: tie.shear_weight", "only by a tie with a strength", "remove"}}));
  EXPECT_TRUE(mentions_each(
      reported(both + "strength = \"1 MPa\"\ntoughness = \"-5 J/m^2\"\nstiffness = 0"),
      {{"case.toml:17:13: tie.toughness", "-5 J/m^2", "above 0"}, {"case.toml:18:13: tie.stiffness", "0", "above 0"}}));
  EXPECT_EQ(reported(both + "strength = \"1 MPa\"\ntoughness = \"100 J/m^2\"\nshear_weight = 0.5"), "");
}

TEST(TieMessages, TheElasticBranchIsShort) {
  // K = 2 M / dp = 2.69e12 Pa/m; it softens from 7.43 um on and has failed at 10 um.
  EXPECT_EQ(reported(both + "strength = \"20 MPa\"\ntoughness = \"100 J/m^2\""),
            "case.toml:16:12: the tie \"tie_0\" is too soft for its strength: it opens by 7.43 um before it softens, "
            "and 10 um is where it has failed (allowed: a tenth of that) - take stiffness = 14.9 or more, a smaller "
            "strength or a smaller spacing");
}

TEST(TieMessages, ATieHoldsSomething) {
  EXPECT_TRUE(mentions(message_of(stack(both, "\"10.7 mm\"", "\"20.7 mm\"")),
                       {"case.toml:15:11:", "tie_0", "holds nothing", "lower", "upper", "0.7 spacings apart",
                        "half a spacing", "touch"}));
  EXPECT_TRUE(mentions(message_of(stack(both, "\"15 mm\"", "\"20 mm\"")),
                       {"case.toml:15:11:", "tie_0", "holds nothing", "lower", "upper", "no surfaces face each other",
                        "two spacings", "half a spacing", "touch"}));
  EXPECT_TRUE(mentions(reported(both + "where = \"X > 1\""),
                       {"case.toml:15:11:", "tie_0", "holds nothing", "lower", "upper", "condition",
                        "no surfaces face each other", "two spacings", "half a spacing", "change where"}));
  EXPECT_EQ(message_of(stack(both, "\"10.4 mm\"", "\"20.4 mm\"")), "") << "a small gap is glue";
}

TEST(TieMessages, BodiesNeedSurfaces) {
  std::string const on_faces =
      replaced(stack(both), "[\"10 mm\", \"20 mm\"] }, spacing = \"1 mm\", placement = \"cell_centred\" }",
               "[\"10 mm\", \"20 mm\"] }, spacing = \"1 mm\" }");
  std::string const mirrored = on_faces + "[[mirror]]\nbody = \"upper\"\nface = \"-x\"\n";
  std::string const held = message_of(mirrored + "antisymmetric = true\n[contact]\nlaw = \"none\"\n");
  expect_words(held, {"case.toml:15:11: the tie \"tie_0\" cannot hold body \"upper\"", "antisymmetric mirror planes",
                      "nodal, jst_sph, taylor_sph"});
  std::string const thin = replaced(stack(both), "\"20 mm\"] }, spacing", "\"11 mm\"] }, spacing");
  EXPECT_NE(message_of(thin).find("is too thin"), std::string::npos) << message_of(thin);
}

TEST(TieMessages, WhatStaysFreeIsToldOf) {
  std::string const wedge = replaced(stack(both), "formulation = { name = \"jst_sph\" }",
                                     "formulation = { name = \"jst_sph\" }\ninitial_displacement = [0, \"0.2*X\"]");
  auto const warnings = build(read_case_text(wedge, "case.toml")).warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(
      warnings.back(),
      "case.toml:16:11: the tie \"tie_0\" holds 5 points, but 11 more that face the other body are farther from "
      "it than half a spacing, as a gap or an overlap, and stay free - let the bodies touch, or select the points "
      "by where");
  EXPECT_EQ(reported(both + "where = \"X < 0.001 && Y*0 == 0 && X > 0.0001\""), "");
}

TEST(TieMessages, ZonesThatSpacingsDoNotResolveAreWarnedOf) {
  CaseSpec const spec = read_case_text(stack(both + "strength = \"12 MPa\"\ntoughness = \"300 J/m^2\"\n"), "case.toml");
  auto const warnings = build(spec).warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings.back(),
            "case.toml:16:12: the tie \"tie_0\" softens over a length of about E G_c/t_max^2 = 2.08 mm, 2.1 spacings, "
            "which takes three or more - take a smaller strength or a smaller spacing");
}

}  // namespace
}  // namespace piola
