// SPDX-License-Identifier: Apache-2.0
// Rigid shapes and contact of a case file.
#include "piola/input/sections.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/setup/shapes.hpp"
#include "support/key_words.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;

using Kind = RigidShape::Kind;
using Law = ContactRule::Law;

template <class Read>
auto read_table(std::string const& text, std::string const& section, Read const& read) {
  Problems problems;
  auto const document = parse_document(text, "case.toml", problems);
  auto const spec = read(Section(document->root, section, problems));
  EXPECT_NO_THROW(problems.raise_if_any());
  return spec;
}

RigidSpec rigid(std::string const& text, int dimension = 3) {
  return read_table("name = \"wall\"\n" + text + "\n", "rigid", [&](Section const& section) {
    BodyNames names;
    names.dimension = dimension;
    names.names.constants = {{"speed", 2.0}};
    return read_rigid(section, names);
  });
}

ContactSpec contact(std::string const& text, int dimension = 3) {
  return read_table(text + "\n", "contact", [&](Section const& section) {
    CaseSpec spec;
    read_contact({section.node(), "contact"}, dimension, section.problems(), spec);
    return spec.contact.value_or(ContactSpec{});
  });
}

TEST(ReadRigid, APlaneHasAPointAndAUnitNormal) {
  RigidSpec const wall = rigid("plane = { point = [0, \"1 cm\"], normal = [3, 4] }", 2);
  EXPECT_EQ(wall.name, "wall");
  EXPECT_EQ(wall.kind, Kind::plane);
  EXPECT_EQ(wall.centre, (std::array<double, 3>{0, 0.01, 0}));
  EXPECT_EQ(wall.axis, (std::array<double, 3>{0.6, 0.8, 0}));
  for (Expression const& component : wall.velocity) EXPECT_EQ(component({}, 5), 0);
}

TEST(ReadRigid, RoundShapesHaveRadii) {
  RigidSpec const ball = rigid("sphere = { centre = [1, 2, 3], radius = \"4 mm\" }");
  EXPECT_EQ(ball.kind, Kind::sphere);
  EXPECT_EQ(ball.centre, (std::array<double, 3>{1, 2, 3}));
  EXPECT_DOUBLE_EQ(ball.radius, 0.004);
  RigidSpec const bar = rigid("cylinder = { centre = [1, 2, 3], axis = [0, -2, 0], radius = 4, length = 5 }");
  EXPECT_EQ(bar.kind, Kind::cylinder);
  EXPECT_EQ(bar.axis, (std::array<double, 3>{0, -1, 0}));
  EXPECT_EQ(bar.radius, 4);
  EXPECT_EQ(bar.half_lengths[0], 2.5);
}

TEST(ReadRigid, ABoxIsGivenByCornersOrByItsMiddle) {
  for (char const* const text :
       {"box = { min = [0, 1], max = [2, 5] }", "box = { centre = [1, 3], lengths = [2, 4] }"}) {
    RigidSpec const box = rigid(text, 2);
    EXPECT_EQ(box.kind, Kind::box);
    EXPECT_EQ(box.centre, (std::array<double, 3>{1, 3, 0}));
    EXPECT_EQ(box.half_lengths, (std::array<double, 3>{1, 2, 0}));
  }
}

TEST(ReadRigid, VelocitiesAreFormulasInTime) {
  RigidSpec const wall = rigid("plane = { point = [0, 0], normal = [1, 0] }\nvelocity = [\"speed*t\", \"36 km/h\"]", 2);
  EXPECT_EQ(wall.velocity[0]({}, 3), 6);
  EXPECT_EQ(wall.velocity[1]({}, 3), 10);
}

TEST(ReadContact, TheDefaultIsTheKernelLaw) {
  ContactSpec const rule = contact("");
  EXPECT_EQ(rule.law, Law::kernel);
  EXPECT_EQ(rule.scale, 1);
  EXPECT_TRUE(std::isnan(rule.exponent));
  EXPECT_TRUE(std::isnan(rule.stiffness));
  EXPECT_TRUE(std::isnan(rule.closing_speed));
}

TEST(ReadContact, LawsHaveTheirNumbers) {
  EXPECT_EQ(contact("law = \"none\"").law, Law::none);
  EXPECT_EQ(contact("law = \"linear\"\nscale = 0.5").law, Law::linear);
  ContactSpec const kernel = contact("law = \"kernel\"\nscale = 2\nclosing_speed = \"3 km/s\"\nexponent = 6");
  EXPECT_EQ(kernel.law, Law::kernel);
  EXPECT_EQ(kernel.scale, 2);
  EXPECT_EQ(kernel.closing_speed, 3000);
  EXPECT_EQ(kernel.exponent, 6);
  ContactSpec const as_published = contact("law = \"published\"\nstiffness = \"2 MPa/mm^2\"", 2);
  EXPECT_EQ(as_published.law, Law::as_published);
  EXPECT_DOUBLE_EQ(as_published.stiffness, 2e12);
  EXPECT_EQ(contact("law = \"published\"\nstiffness = 1e16").stiffness, 1e16);
}

/// A block of 5 x 5 (x 5) particles on [0, 1]^D, perhaps displaced.
struct Block {
  CaseSpec spec;
  ParticleSet particles;

  explicit Block(int dimension) {
    BodySpec body;
    body.name = "block";
    body.shape.dimension = dimension;
    body.shape.max = {1, 1, 1};
    body.shape.particles = {5, 5, 5};
    fill(body.shape, body.name, particles);
    spec.bodies.push_back(body);
  }

  std::string repair_note(RigidSpec const& shape) {
    spec.rigids = {shape};
    Problems problems;
    check_rigid(spec, particles, problems);
    return problems.empty() ? "" : problems.lines().front();
  }
};

TEST(CheckRigid, ShapesMayTouchButNotHoldParticles) {
  Block plate(2), block(3);
  EXPECT_EQ(plate.repair_note(rigid("plane = { point = [0, 0], normal = [1, 0] }", 2)), "");
  EXPECT_EQ(
      plate.repair_note(rigid("plane = { point = [0.1, 0], normal = [1, 0] }", 2)),
      "case.toml:2:9: the rigid shape \"wall\" holds 5 particles of body \"block\" at the start, the first at (0, "
      "0) m (allowed: none) - move the shape or the body");
  EXPECT_EQ(plate.repair_note(rigid("sphere = { centre = [2, 1], radius = 1 }", 2)), "");
  EXPECT_NE(plate.repair_note(rigid("sphere = { centre = [2, 1], radius = 1.02 }", 2)).find(" 1 particle of"),
            std::string::npos);
  EXPECT_EQ(plate.repair_note(rigid("box = { min = [1, -1], max = [2, 2] }", 2)), "");
  EXPECT_NE(plate.repair_note(rigid("box = { min = [0.8, 0.1], max = [2, 0.9] }", 2)).find(" 3 particles of"),
            std::string::npos);
  EXPECT_EQ(block.repair_note(rigid("box = { min = [0, 0, 1], max = [1, 1, 2] }")), "");
  EXPECT_NE(block.repair_note(rigid("box = { min = [-1, -1, 0.8], max = [2, 2, 2] }")).find(" 25 particles of"),
            std::string::npos);
  // Along x through the middle: the axial row of five, and four rows more at 0.25 from it.
  std::string const bar = "axis = [1, 0, 0], length = 0.9, radius = ";
  EXPECT_NE(block.repair_note(rigid("cylinder = { centre = [0.5, 0.5, 0.5], " + bar + "0.2 }")).find(" 3 particles of"),
            std::string::npos);
  EXPECT_NE(
      block.repair_note(rigid("cylinder = { centre = [0.5, 0.5, 0.5], " + bar + "0.3 }")).find(" 15 particles of"),
      std::string::npos);
  EXPECT_EQ(block.repair_note(rigid("cylinder = { centre = [0.5, 2, 0.5], " + bar + "1 }")), "");
}

TEST(CheckRigid, BodiesStandWhereTheirDisplacementPutsThem) {
  Block plate(2);
  plate.spec.bodies[0].initial_displacement = {Expression("-0.3"), Expression("1"), Expression()};
  EXPECT_TRUE(mentions(plate.repair_note(rigid("plane = { point = [-0.1, 0], normal = [1, 0] }", 2)),
                       {"case.toml:2:9:", "wall", "5 particles", "block", "(-0.3, 1) m", "none", "move"}));
}

TEST(CheckRigid, VelocitiesMustBeFiniteAtTheStart) {
  Block plate(2);
  EXPECT_TRUE(
      mentions(plate.repair_note(rigid("plane = { point = [0, 0], normal = [1, 0] }\nvelocity = [0, \"1/t\"]", 2)),
               {"case.toml:3:12: rigid.velocity[1]", "1/t", "inf", "t = 0", "finite"}));
}

}  // namespace
}  // namespace piola
