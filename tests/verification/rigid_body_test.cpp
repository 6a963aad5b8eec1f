// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "verification/surface_bodies.hpp"

/// Free rigid bodies among deformable ones: momenta, energy, threads, checkpoints.
namespace piola {
namespace {

using namespace testing;
using Kind = RigidShape::Kind;

struct Throw {
  std::string name, formulation;
  int dimension;
  Kind kind;
};

RigidShape thrown(Kind kind, int dimension) {
  RigidShape s;
  s.name = "stone";
  s.kind = kind;
  s.free = true;
  double const height = kind == Kind::sphere ? 1.32 : kind == Kind::box ? 1.28 : 1.47;  // it nearly touches
  s.centre = {0.55, height, dimension == 3 ? 0.45 : 0};
  s.half_lengths = {0.35, 0.25, 0.2};
  s.radius = 0.3;
  s.axis = {0.8, 0.6, 0};
  s.mass = dimension == 3 ? 90 : 250;
  s.velocity = formulas({"1", "-6", dimension == 3 ? "0.5" : "0"});
  s.angular_velocity = formulas({dimension == 3 ? "4" : "0", dimension == 3 ? "-7" : "0", "9"});
  return s;
}

class FreeRigidBody : public ::testing::TestWithParam<Throw> {
 protected:
  /// A block, and a turning rigid body that is thrown on it.
  static Assembly scene(double friction) {
    auto const& at = GetParam();
    Assembly a;
    add_block(a, at.dimension, at.formulation, {}, 6, 1.0 / 6);
    a.contact.friction.kinetic = friction;
    a.rigid_shapes.push_back(thrown(at.kind, at.dimension));
    give_velocity(a, [](Point const&) { return Point{0, 0.5, 0}; });
    return a;
  }
  static void run(Formulation& f, double& time, int steps) {
    for (int k = 0; k < steps; ++k) {
      double const dt = f.stable_time_step();
      f.step(time, dt);
      time += dt;
    }
    ASSERT_FALSE(f.failure().has_value());
  }
  /// Steps until it touches, and some more.
  static void run_to_touch(Formulation& f, double& time) {
    for (int k = 0; k < 4000 && !(column(f.diagnose(), "contact_points") > 0); ++k) run(f, time, 1);
    ASSERT_GT(column(f.diagnose(), "contact_points"), 0);
  }
};

TEST_P(FreeRigidBody, SharesMomentaAndEnergyWithWhatItHits) {
  for (double const friction : {0.0, 0.4}) {
    auto const f = make_formulation(scene(friction));
    Diagnostics const before = f->diagnose();
    EXPECT_GT(before.kinetic_energy, 1) << "that of the stone";
    double time = 0;
    run_to_touch(*f, time);
    double const mass = GetParam().dimension == 3 ? 90 : 250, size = mass * 6;
    for (int k = 0; k < 300; ++k) {
      run(*f, time, 1);
      Diagnostics const d = f->diagnose();
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(d.linear_momentum[c], before.linear_momentum[c], 1e-12 * size);
        // Bodies of adaptle in rate form do not keep their own to round-off.
        ASSERT_NEAR(d.angular_momentum[c], before.angular_momentum[c],
                    (GetParam().formulation == "adaptle" ? 1e-4 : 1e-11) * size);
      }
    }
    Diagnostics const d = f->diagnose();
    double const energy = d.total_energy() + column(d, "friction_heat") + d.stabilisation_loss;
    // The edges of a box are sharp, and hit the points of this coarse block one by one.
    EXPECT_NEAR(energy / before.total_energy(), 1, GetParam().kind == Kind::box ? 3e-2 : 6e-3) << friction;
    ASSERT_EQ(d.rigids.size(), 1U);
    EXPECT_GT(d.rigids[0].velocity[1], -5.5) << "the block has pushed back";
  }
}

TEST_P(FreeRigidBody, HasTheSameBitsWithAnyNumberOfThreads) {
  expect_same_on_threads(scene(0.3), [](Formulation& f, double& t) {
    run_to_touch(f, t);
    run(f, t, 15);
  });
}

TEST_P(FreeRigidBody, ResumesBitForBit) {
  Assembly const a = scene(0.3);
  auto const whole = make_formulation(a);
  double time = 0;
  run_to_touch(*whole, time);
  run(*whole, time, 5);
  expect_resumes(a, *whole, time, [](Formulation& f, double& t) { run(f, t, 30); });
}

INSTANTIATE_TEST_SUITE_P(
    Throws, FreeRigidBody,
    ::testing::Values(Throw{"nodal_disc", "nodal", 2, Kind::sphere}, Throw{"jst_box_2d", "jst_sph", 2, Kind::box},
                      Throw{"jst_ball", "jst_sph", 3, Kind::sphere}, Throw{"nodal_box", "nodal", 3, Kind::box},
                      Throw{"nodal_bar", "nodal", 3, Kind::cylinder}, Throw{"adaptle_box", "adaptle", 3, Kind::box}),
    [](auto const& at) { return at.param.name; });

/// A block far off, and free shapes on a rigid floor.
Assembly bouncing(Kind kind, double friction, std::array<std::string, 3> const& velocity, double height) {
  Assembly a;
  ShapeSpec shape;
  shape.max = {0.3, 0.3, 0.3};
  shape.particles = {4, 4, 4};
  fill(shape, "block", a.particles);
  a.materials.push_back(rubber());
  a.formulations.push_back({"jst_sph", {}, {}});
  a.surfaces.push_back(contact_surface(shape, a.particles, a.particles.bodies.back()));
  a.surfaces.back().modulus = 2e7;
  a.contact.friction.kinetic = friction;
  RigidShape s = thrown(kind, 3);
  s.centre = {30, 0, height};
  s.axis = {1, 0, 0};
  s.half_lengths = {0.5, 0.3, 0.2};
  s.velocity = formulas(velocity);
  s.angular_velocity = formulas({"0", "0", "0"});
  s.gravity = formulas({"0", "0", "-9.81"});
  RigidShape floor;
  floor.name = "floor";
  a.rigid_shapes = {s, floor};
  return a;
}

TEST(FreeRigidBodies, BounceOnARigidFloorWithAllTheirEnergy) {
  for (Kind const kind : {Kind::sphere, Kind::cylinder, Kind::box}) {
    SCOPED_TRACE(static_cast<int>(kind));
    auto const f = make_formulation(bouncing(kind, 0, {"0", "0", "-3"}, kind == Kind::box ? 0.3 : 0.4));
    double const before = f->diagnose().total_energy();
    double time = 0, lowest = 1, pushed = 0;
    for (int k = 0; k < 20000 && time < 0.4; ++k) {
      double const dt = f->stable_time_step();
      f->step(time, dt);
      time += dt;
      lowest = std::min(lowest, f->diagnose().rigids[0].centre[2]);
      pushed = std::max(pushed, f->diagnose().actions[1].force[2]);
    }
    Diagnostics const d = f->diagnose();
    EXPECT_NEAR((d.total_energy() - d.external_work) / before, 1, 1e-3);
    EXPECT_GT(lowest, kind == Kind::box ? 0.15 : 0.25) << "it has not fallen through";
    EXPECT_GT(pushed, 90 * 9.81) << "the floor has pushed it";
    EXPECT_GT(d.rigids[0].centre[2], lowest + 0.01);
  }
}

TEST(FreeRigidBodies, SlideThenRollOnARigidFloor) {
  constexpr double v = 2;
  for (Kind const kind : {Kind::sphere, Kind::cylinder}) {
    // Across the axis of the cylinder.
    Assembly a = bouncing(kind, 0.3, {"0", "2", "0"}, 0.3);
    auto const f = make_formulation(a);
    double time = 0;
    while (time < 0.6) {
      double const dt = f->stable_time_step();
      f->step(time, dt);
      time += dt;
    }
    Diagnostics const d = f->diagnose();
    double const share = kind == Kind::sphere ? 5.0 / 7 : 2.0 / 3;
    EXPECT_NEAR(d.rigids[0].velocity[1] / v, share, 0.01 * share);
    EXPECT_NEAR(-0.3 * d.rigids[0].angular_velocity[0] / v, share, 0.01 * share);
    EXPECT_NEAR(column(d, "friction_heat") / (0.5 * 90 * v * v), 1 - share, 0.02);
  }
}

/// Boxes and cylinders without gravity that collide off their middles and rotate.
TEST(FreeRigidBodies, BoxesAndCylindersBounceOffEachOther) {
  for (auto const& [one, other] :
       {std::pair{Kind::box, Kind::box}, {Kind::box, Kind::cylinder}, {Kind::cylinder, Kind::cylinder}})
    for (double const friction : {0.0, 0.4}) {
      SCOPED_TRACE(static_cast<int>(one) * 10 + static_cast<int>(other));
      Assembly a = bouncing(one, friction, {"0.3", "0.2", "-3"}, 2);
      RigidShape target = a.rigid_shapes[0];
      a.rigid_shapes[1] = target;
      a.rigid_shapes[1].name = "target";
      a.rigid_shapes[1].kind = other;
      a.rigid_shapes[1].centre = {30.1, 0.15, 1.2};
      a.rigid_shapes[1].velocity = formulas({"0", "0", "1"});
      a.rigid_shapes[1].angular_velocity = formulas({"0.5", "1", "-2"});
      a.rigid_shapes[0].angular_velocity = formulas({"-1", "2", "0.7"});
      for (RigidShape& s : a.rigid_shapes) s.gravity = formulas({"0", "0", "0"});
      auto const f = make_formulation(a);
      Diagnostics const before = f->diagnose();
      double time = 0, pushed = 0;
      while (time < 0.5) {
        double const dt = f->stable_time_step();
        f->step(time, dt);
        time += dt;
        pushed = std::max(pushed, std::fabs(f->diagnose().actions[1].force[2]));
      }
      Diagnostics const d = f->diagnose();
      EXPECT_GT(pushed, 0);
      EXPECT_LT(column(d, "contact_overlap"), 1);
      double const size = 2 * 90 * 3;
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(d.linear_momentum[c], before.linear_momentum[c], 1e-12 * size);
        EXPECT_NEAR(d.angular_momentum[c], before.angular_momentum[c], 1e-11 * size * 30);
      }
      EXPECT_NEAR((d.total_energy() + column(d, "friction_heat")) / before.total_energy(), 1, 4e-3)
          << "the force of a corner jumps where another face is nearer";
      EXPECT_GT(d.rigids[0].centre[2] - d.rigids[1].centre[2], 0.3) << "it has not gone through";
    }
}

TEST(FreeRigidBodies, ThatMoveWithNoNumberStopTheRun) {
  Assembly a = bouncing(Kind::sphere, 0, {"0", "0", "0"}, 9);
  a.rigid_shapes[0].gravity = formulas({"0", "0", "1/(t < 1e-9)"});
  auto const f = make_formulation(a);
  EXPECT_FALSE(f->failure().has_value());
  f->step(0, 1e-5);
  ASSERT_TRUE(f->failure().has_value());
  EXPECT_NE(f->failure()->what.find("rigid shape 'stone'"), std::string::npos);
}

// A body of adaptle that may turn Eulerian has no surface; with law = "none" a free shape passes through it.
TEST(FreeRigidBodies, PassThroughBodiesWithoutContact) {
  Simulation s = build(read_case_text(R"toml(title = "A stone passes through a block"
[run]
end = "0.3 ms"
[[body]]
name = "floor"
shape = { box = { min = ["0 mm", "-8 mm"], max = ["40 mm", "0 mm"] }, spacing = "2 mm", placement = "cell_centred" }
material = { law = "neo_hookean", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.4 }
formulation = { name = "nodal" }
[[body]]
name = "block"
shape = { box = { min = ["60 mm", "-8 mm"], max = ["80 mm", "20 mm"] }, spacing = "2 mm", placement = "cell_centred" }
material = { law = "elastic", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.4 }
formulation = { name = "adaptle" }
[[rigid]]
name = "stone"
box = { min = ["10 mm", "0.1 mm"], max = ["50 mm", "20 mm"] }
motion = "free"
mass = "1 kg/m"
velocity = ["100 m/s", "-2 m/s"]
[[contact]]
between = ["block", "stone"]
law = "none"
)toml",
                                      "case.toml"));
  double time = 0, touched = 0;
  while (time < s.spec.run.end) {
    double const dt = s.formulation->stable_time_step();
    s.formulation->step(time, dt);
    time += dt;
    touched = std::max(touched, column(s.formulation->diagnose(), "contact_points"));
  }
  Diagnostics const d = s.formulation->diagnose();
  EXPECT_GT(touched, 0) << "the floor pushes it";
  EXPECT_NEAR(d.rigids.at(0).centre[0], 0.03 + 100 * time, 1e-3) << "nothing stops it";
  ASSERT_EQ(d.bodies.size(), 2U);
  EXPECT_NEAR(d.bodies[1].linear_momentum[0], 0, 1e-9);
}

TEST(FreeRigidBodies, NeedASurfaceToPush) {
  Assembly a = bouncing(Kind::box, 0, {"0", "0", "0"}, 1);
  a.surfaces.clear();
  EXPECT_NE(refusal(a).find("no body has one"), std::string::npos);
}

}  // namespace
}  // namespace piola
