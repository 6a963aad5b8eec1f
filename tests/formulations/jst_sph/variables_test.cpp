// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"

/// {p,F,J} and {p,F,H,J}: H and J as unknowns of their own.
namespace piola::testing {
namespace {

Assembly nearly_incompressible(std::string const& scheme, std::string const& variables, double jitter = 0) {
  Assembly a = tumbling_box(3, 6, jitter);
  a.materials.assign(1, rubber("neo_hookean", 0.49));
  choose(a, "scheme", scheme);
  choose(a, "variables", variables);
  return a;
}

/// Velocities after `steps` steps that take 2 ms together.
Values velocities_after(Assembly const& a, int steps) {
  auto const f = make_formulation(a);
  advance(*f, 2e-3 / steps, steps);
  EXPECT_FALSE(f->failure().has_value());
  return sample(*f, "Velocity", a.particles.X.size());
}

/// With Runge-Kutta {p,F}, {p,F,J} and {p,F,H,J} differ by the error in time, which is of second order.
TEST(EvolvedGeometry, DiffersByTheErrorInTimeWithRungeKutta) {
  for (auto const* variables : {"pFJ", "pFHJ"}) {
    auto const difference = [&](int steps) {
      return largest_difference(velocities_after(nearly_incompressible("paper", "pF"), steps),
                                velocities_after(nearly_incompressible("paper", variables), steps));
    };
    double const coarse = difference(100), fine = difference(200);
    EXPECT_GT(coarse, 1e-9) << variables << ": J is not evolved at all";
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3) << variables;
  }
}

/// (51): the stabilisation of J leaves the sum of V J alone.
TEST(EvolvedGeometry, KeepsTheVolumeThatStabilisationSmooths) {
  auto const volume_mismatch = [](double eps4) {
    Assembly a = nearly_incompressible("paper", "pFJ");
    choose(a, "eps4_volume", eps4);
    a.initial_deformation_gradient.clear();
    for (auto const& X : a.particles.X) {
      double const s = 1 + 0.05 * std::sin(7 * X[0]) * std::cos(5 * X[1]);
      a.initial_deformation_gradient.push_back({s, 0, 0, 0, 1, 0, 0, 0, 1});
    }
    auto const f = make_formulation(a);
    f->step(0, 2e-5);
    // Pressure is kappa (J - 1) of the evolved J, so its sum stands for that of J.
    Values const p = sample(*f, "Pressure", a.particles.X.size());
    double sum = 0, most = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      sum += a.particles.volume[i] * p[i];
      most = std::max(most, std::fabs(p[i]));
    }
    return std::pair{sum, most};
  };
  auto const [plain, level] = volume_mismatch(0);
  auto const [smooth, lower] = volume_mismatch(0.125);
  EXPECT_LT(lower, 0.99 * level) << "J is not smoothed";
  EXPECT_NEAR(smooth, plain, 1e-12 * level);
}

/// A volume ratio that stabilisation drives below zero is reported as such.
TEST(EvolvedGeometry, FailsWithAReasonWhenTheVolumeRatioIsLost) {
  Assembly a = nearly_incompressible("paper", "pFJ");
  choose(a, "eps4_volume", 1000);
  a.initial_deformation_gradient.clear();
  for (auto const& X : a.particles.X) {
    double const s = X[0] > 0.4 ? 1.5 : 0.7;
    a.initial_deformation_gradient.push_back({s, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  auto const f = make_formulation(a);
  for (int k = 0; k < 50 && !f->failure(); ++k) f->step(0, 1e-5);
  ASSERT_TRUE(f->failure().has_value());
  EXPECT_NE(f->failure()->what.find("J"), std::string::npos) << f->failure()->what;
}

struct Variant {
  char const* name;
  std::map<std::string, std::string> words;
  std::map<std::string, double> numbers;
};

std::vector<Variant> variants() {
  return {
      {"filtered_pF", {{"scheme", "filtered"}}, {}},
      {"paper_pF", {{"scheme", "paper"}}, {}},
      {"paper_pFJ", {{"scheme", "paper"}, {"variables", "pFJ"}}, {{"eps4_volume", 0.015}}},
      {"paper_pFHJ", {{"scheme", "paper"}, {"variables", "pFHJ"}}, {{"eps4_volume", 0.015}, {"eps2_volume", 0.01}}}};
}

Assembly assembly_of(Variant const& variant, double jitter) {
  Assembly a = nearly_incompressible("filtered", "pF", jitter);
  for (auto const& [key, word] : variant.words) choose(a, key, word);
  for (auto const& [key, number] : variant.numbers) choose(a, key, number);
  return a;
}

class EveryVariant : public ::testing::TestWithParam<Variant> {};

TEST_P(EveryVariant, ResumesBitForBit) {
  for (double const jitter : {0.0, 0.2}) {
    Assembly const a = assembly_of(GetParam(), jitter);
    auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
    auto const take = [](Formulation& f, int n) {
      for (int k = 0; k < n; ++k) f.step(0, f.stable_time_step());
    };
    take(*whole, 120);  // beyond a renewal of the step limit
    take(*first, 60);
    SavedState state = saved(*first);
    second->load(state);
    take(*second, 60);
    EXPECT_EQ(saved(*whole).values, saved(*second).values) << jitter;
  }
}

TEST_P(EveryVariant, GivesTheSameBitsForAnyNumberOfThreads) {
  Assembly a = assembly_of(GetParam(), 0);
  a.particles = unit_box(3, 9);
  a.cfl = 0.3;  // saves measuring the step limit of 729 particles
  give_velocity(a, [](Point const& X) { return Point{20 * X[1] + 8 * X[0] * X[0], -20 * X[0], 6 * X[0] * X[2]}; });
  auto const run = [&](int threads) {
    Threads const count(threads);
    auto const f = make_formulation(a);
    for (int k = 0; k < 5; ++k) f->step(0, f->stable_time_step());
    return saved(*f).values;
  };
  auto const one = run(1);
  for (int const threads : testing::thread_counts) EXPECT_EQ(run(threads), one) << threads;
}

TEST_P(EveryVariant, KeepsRigidMotionFreeOfStress) {
  Assembly a = assembly_of(GetParam(), 0.2);
  give_velocity(a, [](Point const&) { return Point{3, -2, 1}; });
  auto const f = make_formulation(a);
  advance(*f, 1e-5, 50);
  EXPECT_LT(largest(sample(*f, "CauchyStress", a.particles.X.size())), 1e-7 * 17e6);
}

TEST_P(EveryVariant, KeepsMomentum) {
  Assembly const a = assembly_of(GetParam(), 0.2);
  auto const f = make_formulation(a);
  Diagnostics const before = f->diagnose();
  advance(*f, 1e-5, 50);
  Diagnostics const after = f->diagnose();
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(after.linear_momentum[c], before.linear_momentum[c], 1e-9 * 1100);
    EXPECT_NEAR(after.angular_momentum[c], before.angular_momentum[c], 1e-9 * 1100);
  }
}

INSTANTIATE_TEST_SUITE_P(Jst, EveryVariant, ::testing::ValuesIn(variants()),
                         [](auto const& variant) { return std::string(variant.param.name); });

}  // namespace
}  // namespace piola::testing
