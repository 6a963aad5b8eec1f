// SPDX-License-Identifier: Apache-2.0
// Laws of libraries under the nodal formulation.
#include "formulations/copper.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include "support/key_words.hpp"
#include "support/library_laws.hpp"

namespace piola::testing {
namespace {

constexpr double rubber_mu = 17e6 / (2 * 1.45), rubber_kappa = 17e6 / (3 * 0.1);

MaterialParameters own_rubber() { return material_of(example_neo_hookean(), {1100, rubber_mu, rubber_kappa}); }
/// Copper as of metals::copper(), with no hardening: the same law twice.
MaterialParameters own_copper() {
  return material_of(example_voce(), {metals::rho0, metals::E, metals::nu, metals::yield, 0, 0});
}

Assembly tumbling(int dimension, MaterialParameters const& m, double jitter, double speed) {
  Assembly a = nodal_body(brick(dimension, jitter, {5, 5, 6}), m);
  give_velocity(a, [&](Point const& X) {
    return Point{speed * (0.9 * std::sin(2 * X[0]) - 0.4 * X[1]),
                 dimension > 1 ? speed * (0.8 * X[0] * X[1] + 0.4 * X[0]) : 0,
                 dimension > 2 ? 0.6 * speed * X[0] * X[2] : 0};
  });
  return a;
}

std::unique_ptr<Formulation> after_steps(Assembly const& a, int steps, double dt) {
  auto f = make_formulation(a);
  for (int k = 0; k < steps; ++k) f->step(k * dt, dt);
  EXPECT_FALSE(f->failure().has_value());
  return f;
}

double apart(Values const& a, Values const& b) {
  double most = 0, size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    most = std::max(most, std::fabs(a[k] - b[k]));
    size = std::max(size, std::fabs(a[k]));
  }
  return most / size;
}

/// The rubber of the example has the energy of Piola's, but for how cells resist uneven volume changes: laws with a
/// split give them the pressure of the mean volume ratio, which for this law is the same.
TEST(NodalBlockLaw, ElasticLawMovesAsPiolasOwn) {
  for (int const dimension : {1, 2, 3})
    for (double const jitter : {0.0, 0.2}) {
      auto const own = tumbling(dimension, own_rubber(), jitter, 20),
                 ours = tumbling(dimension, rubber("neo_hookean", 0.45), jitter, 20);
      std::size_t const n = own.particles.X.size();
      auto const a = after_steps(own, 100, 2e-5), b = after_steps(ours, 100, 2e-5);
      EXPECT_LT(apart(sample(*a, "Position", n), sample(*b, "Position", n)), 1e-9) << dimension << ' ' << jitter;
      EXPECT_LT(apart(sample(*a, "CauchyStress", n), sample(*b, "CauchyStress", n)), 1e-6) << dimension;
      EXPECT_NEAR(a->diagnose().strain_energy, b->diagnose().strain_energy, 1e-8 * b->diagnose().strain_energy);
    }
}

/// The same metal as a law of the user's and as Piola's: other frames (R against the incremental rotation) and other
/// equations of state (rate form against volume ratio), the same for small elastic strains.
TEST(NodalBlockLaw, MetalYieldsAsPiolasOwn) {
  for (int const dimension : {2, 3}) {
    auto const own = tumbling(dimension, own_copper(), 0.1, 90),
               ours = tumbling(dimension, metals::copper("perfectly_plastic"), 0.1, 90);
    std::size_t const n = own.particles.X.size();
    auto const a = after_steps(own, 200, 2e-6), b = after_steps(ours, 200, 2e-6);
    auto const moved = sample(*b, "Displacement", n);
    EXPECT_GT(*std::max_element(moved.begin(), moved.end()), 0.02);
    EXPECT_LT(apart(sample(*a, "Displacement", n), sample(*b, "Displacement", n)), 0.003) << dimension;
    EXPECT_LT(apart(sample(*a, "VonMisesStress", n), sample(*b, "VonMisesStress", n)), 0.03) << dimension;
  }
}

TEST(NodalBlockLaw, KeepsEnergyAndResumesWithEqualBits) {
  for (auto const& m : {own_rubber(), own_copper()}) {
    auto const a = tumbling(3, m, 0.2, m.value[0] > 2000 ? 90 : 20);
    double const dt = m.value[0] > 2000 ? 2e-6 : 2e-5;
    auto f = make_formulation(a);
    double const start = f->diagnose().kinetic_energy + f->diagnose().strain_energy;
    for (int k = 0; k < 50; ++k) f->step(k * dt, dt);
    SavedState kept = saved(*f);
    auto g = make_formulation(a);
    g->load(kept);
    for (int k = 50; k < 100; ++k) {
      f->step(k * dt, dt);
      g->step(k * dt, dt);
    }
    EXPECT_EQ(saved(*f).values, saved(*g).values);
    double const end = f->diagnose().kinetic_energy + f->diagnose().strain_energy;
    EXPECT_NEAR(end, start, 1e-4 * start);
  }
}

TEST(NodalBlockLaw, OnePartOfABodyMayHaveIt) {
  auto const mixed = [](MaterialParameters const& first, MaterialParameters const& second) {
    Assembly a = tumbling(3, first, 0.2, 20);
    a.parts = {{second}};
    auto& part = a.particles.part.own();
    for (auto const& X : a.particles.X.seen()) part.push_back(X[0] > 0.2 ? 1 : 0);
    return after_steps(a, 60, 2e-5);
  };
  auto const a = mixed(own_rubber(), rubber("neo_hookean", 0.45)), b = mixed(rubber("neo_hookean", 0.45), own_rubber());
  EXPECT_LT(apart(sample(*a, "Position", 150), sample(*b, "Position", 150)), 1e-9);
  Assembly refused = tumbling(3, own_rubber(), 0, 20);
  refused.parts = {{metals::copper()}};
  refused.particles.part.own().assign(refused.particles.X.size(), 0);
  EXPECT_TRUE(test::mentions(refusal(refused), {"blocks of points", "rate form", "tie"}));
}

int fails_in_tension(piola_points const* at) {
  int const code = example_neo_hookean().update(at);
  for (int p = 0; p < at->count; ++p)
    if (at->F_new[p] > 1.05) return 7;
  return code;
}
int not_a_number(piola_points const* at) {
  int const code = example_neo_hookean().update(at);
  for (int p = 0; p < at->count; ++p)
    if (at->F_new[p] > 1.05) at->stress[p] = NAN;
  return code;
}

TEST(NodalBlockLaw, FailureOfTheLawIsTold) {
  for (auto const& [update, words] :
       {std::pair{&fails_in_tension, "code 7"}, std::pair{&not_a_number, "not a number"}}) {
    static std::array<piola_material, 2> wrong;
    piola_material& law = wrong[update == &not_a_number];
    law = example_neo_hookean();
    law.update = update;
    auto f = make_formulation(tumbling(3, material_of(law, {1100, rubber_mu, rubber_kappa}), 0, 60));
    for (int k = 0; k < 400 && !f->failure(); ++k) f->step(k * 2e-5, 2e-5);
    ASSERT_TRUE(f->failure().has_value());
    EXPECT_NE(f->failure()->what.find(words), std::string::npos) << f->failure()->what;
  }
}

}  // namespace
}  // namespace piola::testing
