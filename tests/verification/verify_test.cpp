// SPDX-License-Identifier: Apache-2.0
#include "piola/verification/verify.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/summary.hpp"
#include "support/fake_formulation.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;

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
evidence = "paper"
[[check]]
variant = "coarse"
quantity = "energy.max_increase"
reference = 1e-9
kind = "below"
source = "conservation"
evidence = "theory"
[[check]]
variant = "fine"
quantity = "start"
reference = 1.2
tolerance = 0.01
source = "a book"
evidence = "paper"
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
        {.name = "start", .column = "kinetic_energy", .take = QuantitySpec::Statistic::initial_value, .reference = {}});
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
  c.as = Check::Comparison::order;
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
  std::vector<VariantRun> const runs{run_with("new", "oscillation", 0.02), run_with("published", "oscillation", 0.09)};
  Check c = check_of("new", "oscillation", "0.25", 0, Check::Kind::below);
  c.as = Check::Comparison::ratio;
  c.relative_to = "published";
  auto const rows = compare("c", {c}, runs);
  EXPECT_EQ(rows.at(0).quantity, "oscillation, ratio to published");
  EXPECT_NEAR(*rows.at(0).measured, 0.02 / 0.09, 1e-12);
  EXPECT_TRUE(rows.at(0).accepted);
}

TEST(Verify, CannotCompareWithWhatIsMissingOrZero) {
  Check c = check_of("a", "q", "1", 1);
  c.as = Check::Comparison::ratio;
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
evidence = "code"
)");
  std::vector<VerifyProgress> reported;
  std::atomic<int> const none{0};
  auto const cases = verify(
      {.cases = folder / "cases",
       .names = {},
       .short_only = false,
       .out = folder / "out",
       .weigh = [](std::filesystem::path const&, std::vector<std::string> const&) { return 2.0; }},
      [](std::filesystem::path const&, std::vector<std::string> const&) { return testing::make_springs(); },
      [&](VerifyProgress const& at) { reported.push_back(at); }, none);
  ASSERT_EQ(cases.size(), 1U);
  ASSERT_EQ(cases[0].runs.size(), 2U);
  EXPECT_EQ(cases[0].runs[0].title, "Springs");
  EXPECT_GT(cases[0].runs[0].wall_seconds, 0);
  EXPECT_EQ(cases[0].rows.at(0).verdict, "passes");
  ASSERT_GE(reported.size(), 2U);
  EXPECT_EQ(reported.front().variant, "coarse");
  EXPECT_EQ(reported.front().number, 1U);
  EXPECT_EQ(reported.front().count, 2U);
  EXPECT_FALSE(reported.front().seconds_left);
  EXPECT_EQ(reported.back().variant, "fine");
  EXPECT_EQ(reported.back().number, 2U);
  ASSERT_TRUE(reported.back().seconds_left);
  EXPECT_NEAR(*reported.back().seconds_left, 0, 1e-9);  // the last word of the last run
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
evidence = "theory"
note = "why"
)");
  Check const c = read_checks(folder / "checks.toml").checks.at(0);
  EXPECT_EQ(c.as, Check::Comparison::order);
  EXPECT_EQ(c.relative_to, "5");
  EXPECT_EQ(c.refinement, 1.5);
  EXPECT_TRUE(c.expected_to_fall_short);
}

TEST(ReadChecks, ComparisonsMustBeWhole) {
  testing::TemporaryFolder const folder;
  auto const message = [&](std::string const& keys) {
    write(folder / "checks.toml",
          "[[variant]]\nname = \"5\"\n[[variant]]\nname = \"9\"\n[[check]]\nvariant = \"9\"\nquantity = "
          "\"q\"\nreference = 2\ntolerance = 0.1\nsource = \"s\"\nevidence = \"theory\"\n" +
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
  EXPECT_TRUE(mentions(message("relative_to = \"5\"\nas = \"ratio\"\nratio = 2\n"),
                       {":14:9: check:", "'ratio'", "only for as = \"order\"", "remove"}));
  EXPECT_TRUE(mentions(message("relative_to = \"5\"\nas = \"order\"\nratio = 1\n"),
                       {":14:9: check:", "'ratio'", "wrong kind", "number above 1", "correct it"}));
  EXPECT_TRUE(mentions(message("relative_to = \"9\"\nas = \"ratio\"\n"),
                       {":5:1: check:", "'relative_to'", "variant itself", "[[variant]]"}));
  EXPECT_TRUE(
      mentions(message("relative_to = \"7\"\nas = \"ratio\"\n"), {":5:1: check:", "no variant '7'", "[[variant]]"}));
  EXPECT_TRUE(
      mentions(message("relative_to = \"5\"\nas = \"sum\"\n"),
               {":13:6: check:", "'as'", "wrong kind", "\"order\", \"ratio\" or \"field_error\"", "correct it"}));
  EXPECT_TRUE(mentions(message("expected = \"falls short\"\n"), {":12:12: check:", "fall short", "'note'", "add it"}));
  EXPECT_TRUE(mentions(message("expected = \"passes\"\nnote = \"n\"\n"),
                       {":12:12: check:", "'expected'", "wrong kind", "\"falls short\"", "correct it"}));
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
                             "'kind' has the wrong kind", "'tolerance' has the wrong kind", "needs 'evidence'"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
  }
}

/// What read_checks says about one check with these keys, without the name of the file.
std::string complaints(std::string const& keys) {
  testing::TemporaryFolder const folder;
  write(folder / "checks.toml",
        "[[variant]]\nname = \"5\"\n[[variant]]\nname = \"9\"\n[[check]]\nvariant = \"9\"\nsource = \"s\"\n" + keys);
  try {
    read_checks(folder / "checks.toml");
    return "";
  } catch (InputError const& error) {
    std::string text = error.what();
    std::string const name = (folder / "checks.toml").string();
    for (auto at = text.find(name); at != std::string::npos; at = text.find(name)) text.erase(at, name.size());
    return text;
  }
}

TEST(ReadChecks, EveryRowSaysWhatItStandsOn) {
  std::string const rest = "quantity = \"q\"\nreference = 2\ntolerance = 0.1\n";
  EXPECT_EQ(complaints(rest), ":5:1: check needs 'evidence' - add it");
  for (std::string const& word : evidence_words()) EXPECT_EQ(complaints(rest + "evidence = \"" + word + "\"\n"), "");
  EXPECT_EQ(
      complaints(rest + "evidence = \"finite element\"\n"),
      ":11:12: check: 'finite element' is no kind of evidence (known: theory, finite elements, experiment, paper, "
      "other code, own trial, own refinement, own regression, code) - did you mean \"finite elements\"?");
}

TEST(ReadChecks, BoundsMayStandOnBothSides) {
  std::string const rest = "quantity = \"q\"\nkind = \"between\"\nevidence = \"paper\"\n";
  EXPECT_EQ(complaints(rest + "reference = [1, \"2 m\"]\n"), "");
  EXPECT_TRUE(mentions(complaints(rest + "reference = 1\n"),
                       {":11:13: check:", "'reference'", "wrong kind", "[lowest, highest]", "correct it"}));
  EXPECT_TRUE(mentions(complaints(rest + "reference = [1, 2]\ntolerance = 1\n"),
                       {":12:13: check:", "'tolerance'", "kind = \"between\"", "remove"}));
}

TEST(ReadChecks, FieldsAreComparedAtATime) {
  std::string const rest = "reference = 1\nkind = \"below\"\nevidence = \"own refinement\"\nrelative_to = \"5\"\n";
  std::string const field = rest + "as = \"field_error\"\nfield = \"Pressure\"\n";
  EXPECT_EQ(complaints(field + "time = \"10 ms\"\nwhere = \"Y > 1\"\n"), "");
  EXPECT_EQ(complaints(rest + "as = \"field_error\"\nfield = \"LeastJacobian\"\ntime = 1\n"), "");
  EXPECT_EQ(complaints(field), ":5:1: check needs 'time' - add it");
  EXPECT_TRUE(mentions(complaints(field + "time = \"10 m\"\n"),
                       {":14:8: check:", "'time'", "wrong kind", "0.1 s", "correct it"}));
  EXPECT_NE(complaints(field + "time = 1\nwhere = \"Y >\"\n").find(":15:9: check: 'where'"), std::string::npos);
  EXPECT_TRUE(mentions(complaints(field + "time = 1\nquantity = \"q\"\n"),
                       {":15:12: check:", "'quantity'", "as = \"field_error\"", "'field'", "remove"}));
  EXPECT_TRUE(mentions(complaints(rest + "as = \"ratio\"\nquantity = \"q\"\nwhere = \"Y > 1\"\n"),
                       {":14:9: check:", "'where'", "only for as = \"field_error\"", "remove"}));
}

TEST(Verify, JudgesBoundsOnBothSides) {
  Check c = check_of("v", "a", "1 mm", 0, Check::Kind::between);
  c.upper = "0.002 m";
  auto const row = [&](double value) {
    std::string const summary =
        R"({"status": "completed", "quantities": {"a": {"value": )" + std::to_string(value) + R"(, "unit": "m"}}})";
    return compare("c", {c}, {{.variant = "v", .summary = summary}}).at(0);
  };
  EXPECT_EQ(row(0.0015).verdict, "passes");
  EXPECT_EQ(row(0.0009).verdict, "falls short");
  EXPECT_EQ(row(0.0021).verdict, "falls short");
  EXPECT_EQ(row(0.0021).tolerance, "to 0.002 m");
  c.upper = "2 kg";
  EXPECT_NE(row(0.0015).note.find("kg"), std::string::npos);
  EXPECT_FALSE(row(0.0015).accepted);
}

// Both plates turn alike, so that the field of one is that of the other at the same places.
TEST(Verify, ComparesFieldsWithARefinedRun) {
  testing::TemporaryFolder const folder;
  write(folder / "cases/springs/checks.toml", R"(
[[variant]]
name = "4"
set = ["n=4"]
[[variant]]
name = "8"
set = ["n=8"]
[[check]]
variant = "4"
relative_to = "8"
as = "field_error"
field = "Displacement"
time = "0.3 s"
reference = [0, 1e-12]
kind = "between"
source = "each spring for itself"
evidence = "code"
[[check]]
variant = "4"
relative_to = "8"
as = "field_error"
field = "Displacment"
time = "0.3 s"
reference = 1
kind = "below"
source = "a slip"
evidence = "code"
)");
  std::atomic<int> const none{0};
  auto const prepare = [](std::filesystem::path const&, std::vector<std::string> const& set) {
    Simulation s = testing::make_springs(std::stoi(set.at(0).substr(2)));
    s.spec.run.max_step = 0.005;  // below the step that wanders with the particles
    return s;
  };
  auto const rows =
      verify({.cases = folder / "cases", .names = {}, .out = folder / "out"}, prepare, {}, none).at(0).rows;
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].quantity, "Displacement at 300 ms, error against 8");
  ASSERT_TRUE(rows[0].measured) << rows[0].note;
  EXPECT_EQ(rows[0].verdict, "passes") << *rows[0].measured;
  EXPECT_EQ(rows[0].evidence, "code");
  EXPECT_EQ(rows[1].note, "4 has no Displacment at 300 ms; 8 has no Displacment at 300 ms");
  EXPECT_FALSE(rows[1].accepted);
}

TEST(Verify, DividesTheErrorsOfTwoRuns) {
  auto const run = [](std::string const& name, double value) {
    VariantRun r = run_with(name, "q", 1);
    r.samples = {{.field = "Pressure",
                  .time = 0.5,
                  .dimension = 1,
                  .values = {value},
                  .X = {{0, 0, 0}},
                  .volume = {1},
                  .spacing = {1},
                  .body = {0}}};
    return r;
  };
  Check c = check_of("new", "", "0.1", 0.01);
  c.as = Check::Comparison::field_error;
  c.relative_to = "fine";
  c.beside = "published";
  c.field = "Pressure";
  c.time = 0.5;
  auto const row = compare("c", {c}, {run("new", 4.1), run("published", 5), run("fine", 4)}).at(0);
  EXPECT_EQ(row.quantity, "Pressure at 500 ms, error against fine, by that of published");
  EXPECT_NEAR(row.measured.value_or(0), 0.1, 1e-12);  // 0.1/4 by 1/4
  EXPECT_TRUE(row.accepted);
  EXPECT_TRUE(compare("c", {c}, {run("new", 4.1), run("fine", 4)}).empty());
  EXPECT_FALSE(compare("c", {c}, {run("new", 4.1), run("published", 4), run("fine", 4)}).at(0).accepted);
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
