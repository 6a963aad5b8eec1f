// SPDX-License-Identifier: Apache-2.0
#include "formulations/nodal/nodal_bodies.hpp"
#include "math/random.hpp"

/// Bodies that start with a given deformation gradient.
namespace piola::testing {
namespace {

using Gradient = std::array<double, 9>;

constexpr Point low{-0.2, 0.1, 0}, high{0.7, 1.3, 1.1};  // corners of the brick

constexpr Gradient oblique{1.1, 0.05, 0, -0.03, 0.92, 0.02, 0, 0.04, 1.04};

Assembly prestressed(Gradient const& F, double jitter, std::array<int, 3> n = {5, 6, 5}) {
  Assembly a = nodal_body(brick(3, jitter, n));
  a.cfl = 0.2;
  a.initial_deformation_gradient.assign(a.particles.X.size(), F);
  return a;
}

/// The same body, stretched by its displacement; the lower corner stays.
Assembly displaced(Gradient const& F, Assembly a) {
  a.initial_deformation_gradient.clear();
  displace(a, [&](Point const& X) {
    Point u{};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t J = 0; J < 3; ++J) u[c] += (F[3 * c + J] - (c == J ? 1 : 0)) * (X[J] - low[J]);
    return u;
  });
  return a;
}

Mat<3> matrix(Gradient const& F) {
  Mat<3> r;
  std::copy(F.begin(), F.end(), r.c);
  return r;
}

bool at_face(Point const& X) {
  for (std::size_t c = 0; c < 3; ++c)
    if (X[c] < low[c] + 1e-9 || X[c] > high[c] - 1e-9) return true;
  return false;
}

double largest_error(Values const& P, Mat<3> const& exact) {
  double most = 0;
  for (std::size_t k = 0; k < P.size(); ++k) most = std::max(most, std::fabs(P[k] - exact.c[k % 9]));
  return most;
}

TEST(NodalInitialGradient, HasTheStressOfTheLawAndStaysAtRestBetweenHeldFaces) {
  Mat<3> const F = matrix(oblique), exact = NeoHookean(rubber().value).first_piola(F);
  for (double const jitter : {0.0, 0.2}) {
    Assembly a = prestressed(oblique, jitter);
    support(a, {true, true, true}, at_face);
    auto const f = make_formulation(a);
    auto const n = a.particles.X.size();
    EXPECT_LT(largest_error(sample(*f, "FirstPiolaStress", n), exact), 1e-11 * size(exact)) << jitter;
    EXPECT_LT(largest_error(sample(*f, "DeformationGradient", n), F), 1e-12) << jitter;
    advance_by_itself(*f, 0, 100);
    // Forces of a uniform stress vanish inside to the tolerance of the divergence theorem. Bounds set after the result:
    // 1.3e-4 m and 8.5e-4 m with spacings of 0.24 m, 0.1 and 3 % of the stress.
    EXPECT_LT(largest(sample(*f, "Displacement", n)), 0.005 * 0.24) << jitter;
    EXPECT_LT(largest_error(sample(*f, "FirstPiolaStress", n), exact), 0.05 * size(exact)) << jitter;
  }
}

TEST(NodalInitialGradient, OfARotationHasNoStress) {
  double const c = std::cos(1.1), s = std::sin(1.1);
  Gradient const turned{c, -s, 0, s, c, 0, 0, 0, 1};
  Assembly const a = prestressed(turned, 0.2);
  auto const f = make_formulation(a);
  auto const n = a.particles.X.size();
  EXPECT_LT(largest(sample(*f, "CauchyStress", n)), 1e-11 * 17e6);
  EXPECT_LT(f->diagnose().strain_energy, 1e-12 * 17e6);
  advance_by_itself(*f, 0, 50);
  EXPECT_LT(largest(sample(*f, "Displacement", n)), 1e-10);
}

TEST(NodalInitialGradient, MovesOnReleaseAsAStretchedBody) {
  Gradient const straight{1.1, 0, 0, 0, 0.92, 0, 0, 0, 1.04};
  for (double const jitter : {0.0, 0.2})
    for (bool const mirrored : {false, true}) {
      Gradient const& F = mirrored ? straight : oblique;
      Assembly a = prestressed(F, jitter);
      if (mirrored) a.mirrors.push_back({0, 0, false, false});
      auto const f = make_formulation(a), g = make_formulation(displaced(F, a));
      EXPECT_EQ(f->stable_time_step(), g->stable_time_step());
      double const dt = f->stable_time_step();
      advance(*f, dt, 100);
      advance(*g, dt, 100);
      auto const n = a.particles.X.size();
      Values const v = sample(*f, "Velocity", n), w = sample(*g, "Velocity", n);
      EXPECT_GT(largest(v), 1) << "it springs back";
      EXPECT_LT(largest_difference(v, w), 1e-6 * largest(v)) << jitter << mirrored;
      EXPECT_LT(largest_difference(sample(*f, "DeformationGradient", n), sample(*g, "DeformationGradient", n)), 1e-6);
      EXPECT_NEAR(f->diagnose().strain_energy / g->diagnose().strain_energy, 1, 1e-6);
    }
}

/// The given values count at the particles, not at the centroids of cells, which lie inside of faces.
TEST(NodalInitialGradient, CountsAtTheParticles) {
  constexpr double bend = 0.1;
  Assembly a = nodal_body(unit_box(3, 5));
  displace(a, [](Point const& X) { return Point{bend * X[0] * X[0], 0, 0}; });
  Assembly given = a;
  for (Point const& X : a.particles.X)
    given.initial_deformation_gradient.push_back({1 + 2 * bend * X[0], 0, 0, 0, 1, 0, 0, 0, 1});
  auto const n = a.particles.X.size();
  Values const F = sample(*make_formulation(given), "DeformationGradient", n),
               of_positions = sample(*make_formulation(a), "DeformationGradient", n);
  double const to_centroid = 2 * bend * 0.25 / 4;  // change of F over a quarter of a spacing
  EXPECT_LT(largest_difference(F, of_positions), 0.5 * to_centroid);
}

TEST(NodalInitialGradient, GoesOnBitForBitFromACheckpoint) {
  Assembly const a = prestressed(oblique, 0.2);
  auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
  advance_by_itself(*whole, 0, 40);
  double const middle = advance_by_itself(*first, 0, 17);
  auto state = saved(*first);
  second->load(state);
  advance_by_itself(*second, middle, 23);
  EXPECT_EQ(saved(*second).values, saved(*whole).values);
}

}  // namespace
}  // namespace piola::testing
