// SPDX-License-Identifier: Apache-2.0
#include "piola/study/study.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::TemporaryFolder;

StudySpec spec_of(TemporaryFolder const& folder, char const* text) {
  write_whole_file(folder / "study.toml", text);
  return read_study(folder / "study.toml");
}

TEST(Studies, AreAllCombinationsWithTheLastKeyFastest) {
  TemporaryFolder folder;
  StudySpec const study = spec_of(
      folder, "case = 'c.toml'\njobs = 3\n[parameters]\n'run.end' = ['1 ms', '2 ms']\n'body.a.x' = [1, 2.5, [1, 2]]\n");
  EXPECT_EQ(study.jobs, 3);
  EXPECT_EQ(study.case_file, folder / "c.toml");
  auto const runs = combinations(study);
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs[0].folder, "run-1");
  EXPECT_EQ(runs[0].settings, (std::vector<std::string>{"run.end=\"1 ms\"", "body.a.x=1"}));
  EXPECT_EQ(runs[5].value_text[1], "[1, 2]");
}

TEST(Studies, TellAllThatIsWrong) {
  TemporaryFolder folder;
  try {
    spec_of(folder, "cas = 'c.toml'\njobs = 0\n[parameters]\nrun.end = 3\n");
    FAIL();
  } catch (InputError const& error) {
    std::string const text = error.what();
    for (char const* part : {":1:1: \"cas\" is not a key", "case = ", "jobs is not", "\"run\" is not a list"})
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  EXPECT_THROW(spec_of(folder, "case = 'c'\n"), InputError);
  std::string many = "case = 'c'\n[parameters]\n";
  for (char const* key : {"a", "b", "c", "d", "e"}) many += std::string(key) + " = [1,2,3,4,5,6,7,8,9]\n";
  EXPECT_THROW(spec_of(folder, many.c_str()), InputError);
}

TEST(Studies, TakePathsFromTheirOwnFolder) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "cases");
  std::string const text =
      "out = 'o'\n[parameters]\n'body.a.shape.mesh.file' = ['m.stl', '/m.stl']\n'body.a.shape' = [{ union = [{ mesh = "
      "{ "
      "file = 'm.stl' } }] }]\n'body.a.formulation.file' = ['x']\n";
  StudySpec const there = spec_of(folder, ("case = 'cases/c.toml'\n" + text).c_str());
  EXPECT_EQ(there.out, folder / "o");
  EXPECT_EQ(there.parameters[0].second, (std::vector<std::string>{"\"../m.stl\"", "\"/m.stl\""}));
  EXPECT_NE(there.parameters[1].second[0].find("\"../m.stl\""), std::string::npos) << there.parameters[1].second[0];
  StudySpec const here = spec_of(folder, ("case = 'c.toml'\n" + text).c_str());
  EXPECT_EQ(here.parameters[0].second[0], "\"m.stl\"");
}

constexpr char const* completed_run = R"({"status": "completed", "identity": {"run": "abc"},
"quantities": {"z": {"value": 0.5, "unit": "m"}, "a": {"value": 2, "unit": "1"}}})";

TEST(Studies, TakeResultsOfTheSameIdentityOnly) {
  TemporaryFolder folder;
  EXPECT_FALSE(outcome_in(folder.path(), "abc"));
  write_whole_file(folder / "summary.json", completed_run);
  auto const found = outcome_in(folder.path(), "abc");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->status, "completed");
  ASSERT_EQ(found->quantities.size(), 2u);
  EXPECT_EQ(found->quantities[0].name, "z");  // in the order of the case
  EXPECT_FALSE(outcome_in(folder.path(), "abd"));
  write_whole_file(folder / "summary.json", R"({"status": "completed", "identity": {"run": ""}})");
  EXPECT_FALSE(outcome_in(folder.path(), ""));
  for (char const* text : {"[]", "{", R"({"status": "completed"})", R"({"status": 1, "identity": "abc"})"}) {
    write_whole_file(folder / "summary.json", text);
    EXPECT_FALSE(outcome_in(folder.path(), "abc")) << text;
  }
}

TEST(Studies, BelieveASummaryThatTheRunItselfWrote) {
  TemporaryFolder folder;
  write_whole_file(folder / "summary.json", completed_run);
  auto const status = [&](char const* identity, char const* before, char const* ended_as) {
    RunOutcome const outcome = outcome_of(folder.path(), {identity, before, ended_as});
    EXPECT_EQ(outcome.quantities.empty(), !outcome.why.empty());
    return outcome.status + (outcome.why.empty() ? "" : " without values");
  };
  EXPECT_EQ(status("abc", "", "completed"), "completed");
  EXPECT_EQ(status("abc", completed_run, "completed"), "failed without values");  // it is as it was before
  EXPECT_EQ(status("abd", "", "completed"), "failed without values");
  EXPECT_EQ(status("abc", "", ""), "failed without values");
  EXPECT_EQ(status("abc", "", "stopped"), "stopped");
  EXPECT_EQ(status("abc", "", "failed"), "failed");
  write_whole_file(folder / "summary.json", R"({"status": "completed", "identity": {"run": ""}})");
  EXPECT_EQ(outcome_of(folder.path(), {"", "", "completed"}).status, "completed");  // unknown to both
  write_whole_file(folder / "summary.json", R"({"status": "stopped", "identity": {"run": "abc"}})");
  EXPECT_EQ(outcome_of(folder.path(), {"abc", "", "completed"}).status, "failed");
}

TEST(Studies, HaveATableOfValuesAndQuantities) {
  TemporaryFolder folder;
  StudySpec const study = spec_of(folder, "case = 'c'\n[parameters]\n'a.b' = ['x, y', 2]\n");
  write_study_table(folder.path(), study, combinations(study),
                    {{"failed", {}, "why"}, {"completed", {{"peak", 0.5, "m"}}}});
  EXPECT_EQ(read_text_file(folder / "study.csv"),
            "folder,a.b,status,peak\nrun-1,\"x, y\",failed,\nrun-2,2,completed,0.5\n");
}

TEST(Studies, SetValuesForAllRuns) {
  TemporaryFolder folder;
  StudySpec study = spec_of(folder, "case = 'c'\n[parameters]\n'a.b' = [1, 2]\n");
  study.settings = {"run.end=1"};
  EXPECT_EQ(combinations(study)[1].settings, (std::vector<std::string>{"run.end=1", "a.b=2"}));
  EXPECT_EQ(combinations(study)[1].value_text, std::vector<std::string>{"2"});
}

}  // namespace
}  // namespace piola
