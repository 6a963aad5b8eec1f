// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/build.hpp"
#include "piola/base/units.hpp"
#include "piola/input/history_names.hpp"
#include "piola/model/read_case.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <utility>

namespace piola {
namespace {

using test::expect_words;

Assembly assembled(std::string const& more) {
  return assemble(read_case_text(test::sample_case() + more, "case.toml"));
}

TEST(Assemble, SupportsBecomeIdsAndPrescribedVelocities) {
  Assembly const a = assembled(R"(
[[support]]
body = "column"
where = "Y >= L && X < 0"
fix = "normal"
normal = [0, 2, 0]
velocity = [0, "-10*t*X", 0]
until = "7 ms"
)");
  ASSERT_EQ(a.supports.size(), 2u);
  EXPECT_EQ(a.supports[0].particles.size(), 25u);
  EXPECT_FALSE(a.supports[0].velocity);
  Support const& support = a.supports[1];
  ASSERT_EQ(support.particles.size(), 10u);
  for (std::int64_t const id : support.particles) EXPECT_EQ(a.particles.X[static_cast<std::size_t>(id)][1], 6);
  EXPECT_EQ(support.frame, Support::Frame::normal);
  EXPECT_EQ(support.normal, (std::array<double, 3>{0, 1, 0}));
  EXPECT_DOUBLE_EQ((*support.velocity)[1]({0.5, 6, 0}, 2), -10);
  EXPECT_DOUBLE_EQ(support.until, 0.007);
}

// The sum of mass times acceleration is the whole force: traction times the face, 1 m x 1 m; body force times the
// volume, 6 m^3; acceleration times the mass, 6600 kg.
TEST(Assemble, GivesJitteredParticlesTheVolumesOfTheirCellsWhereTheFormulationWantsThem) {
  auto const volumes = [](char const* formulation, double jitter) {
    CaseSpec spec = read_case_text(test::sample_case(), "case.toml");
    spec.bodies[0].formulation = {formulation, {}, {}};
    spec.bodies[0].shape.jitter = jitter;
    return assemble(spec).particles.volume;
  };
  EXPECT_NE(volumes("jst_sph", 0.2), volumes("jst_sph", 0));
  EXPECT_EQ(volumes("taylor_sph", 0.2), volumes("taylor_sph", 0));
}

TEST(Assemble, LoadsSumToTheWholeForce) {
  Assembly const a = assembled(R"(
[[load]]
body = "column"
face = "+y"
traction = [0, "3 MPa", 0]
until = "1 ms"
[[load]]
body = "column"
body_force = [0, 0, "5 kN/m^3"]
[[load]]
body = "column"
acceleration = ["2 m/s^2", 0, 0]
)");
  ASSERT_EQ(a.loads.size(), 3u);
  std::array<double, 3> const expected{3e6, 6 * 5000, 6600 * 2};
  std::array<std::size_t, 3> const direction{1, 2, 0};
  for (std::size_t l = 0; l < 3; ++l) {
    Load const& load = a.loads[l];
    ASSERT_EQ(load.particles.size(), load.factor.size());
    double force = 0;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      auto const id = static_cast<std::size_t>(load.particles[k]);
      force += 1100 * a.particles.volume[id] * load.factor[k] * load.value[direction[l]](a.particles.X[id]);
    }
    EXPECT_NEAR(force, expected[l], 1e-12 * expected[l]);
  }
  EXPECT_EQ(a.loads[0].particles.size(), 25u);
  EXPECT_DOUBLE_EQ(a.loads[0].until, 1e-3);
  EXPECT_EQ(a.loads[0].normal, (std::array<double, 3>{0, 1, 0}));
  EXPECT_FALSE(a.loads[1].normal);
  EXPECT_FALSE(a.loads[2].normal);
  EXPECT_EQ(a.loads[1].particles.size(), 625u);
}

TEST(Assemble, MirrorsNameTheirBody) {
  Assembly const a = assembled(R"(
[[body]]
name = "second"
shape = { box = { min = [2, 0, 0], max = [3, 1, 1] }, particles = [4, 4, 4] }
material = { law = "neo_hookean", density = 1, youngs_modulus = 1, poissons_ratio = 0 }
formulation = { name = "jst_sph" }
[[mirror]]
body = "second"
face = "+z"
antisymmetric = true
[contact]
law = "none"
)");
  ASSERT_EQ(a.mirrors.size(), 1u);
  EXPECT_EQ(a.mirrors[0].body, 1u);
  EXPECT_EQ(a.mirrors[0].axis, 2);
  EXPECT_TRUE(a.mirrors[0].upper);
  EXPECT_TRUE(a.mirrors[0].skew);
}

// Read, built and run from the same particles, which stand once in memory.
TEST(Build, TakesTheParticlesThatReadingHasMade) {
  ParticleSet particles;
  CaseSpec const spec = read_case_text(test::sample_case(), "case.toml", {}, {}, &particles);
  auto const* const place = std::as_const(particles).X.data();
  Simulation const simulation = build(spec, particles);
  EXPECT_EQ(simulation.particles.X.data(), place);
  EXPECT_EQ(simulation.particles.volume.data(), std::as_const(particles).volume.data());
  particles = {};
  EXPECT_TRUE(simulation.particles.X.shared());  // with the formulation
  EXPECT_GT(simulation.formulation->statistics().memory_bytes, simulation.particles.bytes());
  Simulation const anew = build(spec);
  EXPECT_EQ(anew.particles.X, simulation.particles.X);
  EXPECT_EQ(anew.formulation->diagnose().total_energy(), simulation.formulation->diagnose().total_energy());
}

TEST(Build, FieldsAndColumnsAreThoseThatCaseFilesKnow) {
  Simulation const simulation = build(read_case_text(test::sample_case(), "case.toml"));
  for (FieldInfo const& field : simulation.formulation->observables().fields()) {
    for (FieldName const& known : field_names()) {
      if (known.name != field.name) continue;
      EXPECT_EQ(convert_from_si(1, field.unit, known.unit), 1) << field.name;
      EXPECT_EQ(known.components, field.components) << field.name;
    }
  }
  auto const announced = find_formulation("jst_sph")->diagnostics;
  if (announced.empty()) return;  // then nothing that it adds can be asked for
  for (auto const& [name, value] : simulation.formulation->diagnose().more) {
    EXPECT_TRUE(std::any_of(announced.begin(), announced.end(), [&name = name](DiagnosticInfo const& info) {
      return info.name == name;
    })) << name;
  }
}

TEST(Build, AnnouncedColumnsCanBeAskedFor) {
  auto const announced = find_formulation("jst_sph")->diagnostics;
  for (DiagnosticInfo const& column : announced) {
    std::string const quantity = "[[quantity]]\nname = \"q\"\ncolumn = \"" + std::string(column.name) + "\"\n";
    CaseSpec const spec = read_case_text(test::sample_case() + quantity, "case.toml");
    EXPECT_EQ(spec.quantities[0].unit, column.unit);
  }
}

// The fields are those of the solver, which is known only when it is built.
TEST(Build, ProbesAskForFieldsThatThereAre) {
  std::string const probe = "[[probe]]\nname = \"d\"\nbody = \"column\"\nkind = \"average\"\n";
  auto const built = [&](std::string const& quantities) -> std::string {
    try {
      build(read_case_text(test::sample_case() + probe + "quantities = " + quantities + "\n", "case.toml"));
    } catch (InputError const& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(built("[\"position_x\", \"pressure\"]"), "");
  std::string const message = built("[\"pressure\", \"kernel_type\"]");
  expect_words(message, {"case.toml:27:14: probe \"d\"", "kernel_type", "jst_sph", "KernelType", "Displacement"});
  EXPECT_TRUE(message.ends_with(") - remove it")) << message;
}

// Bodies that are not on a lattice: a uniform rotation keeps its angular momentum, nothing is lost or blows up.
TEST(Build, BodiesOfRingsAreMovedByJst) {
  std::string const material =
      "material = { law = \"neo_hookean\", density = 1000, youngs_modulus = \"1 MPa\", poissons_ratio = 0.3 }\n"
      "formulation = { name = \"jst_sph\" }\ninitial_velocity = [\"-Y\", \"X\"]\n";
  for (std::string const shape :
       {"radius = 1, arrangement = \"rings\"", "radius = 1, arrangement = \"lattice_with_rings\"",
        "radius = 1, inner_radius = 0.5, arrangement = \"rings\"", "radius = 1, inner_radius = 0.5"}) {
    CaseSpec const spec = read_case_text(
        "title = \"disc\"\n[run]\nend = 1\n[[body]]\nname = \"disc\"\nshape = { sphere "
        "= { centre = [0, 0], " +
            shape + " }, spacing = 0.1 }\n" + material,
        "case.toml");
    Simulation simulation = build(spec);
    double const step = simulation.formulation->step_estimate().stable;
    Diagnostics const before = simulation.formulation->diagnose();
    for (int i = 0; i < 10; ++i) simulation.formulation->step(i * step, step);
    Diagnostics const after = simulation.formulation->diagnose();
    EXPECT_GT(after.kinetic_energy, 0) << shape;
    EXPECT_NEAR(after.angular_momentum[2], before.angular_momentum[2], 1e-3 * before.angular_momentum[2]) << shape;
  }
}

}  // namespace
}  // namespace piola
