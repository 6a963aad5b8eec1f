// SPDX-License-Identifier: Apache-2.0
// Forces, torques, springs and dashpots of free rigid shapes against closed forms, with their energies.
#include "piola/base/text.hpp"
#include "piola/math/quaternion.hpp"
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "verification/surface_bodies.hpp"
#include <cmath>

namespace piola {
namespace {

using testing::column;

/// A block far off, which has a surface that free shapes need, and further sections.
Simulation scene(std::string const& more, double step) {
  return build(read_case_text(
      "title = \"t\"\n[run]\nend = 1\nthreads = 1\nmax_step = " + exact_text(step) +
          "\n[[body]]\nname = \"block\"\nshape = { box = { min = [90, 90, 90], max = [91, 91, 91] }, spacing = 0.5 }\n"
          "material = { law = \"neo_hookean\", density = 1000, youngs_modulus = 1e3, poissons_ratio = 0.3 }\n"
          "formulation = { name = \"nodal\" }\n" +
          more,
      "case.toml"));
}

std::string ball(std::string const& name, std::string const& centre, std::string const& more) {
  return "[[rigid]]\nname = \"" + name + "\"\nsphere = { centre = " + centre + ", radius = 0.1 }\nmotion = \"free\"\n" +
         more + "\n";
}

/// Runs to a time with steps of max_step; `look` sees each state.
template <class Look>
void run(Simulation& s, double until, Look const& look) {
  auto const steps = static_cast<int>(std::lround(until / s.spec.run.max_step));
  double const dt = until / steps;
  ASSERT_LE(dt, s.formulation->stable_time_step());
  for (int k = 0; k < steps; ++k) {
    s.formulation->step(k * dt, dt);
    look((k + 1) * dt, s.formulation->diagnose());
  }
}
Diagnostics run(Simulation& s, double until) {
  Diagnostics last;
  run(s, until, [&](double, Diagnostics const& d) { last = d; });
  return last;
}

TEST(ForcesOnRigidShapes, ConstantOneMovesByFttOver2m) {
  Simulation s = scene(ball("ball", "[0, 0, 0]", "mass = 2\nforce = [\"6 N\", -1, 0]"), 0.01);
  Diagnostics const d = run(s, 1);
  EXPECT_NEAR(d.rigids[0].centre[0], 6.0 / (2 * 2), 1e-13);
  EXPECT_NEAR(d.rigids[0].centre[1], -1.0 / (2 * 2), 1e-13);
  EXPECT_NEAR(d.kinetic_energy, 37.0 / (2 * 2), 1e-12);
  EXPECT_NEAR(d.external_work, d.kinetic_energy, 1e-12);
}

TEST(ForcesOnRigidShapes, TableGivesItsImpulseAndHeldDirectionsKeepTheirVelocity) {
  Simulation s = scene(ball("ball", "[0, 0, 0]",
                            "mass = 2\nvelocity = [0, 3, 0]\nfix = \"y\"\n"
                            "force = [{ table = [[0, 0], [0.4, 10], [1, 0]] }, 50, 0]"),
                       0.01);
  double const before = s.formulation->diagnose().kinetic_energy;
  Diagnostics const d = run(s, 1);
  EXPECT_NEAR(d.rigids[0].velocity[0], 5.0 / 2, 1e-13);
  EXPECT_NEAR(d.rigids[0].velocity[1], 3, 0);
  EXPECT_NEAR(d.external_work, d.kinetic_energy - before, 1e-12);
}

/// M about the principal axis z of a body that starts at rest: angle M t^2/(2 I), work M angle.
TEST(TorquesOnRigidShapes, ConstantOneAboutAPrincipalAxisTurnsByMttOver2I) {
  for (std::string const axes : {"space", "body"}) {
    Simulation s = scene(
        "[[rigid]]\nname = \"brick\"\nbox = { min = [-1, -2, -3], max = [1, 2, 3] }\nmotion = \"free\"\n"
        "mass = 3\ntorque = [0, 0, \"4 N m\"]\ntorque_axes = \"" +
            axes + "\"\n",
        0.01);
    Diagnostics const d = run(s, 1);
    double const I = 3.0 / 3 * (1 + 4);
    EXPECT_NEAR(d.rigids[0].turn[2], 4 / (2 * I), 1e-12);
    EXPECT_NEAR(d.rigids[0].rotational_energy, 16 / (2 * I), 1e-12);
    EXPECT_NEAR(d.external_work, d.rigids[0].rotational_energy, 1e-12);
  }
}

/// Euler's equations of a symmetric top (I1 = I2 = A, I3 = C) with a constant torque M about its axis of symmetry:
/// w3 = w30 + M t/C, and w1 + i w2 turns in the body at the rate (C - A)/A w3, with constant size.
TEST(TorquesOnRigidShapes, SpunTopFollowsEulersEquations) {
  constexpr double A = 2, C = 3, M = 1.5, w1 = 0.7, w3 = 2;
  auto const energies = [&](double step) {
    Simulation s = scene(ball("top", "[0, 0, 0]",
                              "mass = 1\ninertia = [2, 2, 3]\nangular_velocity = [0.7, 0, 2]\n"
                              "torque = [0, 0, 1.5]\ntorque_axes = \"body\""),
                         step);
    return run(s, 1);
  };
  Diagnostics const d = energies(0.002);
  double const last = w3 + M / C, energy = 0.5 * (A * w1 * w1 + C * last * last);
  EXPECT_NEAR(d.rigids[0].rotational_energy, energy, 1e-6 * energy);
  EXPECT_NEAR(d.external_work, d.rigids[0].rotational_energy - 0.5 * (A * w1 * w1 + C * w3 * w3), 1e-5 * energy);
  // In space: w = R (body components). The angle in the body is (C - A)/A (w30 t + M t^2/(2 C)).
  double const phase = (C - A) / A * (w3 + M / (2 * C));
  Vec<3> const body{{w1 * std::cos(phase), w1 * std::sin(phase), last}};
  Vec<3> const turn{{d.rigids[0].turn[0], d.rigids[0].turn[1], d.rigids[0].turn[2]}};
  Vec<3> const space = matrix_of(turn_by(turn)) * body;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(d.rigids[0].angular_velocity[static_cast<std::size_t>(c)], space[c], 2e-5) << c;
}

TEST(SpringsOfRigidShapes, DampedMassFollowsItsClosedForm) {
  // m x'' + c x' + k (x - x0) = 0, from the elongation 0.3 at rest: w0 = 5, zeta = 0.1.
  constexpr double m = 2, k = 50, c = 2, start = 0.3;
  constexpr double w0 = 5, zeta = c / (2 * m * w0);
  double const wd = w0 * std::sqrt(1 - zeta * zeta);
  auto const error_with = [&](double step) {
    Simulation s = scene(ball("ball", "[1.3, 0, 0]", "mass = 2") +
                             "[[spring]]\nname = \"leg\"\nbetween = [\"ball\"]\npoints = [[1.3, 0, 0], [0, 0, 0]]\n"
                             "stiffness = 50\ndamping = 2\nrest_length = 1\n",
                         step);
    double const before = s.formulation->diagnose().total_energy();
    EXPECT_NEAR(before, 0.5 * k * start * start, 1e-13);
    double error = 0, drift = 0;
    run(s, 1.6, [&](double t, Diagnostics const& d) {
      double const x = start * std::exp(-zeta * w0 * t) * (std::cos(wd * t) + zeta * w0 / wd * std::sin(wd * t));
      error = std::max(error, std::abs(d.rigids[0].centre[0] - 1 - x));
      drift = std::max(drift, std::abs(d.total_energy() + column(d, "dashpot_loss") - before));
      EXPECT_EQ(d.damping_loss, column(d, "dashpot_loss"));
    });
    EXPECT_LT(drift, 0.02 * before * (step / 0.02) * (step / 0.02));
    return error;
  };
  double const coarse = error_with(0.02), fine = error_with(0.01);
  EXPECT_LT(fine, 4e-4 * start) << "a period is (w h)^2/24 too short: 1e-4, over 1.3 periods";
  EXPECT_NEAR(coarse / fine, 4, 0.2) << "second order";
}

TEST(SpringsOfRigidShapes, TwoBodiesVibrateWithTheirReducedMass) {
  Simulation s = scene(ball("a", "[0, 0, 0]", "mass = 1\nvelocity = [0, 0.2, 0]") +
                           ball("b", "[1.2, 0, 0]", "mass = 3\nvelocity = [0, 0.2, 0]") +
                           "[[spring]]\nbetween = [\"a\", \"b\"]\npoints = [[0, 0, 0], [1.2, 0, 0]]\nstiffness = 75\n"
                           "rest_length = 1\n",
                       0.0005);
  double const before = s.formulation->diagnose().total_energy();
  double const period = 2 * std::numbers::pi / std::sqrt(75 / 0.75);
  double force = 0;
  run(s, std::lround(period / 0.0005) * 0.0005, [&](double t, Diagnostics const& d) {
    double const x = 1 + 0.2 * std::cos(10 * t);
    EXPECT_NEAR(d.rigids[1].centre[0] - d.rigids[0].centre[0], x, 1e-5);
    EXPECT_NEAR(d.linear_momentum[0], 0, 1e-13);
    EXPECT_NEAR(d.linear_momentum[1], 4 * 0.2, 1e-13);
    EXPECT_NEAR(d.total_energy(), before, 1e-5 * before);
    for (Action const& action : d.actions)
      if (action.name == "spring_0") force = action.force[0];
    EXPECT_NEAR(force, 75 * (x - 1), 75 * 2 * 0.0005 * 1.01) << "the mean of the step";
  });
  EXPECT_GT(std::abs(force), 1);
}

/// A rod hangs by its end from a spring without length far stiffer than its weight: a compound pendulum.
TEST(SpringsOfRigidShapes, HoldABodyByAPointBesideItsCentre) {
  Simulation s = scene(
      "[[rigid]]\nname = \"rod\"\nbox = { min = [-0.05, -1, -0.05], max = [0.05, 0, 0.05] }\n"
      "motion = \"free\"\nmass = 1\ngravity = [0.01, -9.81, 0]\n"
      "[[spring]]\nbetween = [\"rod\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nstiffness = 1e5\nrest_length = 0\n",
      2e-4);
  double const inertia = 1.0 / 12 * (1 + 0.01) + 0.25, w = std::sqrt(9.81 * 0.5 / inertia);
  Diagnostics const d = run(s, 1);
  double const angle = 0.01 / 9.81 * (1 - std::cos(w));
  EXPECT_NEAR(d.rigids[0].turn[2], angle, 2e-3 * angle);
}

TEST(SpringsOfRigidShapes, CarryTheWorkOfADrivenShape) {
  // A driven plate pulls a mass by a spring and a dashpot: x_m in closed form is not needed for the energies.
  Simulation s =
      scene(ball("mass", "[1, 0, 0]", "mass = 2") +
                "[[rigid]]\nname = \"hand\"\nsphere = { centre = [3, 0, 0], radius = 0.1 }\n"
                "velocity = [\"sin(3*t)\", 0, 0]\nangular_velocity = [0, 0, 1]\n"
                "[[spring]]\nbetween = [\"mass\", \"hand\"]\npoints = [[1, 0, 0], [3, 0.1, 0]]\nstiffness = 40\n"
                "damping = 5\n",
            0.001);
  double drift = 0, work = 0;
  run(s, 2, [&](double, Diagnostics const& d) {
    work = d.external_work;
    drift = std::max(drift, std::abs(d.total_energy() + column(d, "dashpot_loss") - work));
  });
  EXPECT_GT(work, 0.1);
  EXPECT_LT(drift, 2e-4 * work);
}

TEST(SpringsOfRigidShapes, LimitTheStepAndResumeBitForBit) {
  Simulation s =
      scene(ball("ball", "[1, 0, 0]", "mass = 2\nvelocity = [1, 2, 0]\nangular_velocity = [1, 2, 3]") +
                "[[spring]]\nbetween = [\"ball\"]\npoints = [[1, 0.1, 0], [0, 0, 0]]\nstiffness = \"2e8 N/m\"\n"
                "damping = 1e3\n",
            1);
  double const w2 = 2e8 * (1.0 / 2 + 2 * 0.01 / (0.4 * 2 * 0.01));
  EXPECT_NEAR(s.formulation->stable_time_step(), 0.3 / std::sqrt(w2), 0.01 * 0.3 / std::sqrt(w2));
  double time = 0;
  auto const go = [](Formulation& f, double& t) {
    for (int k = 0; k < 7; ++k) {
      double const dt = f.stable_time_step();
      f.step(t, dt);
      t += dt;
    }
  };
  go(*s.formulation, time);
  testing::expect_resumes(assemble(s.spec, s.particles), *s.formulation, time, go);
}

}  // namespace
}  // namespace piola
