// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_files.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <set>

namespace piola {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

void write(fs::path const& path, std::string const& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

/// A results folder that keeps a copy of what a case called `given`.
struct Kept {
  TemporaryFolder folder;
  std::string text;

  Kept(std::string const& given, std::string const& copy, std::string const& content) {
    write(folder / "case-files/copy.csv", content);
    write(folder / "origin.csv", content);
    write(folder / "case-files/files.toml",
          text_of_list({{given, copy, folder / "origin.csv", content.size(), content_hash(folder / "origin.csv")}}));
    text = "shape.points.file = '" + given + "'\n";
  }
  /// The reported path of the file, or the error.
  std::string place() const {
    Problems problems;
    auto document = parse_document(text, (folder / "case.toml").string(), problems);
    use_kept_files(document->root, folder.path(), problems);
    if (!problems.empty()) return problems.lines().front();
    Section const points(*document->root.find("shape")->find("points"), "body.shape.points", problems);
    return case_file(points, points.node().find("file")->text).path.string();
  }
};

TEST(CaseFiles, DifferentPathsHaveDifferentCopies) {
  std::set<std::string> names;
  std::size_t number = 0;
  for (char const* given : {"a/b.csv", "a__b.csv", "a\\b.csv", "../b.csv", "b.csv"})
    EXPECT_TRUE(names.insert(kept_name(++number, given)).second) << given;
  EXPECT_EQ(kept_name(1, "a/two words.csv"), "1-two_words.csv");
  EXPECT_LT(kept_name(1, std::string(300, 'x') + ".csv").size(), 120U);
  EXPECT_TRUE(kept_name(1, std::string(300, 'x') + ".csv").ends_with(".csv")) << "readers go by the ending";
}

TEST(CaseFiles, HashesTellContentsApart) {
  TemporaryFolder const folder;
  std::set<std::string> hashes;
  for (std::string const& content : {std::string(), std::string("\0", 1), std::string("1"), std::string("1\n"),
                                     std::string(1 << 20, '1'), std::string((1 << 20) + 1, '1')}) {
    write(folder / "a", content);
    write(folder / "b", content);
    EXPECT_EQ(content_hash(folder / "a"), content_hash(folder / "b"));
    EXPECT_TRUE(hashes.insert(content_hash(folder / "a")).second);
  }
}

TEST(CaseFiles, ListReadsBackWhateverPathsHold) {
  TemporaryFolder const folder;
  std::vector<KeptFile> const files{{"a/b.csv", "1-b.csv", "/tmp/\xff 50%\x1b/b.csv", 12, "0123"},
                                    {"c \"d\".stl", "", "/data/m\xc3\xbcller/c.stl", 60'000'000, "4567"}};
  write(folder / "case-files/files.toml", text_of_list(files));
  auto const back = read_kept_list(folder.path());
  ASSERT_EQ(back.size(), files.size());
  for (std::size_t k = 0; k < files.size(); ++k) {
    EXPECT_EQ(back[k].given, files[k].given);
    EXPECT_EQ(back[k].kept, files[k].kept);
    EXPECT_EQ(back[k].from, files[k].from);
    EXPECT_EQ(back[k].bytes, files[k].bytes);
    EXPECT_EQ(back[k].hash, files[k].hash);
  }
  EXPECT_TRUE(read_kept_list(folder / "elsewhere").empty());
}

TEST(CaseFiles, OfResultsAreTheCopies) {
  Kept const kept("sub/cloud.csv", "copy.csv", "x,y\n");
  EXPECT_EQ(kept.place(), (kept.folder / "case-files/copy.csv").string());
}

TEST(CaseFiles, OfResultsAreTheOriginalsWhereNoGoodCopyIsLeft) {
  Kept const large("cloud.csv", "", "x,y\n");
  EXPECT_EQ(large.place(), (large.folder / "origin.csv").string());
  Kept const damaged("cloud.csv", "copy.csv", "x,y\n");
  write(damaged.folder / "case-files/copy.csv", "x,z\n");
  EXPECT_EQ(damaged.place(), (damaged.folder / "origin.csv").string());
}

TEST(CaseFiles, OfResultsThatChangedAreRefusedByName) {
  Kept const large("sub/cloud.csv", "", "x,y\n");
  write(large.folder / "origin.csv", "x,z\n");
  EXPECT_NE(large.place().find("\"sub/cloud.csv\""), std::string::npos) << large.place();
  EXPECT_NE(large.place().find("origin.csv has changed"), std::string::npos) << large.place();
  fs::remove(large.folder / "origin.csv");
  EXPECT_NE(large.place().find("origin.csv cannot be read"), std::string::npos) << large.place();
}

TEST(CaseFiles, OfAnOrdinaryCaseAreNeverTheCopiesBesideIt) {
  Kept const kept("origin.csv", "copy.csv", "x,y\n");
  Problems problems;
  auto const document = parse_document(kept.text, (kept.folder / "case.toml").string(), problems);
  Section const points(*document->root.find("shape")->find("points"), "body.shape.points", problems);
  EXPECT_EQ(case_file(points, "origin.csv").path, kept.folder / "origin.csv");
}

}  // namespace
}  // namespace piola
