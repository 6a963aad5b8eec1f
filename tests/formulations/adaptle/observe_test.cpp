// SPDX-License-Identifier: Apache-2.0
// What comes out of a run of AdapTLE: fields, sums, and defaults of the settings.
#include "formulations/adaptle/clouds.hpp"

namespace piola {
namespace {

using namespace testing;

constexpr double rho0 = 2870, bulk = 70e9 / (3 * (1 - 2 * 0.33));

/// A box of 5 x 5 (x 5) particles, displaced by x = (1.1 X, Y, Z), the left half Eulerian, with a state of its own.
struct Observed {
  explicit Observed(int dimension) {
    assembly = adaptle_assembly(unit_box(dimension, 5));
    choose(assembly, "correction", "mixed");
    choose(assembly, "correction_limit", 1e30);
    choose(assembly, "description", "patch");
    choose(assembly, "blend", 0.0);
    choose_formula(assembly, "eulerian_where", "X < 0.4");
    give_velocity(assembly, [](Point const& X) { return Point{1 + X[0], 2, 0}; });
    formulation = make_formulation(assembly);
    SavedState state = saved(*formulation);
    auto& values = state.values;
    for (std::size_t i = 0; i < assembly.particles.X.size(); ++i) {
      values.at("Position")[3 * i] *= 1.1;
      values.at("Density")[i] = rho0 / 1.1;
      std::copy_n(std::array{4e6, -1e6, -3e6, 2e6}.begin(), 4, &values.at("StressDeviator")[6 * i]);
      values.at("InternalEnergy")[i] = 10 * rho0 * assembly.particles.volume[i];
      values.at("EquivalentPlasticStrain")[i] = 0.25;
      values.at("Temperature")[i] = 400 + static_cast<double>(i);
      values.at("Damage")[i] = i < 2 ? 1 : 0.5;
      values.at("PlasticWork")[i] = 7;
    }
    formulation->load(state);
  }
  Values field(std::string_view name) const { return sample(*formulation, name, assembly.particles.X.size()); }

  Assembly assembly;
  std::unique_ptr<Formulation> formulation;
};

TEST(AdaptleObserve, FieldsAreWhatTheirNamesSay) {
  for (int const dimension : {2, 3}) {
    Observed const o(dimension);
    double const tension = bulk * (1 - 1 / 1.1);
    std::size_t const n = o.assembly.particles.X.size();
    Values const u = o.field("Displacement"), x = o.field("Position"), v = o.field("Velocity"), m = o.field("Momentum"),
                 p = o.field("Pressure"), stress = o.field("CauchyStress"), J = o.field("Jacobian"),
                 mises = o.field("VonMisesStress"), rho = o.field("Density"), phi = o.field("KernelType"),
                 id = o.field("Id"), T = o.field("Temperature");
    for (std::size_t i = 0; i < n; ++i) {
      double const X = o.assembly.particles.X[i][0];
      EXPECT_NEAR(u[3 * i], 0.1 * X, 1e-15);
      EXPECT_NEAR(x[3 * i], 1.1 * X, 1e-15);
      EXPECT_EQ(v[3 * i + 1], 2);
      EXPECT_NEAR(m[3 * i], rho0 / 1.1 * (1 + X), 1e-9);
      EXPECT_NEAR(p[i], tension, 1e-6 * tension) << "positive in tension";
      EXPECT_NEAR(stress[6 * i], 4e6 + tension, 1e-6 * tension);
      EXPECT_NEAR(stress[6 * i + 2], -3e6 + tension, 1e-6 * tension);
      EXPECT_NEAR(stress[6 * i + 3], 2e6, 1e-6);
      EXPECT_NEAR(J[i], 1.1, 1e-14);
      EXPECT_NEAR(mises[i], std::sqrt(1.5 * (16 + 1 + 9 + 2 * 4)) * 1e6, 1e-3);
      EXPECT_NEAR(rho[i], rho0 / 1.1, 1e-10);
      EXPECT_EQ(phi[i], X < 0.4 ? 1 : 0);
      EXPECT_EQ(id[i], static_cast<double>(i));
      EXPECT_EQ(T[i], 400 + static_cast<double>(i));
    }
    for (double const e : o.field("EquivalentPlasticStrain")) EXPECT_EQ(e, 0.25);
    for (double const e : o.field("InternalEnergy")) EXPECT_NEAR(e, 10, 1e-12);
    EXPECT_EQ(o.field("Damage")[0], 1);
    EXPECT_EQ(o.field("Body")[0], 0);
  }
}

TEST(AdaptleObserve, NeighboursAreThoseWithinTwoSmoothingLengths) {
  for (int const dimension : {2, 3}) {
    Assembly a = adaptle_assembly(unit_box(dimension, 6, 0.3));
    choose(a, "material_smoothing_length", 1.3);
    auto const f = make_formulation(a);
    Values const counted = sample(*f, "Neighbours", a.particles.X.size());
    for (std::size_t i = 0; i < counted.size(); ++i) {
      double count = -1;  // not itself
      for (auto const& X : a.particles.X) {
        auto const& Y = a.particles.X[i];
        count += std::hypot(X[0] - Y[0], X[1] - Y[1], X[2] - Y[2]) < 2 * 1.3 * 0.2 ? 1 : 0;
      }
      EXPECT_EQ(counted[i], count);
    }
  }
}

TEST(AdaptleObserve, SumsAreTakenOverAllParticles) {
  Observed const o(3);
  Diagnostics const d = o.formulation->diagnose();
  // Particles carry their part of the volume of 1 m3; int (1 + X)^2 + 4 by the trapezoidal rule with 4 intervals.
  double kinetic = 0, momentum = 0;
  for (int k = 0; k <= 4; ++k) {
    double const X = 0.25 * k, weight = (k == 0 || k == 4 ? 0.5 : 1) * 0.25;
    kinetic += weight * rho0 / 2 * ((1 + X) * (1 + X) + 4);
    momentum += weight * rho0 * (1 + X);
  }
  EXPECT_NEAR(d.kinetic_energy, kinetic, 1e-10 * kinetic);
  EXPECT_NEAR(d.linear_momentum[0], momentum, 1e-10 * momentum);
  EXPECT_NEAR(d.linear_momentum[1], 2 * rho0, 1e-8);
  EXPECT_NEAR(d.strain_energy, 10 * rho0, 1e-7);
  std::map<std::string, double> more(d.more.begin(), d.more.end());
  EXPECT_NEAR(more.at("internal_energy"), 10 * rho0, 1e-7);
  EXPECT_NEAR(more.at("plastic_work"), 7, 1e-12);
  EXPECT_EQ(more.at("eulerian_particles"), 50);  // two layers of 25
  EXPECT_EQ(more.at("failed_particles"), 2);
  EXPECT_EQ(more.at("temperature_max"), 400 + 124);
  FormulationInfo const info = adaptle::info();
  for (auto const& one : info.diagnostics) EXPECT_TRUE(more.contains(std::string(one.name))) << one.name;
  EXPECT_EQ(more.size(), info.diagnostics.size());
}

TEST(AdaptleObserve, UnknownFieldsAreRefused) {
  Observed const o(2);
  Values room(25);
  EXPECT_THROW(o.formulation->observables().sample("Presure", room), std::invalid_argument);
}

TEST(AdaptleObserve, AnInitialPressureActsForOneStepOrAlways) {
  for (std::string const lasts : {"one_step", "always"}) {
    Assembly a = adaptle_assembly(unit_box(2, 9));
    choose(a, "description", "eulerian");
    choose(a, "initial_pressure_duration", lasts);
    choose_formula(a, "initial_pressure", "1e7");
    Cloud cloud(a);
    cloud.evaluate();
    EXPECT_EQ(cloud.half(40).pressure, -1e7) << "positive in tension";
    double pull = cloud.sums(0).force[0];
    EXPECT_GT(pull, 0) << "tension pulls the corner inwards";
    cloud.evaluate();
    if (lasts == "always")
      EXPECT_NEAR(cloud.sums(0).force[0], pull, 1e-9 * pull);
    else
      EXPECT_NEAR(cloud.sums(0).force[0], 0, 1e-9 * pull);
  }
}

TEST(AdaptleOptions, HaveTheDefaultsOfTheManual) {
  Assembly a = adaptle_assembly(unit_box(2, 4));
  adaptle::Options const o = adaptle::read_options(a);
  EXPECT_EQ(o.bodies[0].description, adaptle::Description::adaptive);
  EXPECT_EQ(o.bodies[0].smoothing_length, 1.4);
  EXPECT_EQ(o.bodies[0].conversion_radius, 2);
  EXPECT_EQ(o.bodies[0].blend, 4);
  EXPECT_FALSE(o.bodies[0].deletes);
  EXPECT_EQ(o.settings.equations.interface_form, adaptle::Interface::owner);
  EXPECT_EQ(o.settings.mixed_stress, adaptle::MixedStress::both);
  EXPECT_EQ(o.settings.viscosity, adaptle::Viscosity::compression);
  EXPECT_FALSE(o.settings.corrected);
  EXPECT_EQ(o.settings.fallback, 7.5);
  EXPECT_TRUE(o.settings.artificial_stress);
  EXPECT_EQ(o.settings.cfl, 0.3);
  choose(a, "artificial_stress", 0.0);
  EXPECT_EQ(adaptle::read_options(a).settings.fallback, 7.5);
  EXPECT_FALSE(adaptle::read_options(a).settings.artificial_stress);
  adaptle::Options const space = adaptle::read_options(adaptle_assembly(unit_box(3, 4)));
  EXPECT_EQ(space.bodies[0].smoothing_length, 1.2);
  EXPECT_EQ(space.bodies[0].material_smoothing_length, 1);
  EXPECT_EQ(o.bodies[0].material_smoothing_length, 1.2);
}

TEST(AdaptleOptions, HourglassesAreHeldBySpringsWhereNothingYieldsAndDampedElsewhere) {
  adaptle::Options const elastic = adaptle::read_options(adaptle_assembly(unit_box(2, 4)));
  EXPECT_TRUE(elastic.settings.equations.has_central_viscosity());
  EXPECT_EQ(elastic.bodies[0].hourglass_stiffness, 1);
  EXPECT_EQ(elastic.bodies[0].hourglass, 0.1);
  auto metal = adaptle_assembly(unit_box(2, 4), sample_metal("johnson_cook", "elastic"));
  adaptle::Options const yielding = adaptle::read_options(metal);
  EXPECT_FALSE(yielding.settings.equations.has_central_viscosity());
  EXPECT_EQ(yielding.bodies[0].hourglass_stiffness, 0);
  EXPECT_EQ(yielding.bodies[0].hourglass, 0.7);
  EXPECT_TRUE(yielding.bodies[0].releases);
  choose(metal, "description", "total_lagrangian");
  adaptle::Options const flowing = adaptle::read_options(metal);
  EXPECT_EQ(flowing.bodies[0].hourglass_stiffness, 0);
  EXPECT_EQ(flowing.bodies[0].hourglass, 0.1);
  Assembly plain = adaptle_assembly(unit_box(2, 4));
  choose(plain, "correction", "none");
  adaptle::Options const uncorrected = adaptle::read_options(plain);
  EXPECT_EQ(uncorrected.bodies[0].hourglass_stiffness, 0);
  EXPECT_EQ(uncorrected.bodies[0].hourglass, 0);
  EXPECT_EQ(uncorrected.bodies[0].material_smoothing_length, 1.4);
}

}  // namespace
}  // namespace piola
