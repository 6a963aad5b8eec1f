// SPDX-License-Identifier: Apache-2.0
#include "piola/input/material_library.hpp"
#include "piola/base/text.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/identify.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::TemporaryFolder;

/// A small valid library. Messages of tests refer to its line numbers.
constexpr std::string_view alloys = R"([sources]
report_7 = "A. Author, Report 7 (2026), table 2"
[[material]]
name = "our_steel"
about = "our steel"
range = "tension at 1e-3 1/s and 293 K"
lacks = "no rate"
law = "johnson_cook"
eos = "mie_grueneisen"
density = { value = "7.85 g/cm^3", source = "handbook", checked = "quoted" }
shear_modulus = { value = "80 GPa", source = "report_7", checked = "read" }
bulk_modulus = { value = 160e9, source = "report_7", checked = "unread" }
yield_stress = { value = "355 MPa", source = "report_7", checked = "read" }
hardening_coefficient = { value = 300e6, source = "report_7", checked = "read" }
hardening_exponent = { value = 0.3, source = "report_7", checked = "read" }
rate_coefficient = { value = 0.01, source = "report_7", checked = "read" }
thermal_exponent = { value = 1, source = "report_7", checked = "chosen" }
specific_heat = { value = 450, source = "report_7", checked = "read" }
melting_temperature = { value = 1800, source = "report_7", checked = "read" }
bulk_sound_speed = { value = "4.5 km/s", source = "report_7", checked = "read" }
hugoniot_s1 = { value = 1.3, source = "report_7", checked = "read" }
grueneisen_gamma = { value = 1.7, source = "report_7", checked = "read" }
)";

std::vector<std::string> problems_of(std::string const& text) {
  MaterialLibrary library = material_library();
  Problems problems;
  read_library_file(text, "my.toml", library, problems);
  return problems.lines();
}

std::vector<std::string> problems_with(std::string_view from, std::string_view to) {
  return problems_of(test::replaced(std::string(alloys), from, to));
}

/// The only problem of the library with a change.
std::string problem_with(std::string_view from, std::string_view to) {
  auto const lines = problems_with(from, to);
  EXPECT_EQ(lines.size(), 1U) << joined(lines, "\n");
  return lines.empty() ? "" : lines.front();
}

TEST(MaterialLibraryFile, GivesTextsWordsAndNumbersWithTheirSources) {
  MaterialLibrary library = material_library();
  std::size_t const before = library.materials.size();
  Problems problems;
  read_library_file(alloys, "my.toml", library, problems);
  ASSERT_TRUE(problems.empty()) << problems.lines().front();
  ASSERT_EQ(library.materials.size(), before + 1);
  LibraryMaterial const& steel = *library.find("our_steel");
  EXPECT_EQ(steel.about, "our steel");
  EXPECT_EQ(steel.range, "tension at 1e-3 1/s and 293 K");
  EXPECT_EQ(steel.lacks, "no rate");
  EXPECT_EQ(steel.law, "johnson_cook");
  EXPECT_EQ(steel.word("eos"), "mie_grueneisen");
  EXPECT_DOUBLE_EQ(*steel.number("density"), 7850);
  EXPECT_DOUBLE_EQ(*steel.number("bulk_sound_speed"), 4500);
  EXPECT_EQ(steel.numbers[0].source, "handbook");
  EXPECT_EQ(steel.numbers[0].checked, Checked::quoted);
  EXPECT_EQ(library.sources_of(steel)[1].text, "A. Author, Report 7 (2026), table 2");
}

/// E = 9 K G / (3 K + G), nu = (3 K - 2 G) / (6 K + 2 G), with the sources of G and of K.
TEST(MaterialLibraryFile, TakesShearAndBulkModulus) {
  MaterialLibrary library = material_library();
  Problems problems;
  read_library_file(alloys, "my.toml", library, problems);
  LibraryMaterial const& steel = *library.find("our_steel");
  EXPECT_EQ(steel.numbers[1].parameter, "youngs_modulus");
  EXPECT_DOUBLE_EQ(steel.numbers[1].value, 9 * 160e9 * 80e9 / 560e9);
  EXPECT_EQ(steel.numbers[1].checked, Checked::read);
  EXPECT_EQ(steel.numbers[2].parameter, "poissons_ratio");
  EXPECT_DOUBLE_EQ(steel.numbers[2].value, 320. / 1120);
  EXPECT_EQ(steel.numbers[2].checked, Checked::unread);
  for (std::string_view const line :
       {"bulk_modulus = { value = 160e9, source = \"report_7\", checked = \"unread\" }\n",
        "shear_modulus = { value = \"80 GPa\", source = \"report_7\", checked = \"read\" }\n"})
    EXPECT_NE(problem_with(line, "").find("give one of the two pairs"), std::string::npos);
  EXPECT_NE(problem_with("yield_stress",
                         "poissons_ratio = { value = 0.3, source = \"handbook\", checked = \"read\" }\n"
                         "yield_stress")
                .find("give one of the two pairs"),
            std::string::npos);
}

TEST(MaterialLibraryFile, ReportsProblemsWithTheirPlaces) {
  struct Slip {
    std::string_view from, to;
    test::KeyWords words;
  };
  for (Slip const& slip : std::vector<Slip>{
           {"lacks", "lack", {"my.toml:7:1:", "\"lack\"", "is not a key of material", "(allowed: name, about,"}},
           {"\"355 MPa\"", "\"355 kg\"", {"my.toml:13:26:", "material.yield_stress", "cannot be read"}},
           {"\"355 MPa\"", "-1", {"my.toml:13:26:", "material.yield_stress", "-1 Pa", "(allowed: above 0"}},
           {"{ value = \"355 MPa\", source = \"report_7\", checked = \"read\" }",
            "\"355 MPa\"",
            {"my.toml:13:16:", "material.yield_stress", "is the text \"355 MPa\"", "(allowed: a table"}},
           {"value = \"355 MPa\", ", "", {"my.toml:13:16:", "material.yield_stress", "needs \"value\""}},
           {"\"355 MPa\", source = \"report_7\"",
            "\"355 MPa\"",
            {"my.toml:13:16:", "material.yield_stress", "needs \"source\""}},
           {"\"355 MPa\", source = \"report_7\"",
            "\"355 MPa\", source = \"report_8\"",
            {"my.toml:13:46:", "material.yield_stress.source", "\"report_8\"", "(allowed:"}},
           {"\"355 MPa\", source",
            "\"355 MPa\", sources = 1, source",
            {"my.toml:13:37:", "\"sources\"", "is not a key of material.yield_stress"}},
           {"checked = \"quoted\"", "checked = \"yes\"", {"my.toml:10:67:", "material.density.checked", "\"yes\""}},
           {"density = {",
            "d1 = { value = 1, source = \"handbook\", checked = \"read\" }\ndensity = {",
            {"my.toml:10:16:", "material.d1", "does not count here", "needs damage = \"johnson_cook\")"}},
           {"\"our_steel\"", "\"our steel\"", {"my.toml:4:8:", "material.name", "\"our steel\"", "(allowed: letters"}},
           {"\"our_steel\"", "\"steel_4340\"", {"my.toml:4:8:", "material.name", "\"steel_4340\"", "is taken"}},
           {"\"our_steel\"",
            "\"elastic\"",
            {"my.toml:4:8:", "material.name", "\"elastic\"", "which is the name of a law"}},
           {"about = \"our steel\"\n", "", {"my.toml:3:"}},
           {"range = \"tension at 1e-3 1/s and 293 K\"",
            "range = \"\"",
            {"my.toml:6:9:", "material.range", "is empty"}},
           {"\"johnson_cook\"", "\"johnson_coke\"", {"my.toml:8:7:", "material.law", "\"johnson_coke\""}},
           {"eos = \"mie_grueneisen\"", "eos = \"mie\"", {"my.toml:9:7:", "material.eos", "\"mie\""}},
           {"[sources]", "title = 1\n[sources]", {"my.toml:1:1:", "\"title\"", "is not a key of a library"}},
           {"report_7 = ",
            "handbook = \"another\"\nreport_7 = ",
            {"my.toml:2:1:", "the source \"handbook\"", "is in the"}},
           {"\"our_steel\"", "our_steel", {"my.toml:4:"}}}) {
    std::string const line = problem_with(slip.from, slip.to);
    EXPECT_TRUE(test::mentions(line, slip.words));
  }
  EXPECT_NE(problem_with("yield_stress = { value = \"355 MPa\", source = \"report_7\", checked = \"read\" }\n", "")
                .find("add yield_stress = { value = \"... Pa\", source = \"...\", checked = \"read\" }"),
            std::string::npos);
  std::string const twice = std::string(alloys) + std::string(alloys.substr(alloys.find("[[material]]")));
  EXPECT_NE(problems_of(twice).at(0).find("my.toml:24:8: material.name is \"our_steel\" which is taken"),
            std::string::npos);
  EXPECT_EQ(problems_of("").size(), 1U);
  EXPECT_EQ(problems_of("material = 3").size(), 1U);
}

/// A case beside a library file.
struct CaseWithLibrary {
  TemporaryFolder folder;
  std::string text = "library = [\"my.toml\"]\n" +
                     test::replaced(test::replaced(test::sample_case(),
                                                   "law = \"neo_hookean\", density = \"1100 kg/m^3\", youngs_modulus = "
                                                   "\"17 MPa\", poissons_ratio = 0.45",
                                                   "name = \"our_steel\""),
                                    "\"jst_sph\", variables = \"pF\", eps4_momentum = 0.125", "\"nodal\"");

  CaseWithLibrary() { write(std::string(alloys)); }
  void write(std::string const& library) const { std::ofstream(folder / "my.toml") << library; }
  CaseSpec read(std::vector<std::string> const& overrides = {}) const {
    return read_case_text(text, (folder / "case.toml").string(), overrides);
  }
  std::string message() const {
    try {
      read();
    } catch (InputError const& error) {
      return error.what();
    }
    return "";
  }
};

TEST(CaseLibrary, MaterialsOfItsFilesAreUsedByNameAndChanged) {
  CaseWithLibrary const with;
  CaseSpec const spec = with.read();
  EXPECT_EQ(spec.bodies[0].law, "johnson_cook");
  LawInfo const law = *find_law("johnson_cook");
  auto const density = [&](CaseSpec const& of) {
    for (std::size_t i = 0; i < law.parameters.size(); ++i)
      if (law.parameters[i].name == "density") return of.bodies[0].material.value[i];
    return 0.;
  };
  EXPECT_DOUBLE_EQ(density(spec), 7850);
  Place const place = spec.bodies[0].places.at("material.density");
  EXPECT_EQ(place.file, (with.folder / "my.toml").string());
  EXPECT_EQ(place.line, 10);
  EXPECT_DOUBLE_EQ(density(with.read({"body.column.material.density=7900"})), 7900);
}

TEST(CaseLibrary, FilesCountAsThoseOfTheCase) {
  CaseWithLibrary const with;
  CaseSpec const spec = with.read();
  auto const files = files_of(spec);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].given, "my.toml");
  EXPECT_EQ(files[0].path, with.folder / "my.toml");
  with.write(test::replaced(std::string(alloys), "355 MPa", "356 MPa"));
  EXPECT_EQ(identity_of(spec).case_text, spec.identity.case_text);
  EXPECT_NE(identity_of(spec).files, spec.identity.files);
}

TEST(CaseLibrary, ProblemsOfItsFilesAreThoseOfTheCase) {
  CaseWithLibrary with;
  with.write(test::replaced(std::string(alloys), "\"355 MPa\"", "\"355 s\""));
  EXPECT_TRUE(with.message().starts_with((with.folder / "my.toml").string() + ":13:26: material.yield_stress cannot"))
      << with.message();
  with.write(std::string(alloys));
  with.text = test::replaced(with.text, "\"my.toml\"", "\"my.toml\", \"other.toml\"");
  EXPECT_NE(with.message().find("case.toml:1:23: "), std::string::npos) << with.message();
  EXPECT_NE(with.message().find("other.toml: cannot be read"), std::string::npos) << with.message();
  with.text = test::replaced(with.text, "[\"my.toml\", \"other.toml\"]", "\"my.toml\"");
  EXPECT_TRUE(test::mentions(with.message(), {"case.toml:1:11: ", "library", "\"my.toml\"", "(allowed: a list"}));
}

/// The case.toml of a results folder reads the copy that the run began with.
TEST(CaseLibrary, OfResultsIsTheCopy) {
  CaseWithLibrary const with;
  std::filesystem::create_directories(with.folder / "results/case-files");
  std::filesystem::copy_file(with.folder / "my.toml", with.folder / "results/case-files/1-my.toml");
  std::ofstream(with.folder / "results/case-files/files.toml") << text_of_list(
      {{"my.toml", "1-my.toml", with.folder / "my.toml", alloys.size(), content_hash(with.folder / "my.toml")}});
  with.write("");
  CaseSpec const spec =
      read_case_text(with.text, (with.folder / "results/case.toml").string(), {}, {.of_results = true});
  EXPECT_EQ(files_of(spec).at(0).path, with.folder / "results/case-files/1-my.toml");
}

}  // namespace
}  // namespace piola
