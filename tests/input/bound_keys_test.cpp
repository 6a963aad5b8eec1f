// SPDX-License-Identifier: Apache-2.0
#include "piola/input/bound_keys.hpp"
#include "piola/input/output_keys.hpp"
#include "piola/input/run_keys.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(BoundKeys, ShowTheValueOfTheMemberAsDefault) {
  EXPECT_EQ(key_info("output.pictures", "zoom").standard, "1");
  EXPECT_EQ(key_info("output.pictures", "map").standard, "\"auto\"");
  EXPECT_EQ(key_info("output.pictures", "labels").standard, "true");
  EXPECT_EQ(key_info("output.pictures.cut", "show").standard, "\"clip\"");
  EXPECT_EQ(key_info("run.guards", "small_rotation_warn").standard, "0.05 rad");
  EXPECT_EQ(key_info("run.guards", "small_strain_stop").standard, "\"off\"");
  for (KeyInfo const& info : case_keys()) EXPECT_NE(info.standard, default_of_member) << info.key;
}

TEST(BoundKeys, FillTheirMembersAndLeaveTheOthers) {
  Problems problems;
  auto const document = parse_document("dissipation = \"off\"\noverlap = 2\nproximity = \"off\"", "a.toml", problems);
  ASSERT_TRUE(document);
  GuardLimits limits;
  read_members(Section(document->root, "run.guards", problems), guard_keys(), limits);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(limits.dissipation, GuardLimits::never);
  EXPECT_EQ(limits.overlap, 2);
  EXPECT_EQ(limits.proximity, 0);
  EXPECT_EQ(limits.energy_rise_warn, GuardLimits{}.energy_rise_warn);
}

TEST(BoundKeys, FillEnumeratorsByTheNumberOfTheWord) {
  Problems problems;
  auto const document =
      parse_document("theme = \"dark\"\nquality = \"high\"\noutline = false\nmap = \"jet\"", "a.toml", problems);
  ASSERT_TRUE(document);
  PictureSpec picture;
  read_members(Section(document->root, "output.pictures", problems), picture_keys(), picture);
  EXPECT_EQ(picture.theme, Theme::dark);
  EXPECT_EQ(picture.appearance.quality, Quality::high);
  EXPECT_FALSE(picture.appearance.outline);
  EXPECT_EQ(picture.map, Palette::automatic);
  ASSERT_EQ(problems.count(), 1U);
  EXPECT_NE(problems.lines()[0].find("output.pictures.map is \"jet\""), std::string::npos) << problems.lines()[0];
}

}  // namespace
}  // namespace piola
