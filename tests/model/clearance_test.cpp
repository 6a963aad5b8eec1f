// SPDX-License-Identifier: Apache-2.0
#include "piola/model/clearance.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/region_checks.hpp"
#include "support/sample_case.hpp"
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace piola {
namespace {

/// Two bodies of one formulation at rest; shapes as a case file writes them.
std::string two(std::string const& first, std::string const& second, std::string const& formulation = "adaptle",
                std::string const& more = "") {
  std::string const law = formulation == "adaptle" ? "elastic" : "neo_hookean";
  std::string const body = fmt::format(
      "[[body]]\nname = \"{{}}\"\nshape = {{{{ {{}} }}}}\nmaterial = {{{{ law = \"{}\", density = 1000, youngs_modulus "
      "= 1e7, poissons_ratio = 0.3 }}}}\nformulation = {{{{ name = \"{}\" }}}}\n",
      law, formulation);
  return "title = \"Two\"\n[run]\nend = 1\n" + fmt::format(fmt::runtime(body), "a", first) +
         fmt::format(fmt::runtime(body), "b", second) + more;
}

std::string box(double x0, double x1, std::string const& placement = "on_boundary", int n = 11) {
  return fmt::format("box = {{ min = [{}, 0], max = [{}, 1] }}, particles = [{}, {}], placement = \"{}\"", x0, x1, n, n,
                     placement);
}

std::string disc(double x, double radius, double spacing, std::string const& more = "") {
  return fmt::format("sphere = {{ centre = [{}, 0], radius = {} {} }}, spacing = {}", x, radius, more, spacing);
}

std::string start_of_message(double depth, int particles) {
  return fmt::format(
      "case.toml:11:9: the bodies \"a\" and \"b\" overlap at the start: {} particles of \"b\" up to {} mm "
      "inside \"a\" (allowed: none) - move one of them",
      particles, depth);
}

/// Places of the contact of two boxes, with these lines and settings.
Places contact_places(std::string const& lines, std::vector<std::string> const& settings = {}) {
  return read_case_text(lines + two(box(0, 1), box(3, 4), "jst_sph"), "case.toml", settings).contact->places;
}

TEST(Places, HoldTheKeysOfTheCaseAndOfSettings) {
  std::string const scaled = "contact = { scale = 2 }\n";
  for (Places const& places :
       {contact_places("contact = { law = \"surface\" }\n"), contact_places("contact = [{ law = \"surface\" }]\n"),
        contact_places("", {"contact.law=surface"}), contact_places("", {"contact={ law = \"surface\" }"}),
        contact_places(scaled, {"contact.law=\"surface\""})}) {
    EXPECT_TRUE(is_given(places, "law"));
    EXPECT_FALSE(is_given(places, "self"));
    EXPECT_EQ(place_of(places, "self").file, place_of(places, "").file) << "of the section";
  }
  EXPECT_FALSE(is_given(contact_places("", {"contact.static_friction=0.4", "contact.decay_speed=1"}), "friction"));
  EXPECT_TRUE(is_given(contact_places("", {"contact=none"}), "law")) << "short for a table with it";
}

TEST(Overlap, BodiesDoNotStartInsideEachOther) {
  // Columns at 0.5, ..., 0.9, of which the rows at y = 0 and 1 lie on faces.
  EXPECT_EQ(test::message_of(two(box(0, 1), box(0.5, 1.5))), start_of_message(500, 45));
  // Lattices that are shifted by half a cell have no particles near each other, and overlap all the same.
  EXPECT_NE(test::message_of(two(box(0, 1), "box = { min = [0.55, 0.05], max = [1.55, 1.05] }, particles = [11, 11]"))
                .find("overlap at the start"),
            std::string::npos);
  EXPECT_NE(test::message_of(two(box(0, 1), box(0.5, 1.5), "jst_sph")).find("overlap at the start"), std::string::npos);
}

// Cell-centred particles lie half a spacing inside their faces: they are inside the other body from half a spacing on.
TEST(Overlap, HalfASpacingIsTheBound) {
  std::string const cells = "cell_centred";
  EXPECT_EQ(test::message_of(two(box(0, 1, cells, 10), box(1, 2, cells, 10))), "");
  EXPECT_EQ(test::message_of(two(box(0, 1, cells, 10), box(0.96, 1.96, cells, 10))), "");
  EXPECT_EQ(test::message_of(two(box(0, 1, cells, 10), box(0.94, 1.94, cells, 10))), start_of_message(10, 10));
}

// Both turned by the same displacement they touch as before, however far they are turned.
TEST(Overlap, TurnedBodiesAreWhereTheyAre) {
  std::string const turned = "initial_displacement = [\"0.6*X - 0.8*Y - X\", \"0.8*X + 0.6*Y - Y\"]\n[[body]]";
  auto const both = [&](double gap) {
    std::string const text = two(box(0, 1, "cell_centred", 10), box(1 + gap, 2 + gap, "cell_centred", 10), "nodal");
    return test::replaced(text, "[[body]]\nname = \"b\"", turned + "\nname = \"b\"") +
           turned.substr(0, turned.find('\n')) + "\n";
  };
  EXPECT_EQ(test::message_of(both(0)), "");
  EXPECT_NE(test::message_of(both(-0.2)).find("20 particles of \"b\" up to 150 mm inside"), std::string::npos)
      << test::message_of(both(-0.2));
}

TEST(Overlap, ParticlesOfTwoBodiesAreNoNearerThanHalfASpacing) {
  EXPECT_EQ(test::message_of(two(box(0, 1), box(1, 2))),
            "case.toml:11:9: the bodies \"a\" and \"b\" have particles only 0 m apart at the start, at (1, 0) m "
            "(allowed: half a spacing, 50 mm, or more; contact would push them off with an energy out of nothing) - "
            "leave a gap of one spacing; or give boxes that touch placement = \"cell_centred\"");
  EXPECT_EQ(test::message_of(two(box(0, 1), box(1.05, 2.05))), "");
  // Where bodies are seen as one, or do not see each other, they may share a face.
  EXPECT_EQ(test::message_of(two(box(0, 1), box(1, 2), "adaptle", "[contact]\nlaw = \"none\"\n")), "");
  EXPECT_EQ(test::message_of(two(box(0, 1), box(1, 2), "jst_sph")), "");
}

TEST(Overlap, LooksAtShapesWithHolesAndWhereBodiesReallyStart) {
  std::string const ring = ", inner_radius = 1, arrangement = \"rings\"";
  EXPECT_EQ(test::message_of(two(disc(0, 0.9, 0.05), disc(0, 2, 0.05, ring))), "");
  EXPECT_NE(test::message_of(two(disc(0, 1.2, 0.05), disc(0, 2, 0.05, ring))), "");
  EXPECT_NE(test::message_of(two(disc(0, 1, 0.1, ", arrangement = \"rings\""), disc(1.98, 1, 0.1))), "");
  std::string const displaced = "initial_displacement = [\"-4.5\", \"0\"]\n";
  EXPECT_EQ(test::message_of(two(box(0, 1), box(5, 6))), "");
  EXPECT_EQ(test::message_of(two(box(0, 1), box(5, 6), "adaptle", displaced)), start_of_message(500, 45));
  // Without a finite position there is nothing to compare; the formula itself is the problem.
  EXPECT_NE(test::message_of(two(box(0, 1), box(5, 6), "adaptle", "initial_displacement = [\"1/(X - 5)\", \"0\"]\n"))
                .find("is inf"),
            std::string::npos);
}

TEST(Overlap, IsSeenInThreeDimensionsAndBetweenUnequalSpacings) {
  std::string const cube = "box = { min = [0, 0, 0], max = [1, 1, 1] }, spacing = 0.25, placement = \"cell_centred\"";
  auto const ball = [](double z) {
    return fmt::format("sphere = {{ centre = [0.5, 0.5, {}], radius = 0.5 }}, spacing = 0.1", z);
  };
  auto const pipe = [](double z) {
    return fmt::format(
        "cylinder = {{ centre = [0.5, 0.5, {}], radius = 0.5, length = 1, axis = \"z\" }}, spacing = 0.1", z);
  };
  EXPECT_EQ(test::message_of(two(cube, ball(1.5))), "");
  EXPECT_NE(test::message_of(two(cube, ball(1.4))), "");
  EXPECT_EQ(test::message_of(two(cube, pipe(1))), "");
  EXPECT_NE(test::message_of(two(cube, pipe(0.9))), "");
}

// The nearest two of all pairs, by trying each.
TEST(CloseBodies, FindsTheNearestParticles) {
  for (double const gap : {0.03, 0.08, 0.21}) {
    CaseSpec const spec = read_case_text(two(disc(0, 1, 0.1), disc(2 + gap, 1, 0.07)), "case.toml");
    ParticleSet const set = make_particles(spec);
    double least = 1e300;
    for (std::int64_t i = set.bodies[0].first; i < set.bodies[0].last; ++i)
      for (std::int64_t j = set.bodies[1].first; j < set.bodies[1].last; ++j) {
        auto const &p = set.X[static_cast<std::size_t>(i)], &q = set.X[static_cast<std::size_t>(j)];
        least = std::min(least, std::hypot(p[0] - q[0], p[1] - q[1]));
      }
    auto const found = close_bodies(spec, set, 5);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_DOUBLE_EQ(found[0].distance, least);
    EXPECT_DOUBLE_EQ(found[0].spacing, 0.085);
    EXPECT_TRUE(close_bodies(spec, set, 0.99 * least / 0.085).empty());
  }
}

}  // namespace
}  // namespace piola
