// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/study.hpp"
#include "piola/output/files.hpp"
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

TEST(Studies, HaveATableOfValuesAndQuantities) {
  TemporaryFolder folder;
  StudySpec const study = spec_of(folder, "case = 'c'\n[parameters]\n'a.b' = ['x, y', 2]\n");
  auto const runs = combinations(study);
  std::filesystem::create_directories(folder / "run-2");
  write_whole_file(folder / "run-2/summary.json",
                   R"({"status": "completed", "quantities": {"peak": {"value": 0.5, "unit": "m"}}})");
  write_study_table(folder.path(), study, runs);
  EXPECT_EQ(read_text_file(folder / "study.csv"),
            "folder,a.b,status,peak\nrun-1,\"x, y\",failed,\nrun-2,2,completed,0.5\n");
}

}  // namespace
}  // namespace piola
