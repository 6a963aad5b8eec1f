// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/formulations/jst_sph/stability.hpp"
#include "formulations/small_bodies.hpp"
#include <numbers>

/// The conservative scheme: the energy of what gradients do not see, and its viscous part.
namespace piola::testing {
namespace {

Assembly conservative(ParticleSet set, MaterialParameters const& m = rubber("neo_hookean", 0.47)) {
  Assembly a = assemble(std::move(set), m);
  choose(a, "scheme", "conservative");
  return a;
}

/// A displacement with a sawtooth in it, as large as what resists it allows.
Point crooked(Point const& X, double size = 0.02) {
  double const s = std::sin(977 * X[0] + 641 * X[1] + 353 * X[2]);
  return {size * s + 0.1 * X[1], size * std::cos(1231 * s) - 0.05 * X[0] * X[1], size * std::sin(733 * s) + 0.1 * X[0]};
}
/// A direction in which forces are compared with differences of the energy.
Point direction(Point const& X) {
  return {std::cos(311 * X[0] + 17 * X[1]), std::sin(211 * X[1] + 5 * X[2]), std::cos(401 * X[2] + 91 * X[0])};
}

double column(Diagnostics const& d, std::string_view name) {
  for (auto const& [key, value] : d.more)
    if (key == name) return value;
  ADD_FAILURE() << "no column is named " << name;
  return 0;
}

struct Setting {
  int dimension;
  double jitter;
  char const* law;
  double poissons_ratio;
};

class HourglassEnergy : public ::testing::TestWithParam<Setting> {
 protected:
  Assembly assembly() const {
    auto const& s = GetParam();
    return conservative(unit_box(s.dimension, s.dimension == 1 ? 11 : 5, s.jitter), rubber(s.law, s.poissons_ratio));
  }
  Point in_dimension(Point v) const {
    for (std::size_t c = static_cast<std::size_t>(GetParam().dimension); c < 3; ++c) v[c] = 0;
    return v;
  }
};

INSTANTIATE_TEST_SUITE_P(All, HourglassEnergy,
                         ::testing::Values(Setting{1, 0, "neo_hookean", 0.3}, Setting{2, 0, "neo_hookean", 0.3},
                                           Setting{3, 0, "neo_hookean", 0.3}, Setting{3, 0, "neo_hookean", 0.49},
                                           Setting{2, 0.2, "mooney_rivlin", 0.47}, Setting{3, 0.2, "neo_hookean", 0.49},
                                           Setting{3, 0.2, "linear_elastic", 0.3},
                                           Setting{3, 0, "saint_venant_kirchhoff", 0.3},
                                           Setting{2, 0.2, "compressible_neo_hookean", 0.3}),
                         [](auto const& p) {
                           auto const& s = p.param;
                           return std::to_string(s.dimension) + "D_" + (s.jitter > 0 ? "jittered_" : "regular_") +
                                  s.law + "_" + std::to_string(static_cast<int>(std::lround(100 * s.poissons_ratio)));
                         });

/// sum m a.w = -dE(u + h w)/dh, E with the energy of pairs and its growth with the change of shape.
TEST_P(HourglassEnergy, HasTheForcesAsItsDerivative) {
  Assembly a = assembly();
  choose(a, "hourglass_viscosity", 0.0);
  choose(a, "bulk_viscosity", 0.0);
  choose(a, "angular_momentum_projection", "off");  // linear elasticity resists rotation, which it would take out
  auto const energy = [&](double h) {
    displace(a, [&](Point const& X) {
      Point u = in_dimension(crooked(X));
      Point const w = in_dimension(direction(X));
      for (std::size_t c = 0; c < 3; ++c) u[c] += h * w[c];
      return u;
    });
    return make_formulation(a)->diagnose();
  };
  double const h = 2e-6;
  double const slope = (energy(h).strain_energy - energy(-h).strain_energy) / (2 * h);
  Diagnostics const at_rest = energy(0);
  ASSERT_GT(column(at_rest, "hourglass_energy"), 0.01 * at_rest.strain_energy) << "the test would not see it";
  auto const f = make_formulation(a);
  double const dt = 1e-10;  // from rest, so that velocities are dt times the accelerations of the start
  f->step(0, dt);
  Values const v = sample(*f, "Velocity", a.particles.X.size());
  double power = 0, size = 0;
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    Point const w = in_dimension(direction(a.particles.X[k]));
    for (std::size_t c = 0; c < 3; ++c) {
      double const part = 1100 * a.particles.volume[k] * v[3 * k + c] / dt * w[c];
      power += part;
      size += std::fabs(part);
    }
  }
  EXPECT_NEAR(power, -slope, 1e-7 * size);
}

/// Gradients see a linear displacement whole, and a rigid motion stores and loses nothing.
TEST_P(HourglassEnergy, IsZeroForLinearDisplacements) {
  Assembly a = assembly();
  displace(a, [&](Point const& X) {
    return in_dimension({0.2 * X[0] + 0.3 * X[1] - 0.1 * X[2], 0.1 * X[1] - 0.2 * X[0], 0.3 * X[2] + 0.1 * X[1]});
  });
  Diagnostics const d = make_formulation(a)->diagnose();
  EXPECT_GT(d.strain_energy, 0);
  EXPECT_LT(std::fabs(column(d, "hourglass_energy")), 1e-25 * 17e6);  // squares of round-off
}

TEST_P(HourglassEnergy, ClosesTheBooksWithWhatItsViscousPartTakes) {
  auto const defect = [&](int steps) {
    Assembly a = assembly();
    a.cfl = 0.3;
    displace(a, [&](Point const& X) { return in_dimension(crooked(X, 0.005)); });
    auto const f = make_formulation(a);
    double const before = f->diagnose().total_energy();
    advance(*f, 1e-3 / steps, steps);
    Diagnostics const after = f->diagnose();
    EXPECT_GT(after.stabilisation_loss, 3e-3 * before);
    return std::fabs(after.total_energy() + after.stabilisation_loss + after.projection_loss - before) / before;
  };
  double const coarse = defect(200), fine = defect(400);
  EXPECT_LT(fine, 2e-4);
  EXPECT_LT(fine, 0.6 * coarse + 1e-9);
}

TEST_P(HourglassEnergy, IsNeverFedByItsViscousPart) {
  Assembly a = assembly();
  a.cfl = 0.03;
  displace(a, [&](Point const& X) { return in_dimension(crooked(X, 0.005)); });
  auto const f = make_formulation(a);
  double before = f->diagnose().stabilisation_loss;
  EXPECT_NEAR(before, 0, 1e-12 * f->diagnose().total_energy());
  for (int k = 0; k < 60; ++k) {
    for (int n = 0; n < 5; ++n) f->step(0, f->stable_time_step());
    double const now = f->diagnose().stabilisation_loss;
    EXPECT_GE(now, before) << k;
    before = now;
  }
}

/// e is the error of the trapezium, which is exact for quadratic displacements wherever gradients are: inside.
TEST(HourglassForces, VanishForQuadraticDisplacementsInside) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    Assembly a = conservative(unit_box(dimension, 9));
    displace(a, [&](Point const& X) {
      return Point{0.1 * X[0] * X[0] - 0.05 * X[1] * X[2], dimension > 1 ? 0.1 * X[0] * X[1] : 0,
                   dimension > 2 ? 0.1 * X[2] * X[2] - 0.1 * X[0] * X[1] : 0};
    });
    jst_sph::Backend const& backend = *jst_sph::find_backend("auto");
    jst_sph::JstBody body(a, a.particles, 0, jst_sph::read_options(a.formulations[0], a.materials[0], 0.3), backend);
    backend.observe_energy(body.state());
    double inside = 0, outside = 0;
    for (Index i = 0; i < body.particles(); ++i) {
      auto const X = body.X(i);
      bool deep = true;
      for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) deep = deep && std::fabs(X[c] - 0.5) < 0.3;
      double& most = deep ? inside : outside;
      most = std::max(most, std::fabs(jst_sph::JstBody::value(body.state().hourglass_energy, i)));
    }
    EXPECT_GT(outside, 1) << dimension;
    EXPECT_LT(inside, 1e-20 * outside) << dimension;
  }
}

/// Neither translation nor rotation is seen, however large.
TEST(HourglassForces, VanishInRigidMotion) {
  for (double const jitter : {0.0, 0.2}) {
    Assembly a = conservative(unit_box(3, 5, jitter));
    displace(a, [](Point const& X) { return Point{-X[1] - X[0] + 3, X[0] - X[1], 0}; });  // a quarter turn
    Diagnostics const d = make_formulation(a)->diagnose();
    EXPECT_LT(d.strain_energy, 1e-20 * 17e6);
    give_velocity(a, [](Point const& X) { return Point{-2 * X[0], -2 * X[1], 1}; });  // turns about z at its new place
    auto const f = make_formulation(a);
    double const before = f->diagnose().kinetic_energy;
    f->step(0, 1e-6);
    EXPECT_NEAR(f->diagnose().stabilisation_loss, 0, 1e-9 * before);
  }
}

TEST(ConservativeScheme, KeepsItsEnergyToSecondOrderWithoutViscosity) {
  auto const change = [](double jitter, int steps) {
    Assembly a = tumbling_box(3, 5, jitter);
    for (auto& m : a.materials) m = rubber("neo_hookean", 0.499);
    choose(a, "scheme", "conservative");
    choose(a, "hourglass_viscosity", 0.0);
    choose(a, "bulk_viscosity", 0.0);
    return energy_change(a, 2e-3, steps);
  };
  for (double const jitter : {0.0, 0.2}) {
    double const coarse = change(jitter, 100), fine = change(jitter, 200);
    EXPECT_LT(fine, 1e-4);
    EXPECT_GT(coarse / fine, 3) << coarse << " " << fine;
  }
}

/// The step rule against what happens: energy stays at 0.9 of the limit, but for Verlet's wobble, and blows up at 1.3
/// of it, viscosity or not.
TEST(ConservativeScheme, KnowsTheStepAtWhichItBlowsUp) {
  for (double const poissons_ratio : {0.0, 0.3, 0.499})
    for (double const viscosity : {0.0, 1.0, 3.0}) {
      Assembly a = conservative(unit_box(3, 5), rubber("neo_hookean", poissons_ratio));
      choose(a, "hourglass_viscosity", viscosity);
      double const limit = make_formulation(a)->steady_time_step() / 0.7;
      give_velocity(a, [](Point const& X) {
        double const s = std::sin(977 * X[0] + 641 * X[1] * X[1] + 353 * X[2]);
        return Point{1e-6 * s, -1e-6 * std::cos(1231 * s), 1e-6 * std::sin(733 * s)};
      });
      auto const growth = [&](double share) {
        Assembly b = a;
        b.cfl = 0.3;  // no monitor: the steps are given
        auto const f = make_formulation(b);
        double const before = f->diagnose().total_energy();
        advance(*f, share * limit, 300);
        return f->failure() ? std::numeric_limits<double>::infinity() : f->diagnose().total_energy() / before;
      };
      EXPECT_LT(growth(0.9), 1.1) << poissons_ratio << " " << viscosity;
      EXPECT_GT(growth(1.3), 10) << poissons_ratio << " " << viscosity;
    }
}

/// A free bar that vibrates along itself, 20 particles per wavelength, loses a fraction of a per cent in a period; the
/// biharmonic dissipation takes a tenth.
TEST(ConservativeScheme, HardlyDampsVibrationsThatItResolves) {
  auto const loss = [](std::string const& scheme) {
    double const L = 10, youngs_modulus = 17e6, speed = 1e-3;
    Assembly a = assemble(box({L, 2, 2}, {11, 3, 3}), rubber("neo_hookean", 0.0));
    choose(a, "scheme", scheme);
    give_velocity(a, [&](Point const& X) { return Point{speed * std::cos(std::numbers::pi * X[0] / L), 0, 0}; });
    auto const f = make_formulation(a);
    double const before = f->diagnose().total_energy(), period = 2 * L / std::sqrt(youngs_modulus / 1100);
    int const steps = static_cast<int>(period / (0.5 * f->steady_time_step())) + 1;
    advance(*f, period / steps, steps);
    return f->diagnose().stabilisation_loss / before;
  };
  double const conservative = loss("conservative"), filtered = loss("filtered");
  EXPECT_GT(conservative, 5e-4);
  EXPECT_LT(conservative, 6e-3);
  EXPECT_GT(filtered, 10 * conservative);
}

TEST(ConservativeScheme, LeavesTheStateAsItWasWhenItMeasuresItsStep) {
  for (double const poissons_ratio : {0.3, 0.49}) {
    Assembly a = conservative(unit_box(3, 5, 0.2), rubber("neo_hookean", poissons_ratio));
    displace(a, [](Point const& X) { return crooked(X, 0.005); });
    a.cfl = 0.3;
    SavedState const plain = saved(*make_formulation(a));
    a.cfl = std::numeric_limits<double>::quiet_NaN();
    SavedState const monitored = saved(*make_formulation(a));
    for (auto const& [name, values] : plain.values) EXPECT_EQ(monitored.values.at(name), values) << name;
  }
}

TEST(ConservativeScheme, GoesOnAlikeWhetherItIsWatchedOrNot) {
  Assembly a = tumbling_box(3, 5);
  for (auto& m : a.materials) m = rubber("neo_hookean", 0.49);
  choose(a, "scheme", "conservative");
  auto const watched = make_formulation(a), alone = make_formulation(a);
  for (int k = 0; k < 20; ++k) {
    (void)watched->diagnose();
    watched->step(0, watched->stable_time_step());
    alone->step(0, alone->stable_time_step());
  }
  EXPECT_EQ(saved(*watched).values, saved(*alone).values);
}

}  // namespace
}  // namespace piola::testing
