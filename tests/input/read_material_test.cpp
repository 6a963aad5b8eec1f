// SPDX-License-Identifier: Apache-2.0
#include "piola/input/material_library.hpp"
#include "piola/input/sections.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/model/read_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

/// What a table of a material says; no formulation has a say.
MaterialParameters material_of(std::string const& keys) {
  Problems problems;
  auto const document = parse_document("material = { " + keys + " }", "case.toml", problems);
  BodySpec body;
  read_material(Section(*document->root.find("material"), "body.material", problems), {}, body);
  problems.raise_if_any();
  return body.material;
}

double value_of(MaterialParameters const& material, std::string_view name) {
  LawInfo const law = law_of(material);
  for (std::size_t i = 0; i < law.parameters.size(); ++i)
    if (law.parameters[i].name == name) return material.value[i];
  ADD_FAILURE() << "no parameter " << name;
  return 0;
}

TEST(ReadMaterial, SolidsHaveWordsAndTheNumbersOfTheirWords) {
  auto const material = material_of(
      R"(law = "perfectly_plastic", density = 2785, youngs_modulus = "74 GPa", poissons_ratio = 0.34, )"
      R"(yield_stress = "300 MPa", eos = "stiffened_gas", adiabatic_exponent = 2, bulk_sound_speed = "5.328 km/s")");
  EXPECT_EQ(material.law, find_law("perfectly_plastic")->index);
  EXPECT_EQ(material.word[0], 1);
  EXPECT_EQ(material.word[1], 0);
  EXPECT_DOUBLE_EQ(value_of(material, "yield_stress"), 300e6);
  EXPECT_DOUBLE_EQ(value_of(material, "bulk_sound_speed"), 5328);
  EXPECT_EQ(value_of(material, "spall_pressure"), unbounded);
  EXPECT_EQ(value_of(material, "heat_fraction"), 1);
}

TEST(ReadMaterial, WordsThatAreLeftOutAreElasticAndWithoutDamage) {
  auto const material = material_of(
      R"(law = "elastic", density = 1000, youngs_modulus = 3e9, poissons_ratio = 0.25, spall_pressure = 1e6)");
  int calls = 0;
  with_solid(material, [&](auto const& solid) {
    ++calls;
    EXPECT_NEAR(solid.pressure(1100, 1e9), 2e8, 1e-4);
    EXPECT_EQ(solid.pressure(900, 0), -1e6);
    EXPECT_FALSE(solid.damages);
  });
  EXPECT_EQ(calls, 1);
}

TEST(ReadMaterial, TheLibraryGivesLawWordsAndNumbers) {
  for (LibraryMaterial const& material : material_library().materials) {
    SCOPED_TRACE(material.name);
    auto const read = material_of("name = \"" + std::string(material.name) + "\"");
    auto const expected = parameters_of(material);
    EXPECT_EQ(read.law, expected.law);
    for (int i = 0; i < MaterialParameters::max_words; ++i) EXPECT_EQ(read.word[i], expected.word[i]);
    for (int i = 0; i < MaterialParameters::max_values; ++i) EXPECT_EQ(read.value[i], expected.value[i]) << i;
  }
}

TEST(ReadMaterial, KeysBesideTheNameChangeAMaterialOfTheLibrary) {
  auto const material =
      material_of(R"(name = "steel_4340", damage = "none", eos = "polynomial", c1 = "160 GPa", density = 7800)");
  EXPECT_EQ(material.word[0], 3);
  EXPECT_EQ(material.word[1], 0);
  EXPECT_EQ(value_of(material, "density"), 7800);
  EXPECT_DOUBLE_EQ(value_of(material, "c1"), 160e9);
  EXPECT_DOUBLE_EQ(value_of(material, "yield_stress"), 792e6);
}

}  // namespace
}  // namespace piola
