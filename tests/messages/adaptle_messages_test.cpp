// SPDX-License-Identifier: Apache-2.0
// Messages about invalid settings of AdapTLE: place, key, value, advice.
#include "formulations/small_bodies.hpp"
#include "materials/solid_samples.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"

namespace piola {
namespace {

using namespace testing;
using test::expect_words;
using test::mentions;
using test::mentions_each;
using test::message_of;

/// Two boxes of aluminium under AdapTLE.
Assembly two_boxes(int dimension = 2) {
  ParticleSet set = unit_box(dimension, 4);
  ShapeSpec shape;
  shape.dimension = dimension;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.min[c] = 2;
    shape.max[c] = 3;
    shape.particles[c] = 4;
  }
  fill(shape, "second", set);
  Assembly a;
  a.materials.assign(2, sample_metal("elastic", "elastic"));
  a.formulations.assign(2, FormulationSpec{"adaptle", {}, {}});
  a.particles = std::move(set);
  return a;
}

TEST(AdaptleMessages, GoodBodiesAreTaken) {
  EXPECT_EQ(refusal(two_boxes()), "");
  EXPECT_EQ(refusal(two_boxes(3)), "");
}

TEST(AdaptleMessages, BarsAreRefused) {
  EXPECT_TRUE(mentions(refusal(two_boxes(1)), {"adaptle", "one-dimensional", "2 or 3 dimensions"}));
}

TEST(AdaptleMessages, PlaneStressIsForTwoDimensions) {
  Assembly a = two_boxes(3);
  choose(a, "assumption", "plane_stress");
  EXPECT_TRUE(mentions(refusal(a), {"formulation", "plane_stress", "2D", "leave it out"}));
}

TEST(AdaptleMessages, PairsOfBodiesShareTheirSettings) {
  for (auto const& [name, first, other] : {std::array<std::string, 3>{"interface", "owner", "published"},
                                           {"correction", "material", "mixed"},
                                           {"kernel", "cubic_spline", "wendland_c2"},
                                           {"viscosity", "compression", "balsara"},
                                           {"viscosity_form", "auto", "central"},
                                           {"artificial_stress_interface", "both", "none"},
                                           {"assumption", "plane_strain", "plane_stress"}}) {
    Assembly a = two_boxes();
    a.formulations[1].words[name] = other;
    EXPECT_TRUE(mentions(refusal(a), {"body.formulation." + name, first, "\"box\"", other, "\"second\"",
                                      "the same for all bodies", "make them equal"}));
    a.formulations[0].words[name] = other;
    EXPECT_EQ(refusal(a), "");
  }
  for (std::string const name : {"artificial_stress", "artificial_stress_exponent", "correction_limit"}) {
    Assembly a = two_boxes();
    a.formulations[0].numbers[name] = 1;
    a.formulations[1].numbers[name] = 2;
    EXPECT_TRUE(mentions(refusal(a), {"body.formulation." + name + " differs", "\"box\"", "\"second\"",
                                      "the same for all bodies", "make them equal"}));
  }
}

TEST(AdaptleMessages, BodiesSeenAsOneNeedOneKernel) {
  Assembly a = two_boxes();
  a.contact.law = ContactRule::Law::none;
  EXPECT_EQ(refusal(a), "");
  a.formulations[1].numbers["smoothing_length"] = 1.2;
  EXPECT_EQ(refusal(a),
            "contact.law = \"none\" makes one of the bodies \"box\" and \"second\", but their smoothing length in m, "
            "alpha or beta differ (allowed: equal ones) - make them equal or choose another law of contact");
}

TEST(AdaptleMessages, SettingsOfADescriptionNeedThatDescription) {
  Assembly a = two_boxes();
  a.formulations[0].words["description"] = "patch";
  EXPECT_TRUE(mentions(refusal(a), {"body \"box\": description = \"patch\"", "eulerian_where", "add it"}));
  a = two_boxes();
  a.formulations[0].formulas.insert_or_assign("eulerian_where", Expression("X < 1"));
  EXPECT_TRUE(mentions(refusal(a), {"body \"box\": eulerian_where", "description = \"patch\"", "remove"}));
  a = two_boxes();
  a.formulations[0].words["description"] = "eulerian";
  a.formulations[0].formulas.insert_or_assign("convert_when", Expression("t > 1"));
  EXPECT_TRUE(mentions(refusal(a), {"body \"box\": convert_when", "description = \"adaptive\"", "remove"}));
  a = two_boxes();
  a.formulations[0].words["failed"] = "delete";
  EXPECT_TRUE(
      mentions(refusal(a), {"body \"box\": failed = \"delete\"", "description = \"total_lagrangian\"", "remove"}));
  a = two_boxes();
  choose(a, "viscosity", "riemann");
  a.formulations[0].words["description"] = "eulerian";
  EXPECT_TRUE(mentions(refusal(a), {"second", "viscosity = \"riemann\"", "description = \"eulerian\"",
                                    "correction = \"mixed\"", "change"}));
}

TEST(AdaptleMessages, AllProblemsAreReportedTogether) {
  Assembly a = two_boxes(3);
  choose(a, "assumption", "plane_stress");
  choose(a, "description", "patch");
  EXPECT_TRUE(mentions_each(refusal(a), {{"plane_stress", "2D", "leave it out"},
                                         {"body \"box\"", "patch", "eulerian_where", "add it"},
                                         {"body \"second\"", "patch", "eulerian_where", "add it"}}));
}

TEST(AdaptleMessages, LawsMustBeInRateForm) {
  Assembly a = two_boxes();
  a.materials[1] = rubber();
  EXPECT_TRUE(mentions(refusal(a), {"adaptle", "second", "no rate form", "elastic", "steinberg_guinan", "law"}));
}

TEST(AdaptleMessages, DeformationGradientsAtTheStartAreRefused) {
  Assembly a = two_boxes();
  a.initial_deformation_gradient.assign(a.particles.X.size(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_TRUE(mentions(refusal(a), {"adaptle", "initial deformation gradient", "initial_displacement"}));
}

TEST(AdaptleMessages, SupportsAreAlongAxes) {
  Assembly a = two_boxes();
  support(a, {true, true, false}, everywhere).frame = Support::Frame::normal;
  EXPECT_TRUE(mentions(refusal(a), {"adaptle", "support", "normal", "axes", "fix"}));
}

TEST(AdaptleMessages, UnknownMachinesListThoseThatThereAre) {
  Assembly a = two_boxes();
  a.backend = "v9";
  expect_words(refusal(a), {"instruction set", "'v9'", "usable: auto"});
}

/// A case file with one box; line 7 is its formulation.
std::string with_formulation(std::string const& more) {
  return message_of(R"toml(title = "plate"
run = { end = 1 }
[[body]]
name = "plate"
shape = { box = { min = [0, 0], max = [2, 1] }, particles = [9, 5] }
material = { law = "elastic", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
formulation = { name = "adaptle")toml" +
                    more + " }\n");
}

TEST(AdaptleMessages, WordsNumbersAndFormulasOfACaseAreChecked) {
  EXPECT_EQ(with_formulation(""), "");
  EXPECT_EQ(with_formulation(R"(, description = "langrangian")"),
            "case.toml:7:49: body.formulation.description is \"langrangian\" (allowed: adaptive, total_lagrangian, "
            "eulerian, patch) - choose one of these");
  EXPECT_TRUE(mentions(with_formulation(", smoothing_length = 0.5"),
                       {"case.toml:7:54: body.formulation.smoothing_length", "0.5", "from 0.6 to 3"}));
  EXPECT_TRUE(mentions(with_formulation(", conversion_radius = 2.5"),
                       {"case.toml:7:55: body.formulation.conversion_radius", "2.5", "from 0 to 2"}));
  EXPECT_NE(with_formulation(R"(, convert_when = "damag > 1")").find("\"damag\" is not known"), std::string::npos);
}

}  // namespace
}  // namespace piola
