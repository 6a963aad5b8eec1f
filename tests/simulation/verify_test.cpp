// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/verify.hpp"
#include "piola/base/problems.hpp"
#include "piola/output/summary.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <gtest/gtest.h>

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
  auto const cases = verify(options, prepare, {}, none);
  EXPECT_EQ(cases.size(), 1U);
  return cases.empty() ? std::vector<VerificationRow>{} : cases[0].rows;
}

/// A run that completed with one quantity.
VariantRun run_with(std::string const& variant, std::string const& quantity, double value,
                    std::string const& status = "completed") {
  Summary summary;
  summary.status = status;
  summary.quantities = {{quantity, value, "1"}};
  return {.variant = variant, .summary = to_json(summary)};
}

Check check_of(std::string const& variant, std::string const& quantity, std::string const& reference, double tolerance,
               Check::Kind kind = Check::Kind::within) {
  Check c;
  c.variant = variant;
  c.quantity = quantity;
  c.reference = reference;
  c.tolerance = tolerance;
  c.kind = kind;
  return c;
}

TEST(Verify, ComparesMeasuredWithPublishedNumbers) {
  testing::TemporaryFolder const folder;
  auto const rows = verify_springs(folder, false);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].case_name, "toys/springs");
  EXPECT_DOUBLE_EQ(rows[0].reference, 1.2);
  EXPECT_NEAR(*rows[0].measured, 0.56, 1e-12);  // sum of (X^2 + Y^2) / 200 over 4 x 4 points
  EXPECT_EQ(rows[0].verdict, "falls short");
  EXPECT_EQ(rows[0].tolerance, "within 10 %");
  EXPECT_EQ(rows[1].verdict, "falls short");  // symplectic Euler does not keep the energy to 1e-9
  EXPECT_EQ(rows[1].tolerance, "below");
}

TEST(Verify, RunsOnlyShortVariantsWhenAsked) {
  testing::TemporaryFolder const folder;
  EXPECT_EQ(verify_springs(folder, true).size(), 2U);
}

TEST(Verify, FallsShortWhenTheRunFails) {
  testing::TemporaryFolder const folder;
  for (auto const& row : verify_springs(folder, true, true)) {
    EXPECT_EQ(row.verdict, "falls short");
    EXPECT_NE(row.note.find("did not complete"), std::string::npos) << row.note;
  }
}

TEST(Verify, JudgesEachKindOfCheck) {
  char const* summary =
      R"({"status": "completed", "quantities": {"a": {"value": 2.0, "unit": "ms"}}, "energy": {"max_increase": 0.01}})";
  auto const verdict = [&](std::string quantity, std::string reference, double tolerance, bool relative,
                           Check::Kind kind) {
    Check c = check_of("v", quantity, reference, tolerance, kind);
    c.relative = relative;
    return compare("c", {c}, {{.variant = "v", .summary = summary}})[0].verdict;
  };
  EXPECT_EQ(verdict("a", "0.0021 s", 0.06, true, Check::Kind::within), "passes");
  EXPECT_EQ(verdict("a", "0.0021 s", 0.04, true, Check::Kind::within), "falls short");
  EXPECT_EQ(verdict("a", "2.1", 0.2, false, Check::Kind::within), "passes");
  EXPECT_EQ(verdict("a", "1.9", 0, false, Check::Kind::above), "passes");
  EXPECT_EQ(verdict("a", "1.9", 0, false, Check::Kind::below), "falls short");
  EXPECT_EQ(verdict("energy.max_increase", "0.02", 0, false, Check::Kind::below), "passes");
  EXPECT_EQ(verdict("nothing.here", "0.02", 0, false, Check::Kind::below), "falls short");
  EXPECT_EQ(verdict("a", "3 kg", 0, false, Check::Kind::below), "falls short");
}

// The error falls from 0.09 to 0.02 while the spacing is halved: log(4.5)/log(2) = 2.1699.
TEST(Verify, MeasuresOrdersAcrossVariants) {
  std::vector<VariantRun> const runs{run_with("5", "error", 0.09), run_with("9", "error", 0.02)};
  Check c = check_of("9", "error", "2", 0.2);
  c.as = Check::As::order;
  c.relative_to = "5";
  c.refinement = 2;
  auto const rows = compare("c", {c}, runs);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].quantity, "error, order from 5");
  EXPECT_NEAR(*rows[0].measured, std::log(4.5) / std::log(2.0), 1e-12);
  EXPECT_EQ(rows[0].unit, "1");
  EXPECT_EQ(rows[0].verdict, "passes");
  c.refinement = 4;
  EXPECT_NEAR(*compare("c", {c}, runs)[0].measured, std::log(4.5) / std::log(4.0), 1e-12);
}

TEST(Verify, MeasuresRatiosAcrossVariants) {
  std::vector<VariantRun> const runs{run_with("new", "oscillation", 0.02), run_with("printed", "oscillation", 0.09)};
  Check c = check_of("new", "oscillation", "0.25", 0, Check::Kind::below);
  c.as = Check::As::ratio;
  c.relative_to = "printed";
  auto const rows = compare("c", {c}, runs);
  EXPECT_EQ(rows.at(0).quantity, "oscillation, ratio to printed");
  EXPECT_NEAR(*rows.at(0).measured, 0.02 / 0.09, 1e-12);
  EXPECT_TRUE(rows.at(0).accepted);
}

TEST(Verify, CannotCompareWithWhatIsMissingOrZero) {
  Check c = check_of("a", "q", "1", 1);
  c.as = Check::As::ratio;
  c.relative_to = "b";
  EXPECT_TRUE(compare("c", {c}, {run_with("a", "q", 1)}).empty());  // b was not run
  auto const zero = compare("c", {c}, {run_with("a", "q", 1), run_with("b", "q", 0)}).at(0);
  EXPECT_EQ(zero.note, "1 and 0 cannot be compared");
  EXPECT_FALSE(zero.accepted);
  auto const missing = compare("c", {c}, {run_with("a", "q", 1), run_with("b", "other", 0)}).at(0);
  EXPECT_EQ(missing.note, "summary.json of b has no such quantity");
  auto const failed = compare("c", {c}, {run_with("a", "q", 1), run_with("b", "q", 1, "failed")}).at(0);
  EXPECT_EQ(failed.note, "the run did not complete");
  EXPECT_EQ(failed.verdict, "falls short");
  auto const unmade =
      compare("c", {c}, {run_with("a", "q", 1), VariantRun{.variant = "b", .problem = "no memory"}}).at(0);
  EXPECT_EQ(unmade.note, "no memory");
  EXPECT_FALSE(unmade.accepted);
}

TEST(Verify, KnowsWhatIsExpectedToFallShort) {
  Check c = check_of("a", "q", "1", 0.1);
  c.expected_to_fall_short = true;
  c.note = "the printed scheme cannot";
  auto const row = [&](VariantRun const& run) { return compare("c", {c}, {run}).at(0); };
  EXPECT_EQ(row(run_with("a", "q", 2)).verdict, "falls short, as expected");
  EXPECT_TRUE(row(run_with("a", "q", 2)).accepted);
  EXPECT_EQ(row(run_with("a", "q", 1)).verdict, "passes, contrary to expectation");
  EXPECT_FALSE(row(run_with("a", "q", 1)).accepted);
  // A run that breaks off falls short, too; a slip in a name or a run that cannot be made is not what was expected.
  EXPECT_TRUE(row(run_with("a", "q", 1, "failed")).accepted);
  EXPECT_TRUE(row(run_with("a", "other", 1, "failed")).accepted);
  EXPECT_FALSE(row(run_with("a", "other", 1)).accepted);
  EXPECT_FALSE(row({.variant = "a", .problem = "refused"}).accepted);
}

TEST(Verify, RunsVariantsThatOnlyOthersLookAt) {
  testing::TemporaryFolder const folder;
  write(folder / "cases/springs/checks.toml", R"(
[[variant]]
name = "coarse"
[[variant]]
name = "unused"
[[variant]]
name = "fine"
[[check]]
variant = "fine"
relative_to = "coarse"
as = "ratio"
quantity = "steps"
reference = 1
tolerance = 0
source = "both are the same"
)");
  std::vector<VerifyProgress> told;
  std::atomic<int> const none{0};
  auto const cases = verify(
      {.cases = folder / "cases",
       .names = {},
       .short_only = false,
       .out = folder / "out",
       .weigh = [](std::filesystem::path const&, std::vector<std::string> const&) { return 2.0; }},
      [](std::filesystem::path const&, std::vector<std::string> const&) { return testing::make_springs(); },
      [&](VerifyProgress const& at) { told.push_back(at); }, none);
  ASSERT_EQ(cases.size(), 1U);
  ASSERT_EQ(cases[0].runs.size(), 2U);
  EXPECT_EQ(cases[0].runs[0].title, "Springs");
  EXPECT_GT(cases[0].runs[0].wall_seconds, 0);
  EXPECT_EQ(cases[0].rows.at(0).verdict, "passes");
  ASSERT_GE(told.size(), 2U);
  EXPECT_EQ(told.front().variant, "coarse");
  EXPECT_EQ(told.front().number, 1U);
  EXPECT_EQ(told.front().count, 2U);
  EXPECT_FALSE(told.front().seconds_left);
  EXPECT_EQ(told.back().variant, "fine");
  EXPECT_EQ(told.back().number, 2U);
  ASSERT_TRUE(told.back().seconds_left);
  EXPECT_NEAR(*told.back().seconds_left, 0, 1e-9);  // the last word of the last run
}

TEST(ReadChecks, ReadsComparisonsAndExpectations) {
  testing::TemporaryFolder const folder;
  write(folder / "checks.toml", R"(
[[variant]]
name = "5"
[[variant]]
name = "9"
[[check]]
variant = "9"
relative_to = "5"
as = "order"
ratio = 1.5
quantity = "q"
reference = 2
tolerance = 0.1
expected = "falls short"
source = "s"
note = "why"
)");
  Check const c = read_checks(folder / "checks.toml").checks.at(0);
  EXPECT_EQ(c.as, Check::As::order);
  EXPECT_EQ(c.relative_to, "5");
  EXPECT_EQ(c.refinement, 1.5);
  EXPECT_TRUE(c.expected_to_fall_short);
}

TEST(ReadChecks, ComparisonsMustBeWhole) {
  testing::TemporaryFolder const folder;
  auto const message = [&](std::string const& keys) {
    write(folder / "checks.toml",
          "[[variant]]\nname = \"5\"\n[[variant]]\nname = \"9\"\n[[check]]\nvariant = \"9\"\nquantity = "
          "\"q\"\nreference = 2\ntolerance = 0.1\nsource = \"s\"\n" +
              keys);
    try {
      read_checks(folder / "checks.toml");
      return std::string();
    } catch (InputError const& error) {
      std::string const text = error.what();
      return text.substr(text.find("checks.toml") + 11);
    }
  };
  EXPECT_EQ(message("as = \"order\"\n"), ":5:1: check needs 'relative_to' - add it\n" +
                                             (folder / "checks.toml").string() + ":5:1: check needs 'ratio' - add it");
  EXPECT_EQ(message("relative_to = \"5\"\n"), ":5:1: check needs 'as' - add it");
  EXPECT_EQ(message("relative_to = \"5\"\nas = \"ratio\"\nratio = 2\n"),
            ":13:9: check: 'ratio' is only for as = \"order\" - remove it");
  EXPECT_EQ(message("relative_to = \"5\"\nas = \"order\"\nratio = 1\n"),
            ":13:9: check: 'ratio' has the wrong kind (a number above 1: the spacing of the other variant by that of "
            "this one is expected) - correct it");
  EXPECT_EQ(message("relative_to = \"9\"\nas = \"ratio\"\n"),
            ":5:1: check: 'relative_to' is the variant itself - name another [[variant]]");
  EXPECT_EQ(message("relative_to = \"7\"\nas = \"ratio\"\n"),
            ":5:1: check: there is no variant '7' - give the name of a [[variant]]");
  EXPECT_EQ(message("relative_to = \"5\"\nas = \"sum\"\n"),
            ":12:6: check: 'as' has the wrong kind (\"order\" or \"ratio\" is expected) - correct it");
  EXPECT_EQ(message("expected = \"falls short\"\n"),
            ":11:12: check: what is expected to fall short needs a 'note' that says why - add it");
  EXPECT_EQ(message("expected = \"passes\"\nnote = \"n\"\n"),
            ":11:12: check: 'expected' has the wrong kind (\"falls short\" is expected) - correct it");
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
