// SPDX-License-Identifier: Apache-2.0
// Output of `piola check` and `piola describe`, by running the program.
#include "support/key_words.hpp"
#include "support/places.hpp"
#include "support/sample_case.hpp"
#include "support/temporary_folder.hpp"
#include <array>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#ifdef PIOLA_HAS_PROGRAM

namespace piola {
namespace {

using test::expect_words;
using test::mentions;

struct Answer {
  std::string text;  ///< stdout and stderr
  int code = -1;
};

Answer ask(std::string const& arguments) {
  Answer answer;
  std::FILE* const pipe = popen(("'" + testing::program() + "' " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> buffer{};
  while (std::size_t const n = std::fread(buffer.data(), 1, buffer.size(), pipe)) answer.text.append(buffer.data(), n);
  int const status = pclose(pipe);
  answer.code = status / 256;
  return answer;
}

/// A folder of its own with a case: tests run side by side.
class CaseFolder {
 public:
  explicit CaseFolder(std::string const& text) { std::ofstream(folder_ / "case.toml") << text; }
  std::string argument() const { return "'" + (folder_ / "case.toml").string() + "'"; }

 private:
  testing::TemporaryFolder folder_;
};

TEST(CheckCommand, SaysInWordsWhatWouldRun) {
  CaseFolder const folder(test::sample_case());
  Answer const answer = ask("check " + folder.argument());
  EXPECT_EQ(answer.code, 0) << answer.text;
  expect_words(answer.text,
               {"Twisting column\n625 particles in 3D, 500 ms of motion\n",
                "body \"column\": box of 625 particles (5 x 25 x 5 lattice, spacing 250 mm)\n",
                "  neo_hookean: density = 1100 kg/m^3, youngs_modulus = 17 MPa, poissons_ratio = 0.45\n",
                "  mass 6600 kg; pressure waves 242.1 m/s, shear waves 73 m/s; initial speed up to 74.25 m/s\n",
                "support of \"column\": 25 particles where Y <= 0, held in x, y, z\n",
                "  probes: tip.displacement_x, tip.pressure\n", "Nothing is wrong with this case.\n"});
}

TEST(CheckCommand, WarnsOfImplausibleNumbersAndRefusesBadOnes) {
  CaseFolder const folder(test::sample_case());
  Answer const warned = ask("check " + folder.argument() + " --set body.column.material.density=1.1");
  EXPECT_EQ(warned.code, 0);
  expect_words(warned.text, {"body \"column\": density is 1.1 kg/m^3, lighter than foam"});
  Answer const refused = ask("check " + folder.argument() + " --set run.end=x");
  EXPECT_EQ(refused.code, 2);
  expect_words(refused.text, {"--set run.end=x: run.end", "\"x\"", "number with a unit"});
}

TEST(DescribeCommand, ExplainsOneThingOrListsAll) {
  expect_words(ask("describe").text, {"neo_hookean"});
  expect_words(ask("describe material neo_hookean").text, {"a number, between -1 and 0.5, ends excluded; required"});
  expect_words(ask("describe case run").text, {"time at which the run ends"});
  expect_words(ask("describe kernel cubic_spline").text, {"support 2h"});
  Answer const unknown = ask("describe material neo_hooken");
  EXPECT_EQ(unknown.code, 2);
  expect_words(unknown.text, {"\"neo_hooken\"", "known: neo_hookean", "more)", "did you mean \"neo_hookean\"?"});
}

TEST(DescribeCommand, TellsOfSolidsAndOfTheLibrary) {
  std::string const all = ask("describe material").text, law = ask("describe material johnson_cook").text;
  expect_words(
      all, {"steel_4340                  johnson_cook: 4340 steel (hardness Rockwell C 30), with shock and damage\n",
            "compressible_neo_hookean\n"});
  expect_words(law,
               {"one of elastic, stiffened_gas, mie_grueneisen, polynomial, tillotson; default: \"elastic\"",
                "D1 of the fracture strain; only with damage = \"johnson_cook\"\n", "above 0; default: no limit\n"});
  Answer const steel = ask("describe material steel_4340");
  EXPECT_EQ(steel.code, 0);
  expect_words(
      steel.text,
      {"steel_4340\n  4340 steel",
       "  law = \"johnson_cook\"\n  eos = \"mie_grueneisen\"\n  damage = \"johnson_cook\"\n  density = 7830 kg/m^3 ",
       "  yield_stress = 792 MPa                      # johnson_cook_1983, quoted\n", "  melting_temperature = 1793 K ",
       "  d3 = -2.12 ", "  range: flow stress: torsion", "  lacks: no change of phase",
       "    johnson_cook_1985: G. R. Johnson, W. H. Cook, Fracture characteristics"});
  expect_words(ask("describe material steel_4304").text, {"did you mean \"steel_4340\"?"});
}

TEST(DescribeCommand, DescribesTheLibrary) {
  expect_words(ask("describe library").text, {"  tantalum                    perfectly_plastic: tantalum, "});
  EXPECT_EQ(ask("describe library steel_4340").text, ask("describe material steel_4340").text);
  expect_words(ask("describe library steel_4340 --markdown").text, {"| `d3` | -2.12 | johnson_cook_1985 | quoted |\n"});
  expect_words(ask("describe library steel_4304").text, {"did you mean \"steel_4340\"?"});
  for (std::string const kind : {"library", "material"}) {
    Answer const renamed = ask("describe " + kind + " steel_adaptle_3_3");
    EXPECT_EQ(renamed.code, 2);
    EXPECT_TRUE(mentions(renamed.text, {"steel_adaptle_3_3", "is now", "steel_linear_hardening"}));
  }
  std::ifstream file(testing::source_folder() + "/docs/user/materials.md");
  std::string const page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(ask("describe library --markdown").text, page)
      << "write the page again: piola describe library --markdown > docs/user/materials.md";
}

TEST(DescribeCommand, WritesTheManualPageThatIsInTheManual) {
  std::ifstream file(testing::source_folder() + "/docs/user/case-reference.md");
  std::string const page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(ask("describe --markdown").text, page)
      << "write the page again: piola describe --markdown > docs/user/case-reference.md";
}

}  // namespace
}  // namespace piola

#endif
