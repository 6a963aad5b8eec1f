// SPDX-License-Identifier: Apache-2.0
// Messages about invalid supports, loads and mirrors: place, key, value, advice.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;
using test::mentions_each;
using test::message_of;
using test::replaced;
using test::sample_case;
using test::sample_with;

// The sample has 22 lines, so that what is added starts in line 23.
std::string with(std::string const& more) { return message_of(sample_case() + more); }

TEST(BoundaryMessages, SupportsSayWhatMayBeHeld) {
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"normal\"")),
            "case.toml:14:1: support needs \"normal\" (the direction that fix refers to) - add normal = [1, 1, 0]");
  EXPECT_TRUE(mentions(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nnormal = [1, 1, 0]")),
                       {"case.toml:17:7: support.fix", "xyz", "\"normal\", \"tangent\"", "remove normal"}));
  EXPECT_TRUE(mentions(message_of(sample_with("fix = \"xyz\"", "fix = \"tangent\"\nnormal = [0, 0, 0]")),
                       {"case.toml:18:10: support.normal", "zero", "any other length", "direction"}));
  EXPECT_TRUE(mentions(message_of(sample_with("fix = \"xyz\"", "fix = \"tangent\"\nnormal = [1, 0]")),
                       {"case.toml:18:10: support.normal", "2 components", "3"}));
  EXPECT_TRUE(mentions_each(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nuntill = 1\nuntil = 0")),
                            {{"case.toml:18:1:", "untill", "support", "until", "did you mean \"until\""},
                             {"case.toml:19:9: support.until", "0 s", "above 0"}}));
}

TEST(BoundaryMessages, VelocitiesMustBeFiniteAtTheStart) {
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nvelocity = [0, \"1/t\", 0]")),
            "case.toml:18:12: support.velocity[1], formula \"1/t\" is inf at X = (-0.5, 0, -0.5) m of body \"column\" "
            "(allowed: a finite number at every particle)");
  EXPECT_TRUE(mentions(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nvelocity = [0, 0]")),
                       {"case.toml:18:12: support.velocity", "list of 2", "list of 3"}));
}

TEST(BoundaryMessages, SupportsThatContradictAreNamed) {
  std::string const driven =
      "[[support]]\nbody = \"column\"\nwhere = \"Y <= 0\"\nfix = \"y\"\nvelocity = [0, \"-10*t\", 0]\n";
  EXPECT_EQ(with(driven),
            "case.toml:23:1: support.1 and support.0 (line 14) both hold the particle at X = (-0.5, 0, -0.5) m of body "
            "\"column\", with different velocities (allowed: the same velocity) - let \"where\" leave it out of one of "
            "them");
  EXPECT_TRUE(mentions(
      message_of(sample_with("fix = \"xyz\"", "fix = \"x\"") +
                 "[[support]]\nbody = \"column\"\nwhere = \"X > 0.4\"\nfix = \"normal\"\nnormal = [1, 1, 0]\n"),
      {"case.toml:23:1: support.1", "support.0 (line 14)", "(0.5, 0, -0.5) m", "column", "askew", "right angles",
       "where"}));
}

TEST(BoundaryMessages, LoadsAreOfOneKind) {
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\n"),
                       {"case.toml:23:1: load", "traction, pressure, body_force, acceleration", "none", "add"}));
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\nbody_force = [0, 0, 0]\nacceleration = [0, 0, 0]\n"),
                       {"case.toml:23:1: load", "2 of traction, pressure, body_force, acceleration", "keep one"}));
  EXPECT_TRUE(mentions_each(with("[[load]]\nbody = \"column\"\nforce = [0, 0, 0]\nbody_force = [0, \"1 Pa\", 0]\n"),
                            {{"case.toml:25:1:", "force", "load", "traction", "acceleration", "write \"traction\""},
                             {"case.toml:26:18: load.body_force[1]", "1 Pa", "not a force per volume", "N/m^3"}}));
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\nacceleration = [0, \"1/(Y - 6)\", 0]\nface = \"+x\"\n"),
                       {"case.toml:26:8: load.face", "only by a traction, a pressure or", "remove"}));
  EXPECT_TRUE(
      mentions(with("[[load]]\nbody = \"column\"\nacceleration = [0, \"1/(Y - 6)\", 0]\n"),
               {"case.toml:25:16: load.acceleration[1]", "1/(Y - 6)", "inf", "(-0.5, 6, -0.5) m", "column", "finite"}));
}

TEST(BoundaryMessages, TractionsNeedAFaceOfABox) {
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\n"),
                       {"case.toml:23:1: load", "\"face\" or \"patch\"", "add face = \"+x\""}));
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"y\"\n"),
                       {"case.toml:26:8: load.face", "\"y\"", "-x, +x, -y, +y, -z, +z", "did you mean \"-y\""}));
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"+y\"\nwhere = \"Y <= 3\"\n"),
                       {"case.toml:27:9: load.where", "Y <= 3", "no particle", "+y", "column",
                        "(-0.5, 0, -0.5) m to (0.5, 6, 0.5) m", "condition"}));
  std::string const box = R"(box = { min = ["-0.5 m", 0, "-50 cm"], max = [0.5, "6 m", 0.5] }, particles = [5, 25, 5])";
  EXPECT_TRUE(mentions_each(message_of(sample_with(box, "sphere = { centre = [0, 0, 0], radius = 1 }, spacing = 0.2") +
                                       "[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"+y\"\n"
                                       "[[mirror]]\nbody = \"column\"\nface = \"+y\"\n"),
                            {{"case.toml:26:8:", "column", "no face \"+y\"", "outer"},
                             {"case.toml:29:8:", "column", "no face \"+y\"", "no box", "mirrors"}}));
}

TEST(BoundaryMessages, PressuresActOnFacesAndMayFollowThem) {
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\npressure = 1\nface = \"outer\"\n"),
                       {"case.toml:26:8:", "column", "no face \"outer\"", "-x, +x, -y, +y, -z, +z"}));
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\npressure = \"1/X\"\nface = \"+y\"\n"),
                       {"case.toml:25:12: load.pressure", "1/X", "inf", "(0, 6, -0.5) m", "column", "finite"}));
  EXPECT_TRUE(mentions(with("[[load]]\nbody = \"column\"\ntraction = [0, 1, 0]\nface = \"+y\"\nfollower = true\n"),
                       {"case.toml:27:12: load.follower", "only by a pressure", "remove"}));
}

TEST(BoundaryMessages, NamesThatColumnsBeginWithBelongToOneSection) {
  EXPECT_TRUE(mentions(with("[[load]]\nname = \"support_0\"\nbody = \"column\"\nacceleration = [0, 1, 0]\n"),
                       {"case.toml:24:8:", "support_0", "taken by a support", "one name", "another name"}));
  EXPECT_EQ(with("[[quantity]]\nname = \"base\"\ncolumn = \"support_0.force_y\"\ntake = \"mean\"\nunit = \"kN\"\n"),
            "");
}

TEST(BoundaryMessages, MirrorsNeedParticlesOnTheirFace) {
  std::string const mirror = "[[mirror]]\nbody = \"column\"\nface = \"+z\"\n";
  EXPECT_EQ(message_of(replaced(sample_with("particles = [5, 25, 5]", "spacing = 0.25, placement = \"cell_centred\""),
                                "Y <= 0", "Y <= 1") +
                       mirror),
            "case.toml:24:8: a mirror needs particles on its face in \"jst_sph\", but those of body \"column\" are in "
            "the middle of cells (allowed: placement = \"on_boundary\"; any with nodal) - change body.shape");
  EXPECT_TRUE(mentions(
      message_of(sample_with("[5, 25, 5]", "[5, 25, 1]") + mirror),
      {"case.toml:25:8:", "+z", "column", "mirror", "single particle in z", "2 or more", "body.shape.particles"}));
  EXPECT_TRUE(mentions(with(mirror + mirror),
                       {"case.toml:28:8:", "+z", "column", "mirror already", "one mirror per face", "remove"}));
  EXPECT_TRUE(mentions(with(mirror + "[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"+z\"\n"),
                       {"case.toml:29:8:", "+z", "column", "mirror", "other faces", "remove"}));
  EXPECT_TRUE(mentions(
      with(mirror + "[[support]]\nbody = \"column\"\nwhere = \"Z > 0 && Y > 2\"\nfix = \"z\"\nvelocity = [0, 0, "
                    "1]\n"),
      {"case.toml:23:1: mirror.0", "support.1 (line 26)", "(-0.5, 2.25, 0.5) m", "column", "different velocities",
       "where"}));
}

TEST(BoundaryMessages, FacesHaveTheDimensionOfTheBody) {
  EXPECT_TRUE(mentions(message_of(R"toml(title = "plate"
run = { end = 1 }
[[body]]
name = "plate"
shape = { box = { min = [0, 0], max = [2, 1] }, particles = [9, 5] }
material = { law = "linear_elastic", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
formulation = { name = "jst_sph" }
[[mirror]]
body = "plate"
face = "+z"
)toml"),
                       {"case.toml:10:8: mirror.face", "+z", "in 2D: -x, +x, -y, +y"}));
}

}  // namespace
}  // namespace piola
