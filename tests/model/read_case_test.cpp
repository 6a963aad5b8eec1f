// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "piola/model/case_particles.hpp"
#include "support/sample_case.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace piola {
namespace {

using test::message_of;
using test::replaced;
using test::sample_case;
using test::sample_with;

CaseSpec read(std::string const& text, std::vector<std::string> const& overrides = {}) {
  return read_case_text(text, "case.toml", overrides);
}

TEST(ReadCase, TheSampleIsReadInSiUnits) {
  CaseSpec const spec = read(sample_case());
  EXPECT_EQ(spec.title, "Twisting column");
  EXPECT_DOUBLE_EQ(spec.run.end, 0.5);
  EXPECT_TRUE(std::isnan(spec.run.cfl));
  EXPECT_EQ(spec.run.threads, 0);
  EXPECT_EQ(spec.run.backend, "auto");
  ASSERT_EQ(spec.bodies.size(), 1u);
  BodySpec const& body = spec.bodies[0];
  EXPECT_EQ(body.name, "column");
  EXPECT_EQ(body.shape.dimension, 3);
  EXPECT_EQ(body.shape.min, (std::array<double, 3>{-0.5, 0, -0.5}));
  EXPECT_EQ(body.shape.max, (std::array<double, 3>{0.5, 6, 0.5}));
  EXPECT_EQ(body.shape.particles, (std::array<int, 3>{5, 25, 5}));
  EXPECT_EQ(body.law, "neo_hookean");
  EXPECT_EQ(body.material.law, find_law("neo_hookean")->index);
  EXPECT_DOUBLE_EQ(body.material.value[0], 1100);
  EXPECT_DOUBLE_EQ(body.material.value[1], 17e6);
  EXPECT_DOUBLE_EQ(body.material.value[2], 0.45);
  EXPECT_EQ(body.formulation.name, "jst_sph");
  EXPECT_EQ(body.formulation.words.at("variables"), "pF");
  EXPECT_DOUBLE_EQ(body.formulation.numbers.at("eps4_momentum"), 0.125);
  EXPECT_EQ(body.formulation.words.size() + body.formulation.numbers.size(), 2u);
  EXPECT_FALSE(body.initial_displacement);
  EXPECT_EQ(spec.source, sample_case());
}

TEST(ReadCase, DefinitionsAreOrderedByWhatTheyUse) {
  CaseSpec const spec = read(sample_case());
  std::array<double, 3> const X{0.5, 2, 0.25};
  double const w = 105 * std::sin(std::numbers::pi * 2 / 12);
  EXPECT_DOUBLE_EQ(spec.bodies[0].initial_velocity[0](X), w * 0.25);
  EXPECT_EQ(spec.bodies[0].initial_velocity[1](X), 0);
  EXPECT_DOUBLE_EQ(spec.bodies[0].initial_velocity[2](X), -w * 0.5);
}

TEST(ReadCase, SupportsAndProbesReferToBodies) {
  CaseSpec const spec = read(sample_case() + R"(
[[probe]]
name = "top"
body = "column"
kind = "twist"
where = "Y >= L"
[[probe]]
name = "height"
body = "column"
kind = "extent"
axis = "y"
[[quantity]]
name = "largest_twist"
column = "top.twist_angle"
take = "first_peak"
unit = "degree"
[[quantity]]
name = "arrival"
column = "tip.pressure"
take = "first_time_above"
threshold = "2 MPa"
unit = "ms"
[[quantity]]
name = "error"
column = "tip.displacement_x"
take = "mean_absolute_difference"
reference = "L*t"
)");
  EXPECT_EQ(spec.supports[0].fix, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ((*spec.supports[0].where)({0, 0, 0}), 1);
  EXPECT_EQ(spec.probes[0].kind, ProbeSpec::Kind::point);
  EXPECT_EQ(spec.probes[0].at, (std::array<double, 3>{0.5, 6, 0.5}));
  EXPECT_EQ(spec.probes[1].quantities, std::vector<std::string>{"twist_angle"});
  EXPECT_EQ(spec.probes[2].quantities, std::vector<std::string>{"extent"});
  EXPECT_EQ(spec.probes[2].axis, 1);
  EXPECT_EQ(spec.quantities[0].take, QuantitySpec::Statistic::first_peak);
  EXPECT_EQ(spec.quantities[0].unit, "degree");
  EXPECT_DOUBLE_EQ(spec.quantities[1].threshold, 2e6);
  EXPECT_EQ(spec.quantities[1].unit, "ms");
  EXPECT_DOUBLE_EQ((*spec.quantities[2].reference)({}, 2), 12);
}

TEST(ReadCase, ErrorsCompareAFieldWithFormulas) {
  CaseSpec const spec = read(sample_case() + R"(
[[probe]]
name = "stress"
body = "column"
kind = "error"
field = "CauchyStress"
reference = ["1 MPa", 0, "w*t", 0, 0, 0]
where = "Y > 1"
[[quantity]]
name = "stress_error"
column = "stress.relative_error"
take = "at_time"
time = "1 ms"
)");
  ProbeSpec const& probe = spec.probes[1];
  EXPECT_EQ(probe.kind, ProbeSpec::Kind::error);
  EXPECT_EQ(probe.field, "CauchyStress");
  ASSERT_EQ(probe.reference.size(), 6u);
  EXPECT_DOUBLE_EQ(probe.reference[0]({}), 1e6);
  EXPECT_DOUBLE_EQ(probe.reference[2]({0, 6, 0}, 2), 210);
  EXPECT_TRUE(probe.where);
  EXPECT_EQ(probe.quantities, std::vector<std::string>{"relative_error"});
  EXPECT_EQ(spec.quantities[0].unit, "1");
}

TEST(ReadCase, OutputHasItsParts) {
  CaseSpec const spec = read(sample_case() + R"(
[output.frames]
every = "5 ms"
fields = ["Displacement", "Pressure"]
compress = false
[output.history]
every = 1e-3
[output.pictures]
every = "0.05 s"
field = "VonMisesStress"
range = [0, "5 MPa"]
view = [45, "-10 degree"]
size = [640, 480]
[output.checkpoints]
every = "0.1 s"
)");
  EXPECT_DOUBLE_EQ(spec.output.frames_every, 0.005);
  EXPECT_EQ(spec.output.frame_fields, (std::vector<std::string>{"Displacement", "Pressure"}));
  EXPECT_FALSE(spec.output.compress);
  EXPECT_DOUBLE_EQ(spec.output.history_every, 1e-3);
  EXPECT_DOUBLE_EQ(spec.output.pictures.every, 0.05);
  EXPECT_EQ(spec.output.pictures.field, "VonMisesStress");
  EXPECT_EQ(*spec.output.pictures.range, (std::array<double, 2>{0, 5e6}));
  EXPECT_EQ(spec.output.pictures.view, (std::array<double, 2>{45, -10}));
  EXPECT_EQ(spec.output.pictures.width, 640);
  EXPECT_EQ(spec.output.pictures.height, 480);
  EXPECT_DOUBLE_EQ(spec.output.checkpoints_every, 0.1);
}

TEST(ReadCase, TheLookOfPicturesIsRead) {
  CaseSpec const spec = read(sample_case() + R"(
[output.pictures]
every = "0.05 s"
view = "-x"
roll = "0.1 rad"
zoom = 1.5
look_at = ["1 mm", 2]
follow = "column"
map = "magma"
theme = "dark"
labels = false
)");
  EXPECT_EQ(spec.output.pictures.named_view, "-x");
  EXPECT_NEAR(spec.output.pictures.roll, 5.729578, 1e-6);
  EXPECT_EQ(spec.output.pictures.zoom, 1.5);
  EXPECT_EQ(*spec.output.pictures.look_at, (std::array<double, 3>{0.001, 2, 0}));
  EXPECT_EQ(spec.output.pictures.followed_body, "column");
  EXPECT_EQ(spec.output.pictures.map, Palette::magma);
  EXPECT_EQ(spec.output.pictures.theme, Theme::dark);
  EXPECT_FALSE(spec.output.pictures.labels);
  EXPECT_EQ(spec.output.pictures.width, 0) << "as what is shown needs it";
  CaseSpec const angles = read(sample_case() + "[output.pictures]\nevery = 1\nazimuth = -20\nelevation = 80\n");
  EXPECT_EQ(angles.output.pictures.view, (std::array<double, 2>{-20, 80}));
}

TEST(ReadCase, RunSettingsAreRead) {
  CaseSpec const spec = read(sample_with("end = \"0.5 s\"",
                                         "end = \"0.5 s\"\ncfl = 0.3\nmax_step = \"10 us\"\nmin_step = \"1 ns\"\n"
                                         "threads = 2\ninstruction_set = \"v3\""));
  EXPECT_DOUBLE_EQ(spec.run.cfl, 0.3);
  EXPECT_DOUBLE_EQ(spec.run.max_step, 1e-5);
  EXPECT_DOUBLE_EQ(spec.run.min_step, 1e-9);
  EXPECT_EQ(spec.run.threads, 2);
  EXPECT_EQ(spec.run.backend, "v3");
  EXPECT_EQ(read(sample_with("end = \"0.5 s\"", "end = 0.5\nthreads = \"auto\"")).run.threads, 0);
}

TEST(ReadCase, RanksAreCutAnewAsOftenAsTheCaseSays) {
  auto const with = [](std::string const& value) {
    return sample_with("end = \"0.5 s\"", "end = 0.5\nrepartition = " + value);
  };
  EXPECT_EQ(read(with("300")).run.repartition.every, 300);
  EXPECT_FALSE(read(with("300")).run.repartition.never);
  EXPECT_TRUE(read(with("\"never\"")).run.repartition.never);
  EXPECT_EQ(read(with("\"auto\"")).run.repartition.every, 0);
  EXPECT_FALSE(read(with("\"auto\"")).run.repartition.never);
  for (char const* const wrong : {"\"often\"", "0", "-3", "2.5", "true", "3000000000"})
    EXPECT_NE(message_of(with(wrong)).find(" (allowed: \"auto\", \"never\" or a whole number of steps)"),
              std::string::npos)
        << message_of(with(wrong));
}

TEST(ReadCase, ABoxTakesTheNearestSpacingThatFits) {
  EXPECT_EQ(read(sample_with("particles = [5, 25, 5]", "spacing = \"25 cm\"")).bodies[0].shape.particles,
            (std::array<int, 3>{5, 25, 5}));
  std::string const cells = sample_with("particles = [5, 25, 5]", "spacing = 0.24, placement = \"cell_centred\"");
  EXPECT_EQ(read(replaced(cells, "Y <= 0", "Y < 0.2")).bodies[0].shape.particles, (std::array<int, 3>{4, 25, 4}));
}

TEST(ReadCase, RoundBodiesAreRead) {
  std::string const box = R"(box = { min = ["-0.5 m", 0, "-50 cm"], max = [0.5, "6 m", 0.5] }, particles = [5, 25, 5])";
  std::string const far = replaced(sample_case(), "Y <= 0", "Y <= 1");
  CaseSpec const sphere = read(replaced(
      replaced(far, box, "sphere = { centre = [0, 1, 0], radius = \"1 m\" }, spacing = 0.2, jitter = 0.1, seed = 3"),
      "[0.5, 6, 0.5]", "[0, 1, 0]"));
  EXPECT_EQ(sphere.bodies[0].shape.kind, ShapeSpec::Kind::sphere);
  EXPECT_DOUBLE_EQ(sphere.bodies[0].shape.jitter, 0.1);
  EXPECT_EQ(sphere.bodies[0].shape.seed, 3u);
  CaseSpec const cylinder = read(replaced(
      replaced(far, box, "cylinder = { centre = [0, 0, 0], radius = 0.5, length = 6, axis = \"y\" }, spacing = 0.2"),
      "[0.5, 6, 0.5]", "[0, 6, 0]"));
  EXPECT_EQ(cylinder.bodies[0].shape.axis, 1);
  EXPECT_DOUBLE_EQ(cylinder.bodies[0].shape.length, 6);
}

TEST(ReadCase, TwoDimensionalCasesHaveTwoComponents) {
  CaseSpec const spec = read(R"(
title = "plate"
run = { end = 1 }
[[body]]
name = "plate"
shape = { box = { min = [0, 0], max = [2, 1] }, particles = [9, 5] }
material = { law = "linear_elastic", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
formulation = { name = "jst_sph" }
initial_velocity = ["5 m/s", 0]
initial_displacement = ["1 mm", "X*Y/1000"]
initial_deformation_gradient = [["1 + Y/1000", "X/1000"], [0, 1]]
[[support]]
body = "plate"
where = 1
fix = "y"
)");
  BodySpec const& body = spec.bodies[0];
  EXPECT_EQ(body.shape.dimension, 2);
  EXPECT_EQ(body.initial_velocity[0]({}), 5);
  EXPECT_DOUBLE_EQ((*body.initial_displacement)[0]({}), 0.001);
  auto const& F = *body.initial_deformation_gradient;
  EXPECT_DOUBLE_EQ(F[0]({1, 2, 0}), 1.002);
  EXPECT_DOUBLE_EQ(F[1]({1, 2, 0}), 0.001);
  EXPECT_EQ(F[3]({}), 0);
  EXPECT_EQ(F[4]({}), 1);
  EXPECT_EQ(F[8]({}), 1);
}

TEST(ReadCase, OverridesReplaceValuesAndTheSourceRepeatsThem) {
  std::vector<std::string> const overrides{"body.column.material.poissons_ratio=0.499",
                                           "body.0.shape.particles=[4, 19, 4]", "run.end=0.1 s",
                                           "output.history.every=0.01", "support.0.fix=xy"};
  CaseSpec const spec = read(sample_case(), overrides);
  EXPECT_DOUBLE_EQ(spec.bodies[0].material.value[2], 0.499);
  EXPECT_EQ(spec.bodies[0].shape.particles, (std::array<int, 3>{4, 19, 4}));
  EXPECT_DOUBLE_EQ(spec.run.end, 0.1);
  EXPECT_DOUBLE_EQ(spec.output.history_every, 0.01);
  EXPECT_EQ(spec.supports[0].fix, (std::array<bool, 3>{true, true, false}));
  CaseSpec const again = read(spec.source);
  EXPECT_DOUBLE_EQ(again.bodies[0].material.value[2], 0.499);
  EXPECT_DOUBLE_EQ(again.run.end, 0.1);
  EXPECT_EQ(again.bodies[0].initial_velocity[0].text(), "w*Z");
}

TEST(ReadCase, AFolderStandsForItsCaseFile) {
  testing::TemporaryFolder const folder;
  std::ofstream(folder / "case.toml") << sample_case();
  EXPECT_EQ(read_case(folder.path()).title, "Twisting column");
  EXPECT_EQ(read_case(folder / "case.toml").title, "Twisting column");
  EXPECT_THROW(read_case(folder / "missing.toml"), InputError);
}

TEST(ReadCase, TooManyParticlesAreRefusedBeforeTheyAreMade) {
  EXPECT_NE(message_of(sample_with("[5, 25, 5]", "[50000, 50000, 50000]")).find("at most 2,147,483,647"),
            std::string::npos);
  EXPECT_NE(message_of(sample_with("[5, 25, 5]", "[2000, 1000, 1000]"), {}, {1000, false}).find("at most 1,000"),
            std::string::npos);
}

TEST(CheckCase, ParticlesOfAConditionAreSelected) {
  CaseSpec const spec = read(sample_case());
  ParticleSet const set = make_particles(spec);
  EXPECT_EQ(set.size(), 625);
  EXPECT_EQ(select_particles(set, set.bodies[0], &*spec.supports[0].where).size(), 25u);
  EXPECT_EQ(select_particles(set, set.bodies[0], nullptr).size(), 625u);
}

}  // namespace
}  // namespace piola
