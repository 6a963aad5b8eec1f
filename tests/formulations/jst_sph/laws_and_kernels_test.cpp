// SPDX-License-Identifier: Apache-2.0
// Every registered hyperelastic law and every kernel in whole steps of JST-SPH. The lists follow the registries.
#include "piola/kernels/registry.hpp"
#include "piola/materials/laws.hpp"
#include "formulations/small_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

std::string name_of(std::string_view text) { return std::string(text); }

class EveryLaw : public ::testing::TestWithParam<LawInfo> {
 protected:
  /// Laws of small strain get a hundredth of the motion.
  Assembly tumbling(std::string const& variables) const {
    Assembly a = tumbling_box(3, 6);
    a.materials.assign(1, rubber(GetParam().name));
    choose(a, "scheme", variables == "pF" ? "filtered" : "paper");
    choose(a, "variables", variables);
    if (GetParam().name == "linear_elastic")
      for (auto& v : a.initial_velocity)
        for (double& c : v) c *= 0.01;
    return a;
  }
};

TEST_P(EveryLaw, GivesTheSameMotionOnEveryMachine) {
  if (backends().size() < 2) GTEST_SKIP() << "this build has one machine";
  for (auto const* variables : {"pF", "pFHJ"}) {
    Assembly a = tumbling(variables);
    Values reference;
    for (std::string const& backend : {backends().back(), std::string("auto")}) {
      a.backend = backend;
      auto const f = make_formulation(a);
      advance(*f, 5e-5, 40);
      EXPECT_FALSE(f->failure().has_value());
      Values const v = sample(*f, "Velocity", a.particles.X.size());
      if (reference.empty()) reference = v;
      ASSERT_GT(largest(v), 0.01);
      EXPECT_LT(largest_difference(v, reference), 1e-10 * largest(v)) << variables;
    }
  }
}

/// Without stabilisation and projection the energy error is of second order in the step, or better. Below 1e-7 terms of
/// higher orders cancel, and there is no order to see.
TEST_P(EveryLaw, KeepsTheEnergyThatItStores) {
  for (auto const* variables : {"pF", "pFJ", "pFHJ"}) {
    Assembly a = tumbling(variables);
    choose(a, "eps4_momentum", 0.0);
    choose(a, "angular_momentum_projection", "off");
    auto const error = [&](int steps) {
      auto const f = make_formulation(a);
      double const before = f->diagnose().kinetic_energy + f->diagnose().strain_energy;
      advance(*f, 4e-3 / steps, steps);
      auto const d = f->diagnose();
      EXPECT_GT(d.strain_energy, 0.02 * before) << "nothing was exchanged";
      return std::fabs(d.kinetic_energy + d.strain_energy - before) / before;
    };
    double const fine = error(320);
    EXPECT_LT(fine, 2e-4) << variables;
    EXPECT_LT(fine, std::max(0.35 * error(160), 1e-7)) << variables;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryLaw, ::testing::ValuesIn(laws().first(Laws::size)),
                         [](auto const& p) { return name_of(p.param.name); });

class EveryKernel : public ::testing::TestWithParam<Kernel> {
 protected:
  Assembly with_kernel(Assembly a, std::string const& scheme) const {
    choose(a, "scheme", scheme);
    choose(a, "kernel", std::string(GetParam().name));
    return a;
  }
};

/// The gradient of a linear velocity is exact and its Laplacian vanishes, whatever the kernel.
TEST_P(EveryKernel, DeformsUniformlyWithALinearVelocity) {
  for (int const dimension : {1, 2, 3})
    for (double const jitter : {0.0, 0.2})
      for (auto const* scheme : {"filtered", "paper"}) {
        Assembly a = with_kernel(assemble(unit_box(dimension, 7, jitter)), scheme);
        double const dt = 1e-3;
        give_velocity(a, [&](Point const& X) {
          return Point{30 * X[0] - 20 * X[1], dimension > 1 ? 25 * X[0] : 0, dimension > 2 ? 40 * X[2] : 0};
        });
        auto const f = make_formulation(a);
        f->step(0, dt);
        Values const F = sample(*f, "DeformationGradient", a.particles.X.size());
        double const expected[9] = {1.03, dimension > 1 ? -0.02 : 0, 0, dimension > 1 ? 0.025 : 0, 1, 0, 0,
                                    0,    dimension > 2 ? 1.04 : 1};
        for (std::size_t k = 0; k < F.size(); ++k) ASSERT_NEAR(F[k], expected[k % 9], 1e-11) << dimension << scheme;
      }
}

/// Kernels differ by the error in space alone: bodies of 9 particles a side move alike.
TEST_P(EveryKernel, TumblesAsWithTheCubicSpline) {
  for (auto const* scheme : {"filtered", "paper"}) {
    auto const run = [&](Assembly const& a) {
      auto const f = make_formulation(a);
      double time = 0;
      for (int k = 0; time < 4e-3 && k < 4000; ++k) {
        double const dt = std::min(f->stable_time_step(), 4e-3 - time);
        f->step(time, dt);
        time += dt;
        if (4e-3 - time < 1e-12) break;
      }
      EXPECT_FALSE(f->failure().has_value()) << scheme;
      auto const d = f->diagnose();
      EXPECT_TRUE(std::isfinite(d.kinetic_energy + d.strain_energy));
      return sample(*f, "Displacement", a.particles.X.size());
    };
    Assembly a = tumbling_box(3, 9);
    choose(a, "scheme", scheme);
    Values const cubic = run(a), found = run(with_kernel(a, scheme));
    EXPECT_LT(largest_difference(cubic, found), 0.1 * largest(cubic)) << scheme;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryKernel, ::testing::ValuesIn(kernels().begin(), kernels().end()),
                         [](auto const& p) { return name_of(p.param.name); });

}  // namespace
}  // namespace piola
