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

Appearance read(std::string const& keys) { return read_case_text(with(keys), "case.toml").output.pictures.appearance; }

std::string refusal(std::string const& keys) { return test::message_of(with(keys)); }

TEST(ReadAppearance, IsAutomaticUnlessTheCaseSaysOtherwise) {
  Appearance const standard = read("");
  EXPECT_TRUE(standard.as.empty());
  EXPECT_TRUE(standard.outline);
  EXPECT_FALSE(standard.cut);
  Appearance const all = read("as = \"balls\"\noutline = false");
  EXPECT_EQ(all.as, std::vector{Representation::balls});
  EXPECT_FALSE(all.outline);
  Appearance const one = read("as = { column = \"none\" }");
  EXPECT_EQ(one.as, std::vector{Representation::none});
}

TEST(ReadAppearance, CutsAlongAPlane) {
  Appearance const cut =
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
  expect_words(several,
               {"output.pictures.as.column", "output.pictures.as names", "\"wall\" (allowed: column)", "normal"});
  EXPECT_NE(refusal("as = 3"), "");
  EXPECT_NE(refusal("cut = { point = [0, 0, 0], normal = [0, 0, 0] }"), "");
  EXPECT_NE(refusal("cut = { point = [0, 0, 0], normal = [0, 1, 0], show = \"half\" }"), "");
}

}  // namespace
}  // namespace piola
