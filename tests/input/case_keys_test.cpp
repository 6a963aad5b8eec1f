// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_keys.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/geometry/mesh.hpp"
#include "piola/geometry/transformed_solid.hpp"
#include "piola/setup/shapes.hpp"
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

namespace piola {
namespace {

TEST(CaseKeys, EveryKeyBelongsToASectionAndIsListedOnce) {
  std::set<std::pair<std::string, std::string>> seen;
  for (KeyInfo const& info : case_keys()) {
    bool known = false;
    for (SectionInfo const& section : case_sections()) known = known || section.name == info.section;
    EXPECT_TRUE(known) << info.section;
    EXPECT_TRUE(seen.emplace(info.section, info.key).second) << info.section << "." << info.key;
    EXPECT_FALSE(info.meaning.empty()) << info.key;
    EXPECT_FALSE(value_text(info).empty()) << info.key;
    EXPECT_TRUE(info.unit.empty() || same_dimension(info.unit, info.unit)) << info.unit;
    EXPECT_TRUE(info.kind != KeyInfo::Kind::word || !info.words.empty()) << info.key;
  }
  for (SectionInfo const& section : case_sections()) EXPECT_FALSE(keys_of(section.name).empty()) << section.name;
  EXPECT_THROW(key_info("run", "nothing"), std::logic_error);
}

TEST(CaseKeys, OfShapesHaveTheDefaultsOfTheirMembers) {
  auto const standard_of = [](std::string_view section, std::string_view key) {
    return std::string(key_info(section, key).standard);
  };
  auto const word_of = [](std::string_view section, std::string_view key, auto choice) {
    return in_quotes(key_info(section, key).words[static_cast<std::size_t>(choice)]);
  };
  ShapeSpec const shape;
  EXPECT_EQ(standard_of("body.shape", "jitter"), exact_text(shape.jitter));
  EXPECT_EQ(standard_of("body.shape", "seed"), std::to_string(shape.seed));
  EXPECT_EQ(standard_of("body.shape.sphere", "arrangement"),
            word_of("body.shape.sphere", "arrangement", shape.arrangement));
  EXPECT_EQ(standard_of("body.shape.cylinder", "axis"), word_of("body.shape.cylinder", "axis", shape.axis));
  geometry::MeshOptions const mesh;
  EXPECT_EQ(standard_of("body.shape.mesh", "repair"), word_of("body.shape.mesh", "repair", mesh.repair));
  EXPECT_NEAR(read_quantity(standard_of("body.shape.mesh", "feature_angle"), "rad").value, mesh.feature_angle, 1e-12);
  EXPECT_EQ(standard_of("body.shape.transform", "scale"), exact_text(geometry::RigidTransform{}.scale));
}

TEST(CaseKeys, IntervalsAreSaidInWords) {
  EXPECT_EQ(interval_text(any_value), "");
  EXPECT_EQ(interval_text(positive), "above 0");
  EXPECT_EQ(interval_text(not_negative), "at least 0");
  EXPECT_EQ(interval_text({-1, 0.5, true, true}), "between -1 and 0.5, ends excluded");
  EXPECT_EQ(interval_text({0, 2, true, false}), "above 0, at most 2");
  EXPECT_EQ(interval_text({0, 0.5, false, true}), "at least 0, below 0.5");
  EXPECT_EQ(interval_text({1, 9, false, false}), "from 1 to 9");
  EXPECT_EQ(interval_text({-unbounded, 1, false, false}), "at most 1");
}

TEST(CaseKeys, ConditionsAreSaidAsTheyAreWritten) {
  EXPECT_EQ(condition_text({}), "");
  EXPECT_EQ(condition_text({"eos", "polynomial"}), "eos = \"polynomial\"");
  EXPECT_EQ(condition_text({"eos", "stiffened_gas", "mie_grueneisen"}),
            "eos = \"stiffened_gas\" or \"mie_grueneisen\"");
}

}  // namespace
}  // namespace piola
