// SPDX-License-Identifier: Apache-2.0
// The field lists: checkpoint, records.
#include "piola/formulations/taylor_sph/fields.hpp"
#include "piola/formulations/common/field_list.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using namespace taylor_sph;
using Names = std::vector<std::string>;

Names evolved_names(FieldSet const& set) {
  Names names;
  each_evolved(set, [&](Field const& field) { names.push_back(checkpoint_name(field.name())); });
  return names;
}

/// Files of earlier versions have these arrays in this order.
TEST(TaylorFields, NameTheArraysOfCheckpoints) {
  EXPECT_EQ(evolved_names(Fields(2)),
            (Names{"position", "velocity", "drift", "displacement", "stress", "out_of_plane_stress", "kernel_volume"}));
  EXPECT_EQ(evolved_names(CellFields(2, 4, true)),
            (Names{"cell_stress", "cell_out_of_plane_stress", "cell_hourglass"}));
}

TEST(TaylorFields, TakeTheirEvolvedValuesBack) {
  auto const slot = [](Index k) { return 2 * k + 1; };
  Fields from(3), to(3);
  for (Fields* fields : {&from, &to}) fields->allocate(16);
  double value = 0;
  each_evolved(from, [&](Field& field) {
    for (Index k = 0; k < 5; ++k)
      for (int c = 0; c < field.components(); ++c) field.at(slot(k), c) = ++value;
  });
  auto const values = evolved_values(from, 5, slot);
  EXPECT_EQ(values.size(), 7U);
  EXPECT_EQ(values.front().size(), 15U);
  set_evolved(to, values, slot);
  EXPECT_EQ(evolved_values(to, 5, slot), values);
}

/// Loops read neighbours as records.
TEST(TaylorFields, LieInRecords) {
  using R = Record<2>;
  Fields fields(2);
  fields.allocate(16);
  BodyState state;
  fields.set_views(state);
  double const* const record = state.real + 3 * R::stride;
  EXPECT_GT(record[R::x], 1e10) << "a slot without particle is out of reach";
  for (int c = 0; c < 2; ++c) {
    fields.x.at(3, c) = 1 + c;
    fields.v.at(3, c) = 11 + c;
  }
  for (int c = 0; c < R::stress; ++c) fields.stress.at(3, c) = 21 + c;
  fields.kernel_volume.at(3) = 31;
  EXPECT_EQ((std::vector<double>(record, record + R::values)), (std::vector<double>{1, 2, 31, 11, 12, 21, 22, 23}));
}

TEST(TaylorFields, OfCellsAreAbsentUnderKernelSums) {
  CellFields kernel_sums(2, 4, false), adjoint(2, 4, true);
  for (CellFields* fields : {&kernel_sums, &adjoint}) fields->allocate(16);
  auto const slot = [](Index k) { return k; };
  for (auto const& values : evolved_values(kernel_sums, 5, slot)) EXPECT_TRUE(values.empty());
  auto const values = evolved_values(adjoint, 5, slot);
  EXPECT_EQ(values[0].size(), 15U);
  EXPECT_EQ(values[1].size(), 5U);
  EXPECT_EQ(values[2].size(), 10U);
}

}  // namespace
}  // namespace piola
