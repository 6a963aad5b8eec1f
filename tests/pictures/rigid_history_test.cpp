// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/rigid_history.hpp"
#include "piola/pictures/case_scene.hpp"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace piola {
namespace {

RigidSpec stone(bool free = true) {
  RigidSpec spec;
  spec.name = "stone";
  spec.kind = RigidShape::Kind::box;
  spec.free = free;
  spec.centre = {7, 8, 9};
  return spec;
}

class RigidHistories : public ::testing::Test {
 protected:
  void SetUp() override {
    path = std::filesystem::path(::testing::TempDir()) /
           (std::string("rigid_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
    std::ofstream(path) << "time,stone.x,stone.y,stone.z,stone.rotation_x,stone.rotation_y,stone.rotation_z\n"
                        << "0,1,2,3,0,0,0\n"
                        << "2,3,2,3,0,0,0.4\n";
  }
  void TearDown() override { std::filesystem::remove(path); }
  std::filesystem::path path;
};

TEST_F(RigidHistories, TellWhereShapesStoodBetweenRows) {
  RigidHistory const history(path, {stone()});
  auto const states = history.at(1);
  ASSERT_EQ(states.size(), 1U);
  EXPECT_DOUBLE_EQ(states[0].centre[0], 2);
  EXPECT_NEAR(states[0].turn[2], 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(history.at(9)[0].centre[0], 3) << "the last row";
}

TEST_F(RigidHistories, OfShapesThatDoNotTurnAreEmpty) {
  EXPECT_TRUE(RigidHistory(path, {stone(false)}).at(1).empty());
  EXPECT_TRUE(RigidHistory("/nowhere.csv", {stone()}).at(1).empty());
}

TEST_F(RigidHistories, PlaceAndTurnShapesInPictures) {
  RigidHistory const history(path, {stone()});
  auto const shapes = shapes_at({stone()}, 2, history.at(2));
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_DOUBLE_EQ(shapes[0].centre[0], 3);
  EXPECT_NEAR(shapes[0].edges[0][1], std::sin(0.4), 1e-12);
  EXPECT_EQ(shapes_at({stone()}, 2)[0].centre[0], 7) << "where it started, for want of a history";
}

}  // namespace
}  // namespace piola
