// SPDX-License-Identifier: Apache-2.0
// Supports, loads and mirrors of a case file.
#include "piola/model/case_particles.hpp"
#include "piola/model/read_case.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

using test::sample_case;

CaseSpec read(std::string const& more, std::vector<std::string> const& overrides = {}) {
  return read_case_text(sample_case() + more, "case.toml", overrides);
}

TEST(ReadBoundaries, ASupportIsAtRestAndHoldsToTheEndUnlessItSaysOtherwise) {
  CaseSpec const spec = read("");
  EXPECT_EQ(spec.supports[0].frame, Support::Frame::axes);
  EXPECT_FALSE(spec.supports[0].velocity);
  EXPECT_EQ(spec.supports[0].until, std::numeric_limits<double>::infinity());
}

TEST(ReadBoundaries, ASupportMayDriveAndLetGo) {
  CaseSpec const spec = read(R"(
[[support]]
body = "column"
where = "Y >= L"
fix = "y"
velocity = ["1/0", "-10*t*Omega + X", "0/0"]
until = "7 ms"
)");
  SupportSpec const support = spec.supports[1];
  EXPECT_EQ(support.fix, (std::array<bool, 3>{false, true, false}));
  EXPECT_DOUBLE_EQ((*support.velocity)[1]({0.5, 6, 0}, 2), -10 * 2 * 105 + 0.5);
  EXPECT_DOUBLE_EQ(support.until, 0.007);
}

TEST(ReadBoundaries, VelocitiesAreQuantitiesToo) {
  CaseSpec const spec = read(R"(
[[support]]
body = "column"
where = "Y >= L"
fix = "xyz"
velocity = [0, "-36 km/h", 3]
)");
  EXPECT_DOUBLE_EQ((*spec.supports[1].velocity)[1]({}), -10);
  EXPECT_DOUBLE_EQ((*spec.supports[1].velocity)[2]({}), 3);
}

TEST(ReadBoundaries, NormalsAreOfUnitLength) {
  CaseSpec const spec = read(R"(
[[support]]
body = "column"
where = "Y >= L && X > 0.4"
fix = "normal"
normal = [3, 0, 4]
velocity = [1, 2, 3]
[[support]]
body = "column"
where = "Y >= L && X < -0.4"
fix = "tangent"
normal = [0, -0.25, 0]
)");
  EXPECT_EQ(spec.supports[1].frame, Support::Frame::normal);
  EXPECT_EQ(spec.supports[2].frame, Support::Frame::tangent);
  EXPECT_DOUBLE_EQ(spec.supports[1].normal[0], 0.6);
  EXPECT_DOUBLE_EQ(spec.supports[1].normal[2], 0.8);
  EXPECT_EQ(spec.supports[2].normal, (std::array<double, 3>{0, -1, 0}));
  EXPECT_EQ(spec.supports[1].fix, (std::array<bool, 3>{}));
}

TEST(ReadBoundaries, LoadsAreForcesPerAreaVolumeOrMass) {
  CaseSpec const spec = read(R"(
[[load]]
body = "column"
face = "+y"
where = "X > 0"
traction = [0, "-1 MPa", "Omega*Z*t"]
until = "0.1 s"
[[load]]
body = "column"
body_force = [0, "5 kN/m^3", 0]
[[load]]
body = "column"
acceleration = [0, "-9.81 m/s^2", 0]
)");
  ASSERT_EQ(spec.loads.size(), 3u);
  EXPECT_EQ(spec.loads[0].kind, LoadSpec::Kind::traction);
  EXPECT_EQ(spec.loads[0].face.axis, 1);
  EXPECT_TRUE(spec.loads[0].face.upper);
  EXPECT_DOUBLE_EQ(spec.loads[0].value[1]({}), -1e6);
  EXPECT_DOUBLE_EQ(spec.loads[0].value[2]({0, 0, 2}, 3), 630);
  EXPECT_DOUBLE_EQ(spec.loads[0].until, 0.1);
  EXPECT_EQ(spec.loads[1].kind, LoadSpec::Kind::body_force);
  EXPECT_DOUBLE_EQ(spec.loads[1].value[1]({}), 5000);
  EXPECT_FALSE(spec.loads[1].where);
  EXPECT_EQ(spec.loads[2].kind, LoadSpec::Kind::acceleration);
  EXPECT_DOUBLE_EQ(spec.loads[2].value[1]({}), -9.81);
}

TEST(ReadBoundaries, OnlyTheSelectedPartOfAFaceIsLoaded) {
  CaseSpec const spec = read(
      "[[load]]\nbody = \"column\"\nface = \"+y\"\nwhere = \"X > 0\"\ntraction = [0, 1, 0]\n"
      "[[load]]\nbody = \"column\"\nwhere = \"X > 0\"\nbody_force = [0, 1, 0]\n");
  ParticleSet const set = make_particles(spec);
  EXPECT_EQ(loaded_particles(set, set.bodies[0], spec.loads[0]).size(), 10u);
  EXPECT_EQ(loaded_particles(set, set.bodies[0], spec.loads[1]).size(), 250u);
}

TEST(ReadBoundaries, MirrorsAreFaces) {
  CaseSpec const spec = read(
      "[[mirror]]\nbody = \"column\"\nface = \"-x\"\n[[mirror]]\nbody = \"column\"\nantisymmetric = true\nface = "
      "\"+z\"\n");
  ASSERT_EQ(spec.mirrors.size(), 2u);
  EXPECT_EQ(spec.mirrors[0].face.axis, 0);
  EXPECT_FALSE(spec.mirrors[0].face.upper);
  EXPECT_EQ(spec.mirrors[1].face.axis, 2);
  EXPECT_TRUE(spec.mirrors[1].face.upper);
  EXPECT_FALSE(spec.mirrors[0].antisymmetric);
  EXPECT_TRUE(spec.mirrors[1].antisymmetric);
}

TEST(ReadBoundaries, SettingsReachThem) {
  std::string const more =
      "[[load]]\nbody = \"column\"\nacceleration = [0, 0, 0]\n[[mirror]]\nbody = \"column\"\nface = \"-x\"\n";
  CaseSpec const spec = read(more, {"support.0.until=3 ms", "support.0.velocity=[0,\"t\",0]",
                                    "load.0.acceleration=[0,\"-g\",0]", "constants.g=9.81", "mirror.0.face=+x"});
  EXPECT_DOUBLE_EQ(spec.supports[0].until, 0.003);
  EXPECT_DOUBLE_EQ((*spec.supports[0].velocity)[1]({}, 4), 4);
  EXPECT_DOUBLE_EQ(spec.loads[0].value[1]({}), -9.81);
  EXPECT_TRUE(spec.mirrors[0].face.upper);
}

// What overlaps without contradiction is allowed: no message, so read_case_text does not throw.
TEST(CheckBoundaries, SupportsMayShareParticlesIfTheyAgree) {
  auto const support = [](std::string const& where, std::string const& rest) {
    return "[[support]]\nbody = \"column\"\nwhere = \"" + where + "\"\n" + rest + "\n";
  };
  for (std::string const& rest : {
           std::string("fix = \"y\""),                                   // both at rest
           std::string("fix = \"xy\"\nvelocity = [0, \"0*t\", \"1\"]"),  // z is not held by this one
           std::string("fix = \"normal\"\nnormal = [1, 2, 3]"),          // all directions are held by the other
       }) {
    EXPECT_NO_THROW(read(support("Y <= 0.3", rest))) << rest;
  }
  std::string const driven = "fix = \"y\"\nvelocity = [0, \"-10*sin(t)\", 0]";
  EXPECT_NO_THROW(read(support("Y >= L", driven) + support("Y >= L && X > 0", driven)));
  EXPECT_NO_THROW(read(support("Y >= L", driven) + support("X > 0.4 && Y > 3", "fix = \"x\"")));
  EXPECT_NO_THROW(
      read(support("Y >= L", driven) + support("X > 0.4 && Y > 3", "fix = \"normal\"\nnormal = [1, 0, 1]")));
  EXPECT_NO_THROW(read(support("Y >= L", "fix = \"normal\"\nnormal = [0, 1, 0]\nvelocity = [5, \"-10*sin(t)\", 0]") +
                       support("Y >= L", driven)));
}

}  // namespace
}  // namespace piola
