// SPDX-License-Identifier: Apache-2.0
// One case per rule of input/plausibility.hpp that breaks it, beside a good case that breaks none.
#include "piola/input/material_library.hpp"
#include "piola/input/plausibility.hpp"
#include "piola/model/body_properties.hpp"
#include "piola/model/case_particles.hpp"
#include "support/places.hpp"
#include "support/sample_case.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace piola {
namespace {

std::vector<std::string> slips_of(CaseSpec const& spec) {
  ParticleSet const particles = make_particles(spec);
  auto const facts = body_properties(spec, particles);
  Problems slips;
  find_implausible_values(spec, particles, facts, step_estimate(spec, facts), slips);
  return slips.lines();
}
std::vector<std::string> slips_of(std::string const& text) { return slips_of(read_case_text(text, "case.toml")); }

/// A block of aluminium of 10 mm with all that rules look at, on a support that is driven.
std::string const block = R"toml(title = "Block"
[run]
end = "10 us"
[[body]]
name = "block"
shape = { box = { min = [0, 0], max = ["10 mm", "10 mm"] }, particles = [10, 10], placement = "cell_centred" }
formulation = { name = "adaptle", description = "total_lagrangian" }
initial_velocity = ["10*Y/0.01", "0"]
[body.material]
law = "johnson_cook"
density = "2700 kg/m^3"
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
yield_stress = "300 MPa"
hardening_coefficient = "400 MPa"
hardening_exponent = 0.3
rate_coefficient = 0.01
initial_temperature = "293 K"
reference_temperature = "293 K"
melting_temperature = "900 K"
specific_heat = "900 J/(kg K)"
damage = "johnson_cook"
d1 = 0.1
spall = "hydrostatic"
spall_pressure = "1 GPa"
[[support]]
body = "block"
where = "Y < 0.003"
fix = "y"
velocity = ["0", "20 m/s"]
[[load]]
body = "block"
face = "+x"
traction = ["1 MPa", "0"]
[[load]]
body = "block"
acceleration = ["0", "-9.81 m/s^2"]
[[rigid]]
name = "wall"
plane = { point = [0, -0.02], normal = [0, 1] }
motion = "driven"
velocity = ["0", "1 m/s"]
[contact]
friction = 0.3
)toml";

/// A case with one text of the block replaced, and words of the warning that it earns.
struct Odd {
  std::string rule, from, to, words;
};

std::vector<Odd> const oddities{
    {"density", "2700 kg/m^3", "2.7 kg/m^3", "was g/cm^3 meant"},
    {"density", "2700 kg/m^3", "27000 kg/m^3", "heavier than any metal"},
    {"youngs_modulus", "70 GPa", "70 Pa", "was MPa or GPa meant"},
    {"youngs_modulus", "70 GPa", "70000 GPa", "stiffer than diamond"},
    {"poissons_ratio", "= 0.33", "= -0.33", "check the sign"},
    {"poissons_ratio", "= 0.33", "= 0.499999", "take 0.499 or less"},
    {"yield_stress", "\"300 MPa\"", "300", "is 300 Pa, 4.29e-09 times Young's modulus, 70 GPa"},
    {"yield_stress", "300 MPa", "30 GPa", "above the strength of any solid"},
    {"spall_pressure", "\"1 GPa\"", "1000", "times the modulus of pressure waves"},
    {"spall_pressure", "\"1 GPa\"", "\"100 GPa\"", "above the strength of any solid"},
    {"hardening", "\"400 MPa\"", "400", "the hardening is 400 Pa"},
    {"hardening", "\"400 MPa\"", "\"400 GPa\"", "stiffer than the elastic law"},
    {"hardening_exponent", "hardening_exponent = 0.3", "hardening_exponent = 3", "check the law"},
    {"rate_coefficient", "rate_coefficient = 0.01", "rate_coefficient = 14", "check the law"},
    {"fracture_strain", "d1 = 0.1", "d1 = 0", "the first plastic strain breaks the material"},
    {"fracture_strain", "d1 = 0.1", "d1 = 1000", "nothing ever breaks"},
    {"initial_temperature", "initial_temperature = \"293 K\"", "initial_temperature = 20", "was 273 + this meant"},
    {"reference_temperature", "reference_temperature = \"293 K\"", "reference_temperature = 25",
     "was 273 + this meant"},
    {"melting_temperature", "\"900 K\"", "9000", "higher than that of any solid"},
    {"heat", "initial_temperature = \"293 K\"", "initial_temperature = 1000", "no strength from the start"},
    {"specific_heat", "900 J", "0.9 J", "kJ/(kg K) meant"},
    {"friction", "friction = 0.3", "friction = 5", "check the number"},
    {"size", "max = [\"10 mm\", \"10 mm\"]", "max = [20000, 20000]", "larger than a mountain"},
    {"particles_across", "[10, 10]", "[10, 2]", "only 2 particles across in y"},
    {"spacing_ratio", "[10, 10]", "[30, 10]", "differ by a factor of 3"},
    {"speed", "10*Y/0.01", "10000", "times the speed of pressure waves"},
    {"driven_speed", "\"20 m/s\"", "\"20 km/s\"", "support of body \"block\": the velocity is 2e+04 m/s"},
    {"driven_speed", "\"1 m/s\"", "\"10 km/s\"", "rigid shape \"wall\": the velocity is 1e+04 m/s"},
    {"load", "1 MPa", "50 GPa", "traction: the load is 50 GPa"},
    {"load", "1 MPa", "10 Pa", "was MPa or GPa meant"},
    {"load_on_metal", "\"300 MPa\"", "\"0.1 MPa\"", "times the yield stress, 100 kPa"},
    {"weight", "-9.81 m/s^2", "-9.81e9 m/s^2", "under its own weight"},
    {"steps", "10 us", "150 ns", "only about 4 steps"},
    {"steps", "10 us", "100 s", "more than 10 million"},
    {"transits", "[10, 10]", "[100, 100]", "mm given as m"},
};

std::string odd_case(Odd const& odd) {
  std::string text = test::replaced(block, odd.from, odd.to);
  if (odd.rule == "load_on_metal") text = test::replaced(text, "\"1 MPa\"", "\"1 GPa\"");
  if (odd.rule == "size") text = test::replaced(text, "Y < 0.003", "Y < 5000");
  if (odd.rule == "transits") text = test::replaced(text, "10 us", "100 ns");
  return text;
}

TEST(Slips, AGoodCaseHasNone) { EXPECT_EQ(slips_of(block), std::vector<std::string>{}); }

TEST(Slips, EveryRuleFindsItsOwn) {
  for (Odd const& odd : oddities) {
    auto const found = slips_of(odd_case(odd));
    auto const about = [&](std::string const& line) { return line.find(odd.words) != std::string::npos; };
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), about)) << odd.rule << ": " << odd.words << "\n"
                                                                << (found.empty() ? "no warning" : found.front());
    EXPECT_TRUE(find_plausible_range(odd.rule)) << odd.rule;
  }
}

TEST(Slips, EveryRuleHasACaseHere) {
  for (PlausibleRange const& range : plausible_ranges()) {
    if (range.name == "wave_speed" || range.name == "dense_wave_speed") continue;  // below
    auto const of = [&](Odd const& odd) { return odd.rule == range.name; };
    EXPECT_TRUE(std::any_of(oddities.begin(), oddities.end(), of)) << range.name;
  }
}

// Moduli as plain numbers of GPa or MPa.
TEST(Slips, WavesThatAreTooSlowOrFastTellOfModuli) {
  std::string const soft = test::replaced(test::sample_case(), "17 MPa", "200 Pa");
  EXPECT_NE(slips_of(soft).at(0).find("slower than in any solid"), std::string::npos) << slips_of(soft).at(0);
  std::string const dense =
      test::replaced(test::replaced(test::sample_case(), "17 MPa", "0.2 MPa"), "1100 kg", "7800 kg");
  EXPECT_NE(slips_of(dense).at(0).find("was GPa meant for the modulus"), std::string::npos) << slips_of(dense).at(0);
}

TEST(Slips, PartsAreLookedAtToo) {
  std::string const part =
      "[[body.part]]\nwhere = \"X < 0.005\"\nmaterial = { law = \"johnson_cook\", density = 2.7, "
      "youngs_modulus = \"70 GPa\", poissons_ratio = 0.33, yield_stress = \"300 MPa\", "
      "hardening_coefficient = 0, hardening_exponent = 1, melting_temperature = 900 }\n[[support]]";
  std::string nodal =
      test::replaced(block, "name = \"adaptle\", description = \"total_lagrangian\"", "name = \"nodal\"");
  nodal = test::replaced(nodal, "damage = \"johnson_cook\"\nd1 = 0.1\nspall = \"hydrostatic\"\n", "");
  nodal = test::replaced(nodal, "spall_pressure = \"1 GPa\"\n", "");
  auto const found = slips_of(test::replaced(nodal, "[[support]]", part));
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found.front().find("part \"part_1\": density is 2.7 kg/m^3"), std::string::npos) << found.front();
}

TEST(Slips, ShortPulsesAreSeen) {
  auto const found = slips_of(test::replaced(block, "\"1 MPa\"", "\"t < 1e-9 ? 5e10 : 0\""));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("the load is 50 GPa"), std::string::npos) << found[0];
}

TEST(Slips, FormulasThatStopBeingNumbersAreSeen) {
  auto const found = slips_of(test::replaced(block, "\"1 MPa\"", "\"1e6*sqrt(1 - t/5e-6)\""));
  ASSERT_EQ(found.size(), 1U);
  for (char const* word : {"traction: the load is not a number at t = 5.", "X = (", "give until"})
    EXPECT_NE(found[0].find(word), std::string::npos) << word << "\n" << found[0];
  std::string const drive = test::replaced(block, "\"20 m/s\"", "\"log(5e-6 - t)\"");
  EXPECT_NE(slips_of(drive).at(0).find("the velocity is not a number at t = 5."), std::string::npos)
      << slips_of(drive)[0];
}

/// Sets of the library are of real materials.
TEST(Slips, NoMaterialOfTheLibraryIsOdd) {
  for (LibraryMaterial const& material : material_library().materials) {
    CaseSpec spec = read_case_text(test::sample_case(), "case.toml");
    spec.bodies[0].law = std::string(material.law);
    spec.bodies[0].material = parameters_of(material);
    auto const found = slips_of(spec);
    auto const of_material = [](std::string const& line) { return line.find("case.toml:10:") != std::string::npos; };
    auto const odd = std::find_if(found.begin(), found.end(), of_material);
    EXPECT_EQ(odd, found.end()) << material.name << ": " << *odd;
  }
}

/// docs/user/when-it-stops.md has a row for each rule, with its bounds.
TEST(Slips, TheManualListsEveryRule) {
  std::ifstream file(testing::source_folder() + "/docs/user/when-it-stops.md");
  std::stringstream page;
  page << file.rdbuf();
  auto const bound = [](double value, std::string_view none) {
    return std::isfinite(value) ? fmt::format("{:g}", value) : std::string(none);
  };
  for (PlausibleRange const& range : plausible_ranges()) {
    std::string const low = range.low == 0 && range.below.empty() ? "" : bound(range.low, "");
    std::string const high = range.above.empty() ? "" : bound(range.high, "");
    std::string const row = fmt::format("| `{}` |", range.name), bounds = fmt::format("| {} | {} |", low, high);
    std::size_t const at = page.str().find(row);
    ASSERT_NE(at, std::string::npos) << row;
    std::string const line = page.str().substr(at, page.str().find('\n', at) - at);
    EXPECT_NE(line.find(bounds), std::string::npos) << bounds << "\n" << line;
  }
}

}  // namespace
}  // namespace piola
