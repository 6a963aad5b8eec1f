// SPDX-License-Identifier: Apache-2.0
#include "piola/output/summary.hpp"
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

TEST(Summary, HasTheAgreedKeysInOrder) {
  Summary s;
  s.status = "completed";
  s.quantities = {{"peak", 2.5, "MPa"}};
  s.warnings = {"w"};
  auto const json = nlohmann::ordered_json::parse(to_json(s));
  std::vector<std::string> keys;
  for (auto const& item : json.items()) keys.push_back(item.key());
  EXPECT_EQ(keys, (std::vector<std::string>{"status", "title", "version", "formulation", "particles", "steps",
                                            "end_time", "wall_seconds", "stages_per_second", "threads", "energy",
                                            "momentum", "quantities", "warnings"}));
  EXPECT_TRUE(json["energy"].contains("initial") && json["energy"].contains("final") &&
              json["energy"].contains("max_increase"));
  EXPECT_TRUE(json["momentum"].contains("linear_drift") && json["momentum"].contains("angular_drift"));
  EXPECT_EQ(json["quantities"]["peak"]["value"], 2.5);
  EXPECT_EQ(json["quantities"]["peak"]["unit"], "MPa");
  EXPECT_TRUE(nlohmann::ordered_json::parse(to_json(Summary{}))["quantities"].is_object());
}

TEST(Summary, WritesNullForWhatIsNotANumber) {
  Summary s;
  s.energy_final = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(nlohmann::json::parse(to_json(s))["energy"]["final"].is_null());
}

}  // namespace
}  // namespace piola
