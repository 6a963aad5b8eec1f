// SPDX-License-Identifier: Apache-2.0
#include "formulations/mirrored_parts.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include <numbers>

namespace piola::testing {
namespace {

using Placement = ShapeSpec::Placement;

/// A motion that planes through the origin mirror. It is gentle: tens of percent amplify what differs a thousand times.
void stir(Assembly& a) {
  give_velocity(a, [](Point const& X) {
    return Point{-2 * X[0] * (1 + X[1] * X[1] - X[2] * X[2]), -3 * X[1] * (1 + X[0] * X[0]), 0.9 * X[2] * X[0] * X[0]};
  });
  displace(a, [](Point const& X) { return Point{-0.02 * X[0], -0.01 * X[1] * X[0] * X[0], 0.01 * X[2]}; });
}

struct Differences {
  double F, v;
};
/// After some steps, of `part` and `whole`.
Differences after_steps(Assembly const& part, Assembly const& whole, double dt) {
  auto const f = make_formulation(part), g = make_formulation(whole);
  advance(*f, dt, 20);
  advance(*g, dt, 20);
  double const times = static_cast<double>(whole.particles.X.size()) / static_cast<double>(part.particles.X.size());
  if (part.particles.X.size() == whole.particles.X.size() || times == std::round(times)) {
    EXPECT_NEAR(times * f->diagnose().kinetic_energy / g->diagnose().kinetic_energy, 1, 1e-5);
    EXPECT_NEAR(times * f->diagnose().strain_energy / g->diagnose().strain_energy, 1, 1e-5);
  }
  return {apart(part, *f, whole, *g, "DeformationGradient", 9), apart(part, *f, whole, *g, "Velocity", 3)};
}

struct Halves {
  Assembly whole, part;
};
/// A cube of 2 n particles across about the origin, and the corner of it that `planes` leave.
Halves halves(int dimension, int planes, Placement placement) {
  std::array<int, 3> n{8, 8, 8}, rest = n;  // the points of cells have the same sign in the part and in the whole
  Point low{-1, -1, -1}, zero = low;
  for (auto c = static_cast<std::size_t>(0); c < 3; ++c) {
    if (placement == Placement::on_boundary) n[c] = rest[c] = n[c] + 1;
    if (c >= static_cast<std::size_t>(planes)) continue;
    zero[c] = 0;
    rest[c] = (n[c] + 1) / 2;
  }
  Halves h{nodal_body(box_between(dimension, low, {1, 1, 1}, n, placement)),
           nodal_body(box_between(dimension, zero, {1, 1, 1}, rest, placement))};
  for (int axis = 0; axis < planes; ++axis) h.part.mirrors.push_back({0, axis, false});
  return h;
}

/// A pressure on a face of a body of cells.
void press(Assembly& a, int axis, bool upper, double pressure, bool follows) {
  Load load;
  load.value = {Expression(std::to_string(pressure)), Expression("0"), Expression("0")};
  load.pressure = true;
  load.follows = follows;
  load.normal = Point{};
  auto const c = static_cast<std::size_t>(axis);
  (*load.normal)[c] = upper ? 1 : -1;
  Body const& body = a.particles.bodies[0];
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    double const X = a.particles.X[k][c];
    if ((upper ? body.outline.max[c] - X : X - body.outline.min[c]) > 0.9 * body.spacing[c]) continue;
    load.particles.push_back(static_cast<std::int64_t>(k));
  }
  double area = 1;  // of the face, in equal parts
  for (std::size_t d = 0; d < static_cast<std::size_t>(a.particles.dimension); ++d)
    if (d != c) area *= body.outline.max[d] - body.outline.min[d];
  for (std::int64_t const id : load.particles)
    load.factor.push_back(area / (static_cast<double>(load.particles.size()) * rubber().value[0] *
                                  a.particles.volume[static_cast<std::size_t>(id)]));
  a.loads.push_back(load);
}

/// With the plane between particles all cells and their points are mirrored: the same to round-off.
TEST(NodalMirror, APartMovesAsTheWholeWithThePlaneBetweenParticles) {
  for (int const D : {1, 2, 3})
    for (int planes = 1; planes <= D; ++planes) {
      Halves h = halves(D, planes, Placement::cell_centred);
      for (Assembly* a : {&h.whole, &h.part}) stir(*a);
      double const dt = 0.5 * make_formulation(h.whole)->stable_time_step();
      EXPECT_NEAR(make_formulation(h.part)->stable_time_step() / (2 * dt), 1, 0.05);  // the same operator, fewer modes
      Differences const d = after_steps(h.part, h.whole, dt);
      EXPECT_LT(d.F, 1e-10) << D << planes;
      EXPECT_LT(d.v, 1e-8) << D << planes;
    }
}

/// Particles on the plane: their four points are not mirrored in the whole body, which is off by as much.
TEST(NodalMirror, APartMovesAsTheWholeWithParticlesOnThePlane) {
  for (int const D : {1, 2, 3})
    for (int planes = 1; planes <= D; ++planes) {
      Halves h = halves(D, planes, Placement::on_boundary);
      for (Assembly* a : {&h.whole, &h.part}) stir(*a);
      auto const f = make_formulation(h.part), g = make_formulation(h.whole);
      double const dt = 0.5 * g->stable_time_step();
      advance(*f, dt, 40);
      advance(*g, dt, 40);
      // In 1D and 2D the points of a cell are symmetric.
      EXPECT_LT(apart(h.part, *f, h.whole, *g, "DeformationGradient", 9), D == 3 ? 1e-4 : 1e-9) << D << planes;
      auto const d = f->diagnose(), e = g->diagnose();
      double const times = 1 << planes;
      EXPECT_NEAR(times * d.kinetic_energy / e.kinetic_energy, 1, D == 3 ? 1e-5 : 1e-9);
      EXPECT_NEAR(times * d.strain_energy / e.strain_energy, 1, D == 3 ? 1e-4 : 1e-9);
      Values const x = sample(*f, "Position", h.part.particles.X.size());
      for (std::size_t k = 0; k < h.part.particles.X.size(); ++k)
        if (h.part.particles.X[k][0] == 0) {
          EXPECT_EQ(x[3 * k], 0);
        }
    }
}

/// Forces are minus the derivative of the energy of the part, with images that follow.
TEST(NodalMirror, ForcesAreMinusTheDerivativeOfTheEnergy) {
  for (auto const placement : {Placement::cell_centred, Placement::on_boundary}) {
    Assembly a = nodal_body(box_between(3, {}, {1, 1, 1}, {3, 3, 4}, placement));
    a.mirrors = {{0, 0, false}, {0, 1, true}};
    displace(a, [](Point const& X) {
      return Point{0.2 * X[0] * X[0] + 0.1 * X[0] * X[2], 0.1 * (1 - X[1]) * X[0], 0.2 * X[0] * X[2] + 0.1 * X[1]};
    });
    double const still = make_formulation(a)->diagnose().strain_energy;
    ASSERT_GT(still, 0);
    std::size_t const n = a.particles.X.size();
    auto const rate = saved(*make_formulation(a)).values.at("body0_acceleration");
    // Masses from the kinetic energy of one particle at a time.
    for (std::size_t const k : {0UL, 7UL, 17UL, n - 1})
      for (std::size_t c = 0; c < 3; ++c) {
        Assembly b = a;
        b.initial_velocity.assign(n, Point{});
        b.initial_velocity[k][2] = 1;
        double const mass = 2 * make_formulation(b)->diagnose().kinetic_energy;
        b = a;
        auto const moved = [&](double by) {
          b.initial_displacement[k][c] = a.initial_displacement[k][c] + by;
          return make_formulation(b)->diagnose().strain_energy;
        };
        constexpr double step = 1e-5;
        double const force = -(moved(step) - moved(-step)) / (2 * step);
        EXPECT_NEAR(mass * rate[3 * k + c], force, 1e-6 * still) << k << c;
      }
  }
}

/// A uniformly swollen part is in equilibrium under the pressure of its law: along, across and away from the planes.
TEST(NodalMirror, PatchTest) {
  constexpr double swelling = 1.2;
  Mat<3> F = identity<3>();
  for (int c = 0; c < 3; ++c) F(c, c) = swelling;
  double const pressure = -NeoHookean(rubber().value).pressure(F);
  for (auto const placement : {Placement::cell_centred, Placement::on_boundary})
    for (double const jitter : {0.0, 0.3}) {
      Assembly a = nodal_body(box_between(3, {}, {1, 1.2, 1}, {4, 5, 4}, placement, jitter));
      a.cfl = 0.1;
      for (int axis = 0; axis < 3; ++axis) a.mirrors.push_back({0, axis, false});
      auto const rate = [&] { return largest(saved(*make_formulation(a)).values.at("body0_acceleration")); };
      double const at_rest = rate();
      displace(a, [](Point const& X) {
        return Point{(swelling - 1) * X[0], (swelling - 1) * X[1], (swelling - 1) * X[2]};
      });
      double const without = rate();
      EXPECT_LT(at_rest, 1e-9 * without);
      for (int axis = 0; axis < 3; ++axis) press(a, axis, true, pressure, true);
      EXPECT_LT(rate(), 5e-3 * without) << jitter;
    }
}

TEST(NodalMirror, ABodyFallsAndTurnsAlongItsPlane) {
  Assembly a = nodal_body(box_between(3, {0, -1, -1}, {1, 1, 1}, {3, 5, 5}, Placement::cell_centred));
  a.mirrors.push_back({0, 0, false});
  give_velocity(a, [](Point const& X) { return Point{0, -40 * X[2], 40 * X[1]}; });
  load(a, {"0", "-10", "0"}, everywhere);
  auto const f = make_formulation(a);
  auto const before = f->diagnose();
  double t = 0;
  while (t < 0.02) {
    double const dt = f->stable_time_step();
    f->step(t, dt);
    t += dt;
  }
  auto const after = f->diagnose();
  EXPECT_NEAR(after.linear_momentum[1], -10 * t * 1100 * 4, 1e-9 * 1100 * 4 * 40);
  double const energy = after.kinetic_energy + after.strain_energy - after.external_work;
  EXPECT_NEAR(energy / (before.kinetic_energy + before.strain_energy), 1, 1e-3);
}

/// Between two planes images have images.
TEST(NodalMirror, AThinPartBetweenTwoPlanesMovesAsALongOne) {
  Assembly part = nodal_body(box_between(2, {}, {1, 1, 0}, {3, 4, 1}, Placement::cell_centred)),
           whole = nodal_body(box_between(2, {}, {4, 1, 0}, {12, 4, 1}, Placement::cell_centred));
  for (Assembly* a : {&part, &whole}) {
    a->mirrors = {{0, 0, true}, {0, 0, false}};
    give_velocity(*a, [](Point const& X) {
      double const s = std::sin(std::numbers::pi * X[0]), c = std::cos(std::numbers::pi * X[0]);
      return Point{9 * s * (1 + X[1]), 20 * X[1] * X[1] * c, 0};
    });
  }
  auto const f = make_formulation(part), g = make_formulation(whole);
  double const dt = 0.5 * g->stable_time_step();
  advance(*f, dt, 20);
  advance(*g, dt, 20);
  double const speed = largest(sample(*f, "Velocity", part.particles.X.size()));
  // The divergence theorem is solved to a thousandth.
  EXPECT_LT(apart(part, *f, whole, *g, "Velocity", 3), 1e-3 * speed);
}

TEST(NodalMirror, PressuresOnAPartAreThoseOnTheWhole) {
  Halves h = halves(2, 2, Placement::cell_centred);
  for (Assembly* a : {&h.whole, &h.part}) press(*a, 0, true, 1e5, false);
  press(h.whole, 0, false, 1e5, false);  // the whole body on both sides
  auto const f = make_formulation(h.part), g = make_formulation(h.whole);
  double const dt = 0.5 * g->stable_time_step();
  advance(*f, dt, 30);
  advance(*g, dt, 30);
  double const speed = largest(sample(*f, "Velocity", h.part.particles.X.size()));
  EXPECT_GT(speed, 0);
  EXPECT_LT(apart(h.part, *f, h.whole, *g, "Velocity", 3), 1e-6 * speed);
  EXPECT_NEAR(4 * f->diagnose().external_work / g->diagnose().external_work, 1, 1e-6);
}

TEST(NodalMirror, RunsContinueAndRepeatWithTheSameBits) {
  for (auto const placement : {Placement::cell_centred, Placement::on_boundary})
    expect_same_bits_of_runs([&] {
      int const D = placement == Placement::on_boundary ? 2 : 3;
      Assembly a = nodal_body(box_between(D, {}, {1, 1, 1}, {4, 4, 4}, placement));
      a.mirrors = {{0, 0, false}, {0, 1, true}};
      if (D == 2) a.mirrors.push_back({0, 1, false});  // without end
      give_velocity(a, [](Point const& X) { return Point{9 * X[0], 3 - X[1] * X[1], X[2]}; });
      return a;
    });
}

TEST(NodalMirror, GivesTheSameOnEveryMachine) {
  Assembly a = nodal_body(box_between(3, {}, {1, 1, 1}, {4, 5, 4}, Placement::on_boundary));
  for (int axis = 0; axis < 3; ++axis) a.mirrors.push_back({0, axis, false});
  give_velocity(a, [](Point const& X) { return Point{9 * X[0], -3 * X[1], X[2]}; });
  std::vector<Values> ends;
  for (auto const& backend : backends()) {
    a.backend = backend;
    auto const f = make_formulation(a);
    advance(*f, 1e-5, 20);
    ends.push_back(sample(*f, "Velocity", a.particles.X.size()));
    EXPECT_LT(largest_difference(ends.back(), ends.front()), 1e-9) << backend;
  }
}

TEST(NodalMirror, SkewPlanesAreRefused) {
  Assembly a = nodal_body(box_between(2, {}, {1, 1, 0}, {6, 6, 1}, Placement::on_boundary));
  a.mirrors = {{0, 0, false, true}};
  EXPECT_NE(refusal(a).find("antisymmetric mirror plane"), std::string::npos) << refusal(a);
  a.mirrors = {{0, 2, false, false}};
  EXPECT_NE(refusal(a).find("across Z in 2 dimensions"), std::string::npos) << refusal(a);
  a.mirrors = {{0, 0, false, false}};
  EXPECT_EQ(refusal(a), "");
}

}  // namespace
}  // namespace piola::testing
