// SPDX-License-Identifier: Apache-2.0
// The same step on every instruction set, with every loader, for any number of threads.
#include "formulations/small_bodies.hpp"
#include <cstring>

namespace piola {
namespace {

using namespace testing;

constexpr double dt = 1e-4;
constexpr int steps = 20;

Values end_state(Assembly const& a) {
  auto const f = make_formulation(a);
  advance(*f, dt, steps);
  auto const n = a.particles.X.size();
  Values all = sample(*f, "Velocity", n);
  for (double& v : all) v /= 20;  // m/s, the speed of the motion: all numbers are then of size 1
  for (std::string const field : {"Displacement", "DeformationGradient"}) {
    Values const more = sample(*f, field, n);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

struct Setting {
  int dimension;
  double jitter;
  std::string scheme, variables;
};

class EveryMachine : public ::testing::TestWithParam<Setting> {
 protected:
  Assembly assembly(std::string const& backend) const {
    auto const& s = GetParam();
    Assembly a = tumbling_box(s.dimension, s.dimension == 1 ? 21 : s.dimension == 2 ? 9 : 6, s.jitter);
    choose(a, "scheme", s.scheme);
    choose(a, "variables", s.variables);
    if (s.scheme == "paper") choose(a, "eps2_momentum", 1.0 / 32);
    support(a, {true, true, true}, [](Point const& X) { return X[0] < 1e-9; });
    a.backend = backend;
    return a;
  }
};

TEST_P(EveryMachine, GivesTheSameMotion) {
  if (backends().size() < 2) GTEST_SKIP() << "this build has one machine";
  Values const reference = end_state(assembly(backends().back()));
  ASSERT_GT(largest(reference), 0.5);
  for (auto const& backend : backends())
    EXPECT_LT(largest_difference(end_state(assembly(backend)), reference), 1e-10) << backend;
}

TEST_P(EveryMachine, GivesTheSameBitsForAnyNumberOfThreads) {
  for (auto const& backend : backends()) {
    Values one;
    for (int const threads : testing::thread_counts) {
      Threads const keep(threads);
      Values const more = end_state(assembly(backend));
      if (threads == 1) one = more;
      ASSERT_EQ(one.size(), more.size());
      EXPECT_EQ(std::memcmp(one.data(), more.data(), one.size() * sizeof(double)), 0) << backend << ", " << threads;
    }
  }
}

/// Patterns of a lattice against lists of the same particles: geometry rounds differently, nothing else.
TEST_P(EveryMachine, GivesTheSameMotionWithPatternsAndWithLists) {
  if (GetParam().jitter > 0) GTEST_SKIP() << "irregular bodies always use lists";
  for (auto const& backend : backends()) {
    Assembly a = assembly(backend);
    Values const patterns = end_state(a);
    a.particles.bodies[0].regular = false;
    EXPECT_LT(largest_difference(end_state(a), patterns), 1e-11) << backend;
  }
}

std::vector<Setting> settings() {
  std::vector<Setting> r;
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (double const jitter : {0.0, 0.2})
      for (auto const* scheme : {"filtered", "paper"}) r.push_back({dimension, jitter, scheme, "pF"});
  for (double const jitter : {0.0, 0.2}) r.push_back({3, jitter, "paper", "displacement"});
  return r;
}

INSTANTIATE_TEST_SUITE_P(All, EveryMachine, ::testing::ValuesIn(settings()), [](auto const& p) {
  auto const& s = p.param;
  return std::to_string(s.dimension) + "D_" + (s.jitter > 0 ? "jittered_" : "regular_") + s.scheme + "_" + s.variables;
});

TEST(Machines, AreListedBestFirstAndFoundByName) {
  auto const names = backends();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(jst_sph::find_backend("auto")->name, names.front());
  int lanes = 1 << 10;
  for (auto const& name : names) {
    jst_sph::Backend const* const backend = jst_sph::find_backend(name.c_str());
    ASSERT_NE(backend, nullptr);
    EXPECT_EQ(backend->name, name);
    EXPECT_LE(backend->lanes, lanes);
    lanes = backend->lanes;
  }
  EXPECT_EQ(jst_sph::find_backend("abacus"), nullptr);
}

/// In whichever lane or block it is: steps would else follow from the others.
TEST(Machines, NoticeAWaveSpeedThatIsNotANumber) {
  constexpr Index slots = 192;
  Field speeds("WaveSpeed", "m/s", 1, Role::evolved);
  speeds.allocate(slots, 0);
  for (Index i = 0; i < slots; ++i) speeds.at(i) = 100 + i;
  Values partial(slots);
  jst_sph::BodyState body;
  body.slots = {0, slots};
  body.wave_speed = speeds.ref();
  body.partial = partial.data();
  for (auto const& name : backends()) {
    auto const largest = jst_sph::find_backend(name.c_str())->largest_wave_speed;
    EXPECT_EQ(largest(body), 99 + slots) << name;
    for (Index const at : {0, 5, 63, 64, slots - 1}) {
      speeds.at(at) = std::nan("");
      EXPECT_TRUE(std::isnan(largest(body))) << name << " " << at;
      speeds.at(at) = 100 + at;
    }
  }
}

TEST(Machines, HandAWaveSpeedThatIsNotANumberToTheReportOfFailures) {
  auto const f = make_formulation(tumbling_box(3, 5));
  SavedState state = saved(*f);
  state.values.at("body0_wave_speed")[7] = std::nan("");
  EXPECT_FALSE(f->failure().has_value());
  f->load(state);
  auto const failure = f->failure();
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->particle, 7);
  EXPECT_EQ(failure->what, "has a wave speed that is not a number");
}

TEST(Machines, OfTheSameNameBuildTheSameBitsAgain) {
  Assembly const a = tumbling_box(3, 5);
  EXPECT_EQ(end_state(a), end_state(a));
}

}  // namespace
}  // namespace piola
