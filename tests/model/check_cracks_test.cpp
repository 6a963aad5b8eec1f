// SPDX-License-Identifier: Apache-2.0
#include "piola/input/sections.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/region_checks.hpp"
#include "support/key_words.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions_each;

/// Two plates of 9 x 5 particles, 0.25 m apart.
CaseSpec plates() {
  CaseSpec spec;
  for (char const* const name : {"lower", "upper"}) {
    BodySpec body;
    body.name = name;
    body.shape.dimension = 2;
    body.shape.max = {2, 1, 0};
    body.shape.particles = {9, 5, 1};
    spec.bodies.push_back(body);
  }
  return spec;
}

TEST(ReadCrack, EndsArePointsWithUnits) {
  Problems problems;
  auto const document = parse_document("[[crack]]\nbody = \"plate\"\nfrom = [0, \"50 cm\"]\nto = [\"1 m\", 0.5]\n",
                                       "case.toml", problems);
  ASSERT_TRUE(document);
  BodyNames body;
  body.name = "plate";
  body.dimension = 2;
  Section const section(document->root.find("crack")->items[0], "crack", problems);
  CrackSpec const crack = read_crack(section, {body});
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(crack.body, "plate");
  EXPECT_EQ(crack.from, (std::array<double, 3>{0, 0.5, 0}));
  EXPECT_EQ(crack.to, (std::array<double, 3>{1, 0.5, 0}));
  EXPECT_EQ(crack.places.at("to").line, 4);
}

TEST(MakeParticles, OpensTheCracksOfEachBody) {
  CaseSpec spec = plates();
  spec.cracks.push_back({"upper", {0, 0.5, 0}, {1, 0.5, 0}, {}});
  spec.cracks.push_back({"lower", {2, 0.5, 0}, {1, 0.5, 0}, {}});
  ParticleSet const set = make_particles(spec);
  ASSERT_EQ(set.cracks.size(), 2u);
  EXPECT_EQ(set.cracks[0].body, 0);
  EXPECT_EQ(set.cracks[1].body, 1);
  EXPECT_EQ(set.bodies[0].last, 49);
  EXPECT_EQ(set.bodies[1].last, 98);
  EXPECT_EQ(set.crack_side.size(), 98u);
}

TEST(MakeParticles, WithoutCracksHasNoSides) {
  ParticleSet const set = make_particles(plates());
  EXPECT_TRUE(set.crack_side.empty());
  EXPECT_TRUE(set.bodies[0].regular);
}

TEST(MakeParticles, ReportsAllCracksThatCannotBeAndOpensTheOthers) {
  CaseSpec spec = plates();
  spec.cracks.push_back(
      {"lower", {0, 0.5, 0}, {1.1, 0.5, 0}, {{"", {"case.toml", 8, 1}}, {"to", {"case.toml", 9, 6}}}});
  spec.cracks.push_back({"lower", {0, 0.5, 0}, {1, 0.5, 0}, {}});
  spec.cracks.push_back({"lower", {1, 0.5, 0}, {1, 1, 0}, {{"", {"case.toml", 16, 1}}}});
  Problems problems;
  ParticleSet const set = make_particles(spec, problems);
  ASSERT_EQ(problems.count(), 2u);
  EXPECT_TRUE(mentions_each(problems.lines(), {{"case.toml:9:6: crack.to", "(1.1, 0.5) m", "lower", "has no"},
                                               {"case.toml:16:1: ", "lower", "meets the crack from"}}));

  EXPECT_EQ(set.cracks.size(), 1u);
  EXPECT_THROW(make_particles(spec), InputError);
}

TEST(CheckAbilities, RingsAreRefusedByFormulationsThatNeedALattice) {
  CaseSpec spec = plates();
  spec.bodies[1].shape.arrangement = ShapeSpec::Arrangement::rings;
  spec.bodies[1].places = {{"shape", {"case.toml", 8, 1}}};
  Problems problems;
  for (BodySpec& body : spec.bodies) body.formulation.name = "jst_sph";
  check_abilities(spec, problems);
  EXPECT_TRUE(problems.empty());
  for (BodySpec& body : spec.bodies) body.formulation.name = "taylor_sph";
  check_abilities(spec, problems);
  ASSERT_EQ(problems.count(), 1u);
  EXPECT_EQ(problems.lines()[0], "case.toml:8:1: " + refusal(*find_formulation("taylor_sph"), "rings"));
}

TEST(ParticlesAhead, AreOnARayWithinTheDistances) {
  CaseSpec const spec = plates();
  ParticleSet const set = make_particles(spec);
  ProbeSpec probe;
  probe.at = {1.01, 0.49, 0};  // the nearest particle is at (1, 0.5)
  probe.from = 0.25;
  probe.to = 0.75;
  auto const places = [&] {
    std::vector<std::array<double, 3>> list;
    for (std::int64_t const id : particles_ahead(set, set.bodies[1], probe)) {
      EXPECT_GE(id, 45);
      list.push_back(set.X[static_cast<std::size_t>(id)]);
    }
    return list;
  };
  using List = std::vector<std::array<double, 3>>;
  EXPECT_EQ(places(), (List{{1.25, 0.5, 0}, {1.5, 0.5, 0}, {1.75, 0.5, 0}}));
  probe.from = 0.25 * (1 + 1e-5);
  probe.to = 0.75 * (1 - 1e-5);
  EXPECT_EQ(places(), (List{{1.5, 0.5, 0}}));
  probe.direction = {-1, 0, 0};
  EXPECT_EQ(places(), (List{{0.5, 0.5, 0}}));
  probe.direction = {0, -1, 0};
  EXPECT_EQ(places(), (List{{1, 0, 0}}));
}

}  // namespace
}  // namespace piola
