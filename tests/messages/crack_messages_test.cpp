// SPDX-License-Identifier: Apache-2.0
// Messages about invalid cracks and about probes of cracks, word for word.
#include "piola/formulations/registry.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

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
  EXPECT_TRUE(refused("taylor_sph", "mirrors")
                  .starts_with("the formulation \"taylor_sph\" knows no mirrors (allowed: mirrors in jst_sph"));
}

TEST(CrackMessages, CracksAreInPlaneBoxes) {
  EXPECT_EQ(
      message_of(sample_case() + "[[crack]]\nbody = \"column\"\nfrom = [0, 0, 0]\nto = [0, 1, 0]\n"),
      "case.toml:24:8: body \"column\" cannot have a crack, because it is in 3D (allowed: boxes in 2D) - remove the "
      "crack");
  EXPECT_EQ(
      message_of(R"toml(title = "disc"
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
      "case.toml:9:8: body \"disc\" cannot have a crack, because it is no box (allowed: boxes in 2D) - remove the "
      "crack");
  EXPECT_EQ(plate_with("[[crack]]\nbody = \"plate\"\nfrom = [0, 0.5, 0]\ntoo = [1, 0.5]\n"),
            "case.toml:8:1: crack needs \"to\" (the other end, at a particle) - add to = [\"0 m\", ...]\n"
            "case.toml:10:8: crack.from has 3 components (allowed: 2, the dimension of the body)\n"
            "case.toml:11:1: \"too\" is not a key of crack (allowed: body, from, to) - did you mean \"to\"?");
}

// All that is wrong is said at once: where the crack is, and that this formulation has none.
TEST(CrackMessages, CracksRunFromParticleToParticle) {
  EXPECT_EQ(plate_with("[[crack]]\nbody = \"plate\"\nfrom = [0, 0.5]\nto = [\"110 cm\", 0.5]\n"),
            "case.toml:8:1: " + refused("jst_sph", "cracks") +
                "\n"
                "case.toml:11:6: crack.to is (1.1, 0.5) m, where body \"plate\" has no particle (allowed: the place of "
                "one, within 1e-6 of the spacing) - the nearest is at (1, 0.5) m");
}

TEST(CrackMessages, StressIntensityNeedsATipAndARange) {
  std::string const probe = "[[probe]]\nname = \"K\"\nbody = \"plate\"\nkind = \"stress_intensity\"\n";
  EXPECT_EQ(plate_with(probe),
            "case.toml:8:1: probe needs \"at\" (the point of the probe) - add at = [\"0 m\", ...]\n"
            "case.toml:8:1: probe needs \"from\" (a distance from the crack tip) - add from = \"1 mm\"\n"
            "case.toml:8:1: probe needs \"to\" (a distance from the crack tip) - add to = \"1 mm\"");
  EXPECT_EQ(
      plate_with(probe + "at = [1, 0.5]\nfrom = \"0.5 m\"\nto = \"25 cm\"\ndirection = [0, 0]\nwhere = \"X > 1\"\n"),
      "case.toml:14:6: probe.to is 250 mm (allowed: at least probe.from, which is 500 mm)\n"
      "case.toml:15:13: probe.direction is zero (allowed: any other length) - give a direction\n"
      "case.toml:16:9: probe.where is not used by the kinds \"point\" and \"stress_intensity\" - remove it");
  EXPECT_EQ(
      plate_with(probe + "at = [1, 0.5]\nfrom = 0.3\nto = 0.4\ndirection = [0, 2]\n"),
      "case.toml:13:8: probe \"K\" finds no particle 0.3 m to 0.4 m ahead of the tip at (1, 0.5) m in the direction "
      "(0, 1) (allowed: one or more, within 1e-3 of the distance from that line) - change from, to or direction");
  EXPECT_EQ(
      plate_with(probe + "at = [1, 5]\nfrom = 0.3\nto = 0.4\n"),
      "case.toml:12:6: probe.at of \"K\" is (1, 5) m, outside body \"plate\" (its particles reach from (0, 0) m to "
      "(2, 1) m) - move the point");
  EXPECT_EQ(plate_with(probe + "at = [1, 0.5]\nfrom = 0.25\nto = 0.25\n"), "");
}

TEST(CrackMessages, StressIntensityIsOfPlaneBodies) {
  std::string const probe = "[[probe]]\nname = \"K\"\nbody = \"column\"\nat = [0, 0, 0]\n";
  EXPECT_EQ(
      message_of(sample_case() + probe + "kind = \"stress_intensity\"\nfrom = 1\nto = 2\n"),
      "case.toml:27:8: probe.kind is \"stress_intensity\" for a body in 3D (allowed in 2D) - choose another kind");
  EXPECT_EQ(message_of(sample_case() + probe + "quantities = [\"pressure\"]\nfrom = 1\ndirection = [1, 0, 0]\n"),
            "case.toml:28:8: probe.from is used only by the kind \"stress_intensity\" - remove it\n"
            "case.toml:29:13: probe.direction is used only by the kind \"stress_intensity\" - remove it");
}

TEST(CrackMessages, StressIntensitiesHaveAUnit) {
  std::string const more =
      "[[probe]]\nname = \"K\"\nbody = \"plate\"\nkind = \"stress_intensity\"\nat = [1, 0.5]\nfrom = 0.25\nto = 1\n"
      "[[quantity]]\nname = \"K\"\ncolumn = \"K.stress_intensity\"\n";
  EXPECT_EQ(plate_with(more + "unit = \"MPa m^0.5\"\n"), "");
  EXPECT_EQ(
      plate_with(more + "unit = \"MPa m\"\n"),
      "case.toml:18:8: quantity.unit is \"MPa m\" (allowed: a unit of a stress intensity factor such as Pa m^0.5)");
  EXPECT_EQ(
      plate_with(more + "take = \"first_time_above\"\nthreshold = \"5 MPa\"\n"),
      "case.toml:19:13: quantity.threshold cannot be read: \"5 MPa\" is not a stress intensity factor (expected a "
      "unit such as Pa m^0.5)");
}

TEST(CrackMessages, WindowsAreForTakesThatLookAtManyRows) {
  std::string const quantity = "[[quantity]]\nname = \"q\"\ncolumn = \"time\"\n";
  EXPECT_EQ(plate_with(quantity + "take = \"final_value\"\nfrom = 0\nuntil = 1\n"),
            "case.toml:12:8: quantity.from is not used by this \"take\" - remove it\n"
            "case.toml:13:9: quantity.until is not used by this \"take\" - remove it");
  EXPECT_EQ(plate_with(quantity + "take = \"relative_error\"\nfrom = \"2 ms\"\nuntil = \"1 ms\"\nunit = \"s\"\n"),
            "case.toml:8:1: quantity needs \"reference\" (the formula to compare with) - add reference = ...\n"
            "case.toml:13:9: quantity.until is 1 ms (allowed: at least quantity.from, which is 2 ms)\n"
            "case.toml:14:8: quantity.unit is \"s\" (allowed: a unit of a pure number such as 1)");
  EXPECT_EQ(plate_with(quantity + "take = \"oscillation_period\"\nunit = \"m\"\n"),
            "case.toml:12:8: quantity.unit is \"m\" (allowed: a unit of a time such as s)");
}

}  // namespace
}  // namespace piola
