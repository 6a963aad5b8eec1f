// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/results_folder.hpp"
#include "piola/base/problems.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

namespace fs = std::filesystem;

void write_case(fs::path const& path) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << "title = \"mine\"\n";
}

/// The reason for refusing the folder, even with force; "" if it is taken.
std::string refusal(fs::path const& folder, fs::path const& case_file) {
  try {
    check_results(folder, {.title = "mine", .case_file = case_file, .force = true});
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

TEST(ResultsFolder, IsNeverOneInWhichTheCaseItselfWouldBeReplaced) {
  testing::TemporaryFolder const folder;
  write_case(folder / "work/case.toml");
  fs::create_directories(folder / "out");
  fs::create_hard_link(folder / "work/case.toml", folder / "out/case.toml");
  fs::create_directories(folder / "linked");
  fs::create_symlink(folder / "work/case.toml", folder / "linked/case.toml");
  fs::create_directory_symlink(folder / "work", folder / "door");
  write_case(folder / "deep/frames/mine.toml");

  EXPECT_NE(refusal(folder / "work", folder / "work/case.toml").find("give another folder with --out"),
            std::string::npos);
  EXPECT_NE(refusal(folder / "work/../work", folder / "door/case.toml"), "") << "another way to the same file";
  EXPECT_NE(refusal(folder / "door", folder / "work/case.toml"), "") << "another way to the same folder";
  EXPECT_NE(refusal(folder / "out", folder / "work/case.toml"), "") << "a hard link";
  EXPECT_NE(refusal(folder / "linked", folder / "work/case.toml"), "") << "a symbolic link";
  EXPECT_NE(refusal(folder / "work", folder / "linked/case.toml"), "") << "read through a symbolic link";
  EXPECT_NE(refusal(folder / "deep", folder / "deep/frames/mine.toml"), "") << "inside a folder of results";

  EXPECT_EQ(refusal(folder / "new", folder / "work/case.toml"), "");
  write_case(folder / "beside/bar.toml");
  EXPECT_EQ(refusal(folder / "beside", folder / "beside/bar.toml"), "") << "a case with a name of its own";
  write_case(folder / "copy/case.toml");
  EXPECT_EQ(refusal(folder / "copy", folder / "work/case.toml"), "") << "the copy of an earlier run";
}

TEST(ResultsFolder, LosesOnlyFilesWithNamesOfResults) {
  testing::TemporaryFolder const folder;
  write_case(folder / "case.toml");
  write_case(folder / "frames/000000.hdf");
  write_case(folder / "notes.txt");
  clear_results(folder.path());
  EXPECT_FALSE(fs::exists(folder / "case.toml"));
  EXPECT_FALSE(fs::exists(folder / "frames"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
}

TEST(ResultsFolder, EmptyLogOfAKilledRunDoesNotMakeItForeign) {
  testing::TemporaryFolder const folder;
  std::ofstream(folder / "log.txt").flush();
  EXPECT_NO_THROW(check_results(folder.path(), {.title = "mine", .case_file = {}, .force = false}));
  std::ofstream(folder / "log.txt") << "shopping list\n";
  EXPECT_THROW(check_results(folder.path(), {.title = "mine", .case_file = {}, .force = false}), InputError);
}

TEST(ResultsFolder, LockOfAKilledRunDoesNotMakeItForeign) {
  testing::TemporaryFolder const folder;
  write_case(folder / "lock");
  EXPECT_NO_THROW(check_results(folder.path(), {.title = "mine", .case_file = {}, .force = false}));
  write_case(folder / "thesis.tex");
  EXPECT_THROW(check_results(folder.path(), {.title = "mine", .case_file = {}, .force = false}), InputError);
}

}  // namespace
}  // namespace piola
