// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/observe.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/materials/laws.hpp"
#include "formulations/small_bodies.hpp"
#include "math/random.hpp"
#include <set>

namespace piola {
namespace {

using namespace testing;

TEST(Diagnostics, OfATranslatingBoxAreThoseOfAPointMass) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    Assembly a = assemble(unit_box(dimension, 5));
    Point const v{2, dimension > 1 ? -1 : 0.0, dimension > 2 ? 3 : 0.0};
    give_velocity(a, [&](Point const&) { return v; });
    Diagnostics const d = make_formulation(a)->diagnose();
    double const mass = 1100;  // density times a volume, area or length of 1
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(d.linear_momentum[c], mass * v[c], 1e-9);
    EXPECT_NEAR(d.kinetic_energy, 0.5 * mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), 1e-9);
    double const half = 0.5, y = dimension > 1 ? half : 0, z = dimension > 2 ? half : 0;  // centre of mass
    EXPECT_NEAR(d.angular_momentum[0], mass * (y * v[2] - z * v[1]), 1e-9);
    EXPECT_NEAR(d.angular_momentum[1], mass * (z * v[0] - half * v[2]), 1e-9);
    EXPECT_NEAR(d.angular_momentum[2], mass * (half * v[1] - y * v[0]), 1e-9);
    EXPECT_EQ(d.strain_energy, 0);
    EXPECT_EQ(d.jacobian_min, 1);
    EXPECT_EQ(d.jacobian_max, 1);
    EXPECT_EQ(d.external_work, 0);
    EXPECT_EQ(d.stabilisation_loss, 0);
  }
}

TEST(Diagnostics, FindTheExtremesOfVolumeAndPressure) {
  Assembly a = assemble(unit_box(3, 4));
  a.initial_deformation_gradient.assign(64, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  a.initial_deformation_gradient[10][0] = 1.25;
  a.initial_deformation_gradient[63][4] = 0.5;
  Diagnostics const d = make_formulation(a)->diagnose();
  double const kappa = 17e6 / (3 * (1 - 2 * 0.3));
  EXPECT_DOUBLE_EQ(d.jacobian_min, 0.5);
  EXPECT_DOUBLE_EQ(d.jacobian_max, 1.25);
  EXPECT_NEAR(d.pressure_min, -0.5 * kappa, 1e-9 * kappa);
  EXPECT_NEAR(d.pressure_max, 0.25 * kappa, 1e-9 * kappa);
}

/// J = 1 + e f(lattice index) everywhere; pressure is then kappa e f.
double oscillation(double (*f)(std::array<int, 3> const&)) {
  Assembly a = assemble(unit_box(3, 5));
  for (auto const& at : a.particles.lattice_index)
    a.initial_deformation_gradient.push_back({1 + 0.01 * f(at), 0, 0, 0, 1, 0, 0, 0, 1});
  return make_formulation(a)->diagnose().pressure_oscillation;
}

TEST(Diagnostics, MeasureACheckerboardOfPressureAsOneAndALinearFieldAsZero) {
  EXPECT_NEAR(oscillation([](auto const& at) { return (at[0] + at[1] + at[2]) % 2 == 0 ? 1.0 : -1.0; }), 1, 1e-12);
  EXPECT_NEAR(oscillation([](auto const& at) { return 1.0 * at[0] - 2 * at[1] + 3 * at[2]; }), 0, 1e-12);
}

TEST(SampledFields, AreConsistentWithEachOther) {
  Assembly a = tumbling_box(3, 5);
  auto const f = make_formulation(a);
  advance(*f, 2e-4, 20);
  auto const n = a.particles.X.size();
  NeoHookean const law(a.materials[0].value);
  auto const get = [&](char const* field) { return sample(*f, field, n); };
  Values const x = get("Position"), u = get("Displacement"), v = get("Velocity"), p = get("Momentum"),
               F9 = get("DeformationGradient"), P9 = get("FirstPiolaStress"), s6 = get("CauchyStress"),
               J = get("Jacobian"), pressure = get("Pressure"), mises = get("VonMisesStress"), density = get("Density"),
               id = get("Id");
  for (std::size_t k = 0; k < n; ++k) {
    Mat<3> F, P;
    std::copy_n(&F9[9 * k], 9, F.c);
    std::copy_n(&P9[9 * k], 9, P.c);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(u[3 * k + c], x[3 * k + c] - a.particles.X[k][c], 1e-15);
      EXPECT_NEAR(p[3 * k + c], 1100 * v[3 * k + c], 1e-10);
    }
    EXPECT_NEAR(J[k], determinant(F), 1e-13);
    EXPECT_NEAR(density[k] * J[k], 1100, 1e-9);
    EXPECT_LT(size(P - law.first_piola(F)), 1e-6);
    EXPECT_NEAR(pressure[k], law.pressure(F), 1e-6);
    // sigma = P F^T / J: XX YY ZZ XY YZ XZ, symmetric; its mean is the pressure of a law with isochoric shear.
    Mat<3> const sigma = (1 / J[k]) * (P * transpose(F));
    EXPECT_NEAR(s6[6 * k + 0], sigma(0, 0), 1e-6);
    EXPECT_NEAR(s6[6 * k + 3], sigma(1, 0), 1e-6);
    EXPECT_NEAR(s6[6 * k + 4], sigma(1, 2), 1e-6);
    EXPECT_NEAR(s6[6 * k + 5], sigma(2, 0), 1e-6);
    EXPECT_NEAR((s6[6 * k] + s6[6 * k + 1] + s6[6 * k + 2]) / 3, pressure[k], 1e-6);
    double const a1 = s6[6 * k] - s6[6 * k + 1], a2 = s6[6 * k + 1] - s6[6 * k + 2], a3 = s6[6 * k + 2] - s6[6 * k];
    double const shear = s6[6 * k + 3] * s6[6 * k + 3] + s6[6 * k + 4] * s6[6 * k + 4] + s6[6 * k + 5] * s6[6 * k + 5];
    EXPECT_NEAR(mises[k], std::sqrt(0.5 * (a1 * a1 + a2 * a2 + a3 * a3) + 3 * shear), 1e-6);
    EXPECT_EQ(id[k], static_cast<double>(k));
  }
  EXPECT_GT(largest(mises), 1e5);
}

TEST(SampledFields, AreAllNumbersAndHaveUnits) {
  Assembly const a = tumbling_box(2, 5);
  auto const f = make_formulation(a);
  f->step(0, 1e-4);
  std::set<std::string> names;
  for (FieldInfo const& field : f->observables().fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_TRUE(same_dimension(field.unit, field.unit)) << field.name << ": unit " << field.unit << " is not known";
    for (double const value : sample(*f, field.name, a.particles.X.size()))
      EXPECT_TRUE(std::isfinite(value)) << field.name;
  }
}

TEST(SampledFields, OfAnUnknownNameAreRefused) {
  auto const f = make_formulation(assemble(unit_box(2, 5)));
  Values room(25 * 9);
  EXPECT_THROW(f->observables().sample("Charisma", room), std::invalid_argument);
}

TEST(QuantityNames, OfExistingFieldsFitTheirComponentsAndUnits) {
  auto const f = make_formulation(assemble(unit_box(2, 5)));
  int found = 0;
  for (auto const& quantity : all_quantities())
    for (FieldInfo const& field : f->observables().fields()) {
      if (field.name != quantity.field) continue;
      ++found;
      EXPECT_LT(quantity.component, field.components) << quantity.name;
      EXPECT_TRUE(same_dimension(quantity.unit, field.unit))
          << quantity.name << ": " << quantity.unit << ", " << field.unit;
    }
  EXPECT_GT(found, 30);
}

}  // namespace
}  // namespace piola
