// SPDX-License-Identifier: Apache-2.0
// Spellings of the previous minor release: read, reported, and refused beside the present one.
#include "piola/input/renamed_keys.hpp"
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/input/case_difference.hpp"
#include "piola/simulation/build.hpp"
#include "support/sample_case.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace piola {
namespace {

/// A 2D block of 9 x 9 particles; text[0]: more of [run], [1]: formulation, [2]: material, [3]: more sections.
std::string block(std::array<std::string, 4> const& text) {
  std::string const formulation = text[1].empty() ? "name = \"jst_sph\"" : text[1];
  std::string const material = text[2].empty() ? "law = \"neo_hookean\"" : text[2];
  return "title = \"Block\"\n[run]\nend = \"1 s\"\n" + text[0] + "\n[[body]]\nname = \"block\"\n" +
         "shape = { box = { min = [0, 0], max = [0.8, 0.8] }, particles = [9, 9] }\n" +
         "material = { density = 1000, youngs_modulus = 1e7, poissons_ratio = 0.3, " + material + " }\n" +
         "formulation = { " + formulation + " }\n" + text[3] + "\n";
}

struct Spelling {
  std::string before, now;
  std::array<std::string, 4> text;  ///< of block(), with @ in place of the spelling
};

std::string const taylor = "name = \"taylor_sph\", ", linear = "law = \"linear_elastic\"";
std::string const adaptle = "name = \"adaptle\", ", perfect = "law = \"perfectly_plastic\", yield_stress = 1e6";
std::string const probe = "[[probe]]\nname = \"p\"\nbody = \"block\"\nkind = ";

/// One for each row of renamed_keys() and renamed_words().
std::vector<Spelling> const spellings{
    {"machine", "instruction_set", {"@ = \"scalar\"", "", "", ""}},
    {"rest", "relax_tolerance", {"relax = true\n@ = 0.01", "", "", ""}},
    {"strangers", "proximity", {"guards = { @ = 0.4 }", "", "", ""}},
    {"parting_warn", "strain_drift_warn", {"guards = { @ = 0.4 }", "", "", ""}},
    {"parting_stop", "strain_drift_stop", {"guards = { @ = 0.4 }", "", "", ""}},
    {"share", "c10_fraction", {"", "", "law = \"mooney_rivlin\", @ = 0.5", ""}},
    {"cell_memory", "stress_retention", {"", taylor + "@ = 0.3", linear, ""}},
    {"initial_pressure_lasts",
     "initial_pressure_duration",
     {"", adaptle + "initial_pressure = \"1\", @ = \"one_step\"", perfect, ""}},
    {"least_mass", "min_mass_ratio", {"", "name = \"nodal\", @ = 0.4", "", ""}},
    {"tether", "conversion_separation", {"", adaptle + "convert_strain = 0.5, @ = 2", perfect, ""}},
    {"follows", "follower", {"", "", "", "[[load]]\nbody = \"block\"\nface = \"+x\"\npressure = \"1\"\n@ = true"}},
    {"skew", "antisymmetric", {"", "", "", "[[mirror]]\nbody = \"block\"\nface = \"-x\"\n@ = true"}},
    {"least_particles", "min_particles", {"", "", "", probe + "\"fragment\"\n@ = 2"}},
    {"estimates", "kernel_sums", {"", taylor + "exchange = \"@\"", linear, ""}},
    {"printed", "published", {"", taylor + "exchange = \"kernel_sums\", gradient = \"@\"", linear, ""}},
    {"printed", "published", {"", adaptle + "interface = \"@\"", perfect, ""}},
    {"printed", "published", {"", adaptle + "viscosity_form = \"@\"", perfect, ""}},
    {"printed",
     "published",
     {"", adaptle + "alpha = 1", perfect, "[contact]\nlaw = \"@\"\nstiffness = 1e16\nexponent = 4"}},
};

std::string with(Spelling const& spelling, std::string const& word) {
  std::string text = block(spelling.text);
  return text.replace(text.find('@'), 1, word);
}

std::string advice(std::string const& before, std::string const& now) {
  return "\"" + before + "\" is now \"" + now + "\" - write this, since the next minor release refuses the other";
}

Document read(std::string const& text, std::vector<std::string> const& overrides = {}) {
  Problems problems;
  auto document = parse_document(text, "case.toml", problems);
  EXPECT_TRUE(document) << text;
  if (!document) return {};
  apply_overrides(*document, overrides, problems);
  EXPECT_TRUE(problems.empty()) << problems.lines().front();
  return *document;
}

TEST(RenamedKeys, TheListOfTheTestIsComplete) {
  EXPECT_EQ(spellings.size(), renamed_keys().size() + renamed_words().size());
  auto const listed = [&](std::string_view before, std::string_view now) {
    return std::any_of(spellings.begin(), spellings.end(),
                       [&](Spelling const& s) { return s.before == before && s.now == now; });
  };
  for (RenamedKey const& key : renamed_keys()) EXPECT_TRUE(listed(key.before, key.now)) << key.before;
  for (RenamedWord const& word : renamed_words()) EXPECT_TRUE(listed(word.before, word.now)) << word.before;
}

TEST(RenamedKeys, OldSpellingsAreReadAsTheNewOnesAndReported) {
  for (Spelling const& spelling : spellings) {
    CaseSpec const now = read_case_text(with(spelling, spelling.now), "case.toml"),
                   before = read_case_text(with(spelling, spelling.before), "case.toml");
    EXPECT_TRUE(now.old_spellings.empty());
    ASSERT_EQ(before.old_spellings.size(), 1U) << spelling.before;
    EXPECT_EQ(before.old_spellings[0].text, advice(spelling.before, spelling.now));
    EXPECT_EQ(before.old_spellings[0].place.file, "case.toml");
    EXPECT_GT(before.old_spellings[0].place.line, 2);
    EXPECT_EQ(before.source, read(with(spelling, spelling.before)).source);
    EXPECT_EQ(before.identity.run, now.identity.run) << spelling.before;
    EXPECT_TRUE(case_differences(with(spelling, spelling.before), with(spelling, spelling.now)).empty());
  }
}

TEST(RenamedKeys, AreReportedAtTheStartOfARun) {
  auto const reported = [](CaseSpec const& spec, std::string const& place) {
    auto const all = build(spec).warnings;
    return std::count(all.begin(), all.end(), place + ": " + advice("machine", "instruction_set")) == 1;
  };
  EXPECT_TRUE(reported(read_case_text(with(spellings[0], "machine"), "case.toml"), "case.toml:4:1"));
  EXPECT_TRUE(reported(read_case_text(block({"", "", "", ""}), "case.toml", {"run.machine=scalar"}),
                       "--set run.machine=scalar"));
}

TEST(RenamedKeys, BothSpellingsAreRefused) {
  for (RenamedKey const& key : renamed_keys()) {
    Document document;
    Node* at = &document.root;
    std::string_view rest = key.section;
    for (std::size_t dot = 0; !rest.empty(); rest.remove_prefix(std::min(dot + 1, rest.size()))) {
      dot = std::min(rest.find('.'), rest.size());
      at = &at->entries.emplace_back(Node::Entry{std::string(rest.substr(0, dot)), {}, {}}).value;
    }
    at->entries = {{std::string(key.before), {"case.toml", 3, 1}, {}}, {std::string(key.now), {"case.toml", 4, 1}, {}}};
    Problems problems;
    use_current_spellings(document, problems);
    ASSERT_EQ(problems.count(), 1U) << key.before;
    EXPECT_EQ(problems.lines()[0], "case.toml:3:1: \"" + std::string(key.before) + "\" is now \"" +
                                       std::string(key.now) + "\", and both are given (allowed: \"" +
                                       std::string(key.now) + "\") - remove \"" + std::string(key.before) + "\"");
  }
  EXPECT_EQ(
      test::message_of(block({"machine = \"v3\"\ninstruction_set = \"v4\"", "", "", ""})),
      "case.toml:4:1: \"machine\" is now \"instruction_set\", and both are given (allowed: \"instruction_set\") - "
      "remove \"machine\"");
}

TEST(RenamedKeys, SettingsReplaceValuesInEitherSpelling) {
  auto const rest = [](std::string const& given, std::string const& setting) {
    return read_case_text(block({"relax = true\n" + given, "", "", ""}), "case.toml", {setting}).run.relax_tolerance;
  };
  for (std::string const given : {"rest = 0.1", "relax_tolerance = 0.1"})
    for (std::string const key : {"run.rest", "run.relax_tolerance"}) EXPECT_EQ(rest(given, key + "=0.2"), 0.2);
  EXPECT_EQ(rest("", "run={end=1,relax=true,rest=0.2}"), 0.2);
}

TEST(RenamedKeys, MaterialsOfPartsAndOfNumberedBodiesCount) {
  Document const document = read(block({"", "", "law = \"mooney_rivlin\", share = 0.1",
                                        "[[body.part]]\nwhere = \"X > 0.5\"\nmaterial = { share = 0.2 }"}),
                                 {"body.0.material.share=0.3", "body.block.part.0.material.share=0.4"});
  EXPECT_EQ(document.old_spellings.size(), 4U);
  Node const& body = document.root.find("body")->items[0];
  EXPECT_EQ(body.find("material")->find("c10_fraction")->real, 0.3);
  EXPECT_EQ(body.find("part")->items[0].find("material")->find("c10_fraction")->real, 0.4);
}

TEST(RenamedOutputs, ColumnsAndFieldsOfCasesHavePresentNames) {
  for (RenamedOutput const& output : renamed_outputs()) {
    std::string const of = output.of_parts ? "stone." : "", before = of + std::string(output.before),
                      now = of + std::string(output.now);
    EXPECT_EQ(current_output_name(before), now);
    EXPECT_EQ(current_output_name(now), now);
    EXPECT_EQ(current_output_name("tip." + std::string(output.before)), "tip." + std::string(output.now));
    for (std::string const form :
         {"[[quantity]]\ncolumn = \"@\"\n", "[[probe]]\nquantities = [\"@\"]\n", "[[probe]]\nfield = \"@\"\n",
          "[output.frames]\nfields = [\"@\"]\n", "[output.pictures]\nfield = \"@\"\n",
          "[[output.pictures.panel]]\nfield = \"@\"\n"}) {
      std::string text = form;
      Document const document = read(text.replace(text.find('@'), 1, before));
      ASSERT_EQ(document.old_spellings.size(), 1U) << text;
      EXPECT_EQ(document.old_spellings[0].text, advice(before, now));
      EXPECT_NE(document.source.find("\"" + now + "\""), std::string::npos) << document.source;
    }
  }
  EXPECT_EQ(current_output_name("turn_x"), "turn_x") << "no column of the whole run";
  EXPECT_TRUE(read("[[quantity]]\nname = \"tie_heat\"\n").old_spellings.empty()) << "a name of the user's";
}

TEST(RenamedOutputs, ProbesAndPicturesOfACaseUseThem) {
  CaseSpec const spec = read_case_text(
      block({"", "name = \"nodal\"", "",
             probe + "\"minimum\"\nquantities = [\"least_jacobian\"]\n[[probe]]\nname = \"f\"\nbody = \"block\"\n"
                     "kind = \"fragment\"\nquantities = [\"piece_count\", \"piece_volume\", \"piece_spread\"]\n"
                     "[[quantity]]\nname = \"n\"\ncolumn = \"f.piece_count\"\n"
                     "[[quantity]]\nname = \"j\"\ncolumn = \"least_jacobian\"\n"
                     "[output.pictures]\nevery = \"1 s\"\nfield = \"LeastJacobian\"\n"}),
      "case.toml");
  EXPECT_EQ(spec.old_spellings.size(), 7U);
  EXPECT_EQ(spec.probes[0].quantities, std::vector<std::string>{"cell_jacobian_min"});
  EXPECT_EQ(spec.probes[1].quantities,
            (std::vector<std::string>{"large_fragment_count", "large_fragment_volume", "large_fragment_volume_cv"}));
  EXPECT_EQ(spec.quantities[0].column, "f.large_fragment_count");
  EXPECT_EQ(spec.quantities[1].column, "cell_jacobian_min");
  EXPECT_EQ(spec.output.pictures.field, "CellJacobianMin");
}

}  // namespace
}  // namespace piola
