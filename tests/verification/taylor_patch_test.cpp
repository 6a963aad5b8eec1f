// SPDX-License-Identifier: Apache-2.0
// Linear fields under Taylor-SPH: what follows from them in one step is exact on any set of particles.
#include "formulations/taylor_sph/taylor_bodies.hpp"
#include "math/random.hpp"
#include <fmt/format.h>

namespace piola {
namespace {

using namespace testing;

struct Setting {
  int dimension;
  double jitter;
  std::string configuration, cells, backend;
};

void PrintTo(Setting const& s, std::ostream* out) {
  *out << s.dimension << "D jitter " << s.jitter << " " << s.configuration << " " << s.cells << " " << s.backend;
}

class TaylorPatchTest : public ::testing::TestWithParam<Setting> {
 protected:
  int const D = GetParam().dimension;
  Assembly assembly() const {
    Assembly a = assemble_taylor(unit_box(D, D == 1 ? 12 : D == 2 ? 7 : 5, GetParam().jitter));
    choose(a, "configuration", GetParam().configuration);
    choose(a, "virtual_particles", GetParam().cells);
    a.backend = GetParam().backend;
    return a;
  }
  bool is_moving() const { return GetParam().configuration == "updated"; }
  double modulus() const { return Moduli(D).along; }
};

Mat<3> cut_to(int D, Mat<3> G) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) G(i, j) *= i < D && j < D ? 1 : 0;
  return G;
}
Point times(Mat<3> const& G, Point const& X) {
  Vec<3> const v = G * Vec<3>{{X[0], X[1], X[2]}};
  return {v[0], v[1], v[2]};
}

/// D : d; a bar is free across.
Mat<3> hooke(int D, Mat<3> const& L) {
  if (D == 1) return cut_to(1, (youngs_modulus * L(0, 0)) * identity<3>());
  Moduli const m(D);
  return (m.lambda * trace(L)) * identity<3>() + m.mu * (L + transpose(L));
}

/// With v = G X from rest, velocities of half time are (I + dt/2 G)^-1 G x where particles are then, and the stress has
/// grown by dt/2 D : G. Boundary particles are driven; all others must follow by themselves.
TEST_P(TaylorPatchTest, WithALinearVelocityHasItsGradientAndStressEverywhere) {
  Assembly a = assembly();
  Mat<3> const G = cut_to(D, {{0.3, -0.2, 0.1, 0.25, -0.15, 0.05, -0.1, 0.2, 0.4}});
  give_velocity(a, [&](Point const& X) { return times(G, X); });
  auto const row = [&](int i) { return fmt::format("{}*X + {}*Y + {}*Z", G(i, 0), G(i, 1), G(i, 2)); };
  drive(a, {true, true, true}, {row(0), row(1), row(2)}, [&](Point const& X) { return is_on_edge(X, D); });
  auto const f = make_formulation(a);
  double const dt = f->stable_time_step();
  f->step(0, dt);

  Mat<3> const L = is_moving() ? G * inverse(identity<3>() + (0.5 * dt) * G) : G;
  Mat<3> stress = hooke(D, L);
  if (is_moving()) {
    Mat<3> const half = (0.5 * dt) * hooke(D, G), W = 0.5 * (L - transpose(L));
    stress = stress + (W * half - half * W);
  }
  stress = dt * stress;
  double const volume = 0.5 * dt * trace(L);
  auto const n = a.particles.X.size();
  Values const s = sample(*f, "CauchyStress", n), v = sample(*f, "Velocity", n), u = sample(*f, "Displacement", n),
               J = sample(*f, "Jacobian", n);
  for (std::size_t k = 0; k < n; ++k) {
    Point const expected_v = times(G, a.particles.X[k]);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        EXPECT_NEAR(s[6 * k + static_cast<std::size_t>(SymMat<3>::at(i, j))], stress(i, j), 1e-12 * dt * modulus())
            << k;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(v[3 * k + c], expected_v[c], 1e-13);
      EXPECT_NEAR(u[3 * k + c], dt * expected_v[c], 1e-13);
    }
    EXPECT_NEAR(J[k], is_moving() ? (1 + volume) / (1 - volume) : 1, 1e-13);
  }
}

/// A linear stress accelerates every particle inside by exactly its divergence over the density.
TEST_P(TaylorPatchTest, WithALinearStressHasItsDivergenceInside) {
  Assembly a = assembly();
  choose(a, "hourglass_filter", 0);
  support(a, {true, true, true}, [&](Point const& X) { return is_on_edge(X, D); });
  auto const f = make_formulation(a);
  std::size_t const components = static_cast<std::size_t>(D * (D + 1) / 2);
  double slope[6][3];
  testing::Random random(1);
  for (auto& row : slope)
    for (double& g : row) g = random.in(-1000, 1000);
  give_stress(*f, a, [&](Point const& X) {
    std::array<double, 6> s{};
    for (std::size_t c = 0; c < components; ++c)
      s[c] = 500 + slope[c][0] * X[0] + slope[c][1] * X[1] + slope[c][2] * X[2];
    return s;
  });
  double const dt = f->stable_time_step();
  f->step(0, dt);
  Values const v = sample(*f, "Velocity", a.particles.X.size());
  auto const component = [&](int i, int j) {
    return D == 3 ? SymMat<3>::at(i, j) : D == 2 ? SymMat<2>::at(i, j) : SymMat<1>::at(i, j);
  };
  int inside = 0;
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    if (is_on_edge(a.particles.X[k], D)) continue;
    ++inside;
    for (int i = 0; i < D; ++i) {
      double force = 0;
      for (int j = 0; j < D; ++j) force += slope[component(i, j)][j];
      EXPECT_NEAR(v[3 * k + static_cast<std::size_t>(i)], dt * force / density, 1e-12 * dt);
    }
  }
  EXPECT_GE(inside, 10);
}

std::vector<Setting> settings() {
  std::vector<Setting> r;
  auto const all = backends();
  for (auto const& backend : std::set<std::string>{all.front(), all.back()})
    for (int D = 1; D <= 3; ++D)
      for (auto const* configuration : {"updated", "fixed"}) {
        for (double const jitter : {0.0, 0.15}) r.push_back({D, jitter, configuration, "delaunay", backend});
        if (D > 1)
          for (double const jitter : {0.0, 0.15}) r.push_back({D, jitter, configuration, "lattice_cells", backend});
      }
  return r;
}

INSTANTIATE_TEST_SUITE_P(All, TaylorPatchTest, ::testing::ValuesIn(settings()), [](auto const& p) {
  auto const& s = p.param;
  return std::to_string(s.dimension) + "D_" + (s.jitter > 0 ? "jittered_" : "regular_") + s.configuration + "_" +
         s.cells + "_" + s.backend;
});

/// What the printed form of the gradient cannot do: its values are exact for a constant only.
TEST(TaylorPatchTest, FailsWithThePrintedGradientOnAnIrregularSet) {
  Assembly a = assemble_taylor(unit_box(2, 7, 0.15));
  choose(a, "configuration", "fixed");
  choose(a, "gradient", "published");
  give_velocity(a, [](Point const& X) { return Point{X[0], 0, 0}; });
  auto const f = make_formulation(a);
  double const dt = f->stable_time_step();
  f->step(0, dt);
  Values const s = sample(*f, "CauchyStress", 49);
  double worst = 0;
  for (std::size_t k = 0; k < 49; ++k)
    if (!is_on_edge(a.particles.X[k], 2)) worst = std::max(worst, std::fabs(s[6 * k] / (dt * Moduli(2).along) - 1));
  EXPECT_GT(worst, 0.01);
}

/// The filter of checkerboards leaves what is linear alone, on boxes of any shape.
TEST(TaylorHourglassFilter, DoesNotTouchALinearVelocity) {
  for (int D = 2; D <= 3; ++D) {
    Assembly a = assemble_taylor(unit_box(D, D == 2 ? 7 : 5, 0.2));
    choose(a, "configuration", "fixed");
    choose(a, "hourglass_filter", 0.5);
    Mat<3> const G = cut_to(D, {{0.3, -0.2, 0.1, 0.25, -0.15, 0.05, -0.1, 0.2, 0.4}});
    give_velocity(a, [&](Point const& X) { return times(G, X); });
    auto const f = make_formulation(a);
    f->step(0, 1e-9);
    Values const v = sample(*f, "Velocity", a.particles.X.size());
    for (std::size_t k = 0; k < a.particles.X.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(v[3 * k + c], a.initial_velocity[k][c], 1e-13);
    EXPECT_NEAR(f->diagnose().stabilisation_loss, 0, 1e-12 * f->diagnose().kinetic_energy);
  }
}

/// Each step removes the fraction `hourglass_filter` of a checkerboard velocity, and the energy of that fraction.
TEST(TaylorHourglassFilter, TakesItsShareOfACheckerboard) {
  Assembly a = assemble_taylor(unit_box(2, 9));
  choose(a, "configuration", "fixed");
  choose(a, "hourglass_filter", 0.25);
  for (auto const& at : a.particles.lattice_index)
    a.initial_velocity.push_back({(at[0] + at[1]) % 2 == 0 ? 1.0 : -1.0, 0, 0});
  auto const f = make_formulation(a);
  double const before = f->diagnose().kinetic_energy;
  f->step(0, 1e-9);
  Values const v = sample(*f, "Velocity", 81);
  for (std::size_t k = 0; k < 81; ++k)
    if (!is_on_edge(a.particles.X[k], 2)) {
      EXPECT_NEAR(v[3 * k], 0.75 * a.initial_velocity[k][0], 1e-7);
    }
  Diagnostics const d = f->diagnose();
  EXPECT_GT(d.stabilisation_loss, 0.1 * before);
  EXPECT_NEAR(d.total_energy() + d.stabilisation_loss, before, 1e-6 * before);
}

}  // namespace
}  // namespace piola
