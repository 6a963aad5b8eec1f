// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/output_fields.hpp"
#include "piola/base/units.hpp"
#include "piola/materials/finite_increment.hpp"
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>
#include <string>

namespace piola {
namespace {

TEST(ObservedTable, NamesEveryFieldOnceAndWithAKnownUnit) {
  std::set<std::string_view> words, names;
  for (OutputField const& field : output_field_table()) {
    bool const new_word = field.word.empty() || words.insert(field.word).second,
               new_name = field.put == nullptr || names.insert(field.name).second;
    EXPECT_TRUE(new_word && new_name) << field.word << " " << field.name;
    EXPECT_TRUE(same_dimension(std::string(field.unit), std::string(field.unit))) << field.unit;
  }
  EXPECT_GT(names.size(), 15U);
}

TEST(ObservedTable, GivesAFormulationOnlyWhatItOffers) {
  constexpr std::array<std::string_view, 2> offered{"Damage", "Velocity"};
  EXPECT_EQ(find_output_field("Damage", offered).components, 1);
  EXPECT_THROW(find_output_field("Pressure", offered), std::invalid_argument);
  EXPECT_THROW(find_output_field("Charisma", offered), std::invalid_argument);
  auto const infos = field_infos(offered);
  ASSERT_EQ(infos.size(), 2U);
  EXPECT_EQ(infos[1].name, "Velocity");
  EXPECT_EQ(infos[1].unit, "m/s");
}

TEST(ObservedTable, PutsValuesWhereTheParticleHasItsPlace) {
  ParticleOutput p;
  p.id = 1;
  p.v = {1, 2, 3};
  p.inertia = 10;
  p.cauchy.c[3] = 2;  // shear alone: sqrt(3) tau
  std::array<double, 6> values{};
  constexpr std::array<std::string_view, 2> offered{"Momentum", "VonMisesStress"};
  put(find_output_field("Momentum", offered), p, values);
  EXPECT_EQ(values, (std::array<double, 6>{0, 0, 0, 10, 20, 30}));
  put(find_output_field("VonMisesStress", offered), p, values);
  EXPECT_NEAR(values[1], 2 * std::sqrt(3.0), 1e-15);
}

TEST(CauchyStress, IsThatOfTheDeformedBody) {
  Mat<3> const F{{2, 0, 0, 0, 1, 0, 0, 0, 0.5}};
  Mat<3> const P{{3, 0, 0, 0, 5, 0, 0, 0, 8}};
  SymMat<3> const s = cauchy_stress(P, F, 1);
  EXPECT_EQ(s.c[0], 6);
  EXPECT_EQ(s.c[1], 5);
  EXPECT_EQ(s.c[2], 4);
  EXPECT_EQ(s.c[3], 0);
}

}  // namespace
}  // namespace piola
