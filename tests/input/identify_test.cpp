// SPDX-License-Identifier: Apache-2.0
#include "piola/input/identify.hpp"
#include "piola/base/version.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/case_keys.hpp"
#include "piola/model/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::TemporaryFolder;

constexpr char const* cloud_case = R"(title = "cloud"
[run]
end = "20 us"
[[region]]
name = "r"
shape = { box = { min = [0, 0], max = [1, 1] } }
[[body]]
name = "b"
shape.points = { file = "c.csv" }
material = { law = "neo_hookean", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.4 }
formulation = { name = "jst_sph" }
)";

void write_cloud(std::filesystem::path const& path, int rows, char const* last = "") {
  std::string text = "x,y,volume\n";
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) text += std::to_string(i) + "," + std::to_string(j) + ",1\n";
  write_whole_file(path, text + last);
}

TEST(Identity, IsOfEverythingThatResultsDependOn) {
  TemporaryFolder folder;
  write_whole_file(folder / "c.toml", cloud_case);
  write_cloud(folder / "c.csv", 4);
  auto const with = [&](std::vector<std::string> const& settings) {
    return read_case(folder / "c.toml", settings).identity;
  };
  Identity const first = with({});
  EXPECT_EQ(first.run.size(), 16u);
  ASSERT_EQ(first.files.size(), 1u);
  EXPECT_EQ(first.files[0].first, "c.csv");
  EXPECT_EQ(first.files[0].second, digest_of_file(folder / "c.csv"));
  EXPECT_EQ(with({}).run, first.run);
  EXPECT_EQ(with({"run.threads=1"}).run, first.run);
  EXPECT_NE(with({"run.end=\"21 us\""}).run, first.run);
  bool const is_scalar = first.backend.starts_with("scalar");
  EXPECT_EQ(with({"run.instruction_set=scalar"}).run == first.run, is_scalar);
  write_whole_file(folder / "c.toml", std::string("# comment\n") + cloud_case);
  EXPECT_EQ(with({}).run, first.run);
  write_cloud(folder / "c.csv", 5);
  EXPECT_NE(with({}).run, first.run);
  EXPECT_EQ(with({}).case_text, first.case_text);
  write_cloud(folder / "c.csv", 4);
  EXPECT_EQ(with({}).run, first.run);
}

TEST(Identity, HasTheBuildOfTheProgram) {
  EXPECT_EQ(build_id().size(), 40u);  // SHA-1
  EXPECT_EQ(build_id(), build_id());
  EXPECT_EQ(build_id().find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Identity, DigestsFilesOfAnySize) {
  TemporaryFolder folder;
  std::string const block(std::size_t{1} << 20, 'a');
  std::vector<std::string> digests;
  for (std::string const& content : {std::string(), std::string("a"), block, block + "a", block + block, "b" + block}) {
    write_whole_file(folder / "f", content);
    digests.push_back(digest_of_file(folder / "f"));
    EXPECT_EQ(digests.back().size(), 16u);
  }
  std::sort(digests.begin(), digests.end());
  EXPECT_EQ(std::adjacent_find(digests.begin(), digests.end()), digests.end());
  EXPECT_EQ(digest_of_file(folder / "none"), "");
  EXPECT_EQ(digest_of_file(folder.path()), "");
}

TEST(Settings, TakePathsFromTheFolderOfTheCase) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "there/files");
  write_whole_file(folder / "there/c.toml", cloud_case);
  write_cloud(folder / "there/files/d.csv", 4);
  auto const particles = [&](std::string const& setting) {
    ParticleSet made;
    read_case(folder / "there/c.toml", {setting}, {}, &made);
    return made.size();
  };
  EXPECT_EQ(particles("body.b.shape.points.file=files/d.csv"), 16);
  EXPECT_EQ(particles("body.b.shape={points={file='files/d.csv'}}"), 16);
  EXPECT_EQ(particles("body.0.shape.points={file='files/d.csv'}"), 16);
  EXPECT_EQ(particles("body.0.shape.points.file=" + (folder / "there/files/d.csv").string()), 16);
}

// Studies know by the name of a key that its value is a path.
TEST(Settings, OfFilesAreKeysOfThisName) {
  int files = 0;
  for (KeyInfo const& info : case_keys()) {
    bool const is_path = info.meaning.find("path from the case file") != std::string_view::npos;
    EXPECT_EQ(info.key == "file" || (info.section == "body.material" && info.key == "library"), is_path)
        << info.section << "." << info.key;
    files += is_path ? 1 : 0;
  }
  EXPECT_GE(files, 3);
}

}  // namespace
}  // namespace piola
