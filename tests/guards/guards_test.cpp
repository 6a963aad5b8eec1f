// SPDX-License-Identifier: Apache-2.0
// What guards say of runs whose energies, strains and places are written down here.
#include "piola/materials/hypoelastic_registry.hpp"
#include "formulations/small_bodies.hpp"
#include "support/key_words.hpp"
#include "support/scripted_run.hpp"

namespace piola {
namespace {

using test::expect_words;
using testing::make_plate;
using testing::make_springs;
using testing::Outcome;
using testing::run;
using testing::Script;
using testing::Scripted;
using testing::simulation;
using testing::springs;
using testing::TemporaryFolder;
using testing::text_of;
using testing::turned;
using Point = std::array<double, 3>;

// ---- energy

/// 100 J up to 0.3 s, then a rise to `factor` at the end, all of it in particle 6.
Script rising(double factor) {
  Script s;
  s.kinetic = [=](double t) { return 100 * (1 + (factor - 1) * std::max(0.0, t - 0.3) / 0.7); };
  s.speed = [](std::size_t i, double t) { return i == 6 && t > 0.3 ? 5 * t : 1; };
  return s;
}

TEST(EnergyGuard, SaysNothingOfARiseBelowOnePercent) {
  Outcome const o = run(rising(1.009));
  EXPECT_EQ(o.of.summary.warnings, std::vector<std::string>{});
  EXPECT_NEAR(o.guards["energy_rise"]["share"].get<double>(), 0.009, 0.001);
  EXPECT_FALSE(o.guards["energy_rise"].contains("warning"));
}

TEST(EnergyGuard, WarnsOfARiseAboveOnePercentWithNumbersAndPlace) {
  Outcome const o = run(rising(1.05));
  EXPECT_EQ(o.of.ending, RunStatus::completed);
  ASSERT_EQ(o.of.summary.warnings.size(), 1U);
  expect_words(o.all(), {"energy rose without a load by 4.", " % of 10",
                         "from t = 0 s (step 0) to t = ", "particle 6 of body 'plate' (X = (2, 1, 0) m"});
  EXPECT_NEAR(o.guards["energy_rise"]["share"].get<double>(), 0.05 / 1.05, 0.004);
  EXPECT_EQ(o.guards["energy_rise"]["warning"], o.of.summary.warnings[0]);
  ASSERT_EQ(o.shown.size(), 2U) << "while the run goes on, and at its end";
  expect_words(o.shown[0], {"so far, at t = 0."});
}

TEST(EnergyGuard, StopsARiseAboveTenPercent) {
  TemporaryFolder const folder;
  Simulation s = simulation(rising(1.5));
  Outcome const o = run(s, folder / "r");
  EXPECT_EQ(o.of.ending, RunStatus::failed);
  EXPECT_GT(o.of.summary.end_time, 0.455);  // from then on (E - 100) / E > 0.1
  EXPECT_LT(o.of.summary.end_time, 0.6);
  expect_words(o.of.failure,
               {"particle 6 (body 'plate', X = (2, 1, 0) m", "gains most of an energy that no load brings",
                "rise [%] = 1", "since step = 0", "often the step is too large"});
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "r/summary.json"))["status"], "failed");
  EXPECT_TRUE(std::filesystem::exists(folder / "r" / failed_checkpoint));
}

TEST(EnergyGuard, CountsFromTheLowestEnergySoFar) {
  Script s;
  s.kinetic = [](double t) { return t < 0.5 ? 100 - 100 * t : 50 + 20 * (t - 0.5); };
  Outcome const o = run(s);
  EXPECT_EQ(o.of.ending, RunStatus::completed);
  EXPECT_NEAR(o.guards["energy_rise"]["share"].get<double>(), 0.1, 0.01);
  EXPECT_NEAR(o.guards["energy_rise"]["from_time"].get<double>(), 0.5, 0.02);
}

TEST(EnergyGuard, TakesTheWorkOfLoadsOff) {
  Script s;
  s.kinetic = [](double t) { return 50 * t * t; };
  s.work = s.kinetic;
  EXPECT_EQ(run(s).of.summary.warnings, std::vector<std::string>{});
  s.work = [](double t) { return 40 * t * t; };  // a quarter of the work comes from nowhere
  EXPECT_EQ(run(s).of.ending, RunStatus::failed);
}

/// Work and energy may refer to times that differ by up to one step.
TEST(EnergyGuard, ForgivesTheFirstStepsOfALoad) {
  Script s;
  s.kinetic = [](double t) { return t > 0.5 ? std::pow(t - 0.5 + 1e-3, 2) : 0; };
  s.work = [](double t) { return t > 0.5 ? std::pow(t - 0.5, 2) : 0; };
  Simulation often = simulation(s);
  often.spec.loads.emplace_back();
  often.spec.output.history_every = 1e-3;
  TemporaryFolder const folder;
  Outcome const o = run(often, folder / "r");
  EXPECT_EQ(o.of.ending, RunStatus::completed);
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "r/summary.json"))["status"], "completed");
}

TEST(EnergyGuard, LeavesABodyAtRestAlone) {
  Script s;
  // Speeds of 1e-11 of that of waves, which are a spacing per step here: 1 m in 1 ms.
  s.kinetic = [](double t) { return 8 * std::pow(1e-11 * 1e3 * (1 + t), 2); };
  EXPECT_EQ(run(s).of.summary.warnings, std::vector<std::string>{});
}

// Strain energy at rest is a difference of large numbers: it wobbles by 1e-16 of the moduli.
TEST(EnergyGuard, TakesNoRoundingOfStrainEnergyForARise) {
  constexpr double modulus = 1e10;
  Script s;
  s.kinetic = [](double t) { return modulus * 16 * 1e-16 * (1 + t); };
  Simulation at_rest = simulation(s), soft = simulation(s);
  for (Simulation* one : {&at_rest, &soft}) {
    auto const material = testing::rubber();
    one->spec.bodies[0].material = material;
    with_any_law(material, [&](auto const& law) {
      double const own = law.kappa + 4.0 / 3 * law.mu;
      for (double& v : one->particles.volume.own()) v *= (one == &soft ? 1e-6 : 1) * modulus / own;
    });
  }
  TemporaryFolder const folder;
  EXPECT_EQ(run(at_rest, folder / "rest").of.summary.warnings, std::vector<std::string>{});
  EXPECT_EQ(run(soft, folder / "soft").of.ending, RunStatus::failed) << "the same energy is much to a soft body";
}

TEST(EnergyGuard, StartsBehindAPressureThatTheCaseAdds) {
  Script s;
  s.kinetic = [](double t) { return t > 0 ? 100 : 0; };
  TemporaryFolder const folder;
  Simulation alone = simulation(s), pressed = simulation(s);
  EXPECT_EQ(run(alone, folder / "alone").of.ending, RunStatus::failed);
  pressed.spec.bodies[0].formulation.formulas.emplace("initial_pressure", Expression("5"));
  EXPECT_TRUE(run(pressed, folder / "pressed").of.summary.warnings.empty());
}

TEST(EnergyGuard, HasTheLimitsOfTheCase) {
  TemporaryFolder const folder;
  Simulation strict = simulation(rising(1.009)), mild = simulation(rising(1.5)), off = simulation(rising(1.5));
  strict.spec.run.guards.energy_rise_warn = 1e-3;
  EXPECT_EQ(run(strict, folder / "strict").of.summary.warnings.size(), 1U);
  mild.spec.run.guards.energy_rise_stop = 0.9;
  EXPECT_EQ(run(mild, folder / "mild").of.ending, RunStatus::completed);
  off.spec.run.guards.on = false;
  Outcome const o = run(off, folder / "off");
  EXPECT_EQ(o.of.ending, RunStatus::completed);
  EXPECT_EQ(o.guards, "off");
  EXPECT_TRUE(o.of.summary.warnings.empty());
}

TEST(DissipationGuard, WarnsWithTheSharesOfItsParts) {
  Script s;
  s.kinetic = [](double t) { return 100 - 20 * t; };
  s.loss = [](double t) { return 15 * t; };
  s.more = [](double t) { return std::vector<std::pair<std::string, double>>{{"viscous_loss", 3 * t}}; };
  Outcome const o = run(s);
  expect_words(o.all(),
               {"23 % of the energy", "stabilisation 15 %", "hourglass damping 3 %", "averages of the scheme 5 %"});
  EXPECT_NEAR(o.guards["dissipation"]["share"].get<double>(), 0.23, 1e-12);
  s.kinetic = [](double t) { return 100 - 5 * t; };
  s.loss = [](double t) { return 5 * t; };
  EXPECT_TRUE(run(s).of.summary.warnings.empty());
}

/// Work and energy may refer to times that differ by up to one step: the first check under a load may miss most of its
/// work.
TEST(DissipationGuard, ForgivesTheFirstLooksAtALoad) {
  Script s;
  s.work = [](double t) { return t > 0.5 ? std::pow(t - 0.5 + 0.0003, 4) : 0; };
  s.kinetic = [](double t) { return t > 0.5 ? std::pow(t - 0.5, 4) : 0; };
  Simulation loaded = simulation(s);
  TemporaryFolder const folder;
  Outcome const o = run(loaded, folder / "r");
  EXPECT_EQ(o.shown, std::vector<std::string>{});
  EXPECT_EQ(o.of.ending, RunStatus::completed);
}

// ---- deformation and contact

TEST(JacobianGuard, WarnsOfTheWorstParticleOfWhatDoesNotYield) {
  Script s;
  s.jacobian = [](std::size_t i, double t) { return i == 9 ? 1 - 0.8 * t : i == 3 ? 1 + 1.9 * t : 1; };
  Outcome const o = run(s);
  ASSERT_EQ(o.of.summary.warnings.size(), 1U);
  expect_words(o.all(), {"det F reached 0.2", "at t = ", "particle 9 of body 'plate' (X = (1, 2, 0) m"});
  EXPECT_DOUBLE_EQ(o.guards["jacobian"]["max"].get<double>(), 2.9);
  EXPECT_NEAR(o.guards["jacobian"]["worst"].get<double>(), 0.2, 0.003);
  s.jacobian = [](std::size_t i, double t) { return i == 9 ? 1 - 0.69 * t : 1 + 1.99 * t; };
  EXPECT_TRUE(run(s).of.summary.warnings.empty());
}

TEST(JacobianGuard, LetsMetalsFlow) {
  Script s;
  s.jacobian = [](std::size_t i, double t) { return i == 9 ? 1 + 5 * t : 1; };
  TemporaryFolder const folder;
  for (std::string const law : {"johnson_cook", "perfectly_plastic", "elastic", "neo_hookean"}) {
    Simulation of = simulation(s);
    of.spec.bodies[0].law = law;
    of.spec.bodies[0].material.law = find_law(law).value().index;
    EXPECT_EQ(run(of, folder / law).of.summary.warnings.empty(), law == "johnson_cook" || law == "perfectly_plastic")
        << law;
  }
}

TEST(OverlapGuard, WarnsAboveOneSpacing) {
  auto const with = [](double most) {
    Script s;
    s.more = [=](double t) { return std::vector<std::pair<std::string, double>>{{"contact_overlap", most * t}}; };
    return run(s);
  };
  Outcome const o = with(1.25);
  expect_words(o.all(), {"contact overlap reached 1.25 spacings (limit 1) at t = 1 s"});
  EXPECT_TRUE(with(0.99).of.summary.warnings.empty());
  EXPECT_DOUBLE_EQ(with(0.99).guards["overlap"]["largest"].get<double>(), 0.99);
}

TEST(OverlapGuard, WarnsOfParticlesThatNothingKeepsApart) {
  Script s;
  s.uncovered = {{"body 'plate'", "rigid shapes", 45}};
  expect_words(run(s).all(), {"45 particles of body 'plate' beside failed material", "them apart from rigid shapes"});
}

TEST(StrainDriftGuard, WarnsAndStops) {
  auto const with = [](double most) {
    Script s;
    s.more = [=](double t) { return std::vector<std::pair<std::string, double>>{{"strain_drift", most * t}}; };
    return run(s);
  };
  EXPECT_TRUE(with(0.04).of.summary.warnings.empty());
  expect_words(with(0.1).all(), {"the strain of cells", "stress by 0.1", "limit 0.05"});
  Outcome const o = with(0.5);
  EXPECT_EQ(o.of.ending, RunStatus::failed);
  EXPECT_NEAR(o.of.summary.end_time, 0.41, 0.02);
  expect_words(o.of.failure, {"the strain of cells", "strain without stress = 0.2"});
}

// ---- loads that follow their face

/// A run under a following pressure. damping: 20 1/s leave 1 / e of a velocity after 50 ms.
Outcome run_under_load(Expression const& pressure, std::function<double(double)> const& kinetic, double damping = 20) {
  Script s;
  s.kinetic = kinetic;
  s.work = [=](double t) { return 10 + kinetic(t); };
  Simulation of = simulation(s);
  of.spec.run.damping = damping;
  LoadSpec& load = of.spec.loads.emplace_back();
  load.name = "push";
  load.body = of.spec.bodies[0].name;
  load.kind = LoadSpec::Kind::pressure;
  load.follower = true;
  load.value[0] = pressure;
  TemporaryFolder const folder;
  return run(of, folder / "r");
}
/// Calms down until 0.6 s, grows then by 4.5 in 50 ms.
double fed(double t) { return std::exp(-30 * std::min(t, 0.6)) * std::exp(30 * std::max(t - 0.6, 0.0)); }

TEST(FollowingLoadGuard, NamesTheLoadThatFeedsMotion) {
  Outcome const o = run_under_load(Expression("Y*min(t/0.3, 1)"), fed);
  expect_words(o.all(), {"kinetic energy grew ", " while every load was steady", "did work of ",
                         "load \"push\" follows the face and varies along it"});
  EXPECT_NEAR(o.guards["following_load"]["from_time"].get<double>(), 0.6, 0.06);
  bool const told_early = std::any_of(o.shown.begin(), o.shown.end(),
                                      [](std::string const& text) { return text.starts_with("so far, at t = 0.7"); });
  EXPECT_TRUE(told_early);
}

TEST(FollowingLoadGuard, LetsLoadsChangeAndVibrationsDecay) {
  auto const silent = [](Outcome const& o) { return o.all().find("every load was steady") == std::string::npos; };
  EXPECT_TRUE(silent(run_under_load(Expression("Y*t"), fed)));
  EXPECT_TRUE(silent(run_under_load(Expression("Y"), fed, 0))) << "without damping nothing need decay";
  auto const vibration = [](double t) { return std::exp(-40 * t) * std::pow(std::sin(22 * t), 2); };
  EXPECT_TRUE(silent(run_under_load(Expression("Y"), vibration)));
}

TEST(FollowingLoadGuard, CallsNoFunctionOfAProgram) {
  int calls = 0;
  Expression const pressure("a function of the program", [&](std::array<double, 3> const& X, double) {
    ++calls;
    return X[1];
  });
  EXPECT_EQ(run_under_load(pressure, fed).all().find("every load was steady"), std::string::npos);
  EXPECT_EQ(calls, 0) << "nothing but the formulation evaluates it, and this one does not";
}

// ---- particles that approach each other

/// Two plates of 3 x 3, the second to the right of the first.
ParticleSet two_plates() {
  ParticleSet set = make_plate(3), other = make_plate(3);
  set.bodies[0].name = "left";
  set.bodies.push_back({"right", 9, 18, {1, 1, 1}, {3, 3, 1}, true});
  for (std::size_t i = 0; i < 9; ++i) {
    set.X.push_back({other.X[i][0] + 4, other.X[i][1], 0});
    set.lattice_index.push_back(other.lattice_index[i]);
    set.volume.push_back(1);
    set.kernel_volume.push_back(1);
    set.body.push_back(1);
  }
  return set;
}

TEST(ProximityGuard, WarnsOfABodyThatGoesThroughAnother) {
  Script s;
  auto const by = [&](double far) {
    s.displacement = [=](std::size_t i, double t) { return Point{i < 9 ? far * t : 0, 0, 0}; };
    return run(s, two_plates());
  };
  Outcome const o = by(3.9);
  expect_words(o.all(), {"bodies go through each other: at t = 1 s particle ", "of body 'left'", "of body 'right'",
                         "was 0.1 spacings from"});
  EXPECT_NEAR(o.guards["proximity"]["nearest"].get<double>(), 0.1, 1e-9);
  EXPECT_TRUE(by(1.4).of.summary.warnings.empty());  // 0.6 spacings of distance
}

/// A row of particles that is bent to a hairpin: its ends meet.
ParticleSet row(int n) {
  ParticleSet set = make_plate(n);
  set.bodies[0] = {"row", 0, n, {1, 1, 1}, {n, 1, 1}, true};
  for (auto* all : {&set.volume, &set.kernel_volume}) all->resize(static_cast<std::size_t>(n));
  set.X.resize(static_cast<std::size_t>(n));
  set.body.resize(static_cast<std::size_t>(n));
  set.lattice_index.resize(static_cast<std::size_t>(n));
  return set;
}

TEST(ProximityGuard, WarnsOfABodyThatGoesThroughItself) {
  Script s;
  s.displacement = [](std::size_t i, double t) {
    auto const x = static_cast<double>(i);
    double const radius = 9.6 / (2 * 3.14159265358979), angle = x / radius;
    return Point{t * (radius * std::sin(angle) - x), t * radius * (1 - std::cos(angle)), 0};
  };
  Outcome const o = run(s, row(11));  // the ring closes 0.4 spacings behind its start
  expect_words(o.all(), {"a body goes through itself: at t = 1 s particle ", "of body 'row'", "(limit 0.5)"});
  s.eulerian.assign(11, 1);
  EXPECT_TRUE(run(s, row(11)).of.summary.warnings.empty()) << "Eulerian particles know each other";
}

TEST(ProximityGuard, LeavesBodiesThatTurnOrAreCrushedAlone) {
  Script s;
  ParticleSet const plate = make_plate(6);
  s.displacement = [&](std::size_t i, double t) {
    Point const& X = plate.X[i];
    return Point{X[0] * (std::cos(20 * t) - 1) - X[1] * std::sin(20 * t),
                 X[0] * std::sin(20 * t) + X[1] * (std::cos(20 * t) - 1), 0};
  };
  Outcome const turned = run(s, plate);
  EXPECT_TRUE(turned.of.summary.warnings.empty());
  EXPECT_GT(turned.guards["proximity"]["searches"].get<double>(), 0);
  s.displacement = [&](std::size_t i, double t) {
    return Point{30 * t * (plate.X[i][0] - 2.5), -0.95 * t * plate.X[i][1], 0};
  };
  EXPECT_TRUE(run(s, plate).of.summary.warnings.empty()) << "neighbours lie between";
}

// ---- runs that go on

void expect_same(TemporaryFolder const& folder, std::function<Simulation()> const& make, double stop_at) {
  Simulation whole = make(), first = make(), second = make();
  Outcome const expected = run(whole, folder / "whole");
  std::atomic<int> stop{0};
  auto& formulation = static_cast<Scripted&>(*first.formulation);
  formulation.stop_at = stop_at;
  formulation.stop = &stop;
  EXPECT_EQ(run(first, folder / "parts", false, &stop).of.ending, RunStatus::stopped);
  Outcome const found = run(second, folder / "parts", true);
  EXPECT_EQ(found.of.ending, expected.of.ending);
  EXPECT_EQ(found.of.summary.steps, expected.of.summary.steps);
  EXPECT_EQ(found.guards, expected.guards);
  EXPECT_EQ(found.of.summary.warnings, expected.of.summary.warnings);
}

TEST(Guards, OfAResumedRunSayTheSame) {
  Script s = rising(1.08);
  s.jacobian = [](std::size_t i, double t) { return i == 9 ? 1 - 0.9 * t : 1; };
  s.more = [](double t) {
    return std::vector<std::pair<std::string, double>>{{"contact_overlap", 2 * t}, {"strain_drift", 0.1 * t}};
  };
  s.displacement = [](std::size_t i, double t) { return Point{i < 9 ? 3.8 * t : 0, 0, 0}; };
  s.loss = [](double t) { return 30 * t; };
  s.gradient = [](std::size_t i, double t) { return turned(i == 5 ? t : 0); };
  for (double const stop_at : {100.0, 457.0, 905.0}) {
    TemporaryFolder const folder;
    expect_same(
        folder,
        [&] {
          Simulation of = simulation(s, two_plates());
          of.spec.bodies[0].law = "linear_elastic";
          return of;
        },
        stop_at);
  }
  TemporaryFolder const folder;
  expect_same(
      folder, [] { return simulation(rising(1.5)); }, 420);
}

TEST(Guards, DoNotTouchTheRun) {
  TemporaryFolder const folder;
  Simulation with = make_springs(), without = make_springs();
  without.spec.run.guards.on = false;
  run(with, folder / "with");
  run(without, folder / "without");
  EXPECT_EQ(read_checkpoint(list_checkpoints(folder / "with")[0]).state.arrays(),
            read_checkpoint(list_checkpoints(folder / "without")[0]).state.arrays());
  EXPECT_EQ(text_of(folder / "with/history.csv"), text_of(folder / "without/history.csv"));
}

TEST(Guards, LookBetweenTheRowsOfASparseHistory) {
  TemporaryFolder const folder;
  Simulation s = simulation(rising(1.5));
  s.spec.run.end = 20;
  s.spec.output.history_every = 20;
  Outcome const o = run(s, folder / "r");
  EXPECT_EQ(o.of.ending, RunStatus::failed);
  EXPECT_LT(o.of.summary.steps, 6000);
}

TEST(Guards, LookAtTheStateAtWhichARelaxationEnds) {
  TemporaryFolder const folder;
  Script script;
  // It moves for three steps, slows down, is brought back for a step and stopped, and hardly swings then.
  script.kinetic = [](double t) {
    return t < 3.5e-3 ? 1 : t < 4.5e-3 ? 0.5 : t > 6.5e-3 && t < 7.5e-3 ? 1e-21 : 1e-20;
  };
  script.jacobian = [](std::size_t i, double t) { return i == 6 && t > 4.5e-3 ? 9 : 1; };
  Simulation s = simulation(script);
  s.spec.run.relax = true;
  s.spec.output.history_every = 1;
  Outcome const o = run(s, folder / "r");
  EXPECT_EQ(o.of.summary.steps, 9);
  expect_words(o.all(), {"det F reached 9", "particle 6"});
}

}  // namespace
}  // namespace piola
