// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "support/places.hpp"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace piola {
namespace {

std::vector<std::filesystem::path> corpus() {
  std::vector<std::filesystem::path> files;
  for (auto const& entry : std::filesystem::directory_iterator(testing::source_folder() + "/tests/fuzz/corpus/case")) {
    files.push_back(entry.path());
  }
  return files;
}

std::string content_of(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Corpus, EveryFileIsACaseOrAnInputError) {
  ASSERT_GE(corpus().size(), 10u);
  for (auto const& path : corpus()) {
    std::string const text = content_of(path);
    std::vector<std::string> overrides;
    if (text.starts_with("#set ")) overrides.push_back(text.substr(5, text.find('\n') - 5));
    try {
      read_case_text(text, path.filename().string(), overrides, {.particles = 5000, .memory = false});
    } catch (InputError const& error) {
      EXPECT_NE(std::string(error.what()), "") << path;
    }
  }
}

TEST(Corpus, EveryCutAndEveryChangedByteOfAGoodCaseIsSurvived) {
  std::string const text = content_of(testing::source_folder() + "/tests/fuzz/corpus/case/column.toml");
  ReadLimits const limits{.particles = 5000, .memory = false};
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (std::string const& variant : {text.substr(0, i), std::string(text).replace(i, 1, "~")}) {
      try {
        read_case_text(variant, "case.toml", {}, limits);
      } catch (InputError const&) {
      }
    }
  }
}

}  // namespace
}  // namespace piola
