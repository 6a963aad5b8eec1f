// SPDX-License-Identifier: Apache-2.0
// Messages about invalid cracks and about probes of cracks: place, key, value, advice.
#include "piola/formulations/registry.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;
using test::mentions_each;
using test::message_of;
using test::sample_case;

/// A plate of 9 x 5 particles; what is added starts in line 8.
std::string plate_with(std::string const& more) {
  return message_of(R"toml(title = "plate"
run = { end = 1 }
[[body]]
name = "plate"
shape = { box = { min = [0, 0], max = [2, 1] }, particles = [9, 5] }
material = { law = "linear_elastic", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
formulation = { name = "jst_sph" }
)toml" + more);
}

std::string refused(std::string_view formulation, std::string_view what) {
  return refusal(*find_formulation(formulation), what);
}

TEST(CrackMessages, FormulationsThatKnowNoCracksRefuseThem) {
  std::string const crack = "[[crack]]\nbody = \"plate\"\nfrom = [0, 0.5]\nto = [1, 0.5]\n";
  EXPECT_EQ(plate_with(crack), "case.toml:8:1: " + refused("jst_sph", "cracks"));
  EXPECT_TRUE(refused("jst_sph", "cracks").starts_with("the formulation \"jst_sph\" knows no cracks (allowed: "));
  EXPECT_TRUE(refused("jst_sph", "cracks").ends_with(") - remove the crack or change body.formulation"));
}

TEST(CrackMessages, FormulationsThatKnowNoMirrorsRefuseThem) {
  EXPECT_EQ(message_of(R"toml(title = "row"
run = { end = 1 }
[[body]]
name = "row"
shape = { box = { min = [0], max = [2] }, particles = [9] }
material = { law = "linear_elastic", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
formulation = { name = "taylor_sph" }
[[mirror]]
body = "row"
face = "+x"
)toml"),
            "case.toml:8:1: " + refused("taylor_sph", "mirrors"));
  EXPECT_TRUE(mentions(refused("taylor_sph", "mirrors"),
                       {"formulation", "\"taylor_sph\"", "no mirrors", "mirrors in jst_sph"}));
}

TEST(CrackMessages, CracksAreInPlaneBoxes) {
  EXPECT_EQ(
      message_of(sample_case() + "[[crack]]\nbody = \"column\"\nfrom = [0, 0, 0]\nto = [0, 1, 0]\n"),
      "case.toml:24:8: body \"column\" cannot have a crack, because it is in 3D (allowed: boxes in 2D) - remove the "
      "crack");
  EXPECT_TRUE(mentions(message_of(R"toml(title = "disc"
run = { end = 1 }
[[body]]
name = "disc"
shape = { sphere = { centre = [0, 0], radius = 1 }, spacing = 0.1 }
material = { law = "linear_elastic", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0.3 }
formulation = { name = "jst_sph" }
[[crack]]
body = "disc"
from = [0, 0]
to = [1, 0]
)toml"),
                       {"case.toml:9:8:", "disc", "crack", "no box", "boxes in 2D", "remove"}));
  EXPECT_TRUE(mentions_each(plate_with("[[crack]]\nbody = \"plate\"\nfrom = [0, 0.5, 0]\ntoo = [1, 0.5]\n"),
                            {{"case.toml:8:1: crack", "\"to\"", "other end", "add to"},
                             {"case.toml:10:8: crack.from", "3 components", "2"},
                             {"case.toml:11:1:", "too", "crack", "body, from, to", "did you mean \"to\""}}));
}

// All that is wrong is said at once: where the crack is, and that this formulation has none.
TEST(CrackMessages, CracksRunFromParticleToParticle) {
  EXPECT_TRUE(mentions_each(
      plate_with("[[crack]]\nbody = \"plate\"\nfrom = [0, 0.5]\nto = [\"110 cm\", 0.5]\n"),
      {{"case.toml:8:1: " + refused("jst_sph", "cracks")},
       {"case.toml:11:6: crack.to", "(1.1, 0.5) m", "plate", "no particle", "1e-6 of the spacing", "(1, 0.5) m"}}));
}

TEST(CrackMessages, StressIntensityNeedsATipAndARange) {
  std::string const probe = "[[probe]]\nname = \"K\"\nbody = \"plate\"\nkind = \"stress_intensity\"\n";
  EXPECT_TRUE(mentions_each(plate_with(probe), {{"case.toml:8:1: probe", "\"at\"", "point", "add at"},
                                                {"case.toml:8:1: probe", "\"from\"", "crack tip", "add from"},
                                                {"case.toml:8:1: probe", "\"to\"", "crack tip", "add to"}}));
  EXPECT_TRUE(mentions_each(
      plate_with(probe + "at = [1, 0.5]\nfrom = \"0.5 m\"\nto = \"25 cm\"\ndirection = [0, 0]\nwhere = \"X > 1\"\n"),
      {{"case.toml:14:6: probe.to", "250 mm", "at least probe.from", "500 mm"},
       {"case.toml:15:13: probe.direction", "zero", "any other length", "direction"},
       {"case.toml:16:9: probe.where", "not used", "\"point\" and \"stress_intensity\"", "remove"}}));
  EXPECT_EQ(
      plate_with(probe + "at = [1, 0.5]\nfrom = 0.3\nto = 0.4\ndirection = [0, 2]\n"),
      "case.toml:13:8: probe \"K\" finds no particle 0.3 m to 0.4 m ahead of the tip at (1, 0.5) m in the direction "
      "(0, 1) (allowed: one or more, within 1e-3 of the distance from that line) - change from, to or direction");
  EXPECT_TRUE(mentions(
      plate_with(probe + "at = [1, 5]\nfrom = 0.3\nto = 0.4\n"),
      {"case.toml:12:6: probe.at", "\"K\"", "(1, 5) m", "outside body \"plate\"", "(0, 0) m to (2, 1) m", "move"}));
  EXPECT_EQ(plate_with(probe + "at = [1, 0.5]\nfrom = 0.25\nto = 0.25\n"), "");
}

TEST(CrackMessages, StressIntensityIsOfPlaneBodies) {
  std::string const probe = "[[probe]]\nname = \"K\"\nbody = \"column\"\nat = [0, 0, 0]\n";
  EXPECT_TRUE(mentions(message_of(sample_case() + probe + "kind = \"stress_intensity\"\nfrom = 1\nto = 2\n"),
                       {"case.toml:27:8: probe.kind", "stress_intensity", "3D", "allowed in 2D", "another kind"}));
  EXPECT_TRUE(mentions_each(
      message_of(sample_case() + probe + "quantities = [\"pressure\"]\nfrom = 1\ndirection = [1, 0, 0]\n"),
      {{"case.toml:28:8: probe.from", "only by the kind \"stress_intensity\"", "remove"},
       {"case.toml:29:13: probe.direction", "only by the kind \"stress_intensity\"", "remove"}}));
}

TEST(CrackMessages, StressIntensitiesHaveAUnit) {
  std::string const more =
      "[[probe]]\nname = \"K\"\nbody = \"plate\"\nkind = \"stress_intensity\"\nat = [1, 0.5]\nfrom = 0.25\nto = 1\n"
      "[[quantity]]\nname = \"K\"\ncolumn = \"K.stress_intensity\"\n";
  EXPECT_EQ(plate_with(more + "unit = \"MPa m^0.5\"\n"), "");
  EXPECT_TRUE(mentions(plate_with(more + "unit = \"MPa m\"\n"),
                       {"case.toml:18:8: quantity.unit", "MPa m", "stress intensity factor", "Pa m^0.5"}));
  EXPECT_TRUE(mentions(plate_with(more + "take = \"first_time_above\"\nthreshold = \"5 MPa\"\n"),
                       {"case.toml:19:13: quantity.threshold", "5 MPa", "stress intensity factor", "Pa m^0.5"}));
}

TEST(CrackMessages, WindowsAreForTakesThatLookAtManyRows) {
  std::string const quantity = "[[quantity]]\nname = \"q\"\ncolumn = \"time\"\n";
  EXPECT_TRUE(mentions_each(plate_with(quantity + "take = \"final_value\"\nfrom = 0\nuntil = 1\n"),
                            {{"case.toml:12:8: quantity.from", "not used", "take", "remove"},
                             {"case.toml:13:9: quantity.until", "not used", "take", "remove"}}));
  EXPECT_TRUE(mentions_each(
      plate_with(quantity + "take = \"relative_error\"\nfrom = \"2 ms\"\nuntil = \"1 ms\"\nunit = \"s\"\n"),
      {{"case.toml:8:1: quantity", "reference", "formula", "add reference"},
       {"case.toml:13:9: quantity.until", "1 ms", "at least quantity.from", "2 ms"},
       {"case.toml:14:8: quantity.unit", "\"s\"", "pure number", "such as 1"}}));
  EXPECT_TRUE(mentions(plate_with(quantity + "take = \"oscillation_period\"\nunit = \"m\"\n"),
                       {"case.toml:12:8: quantity.unit", "\"m\"", "unit of a time", "such as s"}));
}

}  // namespace
}  // namespace piola
