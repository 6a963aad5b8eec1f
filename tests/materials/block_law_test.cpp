// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block_law.hpp"
#include "piola/math/polar.hpp"
#include "piola/verification/block_law_battery.hpp"
#include "support/library_laws.hpp"
#include <atomic>
#include <gtest/gtest.h>
#include <list>

namespace piola::testing {
namespace {

constexpr double rho0 = 7800, E = 200e9, nu = 0.3, mu = E / (2 * (1 + nu)), kappa = E / (3 * (1 - 2 * nu));

MaterialParameters steel() { return material_of(example_voce(), {rho0, E, nu, 300e6, 200e6, 10}); }

TEST(BlockLaw, FindsTheModuliAtRest) {
  for (auto const& m : {steel(), material_of(example_neo_hookean(), {rho0, mu, kappa})}) {
    BlockLaw const law(m);
    EXPECT_NEAR(law.mu, mu, 1e-5 * mu);
    EXPECT_NEAR(law.kappa, kappa, 1e-5 * kappa);
    EXPECT_NEAR(law.p_wave_speed(), std::sqrt((kappa + 4 * mu / 3) / rho0), 0.1);
    EXPECT_TRUE(problem_of_block_law(m).empty());
  }
}

TEST(BlockLaw, SaysThatModuliAreNotPositive) {
  auto const problem = problem_of_block_law(material_of(example_neo_hookean(), {rho0, -mu, kappa}));
  EXPECT_NE(problem.find("shear modulus"), std::string::npos) << problem;
}

TEST(BlockLaw, PassesTheBattery) {
  for (auto const& m : {steel(), material_of(example_neo_hookean(), {rho0, mu, kappa})})
    for (LawCheck const& check : check_block_law(m)) EXPECT_TRUE(check.passed()) << check.what << ": " << check.value;
}

/// Laws with an error each, and the words of the check that finds it.
int not_objective(piola_points const* at) {
  for (int p = 0; p < at->count; ++p)
    for (int c = 0; c < 9; ++c) at->stress[c * at->stride + p] = 1e9 * (at->F_new[c * at->stride + p] - (c % 4 == 0));
  return 0;
}
int beyond_its_arrays(piola_points const* at) {
  at->energy[at->stride] = 1;
  return example_neo_hookean().update(at);
}
int wrong_energy(piola_points const* at) {
  int const code = example_neo_hookean().update(at);
  for (int p = 0; p < at->count; ++p) at->energy[p] *= 1.001;
  return code;
}
int with_memory(piola_points const* at) {
  static std::atomic<int> calls{0};
  int const code = example_neo_hookean().update(at);
  at->stress[0] *= 1 + 1e-9 * calls++;
  return code;
}

TEST(BlockLaw, BatteryFindsErrors) {
  struct Wrong {
    int (*update)(piola_points const*);
    char const* found;
  };
  for (Wrong const& wrong : {Wrong{not_objective, "objective"}, Wrong{beyond_its_arrays, "within its arrays"},
                             Wrong{wrong_energy, "derivative of its energy"}, Wrong{with_memory, "twice"}}) {
    static std::list<piola_material> laws;
    piola_material& law = laws.emplace_back(example_neo_hookean());
    law.update = wrong.update;
    std::string failed;
    for (LawCheck const& check : check_block_law(material_of(law, {rho0, mu, kappa})))
      if (!check.passed()) failed += check.what + "\n";
    EXPECT_NE(failed.find(wrong.found), std::string::npos) << wrong.found << " is not in:\n" << failed;
  }
}

TEST(Polar, DecomposesGradientsUpToLargeStretch) {
  Mat<3> R;  // a turn of 120 degrees about (1, 1, 1)
  R(0, 2) = R(1, 0) = R(2, 1) = 1;
  for (double const stretch : {1.0, 1.001, 3.0, 1e3, 1e-3}) {
    Mat<3> U = identity<3>();
    U(0, 0) = stretch;
    U(0, 1) = U(1, 0) = 0.2 * std::min(1.0, stretch);
    Mat<3> const F = R * U, found = rotation_of(F);
    SymMat<3> const again = stretch_of(found, F);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(found(i, j), R(i, j), 1e-12) << stretch;
        EXPECT_NEAR(again(i, j), U(i, j), 1e-12 * std::max(1.0, stretch)) << stretch;
      }
  }
}

}  // namespace
}  // namespace piola::testing
