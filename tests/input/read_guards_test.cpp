// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;
using test::message_of;
using test::sample_with;

GuardLimits limits_of(std::string const& guards) {
  return read_case_text(sample_with("end = \"0.5 s\"", "end = \"0.5 s\"\n" + guards), "case.toml", {}).run.guards;
}

TEST(ReadGuards, AreOnWithTheLimitsOfTheManual) {
  GuardLimits const g = limits_of("");
  EXPECT_TRUE(g.on);
  EXPECT_EQ(g.energy_rise_warn, 0.01);
  EXPECT_EQ(g.energy_rise_stop, 0.1);
  EXPECT_EQ(g.dissipation, 0.1);
  EXPECT_EQ(g.jacobian, (std::array{0.3, 3.0}));
  EXPECT_EQ(g.overlap, 1);
  EXPECT_EQ(g.proximity, 0.5);
  EXPECT_EQ(g.strain_drift_warn, 0.05);
  EXPECT_EQ(g.strain_drift_stop, 0.2);
  EXPECT_EQ(g.step_warn, 1e-3);
  EXPECT_EQ(g.step_stop, 0);
  EXPECT_EQ(g.small_strain_warn, 0.02);
  EXPECT_EQ(g.small_rotation_warn, 0.05);
  EXPECT_TRUE(std::isinf(g.small_strain_stop) && std::isinf(g.small_rotation_stop));
}

TEST(ReadGuards, TakeLimitsAndOff) {
  GuardLimits const g = limits_of(
      "guards = { energy_rise_warn = \"2 %\", energy_rise_stop = \"off\", dissipation = 0.5, jacobian = [0.1, 20], "
      "overlap = \"off\", proximity = \"off\", strain_drift_warn = 0.1, strain_drift_stop = 1 }");
  EXPECT_TRUE(g.on);
  EXPECT_DOUBLE_EQ(g.energy_rise_warn, 0.02);
  EXPECT_TRUE(std::isinf(g.energy_rise_stop));
  EXPECT_EQ(g.dissipation, 0.5);
  EXPECT_EQ(g.jacobian, (std::array{0.1, 20.0}));
  EXPECT_TRUE(std::isinf(g.overlap));
  EXPECT_EQ(g.proximity, 0);
  EXPECT_EQ(g.strain_drift_warn, 0.1);
  EXPECT_EQ(g.strain_drift_stop, 1);
  EXPECT_TRUE(std::isinf(limits_of("guards = { jacobian = \"off\" }").jacobian[1]));
  EXPECT_FALSE(limits_of("guards = \"off\"").on);
}

std::string refusal(std::string const& guards) {
  return message_of(sample_with("end = \"0.5 s\"", "end = \"0.5 s\"\n" + guards));
}

TEST(ReadGuards, TakeLimitsOfTheStepAndOfSmallStrain) {
  GuardLimits const g = limits_of(
      "guards = { step_warn = \"1 %\", step_stop = 1e-4, small_strain_warn = 0.1, small_strain_stop = 0.2, "
      "small_rotation_warn = \"0.2 rad\", small_rotation_stop = 0.5 }");
  EXPECT_DOUBLE_EQ(g.step_warn, 0.01);
  EXPECT_EQ(g.step_stop, 1e-4);
  EXPECT_EQ(g.small_strain_warn, 0.1);
  EXPECT_EQ(g.small_strain_stop, 0.2);
  EXPECT_EQ(g.small_rotation_warn, 0.2);
  EXPECT_EQ(g.small_rotation_stop, 0.5);
  GuardLimits const off = limits_of(
      "guards = { step_warn = \"off\", step_stop = \"off\", small_strain_warn = \"off\", "
      "small_rotation_warn = \"off\", small_strain_stop = \"off\", small_rotation_stop = \"off\" }");
  EXPECT_EQ(off.step_warn, 0);
  EXPECT_EQ(off.step_stop, 0);
  EXPECT_TRUE(std::isinf(off.small_strain_warn) && std::isinf(off.small_rotation_warn));
  EXPECT_TRUE(std::isinf(off.small_strain_stop) && std::isinf(off.small_rotation_stop));
}

TEST(ReadGuards, RefuseWhatHasNoMeaning) {
  expect_words(refusal("guards = \"on\""), {"run.guards", "\"on\"", "guards = { ... }"});
  EXPECT_NE(refusal("guards = { jacobian = [3, 0.3] }").find("run.guards.jacobian is empty"), std::string::npos);
  EXPECT_NE(refusal("guards = { dissipaton = 1 }").find("did you mean \"dissipation\"?"), std::string::npos);
  EXPECT_NE(refusal("guards = { step_stop = 0 }").find("run.guards.step_stop is 0"), std::string::npos);
  EXPECT_NE(refusal("guards = { small_rotation_stop = \"5 mm\" }").find("run.guards.small_rotation_stop"),
            std::string::npos);
  EXPECT_NE(refusal("guards = { overlap = -1 }").find("run.guards.overlap is -1"), std::string::npos);
}

}  // namespace
}  // namespace piola
