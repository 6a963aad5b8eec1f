// SPDX-License-Identifier: Apache-2.0
// The forces of one step of a random cloud: balances of momentum, energy and angular momentum, and linear fields.
#include "piola/kernels/list.hpp"
#include "formulations/adaptle/clouds.hpp"

namespace piola {
namespace {

using namespace testing;

struct Balance {
  double force = 0, power = 0, torque = 0;  ///< sums over the sums of absolute values
};

Balance balance_of(Cloud const& cloud) {
  double force[3]{}, torque[3]{}, power = 0, forces = 0, powers = 0, torques = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    Sums const sums = cloud.sums(i);
    Half const half = cloud.half(i);
    double const *F = sums.force, *v = half.v;
    Components const x = cloud.state[i].x;
    double work = cloud.state[i].energy_rate + sums.hourglass;
    for (int c = 0; c < 3; ++c) {
      int const a = (c + 1) % 3, b = (c + 2) % 3;
      force[c] += F[c];
      torque[c] += x[a] * F[b] - x[b] * F[a];
      work += F[c] * v[c];
    }
    power += work;
    double const strength = std::hypot(F[0], F[1], F[2]);
    forces += strength;
    powers += strength * std::hypot(v[0], v[1], v[2]);
    torques += strength * std::hypot(x[0], x[1], x[2]);
  }
  return {std::hypot(force[0], force[1], force[2]) / forces, std::fabs(power) / powers,
          std::hypot(torque[0], torque[1], torque[2]) / torques};
}

/// How descriptions are given to the particles of a cloud.
enum class Mixture { eulerian, lagrangian, halves, blended };

struct Kind {
  int dimension;
  Mixture mixture;
  std::string correction;
  std::string backend;
  /// Whether linear fields have exact gradients.
  bool exact() const { return correction == "mixed" || (correction == "material" && mixture == Mixture::lagrangian); }
  friend std::ostream& operator<<(std::ostream& out, Kind const& k) {
    constexpr std::array names{"eulerian", "lagrangian", "halves", "blended"};
    return out << k.dimension << "D " << names[static_cast<std::size_t>(k.mixture)] << " " << k.correction << " "
               << k.backend;
  }
};

/// A cloud before its state is random.
Assembly cloud_assembly(Kind const& k) {
  Assembly a = adaptle_assembly(unit_box(k.dimension, k.dimension == 2 ? 14 : 8, 0.15));
  a.backend = k.backend;
  choose(a, "smoothing_length", 1.4);
  choose(a, "correction", k.correction);
  choose(a, "correction_limit", 1e30);
  choose(a, "artificial_stress", 0.3);
  choose(a, "description",
         k.mixture == Mixture::eulerian     ? "eulerian"
         : k.mixture == Mixture::lagrangian ? "total_lagrangian"
                                            : "patch");
  if (k.mixture == Mixture::halves || k.mixture == Mixture::blended) choose_formula(a, "eulerian_where", "X + Y < 1");
  choose(a, "blend", 0.0);
  return a;
}

void make_random(Cloud& cloud, Kind const& k) {
  Random random(3);
  for (Index i = 0; i < cloud.size(); ++i)
    if (k.mixture == Mixture::blended && cloud.state[i].phi > 0) cloud.state[i].phi = random.in(0.05, 1);
  shake_up(cloud, k.dimension, k.dimension == 2 ? 0.006 : 0.01);
}

class AdaptleBalance : public ::testing::TestWithParam<Kind> {};

TEST_P(AdaptleBalance, MomentumAndEnergyCloseWithViscosityAndArtificialStress) {
  Cloud cloud(cloud_assembly(GetParam()));
  make_random(cloud, GetParam());
  cloud.evaluate();
  ASSERT_EQ(cloud.particles->failure().index, FailureSlot::none);
  Balance const b = balance_of(cloud);
  EXPECT_LT(b.force, 1e-14);
  EXPECT_LT(b.power, 1e-14);
}

TEST_P(AdaptleBalance, ViscosityAndArtificialStressAreThere) {
  Assembly a = cloud_assembly(GetParam());
  choose(a, "artificial_stress", 0.0);
  choose(a, "hourglass", 0.0);
  auto const forces_of = [&] {
    Cloud cloud(a);
    make_random(cloud, GetParam());
    cloud.evaluate();
    std::pair<Values, double> r;
    for (Index i = 0; i < cloud.size(); ++i) {
      Sums const sums = cloud.sums(i);
      r.first.insert(r.first.end(), sums.force, sums.force + GetParam().dimension);
      r.second += sums.heat;
    }
    return r;
  };
  auto const with = forces_of();
  EXPECT_GT(with.second, 0);  // without artificial stress, viscosity heats
  choose(a, "alpha", 0.0);
  choose(a, "beta", 0.0);
  auto const without = forces_of();
  EXPECT_EQ(without.second, 0);
  EXPECT_GT(largest_difference(with.first, without.first), 0.01 * largest(with.first));
  choose(a, "artificial_stress", 0.3);
  double const change = largest_difference(forces_of().first, without.first);
  if (GetParam().mixture == Mixture::lagrangian)
    EXPECT_EQ(change, 0);
  else
    EXPECT_GT(change, 0.01 * largest(without.first));
}

/// Where artificial stress lets particles go that are pulled apart it gives back: the book of the viscosity must not
/// see it.
TEST_P(AdaptleBalance, ViscosityAndArtificialStressHaveBooksOfTheirOwn) {
  double viscous[2], artificial[2], work = 0;
  for (int const k : {0, 1}) {
    Assembly a = cloud_assembly(GetParam());
    choose(a, "artificial_stress", 0.3 * k);
    Cloud cloud(a);
    make_random(cloud, GetParam());
    cloud.evaluate();
    viscous[k] = 1e25 * cloud.particles->energy_totals().viscous_loss;  // a step takes 1e-25 s
    artificial[k] = 1e25 * cloud.particles->energy_totals().artificial_work;
    double heat = 0;
    for (Index i = 0; i < cloud.size(); ++i) {
      heat += cloud.sums(i).heat;
      for (int c = 0; c < 3; ++c) work += (1 - 2 * k) * cloud.sums(i).force[c] * cloud.half(i).v[c];
    }
    EXPECT_NEAR(viscous[k] + artificial[k], heat, 1e-12 * viscous[k]);
  }
  EXPECT_GT(viscous[0], 0);
  EXPECT_NEAR(viscous[1], viscous[0], 1e-12 * viscous[0]);
  EXPECT_EQ(artificial[0], 0);
  EXPECT_NEAR(artificial[1], work, 1e-10 * viscous[0]);  // a difference of all forces with and without it
  EXPECT_EQ(artificial[1] != 0, GetParam().mixture != Mixture::lagrangian);
}

TEST_P(AdaptleBalance, StressForcesHaveNoTorqueWithTheCorrection) {
  Assembly a = cloud_assembly(GetParam());
  for (std::string const key : {"alpha", "beta", "artificial_stress", "hourglass"}) choose(a, key, 0.0);
  Cloud cloud(a);
  make_random(cloud, GetParam());
  cloud.evaluate();
  double const torque = balance_of(cloud).torque;
  if (GetParam().exact())
    EXPECT_LT(torque, 1e-14);
  else
    EXPECT_GT(torque, 1e-7);  // the test can fail
}

TEST_P(AdaptleBalance, LinearVelocitiesHaveExactGradientsWithTheCorrection) {
  Cloud cloud(cloud_assembly(GetParam()));
  make_random(cloud, GetParam());
  Mat<3> A{{30, -70, 20, 50, 10, -40, 60, 80, -20}};
  if (GetParam().dimension == 2) A = {{30, -70, 0, 50, 10, 0, 0, 0, 0}};
  for (Index i = 0; i < cloud.size(); ++i)
    for (int p = 0; p < 3; ++p) {
      cloud.state[i].v[p] = 5;
      for (int q = 0; q < 3; ++q) cloud.state[i].v[p] += A(p, q) * cloud.state[i].x[q];
    }
  cloud.evaluate();
  double worst = 0;
  for (Index i = 0; i < cloud.size(); ++i) worst = std::fmax(worst, size(cloud.velocity_gradient(i) - A));
  if (GetParam().exact()) {
    EXPECT_LT(worst, 1e-12 * size(A));
  } else if (GetParam().mixture != Mixture::lagrangian) {  // there L F = Fdot whatever the gradients are
    EXPECT_GT(worst, 1e-3 * size(A));
  }
}

TEST_P(AdaptleBalance, ThePrintedViscosityKeepsMomentumAndEnergy) {
  Assembly a = cloud_assembly(GetParam());
  choose(a, "viscosity_form", "published");
  Cloud cloud(a);
  make_random(cloud, GetParam());
  cloud.evaluate();
  EXPECT_LT(balance_of(cloud).force, 1e-14);
  EXPECT_LT(balance_of(cloud).power, 1e-14);
}

/// Viscosity along the line of centres has no torque; that of set (2) has.
TEST(AdaptleBalances, CentralViscosityHasNoTorque) {
  for (int const dimension : {2, 3})
    for (auto const& backend : adaptle_machines()) {
      Kind const k{dimension, Mixture::lagrangian, "material", backend};
      Assembly a = cloud_assembly(k);
      choose(a, "hourglass", 0.0);
      for (std::string const form : {"central", "published"}) {
        choose(a, "viscosity_form", form);
        Cloud cloud(a);
        make_random(cloud, k);
        cloud.evaluate();
        if (form == "central")
          EXPECT_LT(balance_of(cloud).torque, 1e-14);
        else
          EXPECT_GT(balance_of(cloud).torque, 1e-7);
      }
    }
}

/// Without deformation and correction both forms of the viscosity are one, and so are stress and damping.
TEST(AdaptleBalances, BothFormsOfTheViscosityAgreeWithoutDeformation) {
  for (int const dimension : {2, 3}) {
    Kind const k{dimension, Mixture::lagrangian, "none", "auto"};
    Assembly a = cloud_assembly(k);
    choose(a, "hourglass", 0.2);
    std::map<std::string, std::array<Values, 3>> of;
    for (std::string const form : {"central", "published"}) {
      choose(a, "viscosity_form", form);
      Cloud cloud(a);
      Random random(11);
      for (Index i = 0; i < cloud.size(); ++i)
        for (int c = 0; c < dimension; ++c) {
          cloud.state[i].v[c] = random.in(-100, 100);
          cloud.state[i].S[c] = random.in(-1e8, 1e8);
        }
      cloud.evaluate();
      double heat = 0;
      for (Index i = 0; i < cloud.size(); ++i) {
        Values& force = of[form][0];
        Sums const sums = cloud.sums(i);
        force.insert(force.end(), sums.force, sums.force + dimension);
        of[form][1].push_back(sums.compression);
        heat += sums.heat;
      }
      of[form][2] = {heat};  // each particle's share of the damping differs, the sum does not
    }
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_LT(largest_difference(of["central"][n], of["published"][n]), 1e-12 * largest(of["central"][n]));
  }
}

std::vector<Kind> kinds() {
  std::vector<Kind> r;
  for (int const dimension : {2, 3})
    for (Mixture const m : {Mixture::eulerian, Mixture::lagrangian, Mixture::halves, Mixture::blended})
      for (std::string const correction : {"none", "material", "mixed"})
        for (auto const& backend : adaptle_machines()) r.push_back({dimension, m, correction, backend});
  return r;
}
INSTANTIATE_TEST_SUITE_P(All, AdaptleBalance, ::testing::ValuesIn(kinds()));

TEST(AdaptleBalances, ThePrintedInterfaceKeepsNeitherMomentumNorEnergy) {
  for (int const dimension : {2, 3}) {
    Kind const k{dimension, Mixture::halves, "mixed", "auto"};
    Assembly a = cloud_assembly(k);
    choose(a, "interface", "published");
    Cloud cloud(a);
    make_random(cloud, k);
    cloud.evaluate();
    Balance const b = balance_of(cloud);
    EXPECT_GT(b.force, 1e-4);
    EXPECT_GT(b.power, 1e-5);
  }
}

TEST(AdaptleBalances, ThePrintedInterfaceKeepsThemWithOneDescription) {
  for (Mixture const m : {Mixture::eulerian, Mixture::lagrangian}) {
    Kind const k{2, m, "mixed", "auto"};
    Assembly a = cloud_assembly(k);
    choose(a, "interface", "published");
    Cloud cloud(a);
    make_random(cloud, k);
    cloud.evaluate();
    EXPECT_LT(balance_of(cloud).force, 1e-14);
    EXPECT_LT(balance_of(cloud).power, 1e-14);
  }
}

TEST(AdaptleBalances, ThePrintedInterfaceHasExactGradientsToo) {
  Kind const k{2, Mixture::halves, "mixed", "auto"};
  Assembly a = cloud_assembly(k);
  choose(a, "interface", "published");
  Cloud cloud(a);
  make_random(cloud, k);
  for (Index i = 0; i < cloud.size(); ++i) {
    cloud.state[i].v[0] = 40 * cloud.state[i].x[1];
    cloud.state[i].v[1] = 10 * cloud.state[i].x[1];
  }
  cloud.evaluate();
  Mat<3> const A{{0, 40, 0, 0, 10, 0, 0, 0, 0}};
  for (Index i = 0; i < cloud.size(); ++i) EXPECT_LT(size(cloud.velocity_gradient(i) - A), 1e-11);
}

TEST(AdaptleBalances, HoldWithEveryKernel) {
  for (std::string_view const kernel : LaneKernels::names)
    for (Mixture const m : {Mixture::eulerian, Mixture::lagrangian, Mixture::halves})
      for (std::string const correction : {"material", "mixed"}) {
        Kind const k{2, m, correction, "auto"};
        Assembly a = cloud_assembly(k);
        choose(a, "kernel", std::string(kernel));
        Cloud cloud(a);
        make_random(cloud, k);
        cloud.evaluate();
        EXPECT_LT(balance_of(cloud).force, 1e-14) << kernel << " " << k;
        EXPECT_LT(balance_of(cloud).power, 1e-14) << kernel << " " << k;
      }
}

TEST(AdaptleBalances, LinearDeformationIsExactWithEveryKernel) {
  double first_correction = 0;
  for (std::string_view const kernel : LaneKernels::names) {
    Assembly a = cloud_assembly({2, Mixture::lagrangian, "material", "auto"});
    choose(a, "kernel", std::string(kernel));
    Cloud cloud(a);
    for (Index i = 0; i < cloud.size(); ++i) {
      Point const X = cloud.X(i);
      cloud.state[i].x[0] = 1.1 * X[0] + 0.2 * X[1];
      cloud.state[i].x[1] = 0.9 * X[1] - 0.1 * X[0];
    }
    cloud.evaluate();
    double const expected[9]{1.1, 0.2, 0, -0.1, 0.9, 0, 0, 0, 1};
    for (Index i = 0; i < cloud.size(); ++i)
      for (int c = 0; c < 9; ++c) EXPECT_NEAR(cloud.deformation(i).F[c], expected[c], 1e-12) << kernel;
    double const correction = value_at(cloud.system().field.K, cloud.size() / 2);
    EXPECT_NE(correction, first_correction) << "kernels differ";
    first_correction = correction;
  }
}

TEST(AdaptleBalances, RiemannFluxesKeepMomentumAndEnergy) {
  for (int const dimension : {2, 3})
    for (auto const& backend : adaptle_machines()) {
      Kind const k{dimension, Mixture::eulerian, "none", backend};
      Assembly a = cloud_assembly(k);
      choose(a, "viscosity", "riemann");
      Cloud cloud(a);
      make_random(cloud, k);
      cloud.evaluate();
      EXPECT_LT(balance_of(cloud).force, 1e-14);
      EXPECT_LT(balance_of(cloud).power, 1e-14);
    }
}

TEST(AdaptleBalances, EachSwitchOfTheViscosityKeepsMomentumAndEnergy) {
  for (std::string const switched : {"balsara", "morris_monaghan"}) {
    Kind const k{3, Mixture::halves, "mixed", "auto"};
    Assembly a = cloud_assembly(k);
    choose(a, "viscosity", switched);
    Cloud cloud(a);
    make_random(cloud, k);
    cloud.evaluate();
    EXPECT_LT(balance_of(cloud).force, 1e-14);
    EXPECT_LT(balance_of(cloud).power, 1e-14);
  }
}

TEST(AdaptleBalances, ArtificialStressOnOneSideAloneLosesMomentum) {
  Kind const k{2, Mixture::halves, "none", "auto"};
  for (std::string const side : {"both", "eulerian_only", "none"}) {
    Assembly a = cloud_assembly(k);
    choose(a, "artificial_stress_interface", side);
    Cloud cloud(a);
    make_random(cloud, k);
    cloud.evaluate();
    if (side == "eulerian_only")
      EXPECT_GT(balance_of(cloud).force, 1e-5);
    else
      EXPECT_LT(balance_of(cloud).force, 1e-14);
  }
}

/// Without correction, a lattice far from its surface sees a linear field through sum_b V s x^2.
TEST(AdaptleBalances, PlainGradientsInsideALatticeHaveTheErrorOfTheKernelSum) {
  constexpr int n = 13;
  for (bool const lagrangian : {false, true}) {
    Assembly a = adaptle_assembly(unit_box(2, n));
    choose(a, "description", lagrangian ? "total_lagrangian" : "eulerian");
    choose(a, "smoothing_length", 1.4);
    choose(a, "correction", "none");
    give_velocity(a, [](Point const& X) { return Point{20 * X[0] - 30 * X[1], 40 * X[0] + 10 * X[1], 0}; });
    Cloud cloud(a);
    cloud.evaluate();
    // In units of the spacing: W = 10/(7 pi h^2) w(r/h), V = 1.
    double const h = 1.4;
    double factor = 0;
    for (int i = -3; i <= 3; ++i)
      for (int j = -3; j <= 3; ++j) {
        double const r = std::hypot(i, j), q = r / h;
        double const slope = q < 1 ? -3 * q + 2.25 * q * q : (q < 2 ? -0.75 * (2 - q) * (2 - q) : 0);
        if (r > 0) factor += -10 / (7 * std::numbers::pi * h * h) * slope / h * i * i / r;
      }
    ASSERT_GT(std::fabs(factor - 1), 1e-4);
    Mat<3> const L = cloud.velocity_gradient(n * n / 2);
    // F is the identity: displacements are zero.
    EXPECT_NEAR(L(0, 0), 20 * factor, 1e-11);
    EXPECT_NEAR(L(0, 1), -30 * factor, 1e-11);
    EXPECT_NEAR(L(1, 0), 40 * factor, 1e-11);
    EXPECT_NEAR(L(1, 1), 10 * factor, 1e-11);
  }
}

class AdaptleLinear : public ::testing::TestWithParam<std::string> {};

TEST_P(AdaptleLinear, DisplacementsHaveExactDeformationGradients) {
  for (int const dimension : {2, 3}) {
    Mat<3> F{{1.1, 0.2, -0.1, -0.05, 0.9, 0.15, 0.08, -0.12, 1.05}};
    if (dimension == 2) F = {{1.1, 0.2, 0, -0.05, 0.9, 0, 0, 0, 1}};
    Assembly a = adaptle_assembly(unit_box(dimension, 7, 0.2));
    choose(a, "description", "total_lagrangian");
    choose(a, "correction", GetParam());
    displace(a, [&](Point const& X) {
      Vec<3> const x = F * Vec<3>{{X[0], X[1], X[2]}};
      return Point{x[0] - X[0], x[1] - X[1], x[2] - X[2]};
    });
    Cloud cloud(a);
    cloud.evaluate();
    double const J = determinant(F), rho0 = 2870, K = 70e9 / (3 * (1 - 2 * 0.33));
    for (Index i = 0; i < cloud.size(); ++i) {
      for (int c = 0; c < 9; ++c) EXPECT_NEAR(cloud.deformation(i).F[c], F.c[c], 1e-12);
      EXPECT_NEAR(cloud.half(i).rho, rho0 / J, 1e-11 * rho0);
      EXPECT_NEAR(cloud.half(i).pressure, K * (1 / J - 1), 1e-11 * K);
      // In rate form a displacement at the start has no deviator; the rate of the first evaluation is round-off.
      EXPECT_NEAR(cloud.half(i).S[3], 0, 1e-20);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Corrected, AdaptleLinear, ::testing::Values("material", "mixed"));

}  // namespace
}  // namespace piola
