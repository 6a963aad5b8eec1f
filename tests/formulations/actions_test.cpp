// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"
#include "formulations/taylor_sph/taylor_bodies.hpp"
#include "materials/solid_samples.hpp"
#include <functional>

namespace piola {
namespace {

using namespace testing;

struct Kind {
  std::string name;
  std::function<Assembly(ParticleSet)> assemble;
};

Assembly with_words(Assembly a, std::map<std::string, std::string, std::less<>> const& words) {
  for (auto& f : a.formulations) f.words = words;
  return a;
}

std::vector<Kind> kinds() {
  auto const jst = [](std::map<std::string, std::string, std::less<>> words) {
    return [words](ParticleSet set) { return with_words(assemble(std::move(set)), words); };
  };
  return {
      {"filtered", jst({{"scheme", "filtered"}})},
      {"paper", jst({{"scheme", "paper"}})},
      {"displacement", jst({{"variables", "displacement"}})},
      {"multipliers", jst({{"scheme", "filtered"}, {"supports", "multipliers"}})},
      {"multipliers_rk2", jst({{"scheme", "paper"}, {"supports", "multipliers"}})},
      {"taylor_sph",
       [](ParticleSet set) {
         return with_words(assemble_taylor(std::move(set)), {{"configuration", "updated"}});
       }},
      {"taylor_estimates",
       [](ParticleSet set) {
         return with_words(assemble_taylor(std::move(set)), {{"configuration", "updated"}, {"exchange", "kernel_sums"}});
       }},
      {"nodal",
       [](ParticleSet set) {
         Assembly a = assemble(std::move(set));
         for (auto& f : a.formulations) f = {"nodal", {}, {}};
         return a;
       }},
      {"adaptle", [](ParticleSet set) {
         Assembly a = assemble(std::move(set), sample_metal("elastic", "elastic"));
         for (auto& f : a.formulations) f = {"adaptle", {}, {}};
         return a;
       }}};
}

class EveryFormulation : public ::testing::TestWithParam<Kind> {
 protected:
  /// A block between a clamp and a driven end, under a load and with a spin: all that acts has a name.
  Assembly block(int dimension) const {
    Assembly a = GetParam().assemble(unit_box(dimension, 6));
    support(a, {true, true, true}, [](Point const& X) { return X[0] < 1e-9; }).name = "clamp";
    Support& driven = support(a, {true, false, false}, [](Point const& X) { return X[0] > 1 - 1e-9; });
    driven.name = "grip";
    driven.velocity = formulas({"0.5 + 100 * t", "0", "0"});
    load(a, {"3 * t", "-9.81", "X"}, everywhere).name = "gravity";
    give_velocity(a, [](Point const& X) { return Point{X[0] * X[1], 0.2 * X[0], 0.1 * X[0]}; });
    return a;
  }
};

INSTANTIATE_TEST_SUITE_P(All, EveryFormulation, ::testing::ValuesIn(kinds()),
                         [](auto const& test) { return test.param.name; });

double largest_of(Point const& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

/// Forces and moments about the origin of all that acts, minus the rates of the momenta over a step.
struct Balance {
  Point force{}, moment{};
  double size = 0;
};
Balance balance_of_step(Formulation& f, Assembly const& a, double time, double dt) {
  Diagnostics const before = f.diagnose();
  f.step(time, dt);
  Diagnostics const after = f.diagnose();
  Balance b;
  auto const about = [&](std::string const& name) {
    for (auto const& s : a.supports)
      if (s.name == name) return s.about;
    for (auto const& l : a.loads)
      if (l.name == name) return l.about;
    for (auto const& r : a.rigid_shapes)
      if (r.name == name) return r.centre;
    ADD_FAILURE() << name;
    return Point{};
  };
  for (Action const& action : after.actions) {
    Point const c = about(action.name);
    b.size = std::max(b.size, largest_of(action.force));
    for (std::size_t i = 0; i < 3; ++i) {
      std::size_t const p = (i + 1) % 3, q = (i + 2) % 3;
      b.force[i] += action.force[i];
      b.moment[i] += action.moment[i] + c[p] * action.force[q] - c[q] * action.force[p];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    b.force[i] -= (after.linear_momentum[i] - before.linear_momentum[i]) / dt;
    b.moment[i] -= (after.angular_momentum[i] - before.angular_momentum[i]) / dt;
  }
  return b;
}

TEST_P(EveryFormulation, SaysForcesThatSumToTheRateOfTheMomentum) {
  for (int const dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    Assembly a = block(dimension);
    for (auto& s : a.supports) s.about = {0.3, -2, 5};
    auto const f = make_formulation(a);
    double time = 0;
    for (int k = 0; k < 12; ++k) {
      double const dt = 0.9 * f->stable_time_step();
      Balance const b = balance_of_step(*f, a, time, dt);
      time += dt;
      // Round-off of the momenta, over the step.
      double const mass = 8000, round_off = 1e-14 * mass * 10 / dt;
      EXPECT_GT(b.size, 1e3 * round_off) << k;
      EXPECT_LT(largest_of(b.force), round_off) << k;
      if (GetParam().name == "adaptle" || GetParam().name == "displacement") continue;  // do not keep it
      EXPECT_LT(largest_of(b.moment), round_off) << k;
    }
    EXPECT_FALSE(f->failure().has_value());
  }
}

TEST_P(EveryFormulation, SaysTheSameForcesAfterAResume) {
  Assembly const a = block(2);
  auto const f = make_formulation(a), resumed = make_formulation(a);
  advance(*f, 1e-5, 3);
  SavedState state = saved(*f);
  resumed->load(state);
  for (int k = 0; k < 2; ++k) {
    auto const expected = f->diagnose().actions, found = resumed->diagnose().actions;
    ASSERT_EQ(expected.size(), 3u);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(found[i].force, expected[i].force);
      EXPECT_EQ(found[i].moment, expected[i].moment);
    }
    f->step(3e-5, 1e-5);
    resumed->step(3e-5, 1e-5);
  }
}

TEST_P(EveryFormulation, DampsWhatNothingPrescribes) {
  Assembly a = GetParam().assemble(unit_box(2, 6));
  give_velocity(a, [](Point const&) { return Point{0.3, -0.2, 0}; });
  auto const f = make_formulation(a);
  double const start = f->diagnose().kinetic_energy, dt = 1e-5;
  EXPECT_NEAR(f->kinetic_energy() / start, 1, 1e-13);
  for (int k = 0; k < 20; ++k) {
    f->step(k * dt, dt);
    f->damp(std::exp(-1e4 * dt));
  }
  Diagnostics const d = f->diagnose();
  EXPECT_NEAR(d.kinetic_energy / start, std::exp(-4.0), 1e-11);  // v = v0 exp(-c t), c t = 2
  EXPECT_NEAR((d.kinetic_energy + d.damping_loss) / start, 1, 1e-11);

  Assembly driven = block(2);
  auto const g = make_formulation(driven);
  advance(*g, dt, 3);
  g->damp(0);
  auto const n = driven.particles.X.size();
  Values const v = sample(*g, "Velocity", n);
  for (std::size_t k = 0; k < n; ++k) {
    bool const held = driven.particles.X[k][0] > 1 - 1e-9;
    if (GetParam().name.starts_with("multipliers")) continue;
    EXPECT_NEAR(v[3 * k], held ? 0.5 + 300 * dt : 0, 1e-14);
    EXPECT_EQ(v[3 * k + 1], 0);
  }
}

/// A load that has ended leaves particles that are held where they are.
TEST(Supports, KeepParticlesWhereALoadEnds) {
  Assembly a = with_words(assemble(unit_box(2, 5)), {{"scheme", "filtered"}});
  support(a, {true, true, true}, [](Point const& X) { return X[0] < 1e-9; });
  load(a, {"0", "-1000", "0"}, everywhere).until = 3e-4;
  auto const f = make_formulation(a);
  advance(*f, 1e-4, 6);
  auto const n = a.particles.X.size();
  Values const u = sample(*f, "Displacement", n);
  for (std::size_t k = 0; k < n; ++k)
    if (a.particles.X[k][0] < 1e-9) {
      EXPECT_EQ(u[3 * k + 1], 0);
    }
}

/// A wall that a block runs into gives it the momentum that it loses.
TEST(RigidShapes, SayTheirForce) {
  for (int const dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    Assembly a = kinds().back().assemble(unit_box(dimension, 5));
    give_velocity(a, [](Point const&) { return Point{-30, 0, 0}; });
    RigidShape wall;
    wall.name = "wall";
    wall.centre = {-0.1, 0, 0};
    wall.axis = {1, 0, 0};
    a.rigid_shapes.push_back(wall);
    auto const f = make_formulation(a);
    double most = 0;
    for (double time = 0; time < 4e-4;) {
      double const dt = f->stable_time_step();
      Balance const b = balance_of_step(*f, a, time, dt);
      time += dt;
      most = std::max(most, b.size);
      EXPECT_LT(largest_of(b.force), 1e-14 * 8000 * 30 / dt);
      // It acts at the middle of the face, half a metre from the centre of the wall in y and z.
      Action const found = f->diagnose().actions.at(0);
      double const arm = found.force[0] / 2;
      EXPECT_NEAR(found.moment[1], dimension == 3 ? arm : 0, 1e-9 * most);
      EXPECT_NEAR(found.moment[2], -arm, 1e-9 * most);
    }
    EXPECT_GT(most, 1e6);
  }
}

/// Force of a pressure of 1 Pa on the face +x of a unit square that is deformed by F.
Point pressure_force(std::string const& scheme, std::array<double, 4> const& F, bool follows) {
  Assembly a = with_words(assemble(unit_box(2, 6)), {{"scheme", scheme}});
  displace(a, [&](Point const& X) {
    return Point{(F[0] - 1) * X[0] + F[1] * X[1], F[2] * X[0] + (F[3] - 1) * X[1], 0};
  });
  Load& push = load(a, {"1", "0", "0"}, [](Point const& X) { return X[0] > 1 - 1e-9; });
  for (std::size_t k = 0; k < push.particles.size(); ++k) {
    double const mass = 1100 * a.particles.volume[static_cast<std::size_t>(push.particles[k])];
    push.factor[k] = (k == 0 || k == 5 ? 0.1 : 0.2) / mass;
  }
  push.normal = Point{1, 0, 0};
  push.pressure = true;
  push.follows = follows;
  push.name = "push";
  auto const f = make_formulation(a);
  f->step(0, 1e-9);  // too short for F to change
  return f->diagnose().actions.at(0).force;
}

TEST(Pressure, ActsOnTheFaceOfTheStartOrFollowsIt) {
  for (std::string const scheme : {"filtered", "paper"}) {
    std::array<double, 4> const F{1.2, 0.3, 0.1, 1.5};
    Point const dead = pressure_force(scheme, F, false), follower = pressure_force(scheme, F, true);
    EXPECT_NEAR(dead[0], -1, 1e-9);
    EXPECT_NEAR(dead[1], 0, 1e-9);
    // n da = cof F N dA (Nanson): the face from (1, 0) to (1, 1) goes from F e_x to F (e_x + e_y), turned by -90
    // degrees.
    EXPECT_NEAR(follower[0], -1.5, 1e-4);
    EXPECT_NEAR(follower[1], 0.3, 1e-4);
  }
}

}  // namespace
}  // namespace piola
