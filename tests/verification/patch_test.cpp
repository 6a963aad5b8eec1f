// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"
#include "math/random.hpp"

namespace piola {
namespace {

using namespace testing;

class PatchTest : public ::testing::TestWithParam<std::tuple<int, double, std::string, std::string>> {
 protected:
  int const dimension = std::get<0>(GetParam());
  Assembly assembly(int n) const {
    Assembly a = assemble(unit_box(dimension, n, std::get<1>(GetParam())));
    choose(a, "scheme", std::get<2>(GetParam()));
    a.backend = std::get<3>(GetParam());
    return a;
  }
  /// G without the components that the dimension lacks.
  Mat<3> gradient(double scale) const {
    Mat<3> G{{0.3, -0.2, 0.1, 0.25, -0.15, 0.05, -0.1, 0.2, 0.4}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) G(i, j) *= i < dimension && j < dimension ? scale : 0;
    return G;
  }
};

Point times(Mat<3> const& G, Point const& X) {
  Vec<3> const v = G * Vec<3>{{X[0], X[1], X[2]}};
  return {v[0], v[1], v[2]};
}

/// A linear velocity is differentiated exactly, and its Laplacian vanishes: after one step from F = I, where there is
/// no stress yet, F = I + dt G to round-off.
TEST_P(PatchTest, WithALinearVelocityDeformsUniformlyInOneStep) {
  Assembly a = assembly(6);
  Mat<3> const G = gradient(100);
  give_velocity(a, [&](Point const& X) { return times(G, X); });
  auto const f = make_formulation(a);
  double const dt = 1e-3;
  f->step(0, dt);
  Values const F = sample(*f, "DeformationGradient", a.particles.X.size());
  Mat<3> const expected = identity<3>() + dt * G;
  for (std::size_t k = 0; k < a.particles.X.size(); ++k)
    for (std::size_t c = 0; c < 9; ++c) EXPECT_NEAR(F[9 * k + c], expected.c[c], 1e-12);
  EXPECT_NEAR(f->diagnose().stabilisation_loss, 0, 1e-9 * f->diagnose().kinetic_energy);
}

TEST_P(PatchTest, WithALinearDisplacementHasTheStressOfTheLaw) {
  Assembly a = assembly(6);
  Mat<3> const G = gradient(0.5);
  displace(a, [&](Point const& X) { return times(G, X); });
  auto const f = make_formulation(a);
  auto const n = a.particles.X.size();
  Mat<3> const F = identity<3>() + G;
  Values const found = sample(*f, "DeformationGradient", n), J = sample(*f, "Jacobian", n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t c = 0; c < 9; ++c) EXPECT_NEAR(found[9 * k + c], F.c[c], 1e-12);
    EXPECT_NEAR(J[k], determinant(F), 1e-12);
  }
}

/// Under uniform stress there is no force inside a regular body. Near its faces there is: the traction that is missing.
TEST_P(PatchTest, WithUniformStressAcceleratesTheSurfaceOnly) {
  if (std::get<1>(GetParam()) > 0) GTEST_SKIP() << "on irregular particles the force is balanced in the mean only";
  int const n = 10;
  Assembly a = assembly(n);
  choose(a, "eps4_momentum", 0.0);
  Mat<3> const G = gradient(0.1);
  displace(a, [&](Point const& X) { return times(G, X); });
  auto const f = make_formulation(a);
  f->step(0, 1e-6);
  Values const v = sample(*f, "Velocity", a.particles.X.size());
  // Corrections differ from those of the infinite lattice within the reach of the gradient, the force within twice
  // that; the second kick of Verlet sees the surface that the first one moved, again twice as far.
  constexpr int layers = 4;
  double inside = 0;
  int deep = 0;
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    bool is_deep = true;
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
      int const at = a.particles.lattice_index[k][c];
      is_deep = is_deep && at >= layers && at < n - layers;
    }
    deep += is_deep ? 1 : 0;
    for (std::size_t c = 0; is_deep && c < 3; ++c) inside = std::max(inside, std::fabs(v[3 * k + c]));
  }
  EXPECT_GT(deep, 0);
  EXPECT_GT(largest(v), 1e-3);
  EXPECT_LT(inside, 1e-11 * largest(v));  // cancelling forces of the size of those at the surface
}

std::vector<std::string> narrowest_and_widest() {
  auto const all = backends();
  return all.front() == all.back() ? std::vector<std::string>{all.front()}
                                   : std::vector<std::string>{all.front(), all.back()};
}

INSTANTIATE_TEST_SUITE_P(All, PatchTest,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Values(0.0, 0.2),
                                            ::testing::Values("filtered", "paper"),
                                            ::testing::ValuesIn(narrowest_and_widest())));

}  // namespace
}  // namespace piola
