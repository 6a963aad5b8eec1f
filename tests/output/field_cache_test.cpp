// SPDX-License-Identifier: Apache-2.0
#include "piola/output/field_cache.hpp"
#include "piola/formulations/quantity_names.hpp"
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

}  // namespace
}  // namespace piola
