// SPDX-License-Identifier: Apache-2.0
#include "piola/output/field_cache.hpp"
#include "piola/formulations/derived_fields.hpp"
#include "piola/formulations/field_signs.hpp"
#include "formulations/small_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

TEST(DerivedFields, PrincipalStressesAreTheLargestFirst) {
  DerivedField const field = derived_fields()[0];
  ASSERT_EQ(field.name, "PrincipalStress");
  // Shear of 3 Pa in the plane, 1 Pa across it: 3, 1, -3.
  double const stress[] = {0, 0, 1, 3, 0, 0};
  double principal[3];
  field.put(stress, principal);
  EXPECT_NEAR(principal[0], 3, 1e-14);
  EXPECT_NEAR(principal[1], 1, 1e-14);
  EXPECT_NEAR(principal[2], -3, 1e-14);
}

// Simple shear by 1: the principal stretches are the golden ratio, 1 and its inverse.
TEST(DerivedFields, PrincipalStrainsAreLogarithmsOfTheStretches) {
  Assembly a = assemble(unit_box(2, 6));
  displace(a, [](Point const& X) { return Point{X[1], 0, 0}; });
  auto const f = make_formulation(a);
  FieldCache cache(*f, a.particles);
  ASSERT_TRUE(cache.knows("PrincipalStrain"));
  EXPECT_EQ(cache.info("PrincipalStress").unit, "Pa");
  auto const strain = cache.values("PrincipalStrain");
  double const expected = std::asinh(0.5);
  for (std::size_t i = 0; i < a.particles.X.size(); ++i) {
    EXPECT_NEAR(strain[3 * i], expected, 1e-12);
    EXPECT_NEAR(strain[3 * i + 1], 0, 1e-12);
    EXPECT_NEAR(strain[3 * i + 2], -expected, 1e-12);
  }
  FieldQuantity const third = find_quantity("principal_strain_3").value();
  EXPECT_NEAR(component_values(cache, third.field, third.component)[7], -expected, 1e-12);
  EXPECT_FALSE(find_quantity("principal_strain_x") || find_quantity("principal_strain_magnitude"));
}

TEST(DerivedFields, CompressivePressureIsPressureWithTheOtherSign) {
  Assembly a = assemble(unit_box(2, 6));
  displace(a, [](Point const& X) { return Point{-0.01 * X[0], 0, 0}; });
  auto const f = make_formulation(a);
  FieldCache cache(*f, a.particles);
  auto const pressure = cache.values("Pressure"), compressive = cache.values("CompressivePressure");
  ASSERT_EQ(pressure.size(), compressive.size());
  for (std::size_t i = 0; i < pressure.size(); ++i) EXPECT_EQ(compressive[i], 0 - pressure[i]);
  EXPECT_GT(compressive[0], 0) << "it is compressed";
  EXPECT_EQ(find_quantity("compressive_pressure")->field, "CompressivePressure");
}

TEST(Signs, AreThoseOfNormalComponents) {
  EXPECT_EQ(sign_of("Pressure"), "tension positive");
  EXPECT_EQ(sign_of("Pressure", 0), "tension positive") << "a scalar has one component";
  EXPECT_EQ(sign_of("FirstPiolaStress", 4), "tension positive");
  EXPECT_EQ(sign_of("FirstPiolaStress", 3), "");
  EXPECT_EQ(sign_of("ContactGap"), "overlap negative");
  EXPECT_EQ(sign_of("VonMisesStress"), "");
}

TEST(DerivedFields, AreMadeOfFieldsThatFramesHold) {
  std::vector<std::string> const stored{"Damage", "Pressure"};
  EXPECT_EQ(stored_field("Damage", stored), "Damage");
  EXPECT_EQ(stored_field("CompressivePressure", stored), "Pressure");
  EXPECT_EQ(stored_field("PrincipalStress", stored), "");
}

}  // namespace
}  // namespace piola
