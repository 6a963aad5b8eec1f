// SPDX-License-Identifier: Apache-2.0
// Bodies that are no whole lattice: cracks, holes, corners that point inwards; and what cannot be a body.
#include "piola/setup/cracks.hpp"
#include "formulations/taylor_sph/taylor_bodies.hpp"
#include "support/key_words.hpp"

namespace piola {
namespace {

using namespace testing;
using test::expect_words;

// ---- cracks

/// Velocities of the two sides of the line y = 1/2, particles of crack faces on their own.
void move_apart(Assembly& a, Point const& above, Point const& below) {
  a.initial_velocity.clear();
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    double const side = a.particles.crack_side[k] != 0 ? a.particles.crack_side[k] : a.particles.X[k][1] - 0.5;
    a.initial_velocity.push_back(side > 0 ? above : below);
  }
}

class CrackedPlate : public ::testing::TestWithParam<std::tuple<std::string, double>> {};

/// A crack from edge to edge cuts a plate in two, which do not feel each other.
TEST_P(CrackedPlate, ThatIsCutThroughIsTwoPlates) {
  auto const& [cells, smoothing_length] = GetParam();
  ParticleSet set = unit_box(2, 9);
  open_crack(set, 0, {0, 0.5, 0}, {1, 0.5, 0});
  Assembly a = assemble_taylor(set);
  choose(a, "virtual_particles", cells);
  choose(a, "smoothing_length", smoothing_length);
  move_apart(a, {0.2, 0.5, 0}, {-0.1, -0.3, 0});
  auto const f = make_formulation(a);
  run(*f, 20);
  auto const n = a.particles.X.size();
  Values const v = sample(*f, "Velocity", n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(v[3 * k + c], a.initial_velocity[k][c], 1e-12);
  EXPECT_LT(largest(sample(*f, "CauchyStress", n)), 1e-10 * youngs_modulus);
}

/// Behind the tip the two faces of a crack do not see each other; ahead of it the plate is whole.
TEST_P(CrackedPlate, FeelsItsOtherSideAheadOfTheTipOnly) {
  auto const& [cells, smoothing_length] = GetParam();
  ParticleSet set = unit_box(2, 17);
  open_crack(set, 0, {0, 0.5, 0}, {0.5, 0.5, 0});
  Assembly a = assemble_taylor(set);
  choose(a, "virtual_particles", cells);
  choose(a, "smoothing_length", smoothing_length);
  choose(a, "configuration", "fixed");
  move_apart(a, {0, 0.5, 0}, {0, -0.5, 0});
  auto const f = make_formulation(a);
  run(*f, 1);
  auto const n = a.particles.X.size();
  Values const s = sample(*f, "CauchyStress", n);
  double behind = 0, ahead = 0;
  for (std::size_t k = 0; k < n; ++k) {
    Point const& X = a.particles.X[k];
    for (std::size_t c = 0; c < 6; ++c) {
      // A step reaches a virtual particle's smoothing and a real one's: less than 4 spacings.
      if (X[0] < 0.5 - 4.0 / 16) behind = std::max(behind, std::fabs(s[6 * k + c]));
      if (X[0] > 0.5 + 2.0 / 16) ahead = std::max(ahead, std::fabs(s[6 * k + c]));
    }
  }
  EXPECT_LT(behind, 1e-12 * youngs_modulus);
  EXPECT_GT(ahead, 0.01 * youngs_modulus);
}

INSTANTIATE_TEST_SUITE_P(All, CrackedPlate,
                         ::testing::Combine(::testing::Values("delaunay", "lattice_cells"),
                                            ::testing::Values(0.7, 0.9, 1.1)));

// ---- parts of a lattice

/// A linear velocity, driven at the surface, is differentiated exactly everywhere: the stress after a step is
/// dt D : sym(L), whatever the shape.
void expect_linear_patch(ParticleSet const& set, std::function<bool(Point const&)> const& is_surface) {
  Assembly a = assemble_taylor(set);
  choose(a, "configuration", "fixed");
  Mat<2> const L{{0.3, -0.2, 0.5, -0.1}};
  give_velocity(a, [&](Point const& X) {
    return Point{L(0, 0) * X[0] + L(0, 1) * X[1], L(1, 0) * X[0] + L(1, 1) * X[1], 0};
  });
  drive(a, {true, true, false}, {"0.3*X - 0.2*Y", "0.5*X - 0.1*Y", "0"}, is_surface);
  auto const f = make_formulation(a);
  auto const n = a.particles.X.size();
  double const dt = f->stable_time_step();
  f->step(0, dt);
  Moduli const m(2);
  double const volume = m.lambda * trace(L), scale = dt * m.along;
  Values const s = sample(*f, "CauchyStress", n), v = sample(*f, "Velocity", n);
  for (std::size_t k = 0; k < n; ++k) {
    Point const& X = a.particles.X[k];
    EXPECT_NEAR(s[6 * k], dt * (volume + 2 * m.mu * L(0, 0)), 1e-12 * scale) << X[0] << " " << X[1];
    EXPECT_NEAR(s[6 * k + 1], dt * (volume + 2 * m.mu * L(1, 1)), 1e-12 * scale) << X[0] << " " << X[1];
    EXPECT_NEAR(s[6 * k + 2], dt * volume, 1e-12 * scale) << X[0] << " " << X[1];
    EXPECT_NEAR(s[6 * k + 3], dt * m.mu * (L(0, 1) + L(1, 0)), 1e-12 * scale) << X[0] << " " << X[1];
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(v[3 * k + c], a.initial_velocity[k][c], 1e-12);
  }
}

bool is_near(double a, double b) { return std::fabs(a - b) < 1e-9; }

TEST(PlateWithAHole, PassesThePatchTest) {
  auto const from_centre = [](Point const& X) { return std::max(std::fabs(X[0] - 0.5), std::fabs(X[1] - 0.5)); };
  ParticleSet const set = part_of(unit_box(2, 11), [&](Point const& X) { return from_centre(X) > 0.15; });
  ASSERT_EQ(set.size(), 121 - 9);
  expect_linear_patch(set, [&](Point const& X) { return is_on_edge(X, 2) || is_near(from_centre(X), 0.2); });
}

TEST(LShapedPlate, PassesThePatchTest) {
  ParticleSet const set =
      part_of(unit_box(2, 11), [](Point const& X) { return X[0] < 0.5 + 1e-9 || X[1] < 0.5 + 1e-9; });
  expect_linear_patch(set, [](Point const& X) {
    bool const notch = (is_near(X[0], 0.5) && X[1] > 0.5 - 1e-9) || (is_near(X[1], 0.5) && X[0] > 0.5 - 1e-9);
    return is_on_edge(X, 2) || notch;
  });
}

TEST(JitteredLShapedPlate, PassesThePatchTest) {
  ParticleSet const whole = unit_box(2, 11, 0.15);
  // Lattice positions decide, so that the edge of the notch is uneven.
  std::vector<bool> keep;
  for (auto const& at : whole.lattice_index) keep.push_back(at[0] <= 5 || at[1] <= 5);
  std::size_t k = 0;
  ParticleSet const set = part_of(whole, [&](Point const&) { return keep[k++]; });
  std::vector<Point> notch;
  for (std::size_t p = 0; p < set.X.size(); ++p) {
    auto const& at = set.lattice_index[p];
    if ((at[0] >= 4 && at[1] >= 4)) notch.push_back(set.X[p]);
  }
  expect_linear_patch(
      set, [&](Point const& X) { return is_on_edge(X, 2) || std::find(notch.begin(), notch.end(), X) != notch.end(); });
}

/// The surface of a hole is free: its stress has no traction, and nothing reaches across the hole.
TEST(PlateWithASlot, FeelsNothingAcrossIt) {
  // Rows 7 to 9 of 17 are missing from edge to edge: two plates in one body.
  ParticleSet const whole = unit_box(2, 17);
  ParticleSet const set = part_of(whole, [](Point const& X) { return X[1] < 6.5 / 16 || X[1] > 9.5 / 16; });
  Assembly a = assemble_taylor(set);
  give_velocity(a, [](Point const& X) { return X[1] > 0.5 ? Point{0.3, 0.4, 0} : Point{0, 0, 0}; });
  auto const f = make_formulation(a);
  run(*f, 10);
  auto const n = set.X.size();
  Values const v = sample(*f, "Velocity", n);
  for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(v[3 * k + 1], a.initial_velocity[k][1], 1e-12);
  EXPECT_LT(largest(sample(*f, "CauchyStress", n)), 1e-10 * youngs_modulus);
}

// ---- what cannot be a body

Assembly triangulated(ParticleSet const& set) {
  Assembly a = assemble_taylor(set);
  choose(a, "virtual_particles", "delaunay");
  return a;
}

TEST(TaylorBody, RefusesPointsThatCoincide) {
  ParticleSet set = unit_box(2, 6, 0.1);
  set.X[8] = set.X[7];
  std::string const text = refusal(triangulated(set));
  expect_words(text, {"cells between points: 1 point of 36", "place of another one", "7 and 8"});
}

TEST(TaylorBody, RefusesPointsOnALine) {
  ParticleSet set = unit_box(2, 6, 0.1);
  for (std::size_t k = 0; k < set.X.size(); ++k) {
    double const s = static_cast<double>(k);
    set.X[k] = {s, 2 * s, 0};
  }
  std::string const text = refusal(triangulated(set));
  EXPECT_NE(text.find("cells between points: all 36 points lie on one line"), std::string::npos) << text;
}

TEST(TaylorBody, RefusesPointsInAPlane) {
  ParticleSet set = unit_box(3, 4, 0.1);
  for (std::size_t k = 0; k < set.X.size(); ++k) {
    auto const& at = set.lattice_index[k];
    set.X[k] = {static_cast<double>(at[0] + 5 * at[2]), static_cast<double>(at[1]), 0};
  }
  std::string const text = refusal(triangulated(set));
  EXPECT_NE(text.find("cells between points: all 64 points lie in one plane"), std::string::npos) << text;
}

TEST(TaylorBody, RefusesPositionsThatAreNotFinite) {
  ParticleSet set = unit_box(2, 6, 0.1);
  set.X[8][1] = std::nan("");
  std::string const text = refusal(triangulated(set));
  expect_words(text, {"cells between points: 1 point without a finite position", "number 8"});
}

}  // namespace
}  // namespace piola
