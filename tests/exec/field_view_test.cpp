// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/field_view.hpp"
#include "piola/domain/halo.hpp"
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

namespace piola {
namespace {

TEST(View, ReadsWhatWasWritten) {
  Field f("DeformationGradient", "1", 9, Role::evolved);
  f.allocate(3, 0);
  Mat<3> F;
  for (int c = 0; c < 9; ++c) F.c[c] = c + 0.5;
  write(f.ref()).matrix<3>(1, F);
  Mat<3> const back = read(f.ref()).matrix<3, double>(1);
  for (int c = 0; c < 9; ++c) EXPECT_EQ(back.c[c], F.c[c]);
  Mat<3> const other = read(f.ref()).matrix<3, double>(2);
  for (double const c : other.c) EXPECT_EQ(c, 0);
}

TEST(View, ReadsPartsOfAField) {
  Field f("Record", "1", 5, Role::derived);
  f.allocate(2, 0);
  write(f.ref()).vector<3>(1, Vec<3>{{1, 2, 3}}, 2);
  EXPECT_EQ(f.at(1, 2), 1);
  EXPECT_EQ(f.at(1, 4), 3);
  EXPECT_EQ((read(f.ref()).vector<2, double>(1, 3)[1]), 3);
  EXPECT_EQ((read(f.ref()).scalar<double>(1, 3)), 2);
  SymMat<2> const S = read(f.ref()).symmetric<2, double>(1);
  EXPECT_EQ(S(0, 1), 1);
}

#if defined(PIOLA_CONTRACTS) && PIOLA_CONTRACTS
constexpr bool contracts = true;
#else
constexpr bool contracts = false;
#endif

TEST(Halo, ThatIsStaleIsFoundWhereNeighboursAreRead) {
  if (!contracts) GTEST_SKIP() << "built without contracts";
  Field f("Velocity", "m/s", 1, Role::evolved);
  f.allocate(4, 0);
  EXPECT_NO_THROW((void)read_neighbours(f.ref()));
  (void)write(f.ref());
  EXPECT_NO_THROW((void)read(f.ref()));  // owners may always read their own
  try {
    (void)read_neighbours(f.ref());
    FAIL() << "a stale halo was read";
  } catch (std::logic_error const& e) {
    EXPECT_NE(std::string(e.what()).find("'Velocity'"), std::string::npos) << e.what();
  }
  Halo().refresh(f.ref());
  EXPECT_NO_THROW((void)read_neighbours(f.ref()));
}

TEST(Halo, IsNotCountedWithoutContracts) {
  if (contracts) GTEST_SKIP() << "built with contracts";
  Field f("Velocity", "m/s", 1, Role::evolved);
  f.allocate(4, 0);
  (void)write(f.ref());
  EXPECT_NO_THROW((void)read_neighbours(f.ref()));
}

}  // namespace
}  // namespace piola
