// SPDX-License-Identifier: Apache-2.0
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;

std::string with(std::string const& keys) {
  return test::sample_case() + "\n[output.pictures]\nevery = 1\n" + keys + "\n";
}

AppearanceSpec read(std::string const& keys) {
  return read_case_text(with(keys), "case.toml").output.pictures.appearance;
}

std::string refusal(std::string const& keys) { return test::message_of(with(keys)); }

TEST(ReadAppearance, IsAutomaticUnlessTheCaseSaysOtherwise) {
  AppearanceSpec const standard = read("");
  EXPECT_EQ(standard.as, "auto");
  EXPECT_TRUE(standard.of_body.empty());
  EXPECT_TRUE(standard.outline);
  EXPECT_FALSE(standard.cut);
  AppearanceSpec const all = read("as = \"balls\"\noutline = false");
  EXPECT_EQ(all.as, "balls");
  EXPECT_FALSE(all.outline);
  AppearanceSpec const one = read("as = { column = \"none\" }");
  ASSERT_EQ(one.of_body.size(), 1U);
  EXPECT_EQ(one.of_body[0].body, "column");
  EXPECT_EQ(one.of_body[0].as, "none");
}

TEST(ReadAppearance, CutsAlongAPlane) {
  AppearanceSpec const cut =
      read("cut = { point = [0, \"20 cm\", 0], normal = [0, 2, 0], show = \"ghost\", of = \"reference\" }");
  ASSERT_TRUE(cut.cut);
  EXPECT_DOUBLE_EQ(cut.cut->point[1], 0.2);
  EXPECT_DOUBLE_EQ(cut.cut->normal[1], 1);
  EXPECT_TRUE(cut.cut->ghost);
  EXPECT_TRUE(cut.cut->in_reference);
  EXPECT_FALSE(read("cut = { point = [0, 0, 0], normal = [1, 0, 0] }").cut->ghost);
}

TEST(ReadAppearance, NamesWhatIsWrong) {
  EXPECT_NE(refusal("as = \"marbles\"").find("output.pictures.as"), std::string::npos) << refusal("as = \"marbles\"");
  std::string const several = refusal("as = { column = \"glass\", wall = \"none\" }\ncut = { point = [0, 0, 0] }");
  expect_words(several, {"output.pictures.as.column", "output.pictures.as names", "\"wall\"", "normal"});
  EXPECT_NE(refusal("as = 3"), "");
  EXPECT_NE(refusal("cut = { point = [0, 0, 0], normal = [0, 0, 0] }"), "");
  EXPECT_NE(refusal("cut = { point = [0, 0, 0], normal = [0, 1, 0], show = \"half\" }"), "");
}

}  // namespace
}  // namespace piola
