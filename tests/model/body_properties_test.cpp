// SPDX-License-Identifier: Apache-2.0
#include "piola/model/body_properties.hpp"
#include "piola/input/material_library.hpp"
#include "piola/model/case_particles.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;

struct Looked {
  CaseSpec spec;
  std::vector<BodyProperties> facts;
  std::vector<std::string> warnings;
};

Looked look(std::string const& text) {
  Looked looked{read_case_text(text, "case.toml"), {}, {}};
  looked.facts = body_properties(looked.spec, make_particles(looked.spec));
  Problems slips;
  find_implausible_values(looked.spec, make_particles(looked.spec), looked.facts,
                          step_estimate(looked.spec, looked.facts), slips);
  looked.warnings = slips.lines();
  return looked;
}

TEST(CaseFacts, MassWavesAndStepFollowFromTheCase) {
  Looked const column = look(test::sample_case());
  ASSERT_EQ(column.facts.size(), 1u);
  BodyProperties const& body = column.facts[0];
  EXPECT_EQ(body.particles, 625);
  EXPECT_NEAR(body.mass, 6600, 1e-9);
  double const mu = 17e6 / 2.9, lambda = 0.45 * 17e6 / (1.45 * 0.1);
  EXPECT_NEAR(body.p_wave, std::sqrt((lambda + 2 * mu) / 1100), 1e-9);
  EXPECT_NEAR(body.s_wave, std::sqrt(mu / 1100), 1e-9);
  EXPECT_NEAR(body.largest_speed, 105 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(step_estimate(column.spec, column.facts), 0.3 * 0.25 / body.p_wave, 1e-12);
  EXPECT_TRUE(column.warnings.empty());
}

TEST(CaseFacts, SolidsInRateFormHaveMassAndWavesToo) {
  CaseSpec spec = read_case_text(test::sample_case(), "case.toml");
  spec.bodies[0].law = "isotropic_hardening";
  spec.bodies[0].material = parameters_of(*material_library().find("steel_linear_hardening"));
  BodyProperties const body = body_properties(spec, make_particles(spec)).at(0);
  EXPECT_NEAR(body.mass, 6 * 7870, 1e-8);
  EXPECT_NEAR(body.p_wave, std::sqrt(200e9 * 0.7 / (1.3 * 0.4 * 7870)), 1e-8);
  EXPECT_NEAR(body.s_wave, std::sqrt(200e9 / (2.6 * 7870)), 1e-8);
}

TEST(CaseFacts, SlipsOfUnitsAreNoticed) {
  EXPECT_EQ(look(test::sample_with("1100 kg/m^3", "1.1 kg/m^3")).warnings.at(0),
            "case.toml:10:45: body \"column\": density is 1.1 kg/m^3, lighter than foam (solids have 100 to 20000 "
            "kg/m^3) - was g/cm^3 meant?");
  auto const soft = look(test::sample_with("17 MPa", "17 Pa")).warnings;
  EXPECT_TRUE(mentions(
      soft.at(0), {"case.toml:10:77:", "column", "youngs_modulus", "17 Pa", "softer", "1 kPa to 1 TPa", "MPa or GPa"}));
  EXPECT_NE(soft.at(1).find("times the speed of pressure waves, 0.2421 m/s"), std::string::npos);
  EXPECT_EQ(
      look(test::sample_with("0.5 s", "0.5 us")).warnings.at(0),
      "case.toml:6:7: run.end is 500 ns, shorter than one step of about 309.8 us, so that the run is a single step - "
      "check the units of run.end and of the moduli");
  EXPECT_NE(look(test::sample_with("0.5 s", "500000 s")).warnings.at(0).find("steps are needed"), std::string::npos);
}

TEST(CaseFacts, CoarseAndUnevenBodiesAreNoticed) {
  auto const thin = look(test::sample_with("[5, 25, 5]", "[5, 25, 2]")).warnings;
  EXPECT_TRUE(mentions(thin.at(0), {"case.toml:9:9:", "column", "2 particles", "z", "3 or more", "spacing smaller"}));
  EXPECT_NE(thin.at(1).find("the spacings differ by a factor of 4"), std::string::npos);
}

TEST(CaseFacts, ACaseInWhichNothingMovesIsNoticed) {
  EXPECT_EQ(look(test::sample_with("[\"w*Z\", \"0\", \"-w*X\"]", "[0, 0, 0]")).warnings.at(0),
            "nothing moves: no initial velocity, displacement or deformation, no load and no driven support - add one");
}

}  // namespace
}  // namespace piola
