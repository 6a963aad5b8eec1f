// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/body_extents.hpp"
#include "piola/setup/faces.hpp"
#include "formulations/copper.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include <numbers>

namespace piola::testing {
namespace {

using Placement = ShapeSpec::Placement;

/// A half section from (low, 0) to (high, 1.2), or a disc: cylinders, tubes, balls and tori.
ShapeSpec section(double low, double high, Placement placement, double jitter = 0) {
  ShapeSpec shape;
  shape.dimension = 2;
  shape.axisymmetric = true;
  shape.min = {low, 0, 0};
  shape.max = {high, 1.2, 0};
  shape.particles = {5, 6, 1};
  shape.placement = placement;
  shape.jitter = jitter;
  return shape;
}
ShapeSpec disc(double centre) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.dimension = 2;
  shape.axisymmetric = true;
  shape.centre = {centre, 0, 0};
  shape.radius = 1;
  shape.spacing = 0.2;
  return shape;
}

Assembly ring_body(ShapeSpec const& shape) {
  ParticleSet set;
  set.axisymmetric = true;
  fill(shape, "ring", set);
  Assembly a = nodal_body(std::move(set));
  if (touches_axis(a.particles, a.particles.bodies[0])) a.mirrors.push_back({0, 0, false});
  a.cfl = 0.1;
  return a;
}

/// Cylinders with particles on the axis and half a cell beside it, a tube; lattices and jittered.
std::vector<ShapeSpec> sections() {
  std::vector<ShapeSpec> all;
  for (double const jitter : {0.0, 0.35}) {
    all.push_back(section(0, 1, Placement::on_boundary, jitter));
    all.push_back(section(0, 1, Placement::cell_centred, jitter));
    all.push_back(section(1, 2, Placement::on_boundary, jitter));
  }
  return all;
}

/// r = s R, z = q Z + 0.1.
void stretch(Assembly& a, double s, double q) {
  displace(a, [&](Point const& X) { return Point{(s - 1) * X[0], (q - 1) * X[1] + 0.1, 0}; });
}

/// An uneven motion that keeps the axis, so that points of one cell differ.
void bend(Assembly& a) {
  displace(a, [](Point const& X) {
    return Point{X[0] * (0.1 + 0.08 * X[1] - 0.06 * X[0] * X[0]), 0.05 * X[1] + 0.1 * X[0] * X[0] - 0.03 * X[1] * X[1],
                 0};
  });
}

/// Accelerations times masses, which the kinetic energy of single particles gives [N].
std::vector<Point> ring_forces(Assembly const& a) {
  std::size_t const n = a.particles.X.size();
  auto const rate = saved(*make_formulation(a)).values.at("body0_acceleration");
  std::vector<Point> force(n);
  for (std::size_t k = 0; k < n; ++k) {
    Assembly b = a;
    b.initial_velocity.assign(n, Point{});
    b.initial_velocity[k][1] = 1;
    double const mass = 2 * make_formulation(b)->diagnose().kinetic_energy;
    for (std::size_t c = 0; c < 2; ++c) force[k][c] = mass * rate[2 * k + c];
  }
  return force;
}

TEST(NodalAxisymmetry, VolumesAndMassesAreThoseOfTheFullCircle) {
  struct Whole {
    ShapeSpec shape;
    double volume;
  };
  for (Whole const& whole : {Whole{section(0, 1, Placement::on_boundary), 1.2 * std::numbers::pi},
                             Whole{section(0, 1, Placement::cell_centred), 1.2 * std::numbers::pi},
                             Whole{section(1, 2, Placement::on_boundary, 0.3), 3.6 * std::numbers::pi}}) {
    Assembly a = ring_body(whole.shape);
    give_velocity(a, [](Point const&) { return Point{0, 2, 0}; });
    EXPECT_NEAR(make_formulation(a)->diagnose().kinetic_energy, 2 * 1100 * whole.volume, 1e-9 * 1100 * whole.volume);
    double sum = 0;
    for (double const v : a.particles.volume) sum += v;
    EXPECT_NEAR(sum, whole.volume, whole.shape.jitter > 0 ? 0.02 * whole.volume : 1e-12);
  }
}

TEST(NodalAxisymmetry, GradientsFulfilTheDivergenceTheoremOfRings) {
  auto all = sections();
  all.push_back(disc(0));
  all.push_back(disc(1.5));
  for (ShapeSpec const& shape : all) {
    auto const checks = make_formulation(ring_body(shape))->statistics().set_up_checks;
    for (auto const* name : {"ring.divergence_error", "ring.gradient_error"}) {
      auto const found = std::ranges::find(checks, name, &SetUpCheck::name);
      ASSERT_NE(found, checks.end());
      EXPECT_LT(found->value, 1e-10) << name;
    }
  }
}

TEST(NodalAxisymmetry, UniformStretchesAreExact) {
  for (ShapeSpec const& shape : sections()) {
    Assembly a = ring_body(shape);
    stretch(a, 1.3, 0.8);
    std::size_t const n = a.particles.X.size();
    auto const F = sample(*make_formulation(a), "DeformationGradient", n);
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(F[9 * k], 1.3, 1e-11);
      EXPECT_NEAR(F[9 * k + 4], 0.8, 1e-11);
      EXPECT_NEAR(F[9 * k + 8], 1.3, 1e-11) << k;
      EXPECT_NEAR(F[9 * k + 1], 0, 1e-11);
      EXPECT_NEAR(F[9 * k + 3], 0, 1e-11);
    }
  }
}

TEST(NodalAxisymmetry, ForcesAreMinusTheDerivativeOfTheEnergy) {
  for (ShapeSpec const& shape : sections()) {
    Assembly a = ring_body(shape);
    bend(a);
    auto const force = ring_forces(a);
    std::size_t const n = a.particles.X.size();
    for (std::size_t const k : {std::size_t{0}, std::size_t{5}, n / 2, n / 2 + 1, n - 2})
      for (std::size_t c = 0; c < 2; ++c) {
        if (c == 0 && a.particles.X[k][0] == 0) {
          EXPECT_EQ(force[k][c], 0);
          continue;
        }
        Assembly b = a;
        constexpr double step = 5e-4;
        double slope = 0;
        for (auto const& [place, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
          b.initial_displacement[k][c] = a.initial_displacement[k][c] + place * step;
          slope -= weight * make_formulation(b)->diagnose().strain_energy / (12 * step);
        }
        EXPECT_NEAR(force[k][c], slope, 1e-8 * largest(force)) << k << " " << c;
      }
  }
}

/// A dead pressure on a face, as build.cpp makes it.
void press(Assembly& a, ShapeSpec const& shape, Face const& face, double pressure) {
  Load load;
  load.value = {Expression(std::to_string(pressure)), Expression("0"), Expression("0")};
  load.pressure = true;
  for (auto const& share : face_weights(shape, a.particles, a.particles.bodies[0], face)) {
    load.particles.push_back(share.particle);
    auto const id = static_cast<std::size_t>(share.particle);
    load.factor.push_back(share.area / (rubber().value[0] * a.particles.volume[id]));
    load.normal = share.normal;
  }
  a.loads.push_back(load);
}

TEST(NodalAxisymmetry, UniformStressIsInBalanceWithItsTractions) {
  for (ShapeSpec const& shape : sections()) {
    Assembly a = ring_body(shape);
    stretch(a, 1.2, 0.9);
    Mat<3> F = identity<3>();
    F(0, 0) = F(2, 2) = 1.2;
    F(1, 1) = 0.9;
    Mat<3> const P = NeoHookean(rubber().value).first_piola(F);
    auto const rate = [&] { return largest(ring_forces(a)); };
    double const without = rate();
    for (int axis = 0; axis < 2; ++axis)
      for (bool const upper : {false, true})
        if (axis == 1 || upper || shape.min[0] > 0) press(a, shape, {axis, upper}, -P(axis, axis));
    EXPECT_LT(rate(), 1e-9 * without) << shape.min[0] << " " << shape.jitter;
  }
}

TEST(NodalAxisymmetry, MotionAlongTheAxisKeepsMomentumAndForces) {
  for (ShapeSpec const& shape : sections()) {
    Assembly a = ring_body(shape);
    bend(a);
    auto const before = saved(*make_formulation(a)).values.at("body0_acceleration");
    for (auto& u : a.initial_displacement) u[1] += 3;
    auto const after = saved(*make_formulation(a)).values.at("body0_acceleration");
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(before[k], after[k], 1e-7 * (1 + std::fabs(before[k])));
    give_velocity(a, [](Point const& X) { return Point{2 * X[0] * X[1], 5 - X[0] * X[0], 0}; });
    double error[2];
    for (int half = 0; half < 2; ++half) {
      a.cfl = half == 0 ? 0.1 : 0.05;
      auto const f = make_formulation(a);
      auto const start = f->diagnose();
      advance(*f, f->stable_time_step(), half == 0 ? 50 : 100);
      auto const end = f->diagnose();
      EXPECT_NEAR(end.linear_momentum[1], start.linear_momentum[1], 1e-12 * std::fabs(start.linear_momentum[1]));
      error[half] = std::fabs(end.total_energy() / start.total_energy() - 1);
    }
    EXPECT_LT(error[1], 0.3 * error[0]) << "of second order in the step";
    EXPECT_LT(error[0], 1e-2);
  }
}

TEST(NodalAxisymmetry, SolidsInRateFormKeepTheHoopStretchOfTheLastStep) {
  // Uniform expansion r = s R, z = Z / s^2 of a metal below yield: hoop and radial stress stay equal.
  Assembly a = ring_body(section(0, 1, Placement::on_boundary));
  a.materials[0] = metals::copper();
  give_velocity(a, [](Point const& X) { return Point{X[0], -2 * X[1], 0}; });
  auto const f = make_formulation(a);
  double const dt = 1e-6;
  for (int k = 0; k < 5; ++k) f->step(k * dt, dt);
  auto const stress = sample(*f, "CauchyStress", a.particles.X.size());
  std::size_t inner = 0;
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    auto const& X = a.particles.X[k];
    if (X[0] > 0.5 || X[1] < 0.4 || X[1] > 0.8) continue;  // waves from the surface come later
    ++inner;
    double const rr = stress[6 * k], hoop = stress[6 * k + 2];
    EXPECT_GT(rr, 0);
    EXPECT_NEAR(hoop / rr, 1, 1e-3) << X[0];
  }
  EXPECT_GT(inner, 4U);
}

TEST(NodalAxisymmetry, RunsContinueAndRepeatWithTheSameBits) {
  for (bool const metal : {false, true})
    for (auto const placement : {Placement::cell_centred, Placement::on_boundary})
      expect_same_bits_of_runs([&] {
        Assembly a = ring_body(section(0, 1, placement, 0.2));
        if (metal) a.materials[0] = metals::copper();
        give_velocity(a, [](Point const& X) { return Point{90 * X[0] * X[1], 30 - 50 * X[0] * X[0], 0}; });
        return a;
      });
}

TEST(NodalAxisymmetry, GivesTheSameOnEveryMachine) {
  Assembly a = ring_body(section(0, 1, Placement::on_boundary, 0.3));
  give_velocity(a, [](Point const& X) { return Point{9 * X[0], -3 * X[1], 0}; });
  std::vector<Values> ends;
  for (auto const& backend : backends()) {
    a.backend = backend;
    auto const f = make_formulation(a);
    advance(*f, 1e-5, 20);
    ends.push_back(sample(*f, "Velocity", a.particles.X.size()));
    EXPECT_LT(largest_difference(ends.back(), ends.front()), 1e-9) << backend;
  }
}

TEST(NodalAxisymmetry, APressureThatFollowsHoldsASwollenTubeInBalance) {
  for (double const low : {0.0, 1.0}) {
    ShapeSpec const shape = section(low, low + 1, Placement::on_boundary);
    Assembly a = ring_body(shape);
    stretch(a, 1.2, 1.2);
    Mat<3> F = identity<3>();
    for (int c = 0; c < 3; ++c) F(c, c) = 1.2;
    double const pressure = -NeoHookean(rubber().value).pressure(F), without = largest(ring_forces(a));
    for (int axis = 0; axis < 2; ++axis)
      for (bool const upper : {false, true})
        if (axis == 1 || upper || low > 0) press(a, shape, {axis, upper}, pressure);
    for (auto& load : a.loads) load.follows = true;
    EXPECT_LT(largest(ring_forces(a)), 1e-9 * without) << low;
  }
}

TEST(NodalAxisymmetry, AHoleThatClosesIsAFailure) {
  ShapeSpec const shape = section(0.02, 1, Placement::on_boundary);
  Assembly a = ring_body(shape);
  give_velocity(a, [](Point const&) { return Point{-80, 0, 0}; });
  auto const f = make_formulation(a);
  for (int k = 0; k < 400 && !f->failure(); ++k) f->step(0, f->stable_time_step());
  ASSERT_TRUE(f->failure().has_value());
  EXPECT_NE(f->failure()->what.find("behind the axis"), std::string::npos) << f->failure()->what;
}

/// Far from the axis a ring is a body in plane strain.
TEST(NodalAxisymmetry, ARingFarFromTheAxisMovesAsInPlaneStrain) {
  constexpr double far = 1e6;
  ShapeSpec shape = section(far, far + 1, Placement::on_boundary);
  Assembly ring = ring_body(shape);
  ParticleSet set;
  shape.axisymmetric = false;
  fill(shape, "plane", set);
  Assembly plane = nodal_body(std::move(set));
  plane.cfl = ring.cfl;
  for (Assembly* a : {&ring, &plane})
    give_velocity(*a, [](Point const& X) { return Point{9 * (X[0] - far) * X[1], 5 * X[1], 0}; });
  std::vector<Values> ends;
  for (Assembly* a : {&ring, &plane}) {
    auto const f = make_formulation(*a);
    advance(*f, 1e-5, 100);
    ends.push_back(sample(*f, "Velocity", a->particles.X.size()));
  }
  double const speed = *std::ranges::max_element(ends[0]);
  // Masses of lattices in the plane are products of lines, those of rings transfers between cells.
  EXPECT_LT(largest_difference(ends[0], ends[1]), 0.05 * speed);
}

}  // namespace
}  // namespace piola::testing
