// SPDX-License-Identifier: Apache-2.0
// What is written in a results folder never goes elsewhere, whatever links stand there.
#include "piola/output/atomic_file.hpp"
#include "piola/base/errors.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace piola {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;
using testing::text_of;

void write(fs::path const& path, std::string const& text) { std::ofstream(path) << text; }

std::string refusal(fs::path const& path, Opening how) {
  try {
    ::close(open_result(path, how));
  } catch (FileError const& error) {
    return error.what();
  }
  return "";
}

TEST(Files, NewOnesReplaceLinksOfBothKinds) {
  TemporaryFolder const folder;
  write(folder / "precious", "precious");
  fs::create_symlink(folder / "precious", folder / "a.txt.part");
  fs::create_hard_link(folder / "precious", folder / "b.txt.part");
  fs::create_symlink(folder / "precious", folder / "a.txt");
  write_whole_file(folder / "a.txt", "new");
  write_whole_file(folder / "b.txt", "new");
  EXPECT_EQ(text_of(folder / "precious"), "precious");
  EXPECT_EQ(text_of(folder / "a.txt") + text_of(folder / "b.txt"), "newnew");
  EXPECT_FALSE(fs::is_symlink(folder / "a.txt"));
}

TEST(Files, AppendingRefusesLinksPipesAndMissingFiles) {
  TemporaryFolder const folder;
  write(folder / "precious", "precious");
  fs::create_symlink(folder / "precious", folder / "log.txt");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (Opening const how : {Opening::append, Opening::change}) {
    EXPECT_NE(refusal(folder / "log.txt", how).find("a link stands there"), std::string::npos);
    EXPECT_NE(refusal(folder / "pipe", how), "");
    EXPECT_NE(refusal(folder / "nothing", how).find("nothing: cannot be written"), std::string::npos);
  }
  EXPECT_EQ(text_of(folder / "precious"), "precious");
}

TEST(Files, AppendingLeavesOtherNamesOfTheFileAsTheyWere) {
  TemporaryFolder const folder;
  write(folder / "backup", "old\n");
  fs::create_hard_link(folder / "backup", folder / "log.txt");
  auto const file = open_result_file(folder / "log.txt", Opening::append);
  std::fputs("new\n", file.get());
  std::fflush(file.get());
  EXPECT_EQ(text_of(folder / "log.txt"), "old\nnew\n");
  EXPECT_EQ(text_of(folder / "backup"), "old\n");
}

TEST(Files, OverwritingAnEndLeavesFilesWithOtherNamesAlone) {
  TemporaryFolder const folder;
  write(folder / "index", "one end");
  fs::create_symlink(folder / "index", folder / "link");
  EXPECT_FALSE(overwrite_end(folder / "link", 7, 3, "two end"));
  fs::create_hard_link(folder / "index", folder / "other");
  EXPECT_FALSE(overwrite_end(folder / "index", 7, 3, "two end"));
  fs::remove(folder / "other");
  EXPECT_TRUE(overwrite_end(folder / "index", 7, 3, "two end"));
  EXPECT_EQ(text_of(folder / "index"), "one two end");
}

TEST(Files, KnowWhenTheyWereRemovedOrReplaced) {
  TemporaryFolder const folder;
  int const fd = open_result(folder / "a", Opening::replace);
  EXPECT_TRUE(still_there(fd, folder / "a"));
  fs::remove(folder / "a");
  EXPECT_FALSE(still_there(fd, folder / "a"));
  write(folder / "a", "another");
  EXPECT_FALSE(still_there(fd, folder / "a"));
  ::close(fd);
}

}  // namespace
}  // namespace piola
