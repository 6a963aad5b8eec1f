// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/field.hpp"
#include "piola/exec/field_view.hpp"
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace piola {
namespace {

/// Writes a different number into every component of every particle.
void number(Field& f) {
  for (Index i = 0; i < f.size(); ++i)
    for (int c = 0; c < f.components(); ++c) f.at(i, c) = 1 + i + 1000 * c;
}

TEST(Field, KeepsEveryComponentOfEveryParticleApart) {
  for (Index const n : {1, 7, 8, 125}) {
    Field f("Velocity", "m/s", 3, Role::evolved);
    f.allocate(n, 5);
    number(f);
    for (Index i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(f.at(i, c), 1 + i + 1000 * c);
    EXPECT_EQ(f.size(), n);
  }
}

TEST(Field, HasReadableZerosBeforeAndAfterEachComponent) {
  for (Index const guard : {1, 8, 21}) {
    Field f("Velocity", "m/s", 3, Role::evolved);
    f.allocate(13, guard);
    number(f);
    FieldRef const r = f.ref();
    for (int c = 0; c < 3; ++c)
      for (Index g = 1; g <= guard; ++g) {
        EXPECT_EQ(r.data[c * r.component_stride - g], 0) << "component " << c << ", " << g << " before the first";
        EXPECT_EQ(r.data[c * r.component_stride + 12 + g], 0) << "component " << c << ", " << g << " after the last";
      }
  }
}

TEST(Field, StartsAtACacheLineAndSpacesComponentsByAnOddNumberOfThem) {
  Field f("Velocity", "m/s", 3, Role::evolved);
  f.allocate(512, 16);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(f.ref().data) % 64, 0U);
  EXPECT_EQ(f.ref().component_stride % 16, 8);
}

TEST(Field, PlacedInRecordsSharesTheirMemory) {
  double memory[40]{};
  Field X("Position", "m", 2, Role::reference), v("Velocity", "m/s", 2, Role::evolved);
  X.place(memory, 1, 8, 0, 5);
  v.place(memory, 1, 8, 2, 5);
  number(X);
  for (Index i = 0; i < 5; ++i) v.at(i, 1) = -i;
  EXPECT_EQ(memory[3 * 8 + 0], 4);
  EXPECT_EQ(memory[3 * 8 + 1], 1004);
  EXPECT_EQ(memory[3 * 8 + 3], -3);
  EXPECT_EQ(memory[3 * 8 + 2], 0);
}

TEST(Field, ThatIsExchangedWithAnotherSharesItsVersion) {
  double memory[40]{};
  FieldVersion version;
  Field w("A", "1", 1, Role::derived), A("B", "1", 1, Role::derived);
  w.place(memory, 1, 2, 0, 5, &version);
  A.place(memory, 1, 2, 1, 5, &version);
  EXPECT_EQ(w.ref().version, A.ref().version);
  Field other("C", "1", 1, Role::derived);
  other.allocate(5, 0);
  EXPECT_NE(other.ref().version, w.ref().version);
}

TEST(Field, SharedByGroupsIsReadThroughItsGroups) {
  // Host code has one lane: groups are single particles.
  Field V("TributaryVolume", "m3", 1, Role::reference);
  V.allocate(2, 0);
  V.at(0) = 0.5;
  V.at(1) = 1;
  std::int32_t const group[] = {0, 1, 1, 1, 0};
  V.share(group);
  ReferenceView const view = read_reference(V.ref());
  double const expected[] = {0.5, 1, 1, 1, 0.5};
  for (Index i = 0; i < 5; ++i) EXPECT_EQ(view.scalar<double>(i), expected[i]);
}

TEST(Memory, IsZeroAndMovesWithoutCopying) {
  Memory a(1000);
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(a.data()[k], 0);
  double* const where = a.data();
  where[3] = 7;
  Memory b(std::move(a));
  EXPECT_EQ(b.data(), where);
  Memory c(10);
  c = std::move(b);
  EXPECT_EQ(c.data()[3], 7);
}

TEST(Memory, OfEqualSizesStartsAtDifferentPlacesWithinAPage) {
  Memory const a(1 << 20), b(1 << 20), c(1 << 20);
  auto const offset = [](Memory const& m) { return reinterpret_cast<std::uintptr_t>(m.data()) % 4096; };
  EXPECT_NE(offset(a), offset(b));
  EXPECT_NE(offset(b), offset(c));
}

TEST(Field, KeepsTheComponentsOfATileTogetherWhereItIsOnlyStreamed) {
  Field f("Tensor", "1", 9, Role::evolved);
  f.allocate_tiled(40);
  for (Index i = 0; i < 40; ++i)
    for (int c = 0; c < 9; ++c) f.at(i, c) = 100 * i + c;
  for (Index i = 0; i < 40; ++i)
    for (int c = 0; c < 9; ++c) EXPECT_EQ(f.at(i, c), 100 * i + c) << "every place is used once";
  EXPECT_EQ(&f.at(15, 0) - &f.at(0, 0), 15) << "lanes of a tile lie side by side";
  EXPECT_EQ(&f.at(0, 1) - &f.at(0, 0), tile_size);
  EXPECT_EQ(&f.at(16, 0) - &f.at(0, 0), 9 * tile_size);
  EXPECT_EQ(read(f.ref()).scalar<double>(37, 5), 3705);
}

struct Two : FieldSet {
  ListedField x{*this, "Position", "m", 3, Role::evolved};
  ListedField J{*this, "VolumeRatio", "1", 1, Role::derived};
};

TEST(FieldSet, IsMadeOfWhatIsDeclaredInIt) {
  Two two;
  std::vector<std::string> names;
  two.each([&](Field& f) {
    names.emplace_back(f.name());
    f.allocate(10, 0);
  });
  EXPECT_EQ(names, (std::vector<std::string>{"Position", "VolumeRatio"}));
  EXPECT_EQ(two.bytes(), two.x.bytes() + two.J.bytes());
}

TEST(Field, GivesPointsThatKeepWhatTheBodyDoesNotHave) {
  Field f("Position", "m", 2, Role::evolved);
  f.allocate(2, 0);
  f.at(1, 0) = 4;
  EXPECT_EQ(point_at(f.ref(), 1, 2, {7, 8, 9}), (std::array<double, 3>{4, 0, 9}));
}

}  // namespace
}  // namespace piola
