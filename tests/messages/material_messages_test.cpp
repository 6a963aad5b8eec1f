// SPDX-License-Identifier: Apache-2.0
// Messages about invalid words and numbers of a solid.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;
using test::mentions;
using test::mentions_each;
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
test::KeyWords not_for_taylor(std::string const& law) {
  return {"case.toml:10:12: ", "formulation \"taylor_sph\"", law, "linear_elastic", "adaptle, nodal"};
}

TEST(MaterialMessages, NumbersOfAnotherWordSayWhichWordTheyNeed) {
  EXPECT_TRUE(mentions_each(
      message_with("law = \"elastic\", eos = \"polynomial\", density = 1, youngs_modulus = 1, poissons_ratio = 0, "
                   "hugoniot_s1 = 1, bulk_sound_speed = 2, damage = \"none\""),
      {{"case.toml:10:118: body.material.hugoniot_s1", "eos = \"mie_grueneisen\"", "remove", "mie_grueneisen"},
       {"case.toml:10:140: body.material.bulk_sound_speed", "eos = \"stiffened_gas\" or \"mie_grueneisen\"", "remove",
        "stiffened_gas"},
       {"case.toml:10:143:", "damage", "body.material", "law, name, library, eos", "spall_pressure", "choose"}}));
}

TEST(MaterialMessages, AWordBringsTheNumbersThatItNeeds) {
  EXPECT_TRUE(mentions_each(
      taylor_message_with(
          "law = \"perfectly_plastic\", eos = \"mie_grueneisen\", damage = \"jonson_cook\", density = 1, "
          "youngs_modulus = 1, poissons_ratio = 0, spall_pressure = -1, d1 = 1"),
      {{"case.toml:10:12: body.material", "yield_stress", "in Pa, above 0", "add yield_stress"},
       {"case.toml:10:12: body.material", "grueneisen_gamma", "at least 0", "add grueneisen_gamma"},
       {"case.toml:10:12: body.material", "hugoniot_s1", "at least 0", "add hugoniot_s1"},
       not_for_taylor("perfectly_plastic"),
       {"case.toml:10:74: body.material.damage", "jonson_cook", "none, johnson_cook", "did you mean \"johnson_cook\""},
       {"case.toml:10:159: body.material.spall_pressure", "-1 Pa", "above 0"}}));
}

TEST(MaterialMessages, FailureBySpallNeedsItsStress) {
  std::string const message = message_with("name = \"steel_4340\", spall = \"hydrostatic\"");
  expect_words(message, {"body.material.spall = \"hydrostatic\"", "spall_pressure", "spall = \"limit\""});
}

constexpr char const* metal = "density = 7800, youngs_modulus = 2e11, poissons_ratio = 0.3, ";

std::string message_of_curve(std::string const& curve) {
  return message_with("law = \"tabulated_hardening\", hardening_curve = " + curve + ", " + metal + "damage = \"none\"");
}

TEST(MaterialMessages, HardeningCurvesAreRowsOrAFile) {
  EXPECT_EQ(message_of_curve("[[0, \"200 MPa\"], [0.1, 300e6]]"), "");
  EXPECT_EQ(message_of_curve("{ table = [[0, 200], [0.1, 300]], scale = 1e6 }"), "");
  EXPECT_TRUE(mentions(message_of_curve("{ file = \"none.csv\" }"), {"none.csv", "cannot be read"}));
  EXPECT_TRUE(
      mentions(message_of_curve("{ file = \"a.csv\", over = \"X\" }"), {"table.over", "hardening_curve", "remove"}));
  EXPECT_TRUE(mentions(message_of_curve("[[0, \"200 MPa\"]]"), {"hardening_curve", "1", "2"}));
  EXPECT_TRUE(mentions(message_of_curve("[[0, \"200 m\"], [1, 3e8]]"), {"hardening_curve[0][1]", "200 m", "Pa"}));
  EXPECT_TRUE(mentions(message_of_curve("[[0, 2e8], [0, 3e8]]"), {"hardening_curve[1]", "increasing", "sort"}));
  EXPECT_TRUE(mentions(message_with(std::string("law = \"tabulated_hardening\", ") + metal + "damage = \"none\""),
                       {"body.material", "hardening_curve", "plastic strain", "yield stress", "file"}));
}

TEST(MaterialMessages, HardeningCurvesBeginAtZeroAndDoNotFall) {
  EXPECT_TRUE(
      mentions(message_of_curve("[[0.01, 2e8], [0.1, 3e8]]"), {"hardening_curve", "begins", "0.01", "allowed: 0"}));
  EXPECT_TRUE(mentions(message_of_curve("[[0, 0], [0.1, 3e8]]"), {"hardening_curve", "0 Pa", "above 0"}));
  EXPECT_TRUE(mentions(message_of_curve("[[0, 3e8], [0.1, 2e8]]"),
                       {"hardening_curve", "falls", "300 MPa", "200 MPa", "0.1", "maximum", "damage"}));
  std::string rows = "[0, 1e8]";
  for (int k = 1; k <= 32; ++k) rows += ", [" + std::to_string(k) + ", 1e8]";
  EXPECT_TRUE(mentions(message_of_curve("[" + rows + "]"), {"hardening_curve", "33 rows", "2 to 32", "slope changes"}));
}

TEST(MaterialMessages, RatesNeedTheirConstants) {
  std::string const law = std::string("law = \"voce\", yield_stress = 2e8, voce_q = 1e8, voce_b = 10, ") + metal;
  EXPECT_TRUE(mentions_each(message_with(law + "rate_dependence = \"cowper_symonds\""),
                            {{"body.material", "cowper_symonds_c"}, {"body.material", "cowper_symonds_p"}}));
  EXPECT_TRUE(mentions(message_with(law + "cowper_symonds_c = 40, damage = \"none\""),
                       {"cowper_symonds_c", "rate_dependence = \"cowper_symonds\"", "remove"}));
  EXPECT_TRUE(mentions(
      message_with(law + "cowper_symonds_c = 40, cowper_symonds_p = 0.2, rate_dependence = \"cowper_symonds\""),
      {"cowper_symonds_p", "0.2", "at least 1"}));
}

TEST(MaterialMessages, VapourIsCompleteAboveTheEnergyAtWhichItBegins) {
  EXPECT_TRUE(mentions(message_with("name = \"aluminium_tillotson\", tillotson_ecv = \"2 MJ/kg\""),
                       {"body.material.tillotson_ecv", "2e+06 J/kg", "above tillotson_eiv", "3e+06 J/kg"}));
  EXPECT_EQ(message_with("name = \"aluminium_tillotson\", tillotson_ecv = \"20 MJ/kg\""), "");
}

TEST(MaterialMessages, NamesOfTheLibraryAreKnown) {
  EXPECT_TRUE(mentions(message_with("name = \"steel_4304\""), {"case.toml:10:21: body.material.name", "steel_4304",
                                                               "steel_4340", "more", "did you mean \"steel_4340\""}));
  EXPECT_EQ(
      message_with("name = \"aluminium_adaptle_3_2\""),
      "case.toml:10:21: body.material.name \"aluminium_adaptle_3_2\" is now \"aluminium_perfectly_plastic\" - write "
      "name = \"aluminium_perfectly_plastic\"");
  EXPECT_TRUE(mentions_each(taylor_message_with("name = \"steel_4340\", law = \"elastic\", c1 = 4000, density = 7800"),
                            {not_for_taylor("johnson_cook"),
                             {"case.toml:10:41: body.material.law", "library", "\"name\"", "remove"},
                             {"case.toml:10:57: body.material.c1", "eos = \"polynomial\"", "remove"}}));
  EXPECT_EQ(
      message_with("density = 1"),
      "case.toml:10:12: body.material needs \"law\" (name of the law; or \"name\", a material of the library) - add "
      "law = \"...\"");
}

TEST(MaterialMessages, HeatSpreadsInNodalAlone) {
  std::string const conducting =
      "law = \"perfectly_plastic\", density = 7800, youngs_modulus = 2e11, poissons_ratio = 0.3, "
      "yield_stress = 1e9, conductivity = 50";
  EXPECT_TRUE(mentions(message_with(conducting + ", specific_heat = 400", "adaptle"),
                       {"case.toml:10:12: material.conductivity", "\"adaptle\"", "nodal", "leave"}));
  EXPECT_TRUE(mentions(message_with(conducting), {"case.toml:10:12: material.conductivity", "specific_heat", "both"}));
  EXPECT_TRUE(mentions(message_of(sample_with("initial_velocity", "initial_temperature = 400\ninitial_velocity")),
                       {"case.toml:13:23: body.initial_temperature", "nodal", "jst_sph"}));
  std::string const warm = sample_with(rubber,
                                       "material = { law = \"perfectly_plastic\", density = 7800, youngs_modulus "
                                       "= 2e11, poissons_ratio = 0.3, yield_stress = 1e9, specific_heat = 400 }");
  EXPECT_TRUE(mentions(
      message_of(test::replaced(
          test::replaced(warm, R"(name = "jst_sph", variables = "pF", eps4_momentum = 0.125)", R"(name = "nodal")"),
          "initial_velocity", "initial_temperature = \"100*Y\"\ninitial_velocity")),
      {"case.toml:13:23: body.initial_temperature", "100*Y", "is 0", "above 0"}));
}

}  // namespace
}  // namespace piola
