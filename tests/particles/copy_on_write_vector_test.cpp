// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/copy_on_write_vector.hpp"
#include "particles/lattices.hpp"
#include <gtest/gtest.h>
#include <utility>

namespace piola {
namespace {

TEST(CopyOnWriteVector, CopiesShareTheirMemory) {
  CopyOnWriteVector<double> const a(std::vector<double>{1, 2, 3});
  CopyOnWriteVector<double> const b = a;
  EXPECT_TRUE(b.shared());
  EXPECT_EQ(a.data(), b.data());
  EXPECT_EQ(b[2], 3);
}

TEST(CopyOnWriteVector, AChangeIsSeenByNobodyElse) {
  CopyOnWriteVector<double> a(std::vector<double>{1, 2, 3});
  CopyOnWriteVector<double> const b = a, c = a;
  a[1] = 5;
  a.push_back(7);
  EXPECT_EQ(a.seen(), (std::vector<double>{1, 5, 3, 7}));
  EXPECT_EQ(b.seen(), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(b.data(), c.data());
  EXPECT_FALSE(a.shared());
}

TEST(CopyOnWriteVector, KeepsItsMemoryWhereNobodySharesIt) {
  CopyOnWriteVector<double> a;
  EXPECT_TRUE(a.empty());
  EXPECT_EQ(a.begin(), a.end());
  a.assign(3, 2.5);
  double const* const place = a.data();
  a[0] = 1;
  EXPECT_EQ(a.data(), place);
  a.clear();
  EXPECT_EQ(a.size(), 0U);
  EXPECT_EQ(a, CopyOnWriteVector<double>());
}

TEST(ParticleSet, StandsOnceInMemoryWhoeverKeepsIt) {
  ParticleSet const set = testing::unit_box(3, 4);
  ParticleSet copy = set;
  EXPECT_EQ(copy.X.data(), std::as_const(set.X).data());
  EXPECT_TRUE(copy.volume.shared());
  copy.X[0][0] = -1;
  EXPECT_EQ(set.X[0][0], 0);
}

}  // namespace
}  // namespace piola
