// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/registry.hpp"
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

namespace piola {
namespace {

TEST(Laws, AreFoundByTheirNamesAndNumberedInOrder) {
  int index = 0;
  for (LawInfo const& law : laws()) {
    EXPECT_EQ(law.index, index++);
    ASSERT_TRUE(find_law(law.name).has_value());
    EXPECT_EQ(find_law(law.name)->index, law.index);
    EXPECT_FALSE(law.about.empty());
  }
  EXPECT_EQ(index, Laws::size + Strengths::size + static_cast<int>(block_laws::own_laws().size()));
  EXPECT_FALSE(find_law("no_such_law").has_value());
}

TEST(Laws, AreSelectedByWhatTheyCanDo) {
  using Names = std::vector<std::string_view>;
  EXPECT_EQ(laws_that([](LawInfo const& law) { return law.elastic_rate; }), Names{"linear_elastic"});
  EXPECT_EQ(laws_that([](LawInfo const& law) { return law.brittle; }), Names{"johnson_holmquist"});
  auto const solids = laws_that([](LawInfo const& law) { return law.hypoelastic; });
  ASSERT_EQ(solids.size(), static_cast<std::size_t>(Strengths::size));
  EXPECT_EQ(solids.front(), "elastic") << "in the order of the registry";
}

TEST(EquationsOfState, ShareAParameterThatBothHave) {
  Parameter const& speed = eos_parameters[eos_places<MieGrueneisen>[0]];
  EXPECT_EQ(speed.name, "bulk_sound_speed");
  EXPECT_EQ(eos_places<StiffenedGas>[0], eos_places<MieGrueneisen>[0]);
  EXPECT_TRUE(speed.when.holds(StiffenedGas::name) && speed.when.holds(MieGrueneisen::name));
  EXPECT_FALSE(speed.when.holds(PolynomialEos::name));
}

TEST(EquationsOfState, GoWithTheirStrengths) {
  EXPECT_EQ(EquationsFor<NoPlasticity>::List::words[4], "jwl");
  EXPECT_EQ(EquationsFor<JohnsonCook>::List::words[4], "tillotson") << "metals are no explosives";
  EXPECT_EQ(EquationsFor<JohnsonHolmquist>::List::words.size(), 1u);
}

TEST(Laws, AreEachPickedByTheirNumber) {
  for (LawInfo const& law : laws()) {
    if (law.hypoelastic || law.block != nullptr) continue;
    MaterialParameters material;
    material.law = law.index;
    material.value[0] = 1000;
    material.value[1] = 1e6;
    int calls = 0;
    with_law(material, [&](auto const& picked) {
      ++calls;
      EXPECT_EQ(std::decay_t<decltype(picked)>::name, law.name);
      EXPECT_EQ(picked.rho0, 1000);
    });
    EXPECT_EQ(calls, 1);
  }
}

TEST(Laws, OfANumberThatDoesNotExistAreNotCalled) {
  MaterialParameters material;
  for (int const number : {-1, Laws::size}) {
    material.law = number;
    with_law(material, [](auto const&) { ADD_FAILURE() << "no law has this number"; });
  }
}

TEST(Solids, AreEachPickedByTheirNumberAndTheWordOfTheirEquationOfState) {
  for (LawInfo const& law : laws()) {
    MaterialParameters material;
    material.law = law.index;
    EXPECT_EQ(is_hypoelastic(material), law.hypoelastic);
    for (double& value : material.value) value = 0.25;
    auto const known = law.hypoelastic ? static_cast<int>(law.choices[0].allowed.size()) : 0;
    for (int eos = 0; eos < 7; ++eos) {
      material.word[0] = eos;
      int calls = 0;
      with_solid(material, [&](auto const& solid) {
        ++calls;
        EXPECT_EQ(solid.rho0, 0.25);
      });
      EXPECT_EQ(calls, eos < known ? 1 : 0) << law.name << " " << eos;
    }
    if (law.hypoelastic) with_law(material, [](auto const&) { ADD_FAILURE() << "a solid is no hyperelastic law"; });
  }
}

TEST(ElasticConstants, FollowFromYoungsModulusAndPoissonsRatio) {
  double const values[] = {1000, 2.5, 0.25};
  ElasticConstants const c(values);
  EXPECT_EQ(c.rho0, 1000);
  EXPECT_DOUBLE_EQ(c.mu, 1);
  EXPECT_DOUBLE_EQ(c.lambda, 1);
  EXPECT_DOUBLE_EQ(c.kappa, 5.0 / 3);
  EXPECT_DOUBLE_EQ(c.p_wave_speed(), std::sqrt(3.0 / 1000));
  EXPECT_DOUBLE_EQ(c.s_wave_speed(), std::sqrt(1.0 / 1000));
}

TEST(ElasticConstants, RefuseAnIncompressibleSolid) {
  Interval const allowed = ElasticConstants::parameters[2].allowed;
  EXPECT_FALSE(allowed.contains(0.5));
  EXPECT_TRUE(allowed.contains(0.499));
  EXPECT_FALSE(allowed.contains(-1));
}

}  // namespace
}  // namespace piola
