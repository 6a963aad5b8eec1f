// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/dynamic_relaxation.hpp"
#include "piola/simulation/time_loop.hpp"
#include "formulations/small_bodies.hpp"
#include "materials/solid_samples.hpp"
#include "support/fake_formulation.hpp"
#include <atomic>
#include <numbers>

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
  RelaxationStatus rest;
  TimeState moment;
  bool unfinished = false;
};
RunSpec relaxing(double end, std::string method = "kinetic_damping") {
  RunSpec run;
  run.end = end;
  run.relax = true;
  run.relax_method = std::move(method);
  return run;
}
Relaxed relax(Assembly a, double end = 10, double limit = 1e-4, std::string const& method = "kinetic_damping") {
  RunSpec run = relaxing(end, method);
  run.relax_tolerance = limit;
  a.minimises = run.minimises();
  Relaxed r{make_formulation(a), {}, {}};
  Relaxation relaxation(run, a.particles, rho);  // of a unit box
  std::atomic<int> const stop{0};
  WallLimit wall(WallLimit::none, WallLimit::Clock::now());
  march(*r.formulation, run, r.moment, {}, {stop, wall}, &relaxation);
  r.rest = relaxation.rest();
  r.unfinished = relaxation.unfinished();
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

// Plane strain: u = T (1 - nu^2) / E at the pulled face, and the roller there carries all of the traction.
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

/// Velocity Verlet of independent springs of mass 1, with omega [1/s] and x of the start.
class Springs : public testing::FakeFormulation {
 public:
  Springs(std::vector<double> omega, double dt)
      : omega_(std::move(omega)), x_(omega_.size(), 1), v_(omega_.size(), 0), dt_(dt) {}
  double stable_time_step() const override { return dt_; }
  void step(double, double dt) override {
    ++steps;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      double const k2 = omega_[k] * omega_[k];
      v_[k] -= 0.5 * dt * k2 * x_[k];
      x_[k] += dt * v_[k];
      v_[k] -= 0.5 * dt * k2 * x_[k];
    }
  }
  void damp(double factor) override {
    stops += factor == 0 ? 1 : 0;
    for (double& v : v_) v *= factor;
  }
  double kinetic_energy() const override {
    double sum = 0;
    for (double const v : v_) sum += 0.5 * v * v;
    return sum;
  }
  std::optional<Failure> failure() const override { return std::nullopt; }
  Diagnostics diagnose() const override { return {}; }
  std::vector<FieldInfo> fields() const override { return {{"Displacement", "m", 3}}; }
  /// From the start, where all stretches are 1.
  void sample(std::string_view, std::span<double> values) const override {
    for (std::size_t k = 0; k < x_.size(); ++k) values[3 * k] = x_[k] - 1;
  }
  void save(StateWriter&) const override {}
  void load(StateReader&) override {}
  double largest_x() const {
    double most = 0;
    for (double const x : x_) most = std::max(most, std::abs(x));
    return most;
  }
  int stops = 0, steps = 0;

 private:
  std::vector<double> omega_, x_, v_;
  double dt_;
};

// A spring with omega dt = sqrt(2) turns round exactly in the step after the peak of its energy: stopped there, it
// would lose nothing, and would stop the slow spring in each second step.
TEST(Relaxation, BringsStiffAndSoftSpringsToRestAtAnyStep) {
  for (double const share : {0.3, 0.6, 0.66, 0.7, std::numbers::sqrt2 / 2, 0.72, 0.75, 0.8, 0.85}) {
    double const stiffest = 100;
    Springs springs({1, 3, 20, stiffest}, share * 2 / stiffest);
    ParticleSet set;
    set.X.resize(4);
    set.volume.assign(4, 1);
    RunSpec const run = relaxing(1000);
    Relaxation relaxation(run, set, 4);
    TimeState moment;
    std::atomic<int> const stop{0};
    WallLimit wall(WallLimit::none, WallLimit::Clock::now());
    march(springs, run, moment, {}, {stop, wall}, &relaxation);
    EXPECT_TRUE(relaxation.rest().reached) << share;
    EXPECT_FALSE(relaxation.unfinished());
    EXPECT_LT(springs.largest_x(), 0.02) << share;
    EXPECT_LT(springs.steps, 5000) << share;
    EXPECT_LT(2 * springs.stops, springs.steps) << share;
  }
}

TEST(Relaxation, DoesNotCallABodyAtRestThatFalls) {
  Assembly a = assemble(unit_box(2, 5));
  load(a, {"0", "-10", "0"}, everywhere);
  Relaxed const r = relax(a, 0.02);
  EXPECT_FALSE(r.rest.reached);
  EXPECT_TRUE(r.unfinished);
  EXPECT_EQ(r.moment.time, 0.02);
}

TEST(Relaxation, GoesOnAfterACheckpointAsIfNothingHadBeen) {
  RunSpec const run = relaxing(10);
  Assembly a = box_on_rollers("jst_sph", 2, 5);
  pull(a, 2, 5);
  auto const f = make_formulation(a), g_ = make_formulation(a);
  Relaxation one(run, a.particles, rho), other(run, a.particles, rho);
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

// An error energy that falls by the factor q in a fifth of the run has q / (1 - q) of the last fifth left. A fifth is
// nine marks or more, so that lengths are exact to a ninth.
TEST(RemovedEnergy, ExtrapolatesAGeometricDecay) {
  for (double const decay : {1e-3, 1e-4}) {
    RemovedEnergy removed;
    int const steps = static_cast<int>(2.5 / decay);
    double left = 1;
    for (int k = 0; k < steps; ++k) {
      removed.add(left * (1 - std::exp(-decay)));
      left *= std::exp(-decay);
      removed.end_step();
    }
    double const exact = std::sqrt(left / (1 - left));
    EXPECT_NEAR(removed.left() / exact, 1, 0.25) << decay;
    RemovedEnergy copy;
    copy.load(removed.state());
    EXPECT_EQ(copy.left(), removed.left());
  }
}

TEST(RemovedEnergy, IsNeverBelowTheEnergyOfTheLastFifth) {
  RemovedEnergy removed;
  for (int k = 0; k < 100; ++k) {
    removed.add(k < 90 ? 1 : 0.1);
    removed.end_step();
  }
  EXPECT_GE(removed.left(), std::sqrt(1.0 / 91));
}

/// A column of nodal under its weight, held at its foot.
Assembly hanging_column(int dimension, int n) {
  Assembly a = assemble(unit_box(dimension, n), material("neo_hookean", rho, E, nu));
  a.formulations[0] = {"nodal", {}, {}};
  support(a, {true, true, true}, [](Point const& X) { return X[0] < 1e-9; }).name = "foot";
  load(a, {"100", "30", "0"}, everywhere);
  return a;
}

// Both methods find the same state; energies are compared, whose error is the square of that of the displacement.
TEST(ConjugateGradients, FindTheStateThatKineticDampingFinds) {
  for (int const dimension : {2, 3}) {
    Assembly const a = hanging_column(dimension, 6);
    Relaxed const stops = relax(a, 10, 1e-6), descent = relax(a, 10, 1e-6, "conjugate_gradients");
    EXPECT_TRUE(stops.rest.reached);
    EXPECT_TRUE(descent.rest.reached);
    EXPECT_LT(2 * descent.moment.step, stops.moment.step);
    Diagnostics const one = stops.formulation->diagnose(), other = descent.formulation->diagnose();
    EXPECT_NEAR(other.strain_energy / one.strain_energy, 1, 1e-5);
    EXPECT_NEAR(tip(descent, a) / tip(stops, a), 1, 1e-5);
    EXPECT_NEAR(other.external_work / one.external_work, 1, 1e-2);  // by the trapezoidal rule over long moves
    EXPECT_EQ(other.kinetic_energy, 0);
    EXPECT_NEAR(other.actions[0].force[0], -100 * rho, 1e-4 * 100 * rho);
  }
}

TEST(ConjugateGradients, GoOnAfterACheckpointAsIfNothingHadBeen) {
  Assembly a = hanging_column(2, 6);
  a.minimises = true;
  auto const f = make_formulation(a), g_ = make_formulation(a);
  auto const advance = [](Formulation& formulation, int from, int to) {
    for (int k = from; k < to; ++k) formulation.descend(1e-3 * k, 1e-3);
  };
  advance(*f, 0, 20);
  SavedState state = saved(*f);
  g_->load(state);
  advance(*f, 20, 40);
  advance(*g_, 20, 40);
  auto const n = a.particles.X.size();
  EXPECT_EQ(sample(*f, "Displacement", n), sample(*g_, "Displacement", n));
}

}  // namespace
}  // namespace piola
