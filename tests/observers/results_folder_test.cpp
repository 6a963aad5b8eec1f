// SPDX-License-Identifier: Apache-2.0
#include "piola/observers/results_folder.hpp"
#include "piola/base/errors.hpp"
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

TEST(ResultsFolder, LosesNoFilesOfOthersInFoldersOfResults) {
  testing::TemporaryFolder const folder;
  std::vector<std::string> const results{"frames/000012.hdf",
                                         "frames/1000000.hdf",
                                         "frames/000013.hdf.part",
                                         "pictures/Pressure-000000.png",
                                         "pictures/Velocity-x-000001.png",
                                         "pictures/Pressure-Damage-000001.png",
                                         "pictures/Pressure-times.png",
                                         "checkpoints/000000012.h5",
                                         "checkpoints/failed.h5",
                                         "checkpoints/wall_times.txt",
                                         "case-files/files.toml",
                                         "case-files/packed-0123456789abcdef.cloud"};
  std::vector<std::string> const others{"frames/000012.hdf5",
                                        "frames/notes.txt",
                                        "pictures/figure-3.png",
                                        "pictures/photo-000001.png",
                                        "pictures/Pressure-annotated.png",
                                        "pictures/Pressure.png",
                                        "pictures/Pressure-000000.svg",
                                        "pictures/mine/Pressure-000000.png",
                                        "checkpoints/000000012.h5.bak",
                                        "checkpoints/12.h5",
                                        "case-files/cloud.csv"};
  for (auto const* list : {&results, &others})
    for (std::string const& name : *list) write_case(folder / name);
  std::ofstream(folder / "case-files/files.toml") << "[[file]]\nkept = \"1-mesh.stl\"\n";
  write_case(folder / "case-files/1-mesh.stl");
  clear_results(folder.path());
  for (std::string const& name : results) EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (std::string const& name : others) EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "case-files/1-mesh.stl")) << "the list says that it is a copy of Piola's";
}

TEST(ResultsFolder, LosesLinksToFoldersAndNotWhatIsInThem) {
  testing::TemporaryFolder const folder;
  write_case(folder / "archive/000012.hdf");
  fs::create_directories(folder / "results");
  fs::create_directory_symlink(folder / "archive", folder / "results/frames");
  clear_results(folder / "results");
  EXPECT_FALSE(fs::exists(folder / "results/frames"));
  EXPECT_TRUE(fs::exists(folder / "archive/000012.hdf"));
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
