// SPDX-License-Identifier: Apache-2.0
// Messages about invalid probes of spacings, fragments, rims and holes: place, key, value, advice.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;
using test::mentions_each;
using test::message_of;
using test::sample_case;

/// A plate of 9 x 5 particles; the probe starts in line 8, what is added in line 11.
std::string of_plate(std::string const& more) {
  return message_of(R"toml(title = "plate"
run = { end = 1 }
[[body]]
name = "plate"
shape = { box = { min = [0, 0], max = [2, 1] }, particles = [9, 5] }
material = { law = "linear_elastic", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
formulation = { name = "jst_sph" }
[[probe]]
name = "p"
body = "plate"
)toml" + more);
}

/// The same in 3D; the probe starts in line 23, what is added in line 26.
std::string of_column(std::string const& more) {
  return message_of(sample_case() + "[[probe]]\nname = \"p\"\nbody = \"column\"\n" + more);
}

TEST(ProbeMessages, GoodProbesHaveNoMessage) {
  EXPECT_EQ(of_plate("kind = \"spacing\"\nwhere = \"X > 1\"\nquantities = [\"spacing_min\", \"share_below_0_5\"]\n"),
            "");
  EXPECT_EQ(of_plate("kind = \"fragment\"\nlink = 2\n"), "");
  EXPECT_EQ(of_plate("kind = \"fragment\"\nfragment = \"largest_free\"\nanchored_where = \"X > 1\"\n"
                     "near_axis = \"3 mm\"\nat = [9, 9]\naxis = \"x\"\n"),
            "");
  EXPECT_EQ(of_plate("kind = \"hole\"\nat = [0, 0]\nslab_from = 0\nslab_to = \"2 m\"\n"), "");
  EXPECT_EQ(of_column("kind = \"rim\"\nat = [0, 0, 0]\nwithin = 1\nbase = \"-1 mm\"\nanchored_where = \"Y < 1\"\n"),
            "");
}

TEST(ProbeMessages, KindsHaveNumbersOfTheirOwn) {
  EXPECT_TRUE(mentions_each(of_plate("kind = \"spacing\"\nquantities = [\"spacing_mn\"]\nat = [0, 0]\naxis = \"x\"\n"),
                            {{"case.toml:12:15: probe.quantities[0]", "spacing_mn", "spacing_min", "share_below_0_5",
                              "did you mean \"spacing_min\""},
                             {"case.toml:13:6: probe.at", "only by the kinds",
                              "\"point\", \"stress_intensity\", \"fragment\", \"rim\" and \"hole\"", "remove"},
                             {"case.toml:14:8: probe.axis", "only by the kinds",
                              "\"twist\", \"extent\", \"fragment\", \"rim\" and \"hole\"", "remove"}}));
}

TEST(ProbeMessages, FragmentsNeedWhatTheyAreFoundBy) {
  EXPECT_TRUE(mentions_each(of_plate("kind = \"fragment\"\nfragment = \"largest_free\"\nat = [0, 0]\nlink = 0\n"),
                            {{"case.toml:8:1: probe", "anchored_where", "stay in place", "add anchored_where"},
                             {"case.toml:13:6: probe.at", "\"fragment\" only with near_axis", "remove"},
                             {"case.toml:14:8: probe.link", "0", "above 0, at most 100"}}));
  EXPECT_TRUE(mentions_each(
      of_plate("kind = \"fragment\"\nnear_axis = 1\naxis = \"z\"\nanchored_where = \"X > 1\"\nwhere = \"X > 1\"\n"),
      {{"case.toml:8:1: probe", "\"at\"", "point of the axis", "add at"},
       {"case.toml:13:8: probe.axis", "2D", "x, y"},
       {"case.toml:14:18: probe.anchored_where", "only with fragment = \"largest_free\"", "remove"},
       {"case.toml:15:9: probe.where", "not used", "\"fragment\", \"rim\" and \"hole\"", "remove"}}));
}

TEST(ProbeMessages, AnchorRegionsSelectParticles) {
  EXPECT_TRUE(mentions(
      of_plate("kind = \"hole\"\nat = [0, 0]\nslab_from = 0\nslab_to = 1\nanchored_where = \"X > 7\"\n"),
      {"case.toml:15:18: probe.anchored_where", "X > 7", "no particle", "plate", "(0, 0) m to (2, 1) m", "condition"}));
}

TEST(ProbeMessages, RimsAreInSpaceAndHolesInThePlane) {
  EXPECT_TRUE(mentions(of_plate("kind = \"rim\"\n"),
                       {"case.toml:11:8: probe.kind", "rim", "2D", "allowed in 3D", "another kind"}));
  EXPECT_EQ(of_column("kind = \"hole\"\n"),
            "case.toml:26:8: probe.kind is \"hole\" for a body in 3D (allowed in 2D) - choose another kind");
}

TEST(ProbeMessages, RimsNeedAnAxisARadiusABaseAndAnAnchor) {
  EXPECT_TRUE(mentions_each(of_column("kind = \"rim\"\nbin = 1\nsectors = 2\n"),
                            {{"case.toml:23:1: probe", "\"at\"", "add at"},
                             {"case.toml:23:1: probe", "\"within\"", "distance from the axis", "add within"},
                             {"case.toml:23:1: probe", "\"base\"", "height", "add base"},
                             {"case.toml:23:1: probe", "\"anchored_where\"", "add anchored_where"},
                             {"case.toml:27:7: probe.bin", "only by the kind \"hole\"", "remove"},
                             {"case.toml:28:11: probe.sectors", "2", "whole number from 3 to 3600"}}));
}

TEST(ProbeMessages, HolesNeedASlab) {
  EXPECT_EQ(of_plate("kind = \"hole\"\nat = [0, 0]\nslab_from = 2\n"),
            "case.toml:8:1: probe needs \"slab_to\" (where the slab ends along the axis) - add slab_to = \"1 mm\"");
  EXPECT_TRUE(mentions_each(
      of_plate("kind = \"hole\"\nat = [0, 0]\nslab_from = 2\nslab_to = 1\ncavity_to = \"50 cm\"\nwithin = 1\n"),
      {{"case.toml:14:11: probe.slab_to", "1 m", "at least probe.slab_from", "2 m"},
       {"case.toml:15:13: probe.cavity_to", "500 mm", "at least probe.slab_from", "2 m"},
       {"case.toml:16:10: probe.within", "only by the kind \"rim\"", "remove"}}));
}

TEST(ProbeMessages, OtherKindsRefuseTheKeys) {
  EXPECT_TRUE(mentions_each(
      of_plate("kind = \"extent\"\nlink = 1\nnear_axis = 1\n"),
      {{"case.toml:12:8: probe.link", "only by the kinds", "\"fragment\", \"rim\" and \"hole\"", "remove"},
       {"case.toml:13:13: probe.near_axis", "only by the kind \"fragment\"", "remove"}}));
}

TEST(ProbeMessages, ChangesHaveTheUnitOfTheirColumn) {
  std::string const probe = "kind = \"hole\"\nat = [0, 0]\nslab_from = 0\nslab_to = 1\n";
  std::string const quantity = "[[quantity]]\nname = \"q\"\ncolumn = \"p.hole_slab\"\ntake = \"change\"\n";
  EXPECT_EQ(of_plate(probe + quantity + "from = \"1 ms\"\nunit = \"cm\"\n"), "");
  EXPECT_TRUE(mentions_each(of_plate(probe + quantity + "from = \"1 ms\"\nuntil = 0\nunit = \"s\"\n"),
                            {{"case.toml:20:9: quantity.until", "0 s", "at least quantity.from", "1 ms"},
                             {"case.toml:21:8: quantity.unit", "\"s\"", "unit of a length", "such as m"}}));
}

}  // namespace
}  // namespace piola
