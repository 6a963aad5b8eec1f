// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/stability.hpp"
#include "piola/materials/laws.hpp"
#include "formulations/small_bodies.hpp"

/// The step limit that follows the deformation.
namespace piola::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Nearly incompressible rubber, squeezed to `stretch` across and longer by the same volume.
Assembly squeezed(double stretch, double jitter = 0) {
  Assembly a = assemble(unit_box(3, 5, jitter), rubber("neo_hookean", 0.499));
  choose(a, "scheme", "filtered");
  double const along = 1 / (stretch * stretch);
  displace(a, [&](Point const& X) { return Point{(stretch - 1) * X[0], (along - 1) * X[1], (stretch - 1) * X[2]}; });
  return a;
}

TEST(LargestStep, IsTheRootOfTheStabilityFormula) {
  double const w = 3, d = 0.7, dt = jst_sph::largest_step(w, d);
  EXPECT_NEAR(dt * dt * w * w + 2 * dt * d, 4, 1e-12);
  EXPECT_DOUBLE_EQ(jst_sph::largest_step(2, 0), 1);
  EXPECT_DOUBLE_EQ(jst_sph::largest_step(0, 4), 0.5);
  EXPECT_EQ(jst_sph::largest_step(0, 0), std::numeric_limits<double>::infinity());
}

TEST(StabilityMonitor, LeavesTheStateAsItWas) {
  for (double const jitter : {0.0, 0.2}) {
    Assembly a = squeezed(0.8, jitter);
    a.cfl = 0.3;
    SavedState const plain = saved(*make_formulation(a));
    a.cfl = nan;
    SavedState const monitored = saved(*make_formulation(a));
    for (auto const& [name, values] : plain.values) EXPECT_EQ(monitored.values.at(name), values) << name;
  }
}

/// The limit about a deformed state against what happens there: a small vibration, the difference of two runs that take
/// the same steps, stays small at 0.9 of it and grows at 1.5 of it, before the motion at large has changed the state
/// much.
TEST(StabilityMonitor, FindsTheLimitOfADeformedBody) {
  for (double const stretch : {0.85, 1.0, 1.1}) {
    Assembly still = squeezed(stretch);
    double const limit =
        make_formulation(still)->stable_time_step() / (0.85 * 0.05);  // margin, share of the first step
    auto const growth = [&](double fraction) {
      Assembly shaken = still;
      give_velocity(shaken, [](Point const& X) {
        double const s = std::sin(977 * X[0] + 641 * X[1] * X[1] + 353 * X[2]);
        return Point{1e-6 * s, -1e-6 * std::cos(1231 * s), 1e-6 * std::sin(733 * s)};
      });
      still.cfl = shaken.cfl = 0.3;  // no monitor: the steps are given
      auto const f = make_formulation(still), g = make_formulation(shaken);
      auto const difference = [&] {
        return largest_difference(sample(*f, "Velocity", still.particles.X.size()),
                                  sample(*g, "Velocity", still.particles.X.size()));
      };
      double const before = difference();
      for (int k = 0; k < 25; ++k) {
        f->step(0, fraction * limit);
        g->step(0, fraction * limit);
      }
      still.cfl = nan;
      return difference() / before;
    };
    EXPECT_LT(growth(0.9), 10) << stretch;
    EXPECT_FALSE(growth(1.5) < 1e4) << stretch;  // or not a number any more
  }
}

/// `exact`: rho0 c^2 = the largest second derivative of the energy in a principal stretch, here by differences.
TEST(WaveSpeed, ExactIsTheTangentInThePrincipalDirections) {
  for (auto const* law : {"neo_hookean", "linear_elastic"}) {
    double const l[3] = {0.8, 1.3, 1.1};
    Assembly a = assemble(unit_box(3, 5), rubber(law, 0.4));
    choose(a, "wave_speed", "exact");
    a.cfl = 0.3;
    displace(a, [&](Point const& X) { return Point{(l[0] - 1) * X[0], (l[1] - 1) * X[1], (l[2] - 1) * X[2]}; });
    double modulus = 0;
    with_law(a.materials[0], [&](auto const& material) {
      auto const energy = [&](int c, double change) {
        Mat<3> F = identity<3>();
        for (int k = 0; k < 3; ++k) F(k, k) = l[k] + (k == c ? change : 0);
        return material.energy(F);
      };
      constexpr double d = 1e-4;
      for (int c = 0; c < 3; ++c)
        modulus = std::max(modulus, (energy(c, d) - 2 * energy(c, 0) + energy(c, -d)) / (d * d));
    });
    double const expected = 0.3 * a.particles.bodies[0].spacing[0] / std::sqrt(modulus / 1100);
    EXPECT_NEAR(make_formulation(a)->stable_time_step() / expected, 1, 1e-5) << law;
  }
}

// From 10,000 particles on a lattice gets fewer power iterations: its limit is that of all of them within 1 %.
TEST(StabilityMonitor, MeasuresALargeLatticeAsWell) {
  auto const made = [](int n, double stretch) {
    Assembly a = assemble(unit_box(2, n));
    a.cfl = nan;
    choose(a, "scheme", "conservative");
    if (stretch > 0) displace(a, [&](Point const& X) { return Point{stretch * X[0], 0, 0}; });
    return make_formulation(a);
  };
  auto const large = made(100, 0), small = made(99, 0), strained = made(100, 1e-9);
  double const step = 99 * large->steady_time_step();
  EXPECT_NEAR(step, 98 * small->steady_time_step(), 0.01 * step);
  // One that starts deformed is measured as it starts, too.
  EXPECT_NEAR(step, 99 * strained->steady_time_step(), 0.01 * step);
}

}  // namespace
}  // namespace piola::testing
