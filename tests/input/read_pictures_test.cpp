// SPDX-License-Identifier: Apache-2.0
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

std::string with_pictures(std::string const& keys) {
  return test::sample_case() + "\n[output.pictures]\nevery = 1\n" + keys + "\n";
}
PicturesSpec pictures_of(std::string const& keys) {
  return read_case_text(with_pictures(keys), "case.toml").output.pictures;
}
std::string refusal_of(std::string const& keys) { return test::message_of(with_pictures(keys)); }

TEST(ReadPanels, TakeFromThePictureWhatTheyDoNotSay) {
  PicturesSpec const all = pictures_of(R"(
field = "VonMisesStress"
range = [0, "5 MPa"]
view = "x"
zoom = 2
columns = 1
[[output.pictures.panel]]
view = [10, "20 degree"]
caption = "here"
[[output.pictures.panel]]
field = "Velocity"
component = "y"
cut = { point = [0, 1, 0], normal = [0, 1, 0] }
as = { column = "balls" })");
  ASSERT_EQ(all.panels.size(), 2U);
  EXPECT_EQ(all.columns, 1);
  PictureSpec const &first = all.panels[0], &second = all.panels[1];
  EXPECT_EQ(first.field, "VonMisesStress");
  ASSERT_TRUE(first.range);
  EXPECT_DOUBLE_EQ((*first.range)[1], 5e6);
  EXPECT_EQ(first.named_view, "") << "angles in place of the name";
  EXPECT_DOUBLE_EQ(first.view[0], 10);
  EXPECT_EQ(first.caption, "here");
  EXPECT_EQ(first.zoom, 2);
  EXPECT_FALSE(first.appearance.cut);
  EXPECT_EQ(second.field, "Velocity");
  EXPECT_EQ(second.component, "y");
  EXPECT_FALSE(second.range) << "pascals are no range of velocities";
  EXPECT_EQ(second.named_view, "x");
  ASSERT_TRUE(second.appearance.cut);
  EXPECT_EQ(second.appearance.as, std::vector{Representation::balls});
}

TEST(ReadPanels, RefuseWhatPicturesAloneHave) {
  EXPECT_NE(refusal_of("columns = 2").find("output.pictures.columns is used only with panels"), std::string::npos);
  std::string const text =
      refusal_of("times = [1]\n[[output.pictures.panel]]\ntheme = \"dark\"\nfield = \"Velocity\"\ncomponent = \"xx\"");
  EXPECT_NE(text.find("output.pictures.times has no meaning beside panels"), std::string::npos) << text;
  EXPECT_NE(text.find("theme"), std::string::npos) << text;
  EXPECT_NE(text.find("output.pictures.panel.component is \"xx\" (Velocity has x, y, z)"), std::string::npos) << text;
  EXPECT_NE(refusal_of("panel = [1]").find("output.pictures.panel[0] is 1 (allowed: a table)"), std::string::npos)
      << refusal_of("panel = [1]");
}

TEST(ReadPictures, TakesMomentsAndWhatIsDrawnBesideBodies) {
  PicturesSpec const all =
      pictures_of("times = [0, \"10 ms\"]\nquality = \"high\"\nwarp = 20\nground = true\nsupports = true");
  EXPECT_EQ(all.times, (std::vector<double>{0, 0.01}));
  EXPECT_EQ(all.appearance.quality, Quality::high);
  EXPECT_EQ(all.warp, 20);
  EXPECT_TRUE(all.ground);
  EXPECT_TRUE(all.supports);
  std::string const text = refusal_of("times = [-1]\nquality = \"best\"\nwarp = -1");
  for (char const* const key : {"times", "quality", "warp"})
    EXPECT_NE(text.find(std::string("output.pictures.") + key), std::string::npos) << text;
}

std::string rings(std::string const& keys) {
  return R"(geometry = "axisymmetric"
title = "Ring"
[run]
end = "1 ms"
[[body]]
name = "ring"
shape = { box = { min = [1, 0], max = [2, 1] }, spacing = 0.25 }
material = { law = "neo_hookean", density = "1100 kg/m^3", youngs_modulus = "17 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
[output.pictures]
every = 1
)" + keys +
         "\n";
}

TEST(ReadPictures, TakesTheAngleThroughWhichSectionsAreSwept) {
  EXPECT_EQ(read_case_text(rings(""), "case.toml").output.pictures.revolve, 0);
  PicturesSpec const all =
      read_case_text(rings("[[output.pictures.panel]]\nrevolve = 270\nground = true"), "case.toml").output.pictures;
  EXPECT_EQ(all.revolve, 0);
  EXPECT_EQ(all.panels.front().revolve, 270);
}

TEST(ReadPictures, RefusesToSweepWhatIsNoSection) {
  auto const names = [](std::string const& text, std::string const& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  names(refusal_of("revolve = 270"), "output.pictures.revolve is 270");
  names(refusal_of("revolve = 270"), "axisymmetric");
  for (std::string const wrong : {"0", "-90", "361"})
    names(test::message_of(rings("revolve = " + wrong)), "output.pictures.revolve is " + wrong);
  names(test::message_of(rings("[[output.pictures.panel]]\nrevolve = 400")), "output.pictures.panel.revolve is 400");
  names(test::message_of(rings("revolve = 90\ncut = { point = [0, 0], normal = [0, 1] }")), "revolve is 90");
  names(test::message_of(rings("ground = true")), "output.pictures.ground is true");
}

}  // namespace
}  // namespace piola
