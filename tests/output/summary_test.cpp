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
  s.linear_drift = 0.25;
  s.angular_drift = 0.5;
  auto const json = nlohmann::ordered_json::parse(to_json(s));
  std::vector<std::string> keys;
  for (auto const& item : json.items()) keys.push_back(item.key());
  EXPECT_EQ(keys, (std::vector<std::string>{"status", "title", "version", "identity", "formulation", "particles",
                                            "steps", "bits", "end_time", "wall_seconds", "stages_per_second", "threads",
                                            "energy", "momentum", "quantities", "guards", "warnings"}));
  EXPECT_TRUE(json["energy"].contains("initial") && json["energy"].contains("final") &&
              json["energy"].contains("max_increase") && json["energy"].contains("max_decrease"));
  EXPECT_EQ(json["momentum"]["linear_drift"], 0.25);
  EXPECT_EQ(json["momentum"]["angular_drift"], 0.5);
  EXPECT_EQ(json["quantities"]["peak"]["value"], 2.5);
  EXPECT_EQ(json["quantities"]["peak"]["unit"], "MPa");
  EXPECT_TRUE(nlohmann::ordered_json::parse(to_json(Summary{}))["quantities"].is_object());
}

TEST(Summary, HasTheScalesOfMomentaAndStresses) {
  Summary s;
  s.scales = {{"kg m/s", 3}, {"Pa", 2e11}};
  auto const scales = nlohmann::json::parse(to_json(s))["scales"];
  EXPECT_EQ(scales["kg m/s"], 3);
  EXPECT_EQ(scales["Pa"], 2e11);
}

TEST(Summary, HasNoMomentumWhereItMeansNothing) {
  EXPECT_FALSE(nlohmann::json::parse(to_json(Summary{})).contains("momentum"));
}

TEST(Summary, HasWhatRanksSaidWhereThereAreSeveral) {
  EXPECT_FALSE(nlohmann::json::parse(to_json(Summary{})).contains("ranks"));
  Summary s;
  s.ranks = {{8, 1e6, 7, 1e-3, 2e-3, 0}, {4, 2e6, 7, 0, 0, 3e6}};
  auto const ranks = nlohmann::json::parse(to_json(s))["ranks"];
  ASSERT_EQ(ranks.size(), 2U);
  EXPECT_EQ(ranks[0]["messages"], 8);
  EXPECT_EQ(ranks[1]["bytes"], 2e6);
  EXPECT_EQ(ranks[0]["collectives"], 7);
  EXPECT_EQ(ranks[0]["message_seconds"], 1e-3);
  EXPECT_EQ(ranks[0]["collective_seconds"], 2e-3);
  EXPECT_EQ(ranks[1]["replicated_bytes"], 3e6);
}

TEST(Summary, HasSecondsWhereTheFormulationTellsThem) {
  EXPECT_FALSE(nlohmann::json::parse(to_json(Summary{})).contains("seconds"));
  Summary s;
  s.seconds = {{"neighbours", 1.5}, {"forces", 0.25}};
  auto const seconds = nlohmann::ordered_json::parse(to_json(s))["seconds"];
  EXPECT_EQ(seconds.dump(), R"({"neighbours":1.5,"forces":0.25})");
}

TEST(Summary, WritesNullForWhatIsNotANumber) {
  Summary s;
  s.energy_final = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(nlohmann::json::parse(to_json(s))["energy"]["final"].is_null());
}

}  // namespace
}  // namespace piola
