// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/relaxation.hpp"
#include "piola/simulation/run.hpp"
#include "formulations/small_bodies.hpp"
#include "materials/solid_samples.hpp"
#include <atomic>

// Static answers by dynamic relaxation, against closed forms.
namespace piola {
namespace {

using namespace testing;

constexpr double E = 1e7, nu = 0.3, rho = 1000, T = 1e4, g = 10;

/// A unit box with rollers on the faces -x, -y and -z, of a law for small strains.
Assembly box_on_rollers(std::string const& formulation, int dimension, int n) {
  bool const metal = formulation == "adaptle";
  Assembly a = assemble(unit_box(dimension, n),
                        metal ? parameters_by_name("elastic", "elastic", "none",
                                                   {{"density", rho}, {"youngs_modulus", E}, {"poissons_ratio", nu}})
                              : material("linear_elastic", rho, E, nu));
  for (auto& f : a.formulations) f = {formulation, {}, {}};
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    std::array<bool, 3> fix{};
    fix[c] = true;
    support(a, fix, [c](Point const& X) { return X[c] < 1e-9; }).name = std::string("roller_") + "xyz"[c];
  }
  return a;
}

/// A traction on the face +x.
void pull(Assembly& a, int dimension, int n) {
  Load& l = load(a, {std::to_string(T), "0", "0"}, [](Point const& X) { return X[0] > 1 - 1e-9; });
  l.normal = Point{1, 0, 0};
  l.name = "pull";
  double const spacing = 1.0 / (n - 1);
  for (std::size_t k = 0; k < l.particles.size(); ++k) {
    auto const id = static_cast<std::size_t>(l.particles[k]);
    double area = 1;
    for (std::size_t c = 1; c < static_cast<std::size_t>(dimension); ++c) {
      double const X = a.particles.X[id][c];
      area *= X < 1e-9 || X > 1 - 1e-9 ? spacing / 2 : spacing;
    }
    l.factor[k] = area / (rho * a.particles.volume[id]);
  }
}

struct Relaxed {
  std::unique_ptr<Formulation> formulation;
  Rest rest;
  Moment moment;
};
Relaxed relax(Assembly const& a, double end = 10, double limit = 1e-4) {
  Relaxed r{make_formulation(a), {}, {}};
  RunSpec run;
  run.end = end;
  run.relax = true;
  run.rest = limit;
  Relaxation relaxation(run);
  std::atomic<int> const stop{0};
  WallLimit wall(WallLimit::none, WallLimit::Clock::now());
  march(*r.formulation, run, r.moment, {}, {stop, wall}, &relaxation);
  r.rest = relaxation.rest();
  return r;
}

double tip(Relaxed const& r, Assembly const& a) {
  auto const n = a.particles.X.size();
  return sample(*r.formulation, "Displacement", n)[3 * (n - 1)];
}

class Statics : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, Statics, ::testing::Values("jst_sph", "taylor_sph", "adaptle"),
                         [](auto const& test) { return test.param; });

/// AdapTLE has motions without stiffness, which forces on single particles excite.
class Tension : public Statics {};
INSTANTIATE_TEST_SUITE_P(All, Tension, ::testing::Values("jst_sph", "taylor_sph"),
                         [](auto const& test) { return test.param; });

// Plane strain: u = T (1 - nu^2) / E at the pulled face, and the roller there bears all of the traction.
TEST_P(Tension, ABlockUnderTensionIsStretchedAsElasticityHasIt) {
  Assembly a = box_on_rollers(GetParam(), 2, 7);
  pull(a, 2, 7);
  Relaxed const r = relax(a);
  EXPECT_TRUE(r.rest.reached);
  EXPECT_LE(r.rest.residual, 1e-4);
  EXPECT_LT(r.moment.time, 10);
  double const exact = T * (1 - nu * nu) / E;
  EXPECT_NEAR(tip(r, a) / exact, 1, 0.03);
  Diagnostics const d = r.formulation->diagnose();
  EXPECT_EQ(d.kinetic_energy, 0);
  EXPECT_GT(d.damping_loss, 0);
  for (Action const& action : d.actions)
    if (action.name == "roller_x") {
      EXPECT_NEAR(action.force[0] / -T, 1, 0.02);
    }
}

// Uniaxial strain: u = rho g L^2 / (2 M) at the end of a bar that hangs, M = lambda + 2 mu.
TEST_P(Statics, ABarUnderItsWeightIsBorneAndStretchedAsElasticityHasIt) {
  bool const flat = GetParam() == "adaptle";  // has no bodies in one dimension
  Assembly a = box_on_rollers(GetParam(), flat ? 2 : 1, flat ? 11 : 21);
  if (flat) support(a, {false, true, false}, everywhere).name = "sides";
  load(a, {std::to_string(g), "0", "0"}, everywhere);
  Relaxed const r = relax(a, 10, flat ? 1e-2 : 1e-4);
  EXPECT_TRUE(r.rest.reached);
  for (Action const& action : r.formulation->diagnose().actions) {
    if (action.name == "roller_x") {
      EXPECT_NEAR(action.force[0] / (-rho * g), 1, 0.02);
    }
  }
  if (flat) return;  // 19 % too soft on 11 particles: its gradients at edges are of first order
  double const M = GetParam() == "taylor_sph" ? E : E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));  // uniaxial stress there
  EXPECT_NEAR(tip(r, a) / (rho * g / (2 * M)), 1, 0.03);
}

TEST(Relaxation, DoesNotCallABodyAtRestThatFalls) {
  Assembly a = assemble(unit_box(2, 5));
  load(a, {"0", "-10", "0"}, everywhere);
  Relaxed const r = relax(a, 0.02);
  EXPECT_FALSE(r.rest.reached);
  EXPECT_EQ(r.moment.time, 0.02);
}

TEST(Relaxation, GoesOnAfterACheckpointAsIfNothingHadBeen) {
  RunSpec run;
  run.end = 10;
  run.relax = true;
  Assembly a = box_on_rollers("jst_sph", 2, 5);
  pull(a, 2, 5);
  auto const f = make_formulation(a), g_ = make_formulation(a);
  Relaxation one(run), other(run);
  one.start(*f);
  for (int k = 0; k < 40; ++k) {
    double const dt = f->stable_time_step();
    f->step(1e-3 * k, dt);
    one.after_step(*f, dt);
  }
  SavedState state = saved(*f);
  NamedState kept;
  one.save(kept);
  g_->load(state);
  other.load(kept, {});
  for (int k = 40; k < 80; ++k) {
    double const dt = f->stable_time_step();
    ASSERT_EQ(g_->stable_time_step(), dt);
    f->step(1e-3 * k, dt);
    g_->step(1e-3 * k, dt);
    EXPECT_EQ(one.after_step(*f, dt), other.after_step(*g_, dt));
  }
  EXPECT_EQ(one.rest().stops, other.rest().stops);
  EXPECT_GT(one.rest().stops, 0);
  EXPECT_EQ(one.rest().residual, other.rest().residual);
  EXPECT_EQ(f->kinetic_energy(), g_->kinetic_energy());
}

}  // namespace
}  // namespace piola
