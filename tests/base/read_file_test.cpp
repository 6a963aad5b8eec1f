// SPDX-License-Identifier: Apache-2.0
#include "piola/base/read_file.hpp"
#include "piola/base/errors.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace piola {
namespace {

std::string refusal(std::filesystem::path const& path) {
  try {
    read_input_file(path);
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

TEST(ReadFile, GivesTheWholeContentOfFilesOfAnySize) {
  testing::TemporaryFolder const folder;
  for (std::size_t const size : {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{65537}}) {
    std::ofstream(folder / "a") << std::string(size, 'x');
    EXPECT_EQ(read_text_file(folder / "a"), std::string(size, 'x'));
  }
  std::filesystem::create_symlink(folder / "a", folder / "link");
  EXPECT_EQ(read_text_file(folder / "link").size(), 65537U) << "links to files are followed";
  EXPECT_THROW(read_text_file(folder / "a", 65536), FileError);
  EXPECT_EQ(read_text_file(folder / "a", 65537).size(), 65537U);
}

TEST(ReadFile, RefusesWhatIsNoRegularFileWithoutWaiting) {
  testing::TemporaryFolder const folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder / "pipe", folder / "link");
  EXPECT_NE(refusal(folder / "pipe").find("pipe: is a pipe (a regular file is needed)"), std::string::npos);
  EXPECT_NE(refusal(folder / "link").find("link: is a pipe"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero").find("is a device"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(refusal(folder / "nothing").find("cannot be read - check that the file exists"), std::string::npos);
}

}  // namespace
}  // namespace piola
