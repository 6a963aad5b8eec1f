// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/field_list.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/nodal/state.hpp"
#include <gtest/gtest.h>
#include <string>
#include <type_traits>
#include <vector>

namespace piola {
namespace {

struct Fields {
  explicit Fields(FieldList* of = nullptr) : owner(of) {}
  FieldList* owner;
  ListedRef x{owner, "Position", "m", 3, Role::evolved};
  ListedRef c{owner, "WaveSpeed", "m/s", 1, Role::evolved};
  ListedRef J{owner, "VolumeRatio", "1", 1, Role::evolved, false};
  ListedRef c_next{owner, "NextWaveSpeed", "m/s", 1, Role::derived};
};

void allocate(FieldList& list) {
  list.each_without_memory([](Field& field) { field.allocate(8, 0); });
  list.bind();
}

std::vector<std::string> evolved(FieldList const& list) {
  std::vector<std::string> names;
  list.each_evolved([&](std::string const& name, FieldRef const&, int) { names.push_back(name); });
  return names;
}

TEST(FieldList, GivesMemoryToTheFieldsThatABodyHas) {
  FieldList list;
  Fields fields(&list);
  allocate(list);
  value_at(fields.x, 7, 2) = 5;
  EXPECT_EQ(list[fields.x].at(7, 2), 5);
  EXPECT_EQ(fields.J.data, nullptr);
  EXPECT_EQ(list.bytes(), list[fields.x].bytes() + list[fields.c].bytes() + list[fields.c_next].bytes());
}

TEST(FieldList, NamesTheEvolvedFieldsOfACheckpointInTheOrderOfDeclaration) {
  FieldList list;
  Fields const fields(&list);
  Fields const copy = fields;  // adds nothing
  EXPECT_EQ(evolved(list), (std::vector<std::string>{"position", "wave_speed"}));
  EXPECT_EQ(copy.owner, &list);
}

/// A step may exchange the references of two fields.
TEST(FieldList, FollowsReferencesThatChangePlaces) {
  FieldList list;
  Fields fields(&list);
  allocate(list);
  FieldRef const next = fields.c_next;
  fields.c_next = fields.c;
  fields.c = next;
  list.each_evolved([&](std::string const& name, FieldRef const& field, int components) {
    if (name != "wave_speed") return;
    EXPECT_EQ(field.data, next.data);
    EXPECT_EQ(components, 1);
  });
}

TEST(FieldList, HoldsTheEvolvedFieldsOfJstSph) {
  FieldList list;
  jst_sph::BodyState const paper(&list, 3, {.area = true, .volume = true});
  EXPECT_EQ(evolved(list), (std::vector<std::string>{"position", "velocity", "deformation_gradient", "wave_speed",
                                                     "area_map", "volume_ratio"}));
  FieldList other;
  jst_sph::BodyState const filtered(&other, 3, {.verlet = true, .filter = true});
  EXPECT_EQ(evolved(other), (std::vector<std::string>{"position", "velocity", "deformation_gradient", "wave_speed",
                                                      "acceleration", "filtered_ratio", "filtered_pressure"}));
  EXPECT_TRUE(std::is_trivially_copyable_v<jst_sph::Fields>);
}

TEST(FieldList, HoldsTheEvolvedFieldsOfNodal) {
  FieldList list;
  nodal::BodyState const state(&list, 3, {.viscosity = true, .solids = true});
  EXPECT_EQ(evolved(list), (std::vector<std::string>{"position", "velocity", "acceleration", "measured_stretch",
                                                     "change", "solid_history", "viscous_history"}));
  EXPECT_TRUE(std::is_trivially_copyable_v<nodal::Fields>);
}

}  // namespace
}  // namespace piola
