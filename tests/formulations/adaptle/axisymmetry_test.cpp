// SPDX-License-Identifier: Apache-2.0
// Axisymmetric bodies: rings about the axis x = 0, with images behind it.
#include "piola/formulations/adaptle/contact.hpp"
#include "formulations/adaptle/clouds.hpp"
#include <numbers>

namespace piola {
namespace {

using namespace testing;

using enum ShapeSpec::Placement;

/// A half section from (low, bottom) to (high, bottom + 1.2), half a spacing beside the axis or the faces.
ShapeSpec section(double low, double high, double jitter = 0, double bottom = 0) {
  ShapeSpec shape;
  shape.dimension = 2;
  shape.axisymmetric = true;
  shape.min = {low, bottom, 0};
  shape.max = {high, bottom + 1.2, 0};
  shape.particles = {10, 12, 1};
  shape.placement = cell_centred;
  shape.jitter = jitter;
  return shape;
}

/// The same with particles on the axis and the faces.
ShapeSpec on_axis(double jitter = 0) {
  ShapeSpec shape = section(0, 1, jitter);
  shape.placement = on_boundary;
  shape.particles = {11, 13, 1};
  return shape;
}

Assembly rings(std::vector<ShapeSpec> const& shapes) {
  ParticleSet set;
  set.axisymmetric = true;
  for (ShapeSpec const& shape : shapes) fill(shape, "ring" + std::to_string(set.bodies.size()), set);
  Assembly a = adaptle_assembly(std::move(set));
  for (std::size_t b = 0; b < shapes.size(); ++b) a.mirrors.push_back({b, 0, false});
  return a;
}

/// Force with that of the hoop stress: mass times acceleration.
double force(Cloud const& cloud, Index i, int c) { return cloud.mass(i) * value_at(cloud.system().field.a, i, c); }

struct RingBalance {
  double axial = 0, power = 0;  ///< sums over the sums of absolute values
};

RingBalance balance_of(Cloud const& cloud) {
  double axial = 0, power = 0, forces = 0, powers = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    Half const half = cloud.half(i);
    Sums const sums = cloud.sums(i);
    double const r = force(cloud, i, 0), z = force(cloud, i, 1);
    axial += z;
    forces += std::hypot(r, z);
    powers += std::hypot(r, z) * std::hypot(half.v[0], half.v[1]);
    power += r * half.v[0] + z * half.v[1] + cloud.state[i].energy_rate + sums.hourglass + sums.contact;
  }
  return {std::fabs(axial) / forces, std::fabs(power) / powers};
}

/// Random motion and stress; `eulerian`: share of Eulerian particles.
void make_random(Cloud& cloud, double eulerian) {
  shake_up(cloud, 2, 0.005);
  Random random(5);
  for (Index i = 0; i < cloud.size(); ++i) {
    State const s = cloud.state[i];
    s.x[0] = std::max(s.x[0], 0.02);
    if (cloud.X(i)[0] == 0) s.x[0] = s.v[0] = 0;
    if (random.in(0, 1) < eulerian) s.phi = 1;
    value_at(cloud.system().field.thickness, i) = 2 * std::numbers::pi * s.x[0] * random.in(0.9, 1.1);
  }
  cloud.changed();
}

TEST(AdaptleAxisymmetry, MassesAreThoseOfTheFullCircle) {
  for (ShapeSpec const& shape : {section(0, 1), on_axis()}) {
    Assembly a = rings({shape});
    choose(a, "description", "total_lagrangian");
    Cloud const cloud(a);
    double mass = 0;
    for (Index i = 0; i < cloud.size(); ++i) mass += cloud.mass(i);
    double const rho = cloud.particles->data().body_of(0).rho0;
    EXPECT_NEAR(mass, rho * 1.2 * std::numbers::pi, 1e-12 * mass);
  }
}

TEST(AdaptleAxisymmetry, AxialMomentumAndEnergyClose) {
  for (double const eulerian : {0.0, 0.5, 1.0})
    for (char const* form : {"central", "published"})
      for (double const jitter : {0.0, 0.2}) {
        Assembly a = rings({section(0, 1, jitter)});
        choose(a, "viscosity_form", form);
        choose(a, "artificial_stress", 0.3);
        Cloud cloud(a);
        make_random(cloud, eulerian);
        cloud.evaluate();
        ASSERT_EQ(cloud.particles->failure().index, FailureSlot::none);
        RingBalance const b = balance_of(cloud);
        EXPECT_LT(b.axial, 1e-14) << form << " " << eulerian << " " << jitter;
        EXPECT_LT(b.power, 1e-14) << form << " " << eulerian << " " << jitter;
      }
}

TEST(AdaptleAxisymmetry, AxialMomentumAndEnergyCloseOnTheAxis) {
  for (char const* form : {"central", "published"})
    for (double const jitter : {0.0, 0.2}) {
      Assembly a = rings({on_axis(jitter)});
      choose(a, "viscosity_form", form);
      choose(a, "description", "total_lagrangian");
      Cloud cloud(a);
      make_random(cloud, 0);
      cloud.evaluate();
      ASSERT_EQ(cloud.particles->failure().index, FailureSlot::none);
      RingBalance const b = balance_of(cloud);
      EXPECT_LT(b.axial, 1e-14) << form << " " << jitter;
      EXPECT_LT(b.power, 1e-14) << form << " " << jitter;
    }
}

TEST(AdaptleAxisymmetry, ContactKeepsAxialMomentumAndEnergy) {
  for (char const* law : {"kernel", "linear"})
    for (double const eulerian : {0.0, 1.0}) {
      Assembly a = rings({section(0, 1), section(0, 1, 0, 1.17)});
      a.contact.law = law[0] == 'k' ? ContactRule::Law::kernel : ContactRule::Law::linear;
      choose(a, "artificial_stress", 0.0);
      Cloud cloud(a);
      Random random(3);
      for (Index i = 0; i < cloud.size(); ++i) {
        for (int c = 0; c < 2; ++c) cloud.state[i].v[c] = random.in(-50, 50);
        cloud.state[i].phi = eulerian;
      }
      cloud.changed();
      cloud.evaluate();
      double power = 0;
      for (Index i = 0; i < cloud.size(); ++i) power += cloud.sums(i).contact;
      EXPECT_NE(power, 0);
      RingBalance const b = balance_of(cloud);
      EXPECT_LT(b.axial, 1e-14) << law;
      EXPECT_LT(b.power, 1e-14) << law;
    }
}

/// Contact of two bodies and with a wall [J], after a motion of all particles.
double contact_energy_after(Assembly a, double time) {
  displace(a, [&](Point const& X) {
    return Point{time * 30 * X[0] * (1 - X[1]), time * (20 - 40 * X[1] + 15 * X[0]), 0};
  });
  return Cloud(a).particles->energy_totals().contact_energy;
}

TEST(AdaptleAxisymmetry, PowerOfContactIsTheRateOfItsEnergy) {
  Assembly a = rings({section(0, 1), section(0, 1, 0, 1.25)});
  a.contact.law = ContactRule::Law::kernel;
  RigidShape wall;
  wall.kind = RigidShape::Kind::plane;
  wall.centre = {0, 0.02, 0};
  wall.axis = {0, 1, 0};
  wall.velocity = formulas({"0", "0", "0"});
  a.rigid_shapes.push_back(wall);
  constexpr double step = 1e-6;
  double const rate = (contact_energy_after(a, step) - contact_energy_after(a, -step)) / (2 * step);
  give_velocity(a, [](Point const& X) { return Point{30 * X[0] * (1 - X[1]), 20 - 40 * X[1] + 15 * X[0], 0}; });
  Cloud cloud(a);
  cloud.evaluate();
  double power = 0;
  for (Index i = 0; i < cloud.size(); ++i) power += cloud.sums(i).contact;
  EXPECT_NEAR(power, rate, 1e-6 * std::fabs(rate));
}

TEST(AdaptleAxisymmetry, DeformationOfLinearFieldsIsExact) {
  for (char const* form : {"central", "published"})
    for (ShapeSpec const& shape : {section(0, 1), section(0, 1, 0.3), on_axis(), on_axis(0.3)}) {
      Assembly a = rings({shape});
      choose(a, "description", "total_lagrangian");
      choose(a, "viscosity_form", form);
      displace(a, [](Point const& X) { return Point{0.1 * X[0], -0.05 * X[1] + 0.3, 0}; });
      Cloud cloud(a);
      cloud.evaluate();
      for (Index i = 0; i < cloud.size(); ++i) {
        Deformation const d = cloud.deformation(i);
        double const expected[9]{1.1, 0, 0, 0, 0.95, 0, 0, 0, 1.1};
        for (int c = 0; c < 9; ++c) EXPECT_NEAR(d.F[c], expected[c], 1e-10) << form << " " << i << " " << c;
      }
    }
}

/// Largest radial force that a uniform pressure leaves on rings with a complete neighbourhood, over the hoop force of
/// that ring.
double force_of_uniform_pressure(Cloud const& cloud) {
  double worst = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    Point const X = cloud.X(i);
    if (X[0] == 0 || X[0] > 0.7 || X[1] < 0.3 || X[1] > 0.9) continue;
    Half const half = cloud.half(i);
    double const hoop = half.pressure * cloud.mass(i) / half.rho / cloud.state[i].x[0];
    worst = std::max(worst, std::fabs(force(cloud, i, 0) / hoop));
  }
  return worst;
}

/// Both forms of viscosity, with particles beside the axis and on it.
std::vector<std::pair<std::string, ShapeSpec>> forms_and_sections() {
  return {{"central", section(0, 1)}, {"published", section(0, 1)}, {"central", on_axis()}, {"published", on_axis()}};
}

Assembly total_lagrangian_rings(std::string const& form, ShapeSpec const& shape) {
  Assembly a = rings({shape});
  choose(a, "description", "total_lagrangian");
  choose(a, "viscosity_form", form);
  return a;
}

TEST(AdaptleAxisymmetry, UniformPressureLeavesNoForceNearTheAxis) {
  for (auto const& [form, shape] : forms_and_sections()) {
    Assembly a = total_lagrangian_rings(form, shape);
    displace(a, [](Point const& X) { return Point{-0.01 * X[0], -0.01 * X[1], 0}; });
    Cloud cloud(a);
    cloud.evaluate();
    EXPECT_LT(force_of_uniform_pressure(cloud), 0.01) << form;
    System without = cloud.system();
    without.material.axis = {};
    adaptle::Backend const& backend = *adaptle::find_backend(a.backend.c_str());
    backend.predict(without, 1e-25);
    backend.deform(without);
    backend.half_state(without, 1e-25);
    backend.sweep(without);
    (void)backend.finish(without, 1e-25);
    EXPECT_GT(force_of_uniform_pressure(cloud), shape.placement == cell_centred ? 0.4 : 0.2) << form;
  }
}

/// Smallest and largest axial acceleration of the rings with a complete neighbourhood in a pressure that grows along
/// the axis, over the mean.
std::array<double, 2> spread_of_axial_acceleration(Cloud const& cloud) {
  double least = 1e300, most = -1e300, sum = 0, count = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    Point const X = cloud.X(i);
    if (X[0] > 0.7 || std::fabs(X[1] - 0.6) > 0.11) continue;
    double const a = value_at(cloud.system().field.a, i, 1);
    least = std::min(least, a);
    most = std::max(most, a);
    sum += a;
    count += 1;
  }
  return {least * count / sum, most * count / sum};
}

TEST(AdaptleAxisymmetry, APressureThatGrowsAlongTheAxisAcceleratesAllRingsAlike) {
  for (auto const& [form, shape] : forms_and_sections()) {
    Assembly a = total_lagrangian_rings(form, shape);
    displace(a, [](Point const& X) { return Point{0, -1e-3 * X[1] * X[1], 0}; });
    Cloud cloud(a);
    cloud.evaluate();
    auto const [least, most] = spread_of_axial_acceleration(cloud);
    EXPECT_GT(least, 0.92) << form << " " << (shape.placement == cell_centred);
    EXPECT_LT(most, 1.08) << form << " " << (shape.placement == cell_centred);
  }
}

TEST(AdaptleAxisymmetry, SectionsOfConvertedRingsFollowTheirVolume) {
  Assembly a = rings({section(0, 1)});
  choose_formula(a, "convert_when", "t > 0");
  displace(a, [](Point const& X) { return Point{0.1 * X[0], -0.05 * X[1], 0}; });
  Cloud cloud(a);
  cloud.evaluate();
  for (Index i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(cloud.state[i].phi, 1);
    double const around = value_at(cloud.system().field.thickness, i), radius = cloud.state[i].x[0];
    EXPECT_NEAR(around, 2 * std::numbers::pi * radius, 1e-12);
    EXPECT_NEAR(cloud.mass(i) / cloud.state[i].rho / around, 1.1 * 0.95 * 0.01, 1e-10);
  }
}

TEST(AdaptleAxisymmetry, EulerianRingsFillTheirKernelAtMost) {
  Assembly a = rings({section(0, 1)});
  choose(a, "description", "eulerian");
  Cloud cloud(a);
  double const h = cloud.particles->data().body_of(0).h, most = 4 * std::numbers::pi * h * h;
  for (Index i = 0; i < cloud.size(); ++i) {
    cloud.state[i].rho *= 1e-4;
    value_at(cloud.system().field.thickness, i) *= 1e-4;
  }
  cloud.changed();
  cloud.evaluate();
  for (Index i = 0; i < cloud.size(); ++i) {
    double const around = value_at(cloud.system().field.thickness, i);
    EXPECT_LE(cloud.mass(i) / cloud.state[i].rho, 2 * std::numbers::pi * cloud.state[i].x[0] * most * (1 + 1e-9));
    EXPECT_LE(cloud.mass(i) / cloud.state[i].rho / around, most * (1 + 1e-9));
  }
}

TEST(AdaptleAxisymmetry, RingsThatCrossTheAxisAreTurnedBack) {
  Assembly a = rings({section(0, 1)});
  choose(a, "description", "eulerian");
  Cloud cloud(a);
  for (Index i = 0; i < cloud.size(); ++i) cloud.state[i].v[0] = -3;
  cloud.changed();
  EXPECT_EQ(cloud.particles->energy_totals().axis_crossings, 0);
  cloud.particles->step(0, 0.04);
  for (Index i = 0; i < cloud.size(); ++i) EXPECT_GE(cloud.state[i].x[0], 0);
  EXPECT_GE(cloud.particles->energy_totals().axis_crossings, 12);  // those that began 0.05 from the axis
}

TEST(AdaptleAxisymmetry, AResumedRunIsTheSame) {
  Assembly a = rings({section(0, 1), section(0, 1, 0, 1.25)});
  a.contact.law = ContactRule::Law::kernel;
  choose_formula(a, "convert_when", "X < 0.3");
  give_velocity(a, [](Point const& X) { return Point{20 * X[0], X[1] > 1.22 ? -200.0 : 0.0, 0}; });
  auto const whole = make_formulation(a), second = make_formulation(a);
  double const time = take_steps(*whole, 0, 5);
  SavedState state = saved(*whole);
  second->load(state);
  take_steps(*whole, time, 5);
  take_steps(*second, time, 5);
  EXPECT_EQ(saved(*whole).values, saved(*second).values);
}

TEST(AdaptleAxisymmetry, WhatItCannotRunIsRefusedByName) {
  Assembly a = rings({section(0, 1)});
  EXPECT_EQ(refusal(a), "");
  Assembly b = a;
  choose(b, "viscosity", "riemann");
  EXPECT_NE(refusal(b).find("body.formulation.viscosity"), std::string::npos);
  b = a;
  choose(b, "correction", "mixed");
  EXPECT_NE(refusal(b).find("body.formulation.correction"), std::string::npos);
  b = a;
  choose(b, "interface", "published");
  EXPECT_NE(refusal(b).find("body.formulation.interface"), std::string::npos);
  b = a;
  choose(b, "description", "patch");
  choose_formula(b, "eulerian_where", "X < 0.5");
  EXPECT_NE(refusal(b).find("body.formulation.description"), std::string::npos);
  EXPECT_NE(refusal(rings({on_axis()})).find("body.shape.placement"), std::string::npos);
  ShapeSpec disc = section(0, 1);
  disc.kind = ShapeSpec::Kind::sphere;
  disc.centre = {0, 0, 0};
  disc.radius = 1;
  disc.spacing = 2.0 / 9;
  EXPECT_NE(refusal(rings({disc})).find("even number"), std::string::npos);
  disc.spacing = 2.0 / 10;
  EXPECT_EQ(refusal(rings({disc})), "");
  b = a;
  b.mirrors.push_back({0, 1, false});
  EXPECT_NE(refusal(b).find("mirror"), std::string::npos);
}

}  // namespace
}  // namespace piola
