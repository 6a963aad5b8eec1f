// SPDX-License-Identifier: Apache-2.0
#include "piola/output/checksum_trailer.hpp"
#include "piola/output/hdf5.hpp"
#include "piola/setup/cloud_file.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;
using testing::TemporaryFolder;
using Words = std::vector<std::string>;
using Numbers = std::vector<double>;

struct ReadPoints {
  PointCloud cloud;
  Words problems;
};

/// A file as another program writes it: without the checksum trailer of Piola.
ReadPoints read_foreign(std::function<void(hdf5::Writer&)> const& fill, CloudOptions const& options = {}) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "points.h5";
  hdf5::Writer file(path);
  fill(file);
  file.finish();
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - checksum_trailer_of({}, 0).size());
  ReadPoints read;
  read.cloud = read_cloud(path.string(), options, read.problems);
  for (std::string& problem : read.problems) problem.erase(0, path.string().size() + 2);
  return read;
}

/// The middles of 27 cells of edge 1: x, y, z one after the other.
Numbers places() {
  Numbers X;
  for (int k = 0; k < 27; ++k)
    for (int const at : {k % 3, k / 3 % 3, k / 9}) X.push_back(at + 0.5);
  return X;
}

Numbers component(std::size_t c) {
  Numbers values;
  Numbers const all = places();
  for (std::size_t i = c; i < all.size(); i += 3) values.push_back(all[i]);
  return values;
}

void put(hdf5::Writer& file, std::string const& path, Numbers const& values, int columns = 1) {
  file.dataset<double>(path, values, columns);
}

TEST(CloudDatasets, TakesATableOfPlacesInAGroupWithUnits) {
  auto const [cloud, problems] = read_foreign(
      [](hdf5::Writer& file) {
        file.group("/PartType0");
        put(file, "/PartType0/Coordinates", places(), 3);
        put(file, "/PartType0/volume", Numbers(27, 1000));
        put(file, "/PartType0/Density", Numbers(27, 7800));
        file.attribute("/PartType0/Coordinates", "units", "cm");
        file.attribute("/PartType0/volume", "unit", "mm^3");
      },
      {.group = "PartType0"});
  EXPECT_EQ(problems, Words{});
  ASSERT_EQ(cloud.X.size(), 27U);
  EXPECT_EQ(cloud.dimension, 3);
  EXPECT_NEAR(cloud.X[5][0], 0.025, 1e-16);
  EXPECT_NEAR(cloud.X[5][1], 0.015, 1e-16);
  EXPECT_NEAR(cloud.X[5][2], 0.005, 1e-16);
  EXPECT_NEAR(cloud.spacing, 0.01, 1e-15);
  ASSERT_EQ(cloud.notes.size(), 1U);
  EXPECT_NE(cloud.notes[0].find("data sets that are not used: \"Density\""), std::string::npos) << cloud.notes[0];
}

TEST(CloudDatasets, TakesListsOfComponentsAndOneBody) {
  auto const [cloud, problems] = read_foreign(
      [](hdf5::Writer& file) {
        Numbers body(27, 4);
        for (std::size_t i = 0; i < 9; ++i) body[i] = -7;  // the lowest layer
        put(file, "/x", component(0));
        put(file, "/Y", component(1));
        put(file, "/z", component(2));
        put(file, "/body", body);
      },
      {.length_unit = 0.001, .total_volume = 18e-9, .body = "4"});
  EXPECT_EQ(problems, Words{});
  ASSERT_EQ(cloud.X.size(), 18U);
  EXPECT_NEAR(cloud.min[2], 0.0015, 1e-16);
  EXPECT_NEAR(cloud.volume[3], 1e-9, 1e-22);
}

TEST(CloudDatasets, SaysWhatIsMissingOrWrong) {
  auto const refused = [](auto const& fill, CloudOptions const& options = {}) {
    auto const problems = read_foreign(fill, options).problems;
    return problems.size() == 1 ? problems[0] : "not one problem but " + std::to_string(problems.size());
  };
  EXPECT_EQ(refused([](hdf5::Writer& file) { file.group("/gas"); }, {.group = "dust"}),
            "has no group \"dust\" (it has \"gas\") - correct the group");
  EXPECT_EQ(refused([](hdf5::Writer& file) {
              put(file, "/mass", {1, 2});
            }),
            "has no places (it has \"mass\"; expected a data set \"points\" of two or three columns, or lists \"x\", "
            "\"y\", \"z\") - name them so, or give the group that holds them");
  EXPECT_TRUE(mentions(refused([](hdf5::Writer& file) {
                         put(file, "/points", places(), 3);
                         put(file, "/volume", {1, 1});
                       }),
                       {"\"volume\" has 2 values", "\"x\" has 27", "each point"}));
  EXPECT_TRUE(mentions(refused(
                           [](hdf5::Writer& file) {
                             put(file, "/points", places(), 3);
                             put(file, "/body", Numbers(27, 0.5));
                           },
                           {.total_volume = 27}),
                       {"body", "no whole numbers", "number the bodies"}));
  EXPECT_TRUE(mentions(refused([](hdf5::Writer& file) {
                         Numbers X = places();
                         X[4] = std::nan("");
                         put(file, "/points", X, 3);
                         put(file, "/volume", Numbers(27, 1));
                       }),
                       {"particle 1: y", "not a number", "finite", "correct the row"}));
}

TEST(CloudDatasets, FilesThatAreCutOffOrDamagedAreRefused) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "points.h5";
  hdf5::Writer file(path);
  put(file, "/points", places(), 3);
  put(file, "/volume", Numbers(27, 1));
  file.finish();
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  Words problems;
  read_cloud(path.string(), {}, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("is no HDF5 file or is cut off"), std::string::npos) << problems[0];
}

}  // namespace
}  // namespace piola
