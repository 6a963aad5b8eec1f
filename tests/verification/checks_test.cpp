// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/verification/verify.hpp"
#include "support/fake_formulation.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;

void write(std::filesystem::path const& path, std::string const& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

/// What read_checks complains about, without the file and the place; "" if nothing.
std::string repair_note(std::string const& text) {
  testing::TemporaryFolder const folder;
  write(folder / "checks.toml", text);
  try {
    read_checks(folder / "checks.toml");
    return {};
  } catch (InputError const& error) {
    std::string message = error.what();
    for (std::size_t at = 0; (at = message.find(folder.path().string())) != std::string::npos;)
      message.erase(at, message.find(": ", at) + 2 - at);
    return message;
  }
}

std::string const good_check =
    "[[check]]\nquantity = \"q\"\nreference = 1\ntolerance = 0.1\nsource = \"s\"\nevidence = \"theory\"\n";

TEST(ReadChecks, NamesOfVariantsAreNamesOfFolders) {
  auto const named = [](std::string const& name) {
    return repair_note("[[variant]]\nname = " + name + "\n" + good_check);
  };
  EXPECT_EQ(named("\"nu 0.499, 5x25x5\""), "");
  EXPECT_EQ(named("\"eps4 1/64, 3 rad/s\""), "");
  EXPECT_EQ(folder_of("../../other"), ".._.._other");
  EXPECT_EQ(
      named("\"..\""),
      "variant: 'name' is \"..\", which cannot name a folder (allowed: 1 to 100 characters without backslashes, line "
      "breaks or blanks at the ends, not . or ..) - choose another");
  EXPECT_NE(
      repair_note("[[variant]]\nname = \"1/8\"\n[[variant]]\nname = \"1_8\"\n" + good_check).find("gives the folder"),
      std::string::npos);
  for (char const* const name : {"\"\"", "\".\"", "\"..\"", "'a\\b'", "\"a\\nb\"", "\" a\"", "\"a \""})
    EXPECT_NE(named(name).find("which cannot name a folder"), std::string::npos) << name;
  EXPECT_NE(named("\"" + std::string(101, 'a') + "\"").find("which cannot name a folder"), std::string::npos);
  EXPECT_TRUE(
      mentions(repair_note("[[variant]]\nname = \"a\"\n[[variant]]\nname = \"a\"\n" + good_check + "variant = \"a\"\n"),
               {"variant", "\"a\"", "folder", "variant above", "another"}));
}

TEST(ReadChecks, FilesThatCheckNothingAreRefused) {
  std::string const nothing = "holds no check, so that it could never fail - add a [[check]]";
  EXPECT_EQ(repair_note(""), nothing);
  EXPECT_EQ(repair_note("# later\n"), nothing);
  EXPECT_EQ(repair_note("check = []\n"), nothing);
  EXPECT_EQ(repair_note("[[variant]]\nname = \"a\"\n"), nothing);
}

TEST(ReadChecks, SingleBracketsAreRefused) {
  EXPECT_EQ(repair_note("[check]\nquantity = \"q\"\n"),
            "'check' is one table (a list of tables is needed) - write [[check]] in double brackets");
  EXPECT_TRUE(mentions(repair_note("[variant]\nname = \"a\"\n" + good_check),
                       {"'variant'", "one table", "list of tables", "[[variant]]"}));
  EXPECT_TRUE(mentions(repair_note("check = 3\n"), {"'check'", "value", "list of tables", "[[check]]"}));
  EXPECT_TRUE(mentions(repair_note("check = [3]\n"), {"'check'", "value", "list of tables", "[[check]]"}));
}

TEST(ReadChecks, TolerancesThatCannotFailAreRefused) {
  auto const with = [](std::string const& tolerance) {
    return repair_note(
        "[[check]]\nquantity = \"q\"\nreference = 1\nsource = \"s\"\nevidence = \"theory\"\ntolerance = " + tolerance +
        "\n");
  };
  EXPECT_EQ(with("0"), "");
  EXPECT_EQ(with("\"2.5 %\""), "");
  EXPECT_TRUE(mentions(with("inf"), {"check:", "'tolerance'", "inf", "0 or more, finite", "what the source grants"}));
  for (char const* const tolerance : {"\"inf %\"", "+inf"})
    EXPECT_NE(with(tolerance).find("no check could fail"), std::string::npos) << tolerance;
  for (char const* const tolerance : {"nan", "-0.1", "-inf", "\"-1 %\"", "\"nan %\""})
    EXPECT_NE(with(tolerance).find("no check could pass"), std::string::npos) << tolerance;
}

TEST(ReadChecks, ReferencesAreNumbersOrQuantities) {
  auto const with = [](std::string const& reference) {
    return repair_note(
        "[[check]]\nquantity = \"q\"\ntolerance = 1\nsource = \"s\"\nevidence = \"theory\"\nreference = " + reference +
        "\n");
  };
  EXPECT_EQ(with("\"100 ms\""), "");
  for (char const* const reference : {"inf", "nan", "\"soon\"", "\"5 bananas\"", "true", "[1]"})
    EXPECT_TRUE(mentions(with(reference), {"check:", "'reference'", "wrong kind", "number with unit", "correct it"}))
        << reference;
}

TEST(ReadChecks, OverridesAreKeysWithValues) {
  for (char const* const item : {"\"run.end\"", "\"=3\"", "7"})
    EXPECT_NE(
        repair_note(std::string("[[variant]]\nname = \"a\"\nset = [") + item + "]\n" + good_check).find("key=value"),
        std::string::npos)
        << item;
}

TEST(Verify, ReportsTheProblemsOfAllFilesBeforeAnythingRuns) {
  testing::TemporaryFolder const folder;
  write(folder / "cases/a/checks.toml", "[[variant]]\nname = \"..\"\n[check]\n");
  write(folder / "cases/b/checks.toml", "");
  write(folder / "cases/c/checks.toml", good_check);
  std::atomic<int> const none{0};
  try {
    verify(
        {.cases = folder / "cases", .names = {}, .out = folder / "out"},
        [](std::filesystem::path const&, std::vector<std::string> const&) { return testing::make_springs(); }, {},
        none);
    FAIL();
  } catch (InputError const& error) {
    std::string const text = error.what();
    for (char const* part :
         {"a/checks.toml:2:8: variant: 'name'", "write [[check]] in double brackets", "b/checks.toml: holds no check"})
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace piola
