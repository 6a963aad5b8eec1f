// SPDX-License-Identifier: Apache-2.0
#include "piola/verification/verification_report.hpp"
#include "support/temporary_folder.hpp"
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

VerificationRow row(std::string const& variant, std::string const& verdict, bool accepted) {
  return {.case_name = "toys/springs",
          .variant = variant,
          .quantity = "start",
          .unit = "J",
          .reference = 1.2,
          .source = "a book | a paper",
          .measured = 1.5,
          .tolerance = "within 10 %",
          .verdict = verdict,
          .accepted = accepted,
          .note = "two\nlines",
          .evidence = "paper"};
}

std::vector<CaseVerification> sample(std::filesystem::path const& picture) {
  CaseVerification c{
      "toys/springs",
      {{.variant = "eps = 1/8", .title = "Springs on a plate", .wall_seconds = 12, .picture = picture, .summary = "{}"},
       {.variant = "eps = 1 8", .wall_seconds = 3, .picture = picture, .summary = "{}"},
       {.variant = "refused", .problem = "no"}},
      {row("eps = 1/8", "passes", true), row("eps = 1 8", "falls short, as expected", true)}};
  return {c};
}

TEST(VerificationReport, AcceptsWhatPassesOrFallsShortAsExpected) {
  auto cases = sample("");
  EXPECT_TRUE(all_accepted(cases));
  cases[0].rows.push_back(row("refused", "falls short", false));
  EXPECT_FALSE(all_accepted(cases));
}

TEST(VerificationReport, IsJsonForScripts) {
  auto const json = nlohmann::json::parse(verification_json(sample("")));
  for (char const* key : {"case", "variant", "quantity", "unit", "reference", "source", "measured", "tolerance",
                          "verdict", "accepted", "note", "evidence"})
    EXPECT_TRUE(json["rows"][0].contains(key)) << key;
  EXPECT_EQ(json["rows"][0]["measured"], 1.5);
  EXPECT_EQ(json["runs"][0]["wall_seconds"], 12);
  EXPECT_EQ(json["runs"][2]["variant"], "refused");
  EXPECT_EQ(json["evidence"]["paper"], 2);
  EXPECT_EQ(json["evidence"]["code"], 0);
}

TEST(VerificationReport, IsATableWithNotesWhereNotAllIsWell) {
  std::string const text = verification_table(sample(""));
  EXPECT_NE(text.find("falls short, as expected\n    two\nlines"), std::string::npos) << text;
  EXPECT_EQ(text.find("passes\n    two"), std::string::npos) << text;
}

// What holds by construction is shown, and does not count.
TEST(VerificationReport, CountsEvidenceByKind) {
  auto cases = sample("");
  EXPECT_EQ(evidence_text(cases), "Evidence: 2 paper.");
  for (char const* kind : {"theory", "code", "own trial", "theory", "code"}) {
    cases[0].rows.push_back(row("v", "passes", true));
    cases[0].rows.back().evidence = kind;
  }
  EXPECT_EQ(evidence_text(cases), "Evidence: 2 theory, 2 paper, 1 own trial; also 2 checks of the code.");
  EXPECT_TRUE(verification_table(cases).ends_with("\n" + evidence_text(cases) + "\n"));
}

TEST(VerificationReport, IsAPageWithPicturesBesideIt) {
  testing::TemporaryFolder const folder;
  std::ofstream(folder / "Pressure-000001.png") << "a picture";
  auto cases = sample(folder / "Pressure-000001.png");
  cases[0].rows.push_back(row("refused", "falls short", false));
  write_verification_page(folder / "new/page", cases);
  std::string const page = testing::text_of(folder / "new/page/README.md");
  for (char const* part :
       {"# Verification\n",
        "1 of 3 rows pass, 1 falls short as expected, **1 not as they should**. The runs took 15 s of wall time. "
        "Evidence: 3 paper.\n",
        "\n## Springs on a plate\n\n`toys/springs`\n",
        "| eps = 1/8 | start | 1.2 J | 1.5 J | within 10 % | passes | paper | a book \\| a paper | two lines |\n",
        "| **falls short** |", "| eps = 1/8 | 12 s | ![eps = 1/8](toys-springs-eps-1-8.png) |\n",
        "| eps = 1 8 | 3 s | ![eps = 1 8](toys-springs-eps-1-8-2.png) |\n", "| refused | did not run |  |\n"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
  }
  EXPECT_EQ(testing::text_of(folder / "new/page/toys-springs-eps-1-8.png"), "a picture");
  EXPECT_EQ(testing::text_of(folder / "new/page/toys-springs-eps-1-8-2.png"), "a picture");
}

TEST(VerificationReport, DrawsPlotsBesideThePage) {
  testing::TemporaryFolder const folder;
  auto const plots = [](CaseVerification const& c) {
    Plot plot{.title = c.name, .note = {}, .x = {"time", "s"}, .y = {"top | sway", "m"}, .curves = {}};
    plot.curves = {{.label = "ours", .x = {0, 1}, .y = {0, 2}},
                   {.label = "paper", .x = {0.5}, .y = {1}, .marks = true}};
    Plot const nothing{.title = c.name, .note = {}, .x = {"time", "s"}, .y = {"nothing", "m"}, .curves = {}};
    return std::vector{plot, nothing, plot};
  };
  write_verification_page(folder / "page", sample(""), plots);
  std::string const page = testing::text_of(folder / "page/README.md");
  EXPECT_NE(page.find("\n![top \\| sway, measured and expected](toys-springs-top-sway.svg)\n"), std::string::npos)
      << page;
  EXPECT_NE(page.find("(toys-springs-top-sway-2.svg)"), std::string::npos) << page;
  EXPECT_EQ(page.find("nothing"), std::string::npos) << page;
  std::string const svg = testing::text_of(folder / "page/toys-springs-top-sway.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace piola
