// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/verify.hpp"
#include "piola/base/problems.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

constexpr char const* checks = R"(
[[variant]]
name = "coarse"
set = ["run.end=1"]
short = true
[[variant]]
name = "fine"
[[check]]
variant = "coarse"
quantity = "start"
reference = "1.2 J"
tolerance = "10 %"
source = "a book"
[[check]]
variant = "coarse"
quantity = "energy.max_increase"
reference = 1e-9
kind = "below"
source = "conservation"
[[check]]
variant = "fine"
quantity = "start"
reference = 1.2
tolerance = 0.01
source = "a book"
)";

void write(std::filesystem::path const& path, std::string const& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

std::vector<VerificationRow> verify_springs(testing::TemporaryFolder const& folder, bool short_only,
                                            bool failing = false) {
  write(folder / "cases/toys/springs/checks.toml", checks);
  VerifyOptions const options{
      .cases = folder / "cases", .names = {"springs"}, .short_only = short_only, .out = folder / "out"};
  auto const prepare = [&](std::filesystem::path const&, std::vector<std::string> const&) {
    Simulation s = testing::make_springs();
    s.spec.quantities.push_back(
        {.name = "start", .column = "kinetic_energy", .take = QuantitySpec::Take::initial_value, .reference = {}});
    if (failing) testing::springs(s).fail_at = 30;
    return s;
  };
  std::atomic<int> const none{0};
  return verify(options, prepare, {}, none);
}

TEST(Verify, ComparesMeasuredWithPublishedNumbers) {
  testing::TemporaryFolder const folder;
  auto const rows = verify_springs(folder, false);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].case_name, "toys/springs");
  EXPECT_DOUBLE_EQ(rows[0].reference, 1.2);
  EXPECT_NEAR(*rows[0].measured, 0.56, 1e-12);  // sum of (X^2 + Y^2) / 200 over 4 x 4 points
  EXPECT_EQ(rows[0].verdict, "fall short");
  EXPECT_EQ(rows[0].tolerance, "within 10 %");
  EXPECT_EQ(rows[1].verdict, "fall short");  // symplectic Euler does not keep the energy to 1e-9
  EXPECT_EQ(rows[1].tolerance, "below");
}

TEST(Verify, RunsOnlyShortVariantsWhenAsked) {
  testing::TemporaryFolder const folder;
  EXPECT_EQ(verify_springs(folder, true).size(), 2U);
}

TEST(Verify, FallsShortWhenTheRunFails) {
  testing::TemporaryFolder const folder;
  for (auto const& row : verify_springs(folder, true, true)) {
    EXPECT_EQ(row.verdict, "fall short");
    EXPECT_NE(row.note.find("did not complete"), std::string::npos) << row.note;
  }
}

TEST(Verify, PrintsJsonMarkdownAndATable) {
  testing::TemporaryFolder const folder;
  auto const rows = verify_springs(folder, true);
  auto const json = nlohmann::json::parse(verification_json(rows));
  for (char const* key : {"case", "quantity", "reference", "source", "measured", "tolerance", "verdict", "note"})
    EXPECT_TRUE(json["rows"][0].contains(key)) << key;
  EXPECT_NE(verification_markdown(rows).find("| toys/springs | coarse | start | 1.2 "), std::string::npos);
  EXPECT_NE(verification_table(rows).find("fall short"), std::string::npos);
}

TEST(Verify, JudgesEachKindOfCheck) {
  char const* summary =
      R"({"status": "completed", "quantities": {"a": {"value": 2.0, "unit": "ms"}}, "energy": {"max_increase": 0.01}})";
  auto const verdict = [&](std::string quantity, std::string reference, double tolerance, bool relative,
                           Check::Kind kind) {
    return compare("c",
                   {{.variant = "v",
                     .quantity = quantity,
                     .reference = reference,
                     .tolerance = tolerance,
                     .relative = relative,
                     .kind = kind,
                     .source = {},
                     .note = {}}},
                   summary)[0]
        .verdict;
  };
  EXPECT_EQ(verdict("a", "0.0021 s", 0.06, true, Check::Kind::within), "pass");
  EXPECT_EQ(verdict("a", "0.0021 s", 0.04, true, Check::Kind::within), "fall short");
  EXPECT_EQ(verdict("a", "2.1", 0.2, false, Check::Kind::within), "pass");
  EXPECT_EQ(verdict("a", "1.9", 0, false, Check::Kind::above), "pass");
  EXPECT_EQ(verdict("a", "1.9", 0, false, Check::Kind::below), "fall short");
  EXPECT_EQ(verdict("energy.max_increase", "0.02", 0, false, Check::Kind::below), "pass");
  EXPECT_EQ(verdict("nothing.here", "0.02", 0, false, Check::Kind::below), "fall short");
  EXPECT_EQ(verdict("a", "3 kg", 0, false, Check::Kind::below), "fall short");
}

TEST(ReadChecks, ReportsAllThatIsWrong) {
  testing::TemporaryFolder const folder;
  write(folder / "checks.toml",
        "[[check]]\nquantity = \"a\"\nreferense = 1\nkind = \"near\"\nsource = \"s\"\ntolerance = \"1 m\"\n");
  try {
    read_checks(folder / "checks.toml");
    FAIL();
  } catch (InputError const& error) {
    std::string const text = error.what();
    for (char const* part : {"does not know 'referense'", "did you mean", "needs 'reference'",
                             "'kind' has the wrong kind", "'tolerance' has the wrong kind"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
  }
}

TEST(FindCases, NamesTheCasesThereAre) {
  testing::TemporaryFolder const folder;
  write(folder / "a/one/checks.toml", "");
  write(folder / "a/two/checks.toml", "");
  EXPECT_EQ(find_cases(folder.path(), {"a"}).size(), 2U);
  EXPECT_EQ(find_cases(folder.path(), {"a/two"}).size(), 1U);
  EXPECT_THROW(find_cases(folder.path(), {"three"}), InputError);
}

}  // namespace
}  // namespace piola
