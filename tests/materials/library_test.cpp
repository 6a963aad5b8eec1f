// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library.hpp"
#include "piola/materials/solids.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace piola {
namespace {

/// Every name in the library is one of its law, every number allowed and of use, every needed number given.
TEST(MaterialLibrary, GivesEachLawWhatItAsksFor) {
  std::set<std::string_view> names;
  for (LibraryMaterial const& material : material_library()) {
    SCOPED_TRACE(material.name);
    EXPECT_TRUE(names.insert(material.name).second);
    EXPECT_FALSE(find_law(material.name).has_value());
    EXPECT_GT(material.source.size(), 40u);
    auto const law = find_law(material.law);
    ASSERT_TRUE(law.has_value());
    MaterialParameters const values = parameters_of(material);
    EXPECT_EQ(values.law, law->index);
    std::size_t found = 0;
    for (Choice const& choice : law->choices) {
      auto const word = material.word(choice.name);
      found += word ? 1 : 0;
      EXPECT_TRUE(!word || index_of(choice, *word) >= 0) << choice.name;
    }
    EXPECT_EQ(found, material.words.size());
    found = 0;
    for (Parameter const& parameter : law->parameters) {
      auto const number = material.number(parameter.name);
      found += number ? 1 : 0;
      bool const counts = applies(*law, parameter, values);
      EXPECT_TRUE(!number || (counts && parameter.allowed.contains(*number))) << parameter.name;
      EXPECT_TRUE(number || !counts || !parameter.required()) << parameter.name;
    }
    EXPECT_EQ(found, material.numbers.size());
  }
  EXPECT_FALSE(find_material("unobtainium").has_value());
}

TEST(MaterialLibrary, HasMetalsWhoseWavesAreThoseOfMetals) {
  for (LibraryMaterial const& material : material_library()) {
    int calls = 0;
    with_solid(parameters_of(material), [&](auto const& solid) {
      ++calls;
      EXPECT_TRUE(solid.p_wave_speed() > 4000 && solid.p_wave_speed() < 14000) << material.name;
      EXPECT_TRUE(solid.s_wave_speed() > 2000 && solid.s_wave_speed() < 10000) << material.name;
    });
    EXPECT_EQ(calls, 1);
  }
}

TEST(MaterialLibrary, KeepsTheModuliFromWhichYoungsModulusWasMade) {
  with_solid(parameters_of(*find_material("aluminium_adaptle_3_2")), [](auto const& solid) {
    EXPECT_NEAR(solid.mu, 27.6e9, 1);
    EXPECT_NEAR(solid.kappa, 79.06e9, 1e7);
  });
  with_solid(parameters_of(*find_material("beryllium")), [](auto const& solid) {
    EXPECT_NEAR(solid.mu, 151e9, 1);
    EXPECT_NEAR(solid.kappa, 114.5e9, 1);
  });
}

/// (90 + 292 0.5^0.31) (1 + 0.025 ln 1000) (1 - (400/1063)^1.09) MPa
TEST(MaterialLibrary, HasTheFlowStressOfCopper) {
  with_solid(parameters_of(*find_material("copper_ofhc")), [](auto const& solid) {
    SolidHistory const h{.plastic_strain = 0.5, .temperature = 693};
    EXPECT_NEAR(solid.yield_stress(h, 1e3), 250201545.9, 1);
  });
}

}  // namespace
}  // namespace piola
