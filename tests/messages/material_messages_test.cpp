// SPDX-License-Identifier: Apache-2.0
// Messages about invalid words and numbers of a solid.
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::message_of;
using test::sample_with;

constexpr std::string_view rubber =
    R"(material = { law = "neo_hookean", density = "1100 kg/m^3", youngs_modulus = "17 MPa", poissons_ratio = 0.45 })";

/// The sample case with another material and formulation.
std::string message_with(std::string const& keys, std::string const& formulation = "nodal") {
  std::string const text = sample_with(rubber, "material = { " + keys + " }");
  return message_of(test::replaced(text, R"(name = "jst_sph", variables = "pF", eps4_momentum = 0.125)",
                                   "name = \"" + formulation + "\""));
}
/// The same under Taylor-SPH, which takes none of the solids.
std::string taylor_message_with(std::string const& keys) { return message_with(keys, "taylor_sph"); }
std::string not_for_taylor(std::string const& law) {
  return "case.toml:10:12: the formulation \"taylor_sph\" cannot use the law \"" + law +
         "\" (allowed: linear_elastic) - change body.material.law or body.formulation (adaptle, nodal can use it)";
}

TEST(MaterialMessages, NumbersOfAnotherWordSayWhichWordTheyNeed) {
  EXPECT_EQ(
      message_with("law = \"elastic\", eos = \"polynomial\", density = 1, youngs_modulus = 1, poissons_ratio = 0, "
                   "hugoniot_s1 = 1, bulk_sound_speed = 2, damage = \"none\""),
      "case.toml:10:118: body.material.hugoniot_s1 does not count here (it needs eos = \"mie_grueneisen\") - "
      "remove it or set eos = \"mie_grueneisen\"\n"
      "case.toml:10:140: body.material.bulk_sound_speed does not count here (it needs eos = \"stiffened_gas\" or "
      "\"mie_grueneisen\") - remove it or set eos = \"stiffened_gas\" or \"mie_grueneisen\"\n"
      "case.toml:10:143: \"damage\" is not a key of body.material (allowed: law, name, eos, density, "
      "youngs_modulus, poissons_ratio, bulk_sound_speed, hugoniot_s1, c1, c2, c3, c4, c5, c6, spall_pressure) - "
      "choose one of these");
}

TEST(MaterialMessages, AWordBringsTheNumbersThatItNeeds) {
  EXPECT_EQ(taylor_message_with(
                "law = \"perfectly_plastic\", eos = \"mie_grueneisen\", damage = \"jonson_cook\", density = 1, "
                "youngs_modulus = 1, poissons_ratio = 0, spall_pressure = -1, d1 = 1"),
            "case.toml:10:12: body.material needs \"yield_stress\" (von Mises stress at yield, in Pa, above 0) - add "
            "yield_stress = \"... Pa\"\n"
            "case.toml:10:12: body.material needs \"grueneisen_gamma\" (Grueneisen's gamma0 at rest, at least 0) - add "
            "grueneisen_gamma = ...\n"
            "case.toml:10:12: body.material needs \"hugoniot_s1\" (s1, slope of shock speed over particle speed, at "
            "least 0) - add hugoniot_s1 = ...\n" +
                not_for_taylor("perfectly_plastic") +
                "\n"
                "case.toml:10:74: body.material.damage is \"jonson_cook\" (allowed: none, johnson_cook) - did you mean "
                "\"johnson_cook\"?\n"
                "case.toml:10:159: body.material.spall_pressure is -1 Pa (allowed: above 0)");
}

TEST(MaterialMessages, FailureBySpallNeedsItsStress) {
  std::string const message = message_with("name = \"steel_4340\", spall = \"hydrostatic\"");
  EXPECT_NE(
      message.find("body.material.spall = \"hydrostatic\" needs spall_pressure, which has no limit here - give it, "
                   "or spall = \"limit\""),
      std::string::npos)
      << message;
}

TEST(MaterialMessages, NamesOfTheLibraryAreKnown) {
  EXPECT_EQ(message_with("name = \"steel_4304\""),
            "case.toml:10:21: body.material.name is \"steel_4304\" (allowed: steel_4340, steel_1006, steel_mild, "
            "pbx_9404, armox_500t, weldox_460_e, copper_ofhc, tantalum and 30 more) - did you mean \"steel_4340\"?");
  EXPECT_EQ(
      message_with("name = \"aluminium_adaptle_3_2\""),
      "case.toml:10:21: body.material.name \"aluminium_adaptle_3_2\" is now \"aluminium_perfectly_plastic\" - write "
      "name = \"aluminium_perfectly_plastic\"");
  EXPECT_EQ(
      taylor_message_with("name = \"steel_4340\", law = \"elastic\", c1 = 4000, density = 7800"),
      not_for_taylor("johnson_cook") +
          "\ncase.toml:10:41: body.material.law is that of the material of the library when \"name\" is given - remove "
          "it\n"
          "case.toml:10:57: body.material.c1 does not count here (it needs eos = \"polynomial\") - remove it or set "
          "eos = \"polynomial\"");
  EXPECT_EQ(
      message_with("density = 1"),
      "case.toml:10:12: body.material needs \"law\" (name of the law; or \"name\", a material of the library) - add "
      "law = \"...\"");
}

}  // namespace
}  // namespace piola
