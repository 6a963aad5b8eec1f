// SPDX-License-Identifier: Apache-2.0
// Messages about invalid supports, loads and mirrors, word for word.
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::message_of;
using test::replaced;
using test::sample_case;
using test::sample_with;

// The sample has 22 lines, so that what is added starts in line 23.
std::string with(std::string const& more) { return message_of(sample_case() + more); }

TEST(BoundaryMessages, SupportsSayWhatMayBeHeld) {
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"normal\"")),
            "case.toml:14:1: support needs \"normal\" (the direction that fix refers to) - add normal = [1, 1, 0]");
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nnormal = [1, 1, 0]")),
            "case.toml:17:7: support.fix is \"xyz\" (allowed with a normal: \"normal\", \"tangent\") - choose one, or "
            "remove normal");
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"tangent\"\nnormal = [0, 0, 0]")),
            "case.toml:18:10: support.normal is zero (allowed: any other length) - give a direction");
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"tangent\"\nnormal = [1, 0]")),
            "case.toml:18:10: support.normal has 2 components (allowed: 3, the dimension of the body)");
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nuntill = 1\nuntil = 0")),
            "case.toml:18:1: \"untill\" is not a key of support (allowed: name, body, where, patch, hold, fix, normal, "
            "velocity, until) - did you mean \"until\"?\n"
            "case.toml:19:9: support.until is 0 s (allowed: above 0)");
}

TEST(BoundaryMessages, VelocitiesMustBeFiniteAtTheStart) {
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nvelocity = [0, \"1/t\", 0]")),
            "case.toml:18:12: support.velocity[1], formula \"1/t\" is inf at X = (-0.5, 0, -0.5) m of body \"column\" "
            "(allowed: a finite number at every particle)");
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"xyz\"\nvelocity = [0, 0]")),
            "case.toml:18:12: support.velocity is a list of 2 (allowed: a list of 3)");
}

TEST(BoundaryMessages, SupportsThatContradictAreNamed) {
  std::string const driven =
      "[[support]]\nbody = \"column\"\nwhere = \"Y <= 0\"\nfix = \"y\"\nvelocity = [0, \"-10*t\", 0]\n";
  EXPECT_EQ(with(driven),
            "case.toml:23:1: support.1 and support.0 (line 14) both hold the particle at X = (-0.5, 0, -0.5) m of body "
            "\"column\", with different velocities (allowed: the same velocity) - let \"where\" leave it out of one of "
            "them");
  EXPECT_EQ(message_of(sample_with("fix = \"xyz\"", "fix = \"x\"") +
                       "[[support]]\nbody = \"column\"\nwhere = \"X > 0.4\"\nfix = \"normal\"\nnormal = [1, 1, 0]\n"),
            "case.toml:23:1: support.1 and support.0 (line 14) both hold the particle at X = (0.5, 0, -0.5) m of body "
            "\"column\", in directions that are askew (allowed: the same or at right angles) - let \"where\" leave it "
            "out of one of them");
}

TEST(BoundaryMessages, LoadsAreOfOneKind) {
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\n"),
            "case.toml:23:1: load needs one of traction, pressure, body_force, acceleration (has none) - add one");
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\nbody_force = [0, 0, 0]\nacceleration = [0, 0, 0]\n"),
            "case.toml:23:1: load has 2 of traction, pressure, body_force, acceleration (allowed: one) - keep one");
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\nforce = [0, 0, 0]\nbody_force = [0, \"1 Pa\", 0]\n"),
            "case.toml:25:1: \"force\" is not a key of load (allowed: name, body, where, traction, pressure, follower, "
            "face, patch, body_force, acceleration, until) - write \"traction\"\n"
            "case.toml:26:18: load.body_force[1] cannot be read: \"1 Pa\" is not a force per volume (expected a unit "
            "such as N/m^3)");
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\nacceleration = [0, \"1/(Y - 6)\", 0]\nface = \"+x\"\n"),
            "case.toml:26:8: load.face is used only by a traction or a pressure - remove it");
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\nacceleration = [0, \"1/(Y - 6)\", 0]\n"),
            "case.toml:25:16: load.acceleration[1], formula \"1/(Y - 6)\" is inf at X = (-0.5, 6, -0.5) m of body "
            "\"column\" (allowed: a finite number at every particle)");
}

TEST(BoundaryMessages, TractionsNeedAFaceOfABox) {
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\n"),
            "case.toml:23:1: load needs \"face\" or \"patch\" (the part of the surface that the load acts on) - add "
            "face = \"+x\"");
  EXPECT_EQ(
      with("[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"y\"\n"),
      "case.toml:26:8: load.face is \"y\" (allowed: -x, +x, -y, +y, -z, +z, outer, inner) - did you mean \"-y\"?");
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"+y\"\nwhere = \"Y <= 3\"\n"),
            "case.toml:27:9: load.where, formula \"Y <= 3\" selects no particle of the face \"+y\" of body \"column\" "
            "(its particles reach from (-0.5, 0, -0.5) m to (0.5, 6, 0.5) m) - change the condition");
  std::string const box = R"(box = { min = ["-0.5 m", 0, "-50 cm"], max = [0.5, "6 m", 0.5] }, particles = [5, 25, 5])";
  EXPECT_EQ(message_of(sample_with(box, "sphere = { centre = [0, 0, 0], radius = 1 }, spacing = 0.2") +
                       "[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"+y\"\n"
                       "[[mirror]]\nbody = \"column\"\nface = \"+y\"\n"),
            "case.toml:26:8: body \"column\" has no face \"+y\" (allowed: outer)\n"
            "case.toml:29:8: body \"column\" has no face \"+y\", because it is no box (allowed: mirrors at faces of "
            "boxes)");
}

TEST(BoundaryMessages, PressuresActOnFacesAndMayFollowThem) {
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\npressure = 1\nface = \"outer\"\n"),
            "case.toml:26:8: body \"column\" has no face \"outer\" (allowed: -x, +x, -y, +y, -z, +z)");
  EXPECT_EQ(
      with("[[load]]\nbody = \"column\"\npressure = \"1/X\"\nface = \"+y\"\n"),
      "case.toml:25:12: load.pressure, formula \"1/X\" is inf at X = (0, 6, -0.5) m of body \"column\" (allowed: a "
      "finite number at every particle)");
  EXPECT_EQ(with("[[load]]\nbody = \"column\"\ntraction = [0, 1, 0]\nface = \"+y\"\nfollower = true\n"),
            "case.toml:27:12: load.follower is used only by a pressure - remove it");
}

TEST(BoundaryMessages, NamesThatColumnsBeginWithBelongToOneSection) {
  EXPECT_EQ(with("[[load]]\nname = \"support_0\"\nbody = \"column\"\nacceleration = [0, 1, 0]\n"),
            "case.toml:24:8: the name \"support_0\" is taken by a support (allowed: one name for one support, load, "
            "rigid shape, tie or probe) - choose another name");
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
  EXPECT_EQ(message_of(sample_with("[5, 25, 5]", "[5, 25, 1]") + mirror),
            "case.toml:25:8: the face \"+z\" of body \"column\" cannot be a mirror, because the body has a single "
            "particle in z, in its middle (allowed: 2 or more) - change body.shape.particles");
  EXPECT_EQ(with(mirror + mirror),
            "case.toml:28:8: the face \"+z\" of body \"column\" is a mirror already (allowed: one mirror per face) - "
            "remove one");
  EXPECT_EQ(with(mirror + "[[load]]\nbody = \"column\"\ntraction = [0, 0, 0]\nface = \"+z\"\n"),
            "case.toml:29:8: the face \"+z\" of body \"column\" is a mirror, inside the whole body (allowed: tractions "
            "and pressures on other faces) - remove the load or the mirror");
  EXPECT_EQ(with(mirror + "[[support]]\nbody = \"column\"\nwhere = \"Z > 0 && Y > 2\"\nfix = \"z\"\nvelocity = [0, 0, "
                          "1]\n"),
            "case.toml:23:1: mirror.0 and support.1 (line 26) both hold the particle at X = (-0.5, 2.25, 0.5) m of "
            "body \"column\", with different velocities (allowed: the same velocity) - let \"where\" leave it out of "
            "one of them");
}

TEST(BoundaryMessages, FacesHaveTheDimensionOfTheBody) {
  EXPECT_EQ(message_of(R"toml(title = "plate"
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
            "case.toml:10:8: mirror.face is \"+z\" (allowed in 2D: -x, +x, -y, +y)");
}

}  // namespace
}  // namespace piola
