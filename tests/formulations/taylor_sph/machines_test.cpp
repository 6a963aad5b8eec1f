// SPDX-License-Identifier: Apache-2.0
// The same step on every instruction set and for any number of threads.
#include "formulations/taylor_sph/taylor_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

/// A body that is held at one side, pulled at another and falls.
Assembly loaded_body(int dimension, int n, double jitter, std::string const& backend) {
  Assembly a = busy_body(dimension, n, jitter);
  support(a, {true, true, true}, [](Point const& X) { return X[0] < 1e-9; });
  Load& pull = load(a, {"1e3*t", "200", "0"}, [](Point const& X) { return X[0] > 1 - 1e-9; });
  pull.normal = std::array<double, 3>{1, 0, 0};
  load(a, {"0", "-9.81", "0"}, everywhere);
  a.backend = backend;
  return a;
}

/// Velocities over their speed and stresses over the modulus: numbers of size 1 and less.
Values end_state(Assembly const& a, int steps) {
  auto const f = make_formulation(a);
  run(*f, steps);
  EXPECT_FALSE(f->failure().has_value());
  auto const n = a.particles.X.size();
  Values all;
  for (auto const& [field, scale] : {std::pair{"Velocity", 1.0}, {"Displacement", 0.1}, {"CauchyStress", 1e4}})
    for (double const v : sample(*f, field, n)) all.push_back(v / scale);
  return all;
}

struct Setting {
  int dimension;
  double jitter;
  std::string configuration, cells;
};

void PrintTo(Setting const& s, std::ostream* out) {
  *out << s.dimension << "D jitter " << s.jitter << " " << s.configuration << " " << s.cells;
}

class EveryTaylorMachine : public ::testing::TestWithParam<Setting> {
 protected:
  Assembly assembly(std::string const& backend) const {
    auto const& s = GetParam();
    Assembly a = loaded_body(s.dimension, s.dimension == 1 ? 21 : s.dimension == 2 ? 9 : 5, s.jitter, backend);
    choose(a, "configuration", s.configuration);
    choose(a, "virtual_particles", s.cells);
    return a;
  }
};

TEST_P(EveryTaylorMachine, GivesTheSameMotion) {
  if (backends().size() < 2) GTEST_SKIP() << "this build has one machine";
  Values const reference = end_state(assembly(backends().back()), 15);
  ASSERT_GT(largest(reference), 0.3);
  for (auto const& backend : backends())
    EXPECT_LT(largest_difference(end_state(assembly(backend), 15), reference), 1e-10) << backend;
}

std::vector<Setting> settings() {
  std::vector<Setting> r;
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (auto const* configuration : {"updated", "fixed"})
      for (double const jitter : {0.0, 0.2}) r.push_back({dimension, jitter, configuration, "delaunay"});
  for (int dimension = 2; dimension <= 3; ++dimension) r.push_back({dimension, 0.0, "updated", "lattice_cells"});
  return r;
}

INSTANTIATE_TEST_SUITE_P(All, EveryTaylorMachine, ::testing::ValuesIn(settings()), [](auto const& p) {
  auto const& s = p.param;
  return std::to_string(s.dimension) + "D_" + (s.jitter > 0 ? "jittered_" : "regular_") + s.configuration + "_" +
         s.cells;
});

/// Bodies large enough for two threads (exec::team_size), compressed until neighbour lists are rebuilt.
class TaylorThreads : public ::testing::TestWithParam<std::tuple<int, std::string>> {};

TEST_P(TaylorThreads, DoNotChangeABit) {
  auto const& [D, backend] = GetParam();
  int const n = D == 1 ? 2201 : D == 2 ? 52 : 15, steps = 2;
  Assembly a = assemble_taylor(unit_box(D, n));
  choose(a, "virtual_particles", D == 3 ? "lattice_cells" : "delaunay");
  a.backend = backend;
  a.cfl = 0.5;
  // Compression changes lengths by 7.5 % in a step.
  double const rate = 0.15 * Moduli(D).speed() * (n - 1);
  give_velocity(a, [&, D = D](Point const& X) {
    double const wave = 1 + 0.2 * std::sin(9 * X[0]);
    return Point{-rate * X[0] * wave, D > 1 ? 0.3 * rate * X[0] * X[0] : 0, D > 2 ? 0.2 * rate * X[1] : 0};
  });
  Values first;
  for (int const threads : testing::thread_counts) {
    Threads const keep(threads);
    auto const f = make_formulation(a);
    ASSERT_EQ(exec::team_size(Range{0, static_cast<Index>(a.particles.X.size())}), threads);
    run(*f, steps);
    EXPECT_GE(more(*f, "list_updates"), 1);
    EXPECT_FALSE(f->failure().has_value());
    if (threads == 1) first = whole_state(*f);
    EXPECT_EQ(whole_state(*f), first) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(All, TaylorThreads,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::ValuesIn(backends())));

TEST(TaylorMachines, AreListedBestFirstAndFoundByName) {
  std::vector<std::string> names;
  for (auto name = taylor_sph::backend_names(); *name != nullptr; ++name) names.push_back(*name);
  EXPECT_EQ(names, backends()) << "the same as those of the other formulations";
  EXPECT_EQ(taylor_sph::find_backend("auto")->name, names.front());
  for (auto const& name : names) EXPECT_EQ(taylor_sph::find_backend(name.c_str())->name, name);
  EXPECT_EQ(taylor_sph::find_backend("abacus"), nullptr);
}

}  // namespace
}  // namespace piola
