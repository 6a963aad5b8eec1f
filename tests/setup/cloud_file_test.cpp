// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_file.hpp"
#include "piola/output/frames.hpp"
#include "piola/setup/cloud_checks.hpp"
#include "piola/setup/shapes.hpp"
#include "support/fake_formulation.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <chrono>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

namespace piola {
namespace {

using test::mentions;
using test::mentions_each;
using testing::TemporaryFolder;
using Words = std::vector<std::string>;

struct Read {
  PointCloud cloud;
  Words problems;
};

Read read_text(std::string_view text, CloudOptions const& options = {}) {
  Read read;
  read.cloud = read_cloud_text(text, "cloud.csv", options, read.problems);
  return read;
}

/// n x n x n points in the middle of cells of edge 1, as rows "x,y,z,1".
std::string lattice_rows(int n, char separator = ',') {
  std::string text;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) text += fmt::format("{1}.5{0}{2}.5{0}{3}.5{0}1\n", separator, i, j, k);
  return text;
}

std::string square_rows(int n) {
  std::string text;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) text += fmt::format("{},{}\n", i, j);
  return text;
}

TEST(CloudTable, HasPositionsAndVolumesInSiUnits) {
  auto const [cloud, problems] = read_text(
      "x [mm],y [cm],z [m],volume [mm^3],kernel_volume [cm^3]\n"
      "1,0,0,1,0.001\n0,0.1,0,1,0.001\n0,0,1e-3,1,0.002\n0,0,0,1,0.001\n");
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.dimension, 3);
  ASSERT_EQ(cloud.X.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(cloud.X[i][i], 1e-3, 1e-18);
  EXPECT_NEAR(cloud.volume[0], 1e-9, 1e-24);
  EXPECT_NEAR(cloud.kernel_volume[2], 2e-9, 1e-24);
  EXPECT_NEAR(cloud.spacing, 1e-3, 1e-18);
  EXPECT_EQ(cloud.min, (std::array<double, 3>{0, 0, 0}));
  EXPECT_NEAR(cloud.max[1], 1e-3, 1e-18);
}

TEST(CloudTable, TakesTheUnitOfTheCaseWhereTheHeaderGivesNone) {
  auto const [cloud, problems] = read_text("x,y,volume\n0,0,1\n1,0,1\n0,1,1\n1,1,1\n", {.length_unit = 1e-3});
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.dimension, 2);
  EXPECT_DOUBLE_EQ(cloud.X[3][1], 1e-3);
  EXPECT_DOUBLE_EQ(cloud.volume[0], 1e-6);
  EXPECT_EQ(cloud.kernel_volume, cloud.volume);
  EXPECT_DOUBLE_EQ(cloud.spacing, 1e-3);
}

TEST(CloudTable, KnowsOneDimension) {
  auto const [cloud, problems] = read_text("x,volume\n0,1\n1,1\n2,1\n");
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.dimension, 1);
  EXPECT_DOUBLE_EQ(cloud.spacing, 1);
}

TEST(CloudTable, SurvivesWhatSpreadsheetsMakeOfIt) {
  std::string const plain = "x,y,z,volume\n" + lattice_rows(3);
  std::string odd = "\xef\xbb\xbf# made by hand\r\n\r\n \"X\" ; \"y\";Z;Volume\r\n" + lattice_rows(3, ';');
  for (std::size_t at = odd.find(".5;1\n"); at != std::string::npos; at = odd.find(".5;1\n", at))
    odd.replace(at, 5, ".5 ; \"+1\" \r\n\r\n  # more\r\n");
  auto const [expected, none] = read_text(plain);
  auto const [cloud, problems] = read_text(odd);
  EXPECT_EQ(none, Words{});
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.X, expected.X);
  EXPECT_EQ(cloud.volume, expected.volume);
}

TEST(CloudTable, GivesTheRowsOfOneBody) {
  std::string text = "body,x,y\n";
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) text += fmt::format("left,{},{}\n\"the, right\",{},{}\n", i, j, i + 3, j);
  auto const [all, none] = read_text(text, {.total_volume = 18});
  EXPECT_EQ(none, Words{});
  EXPECT_EQ(all.X.size(), 18U);
  EXPECT_TRUE(mentions_each(all.notes, {{"cloud.csv:", "2 bodies", "taken as one", "body"}}));
  auto const [right, still_none] = read_text(text, {.total_volume = 9, .body = "the, right"});
  EXPECT_EQ(still_none, Words{});
  EXPECT_EQ(right.X.size(), 9U);
  EXPECT_EQ(right.min[0], 3);
  EXPECT_EQ(right.notes, Words{});
  EXPECT_TRUE(mentions_each(read_text(text, {.total_volume = 9, .body = "lef"}).problems,
                            {{"cloud.csv:", "no rows", "\"lef\"", "\"left, the, right\"", "did you mean \"left\""}}));
}

TEST(CloudTable, SharesTheTotalVolumeEqually) {
  auto const [cloud, problems] = read_text("x,y\n" + square_rows(5), {.total_volume = 20});
  EXPECT_EQ(problems, Words{});
  for (double const v : cloud.volume) EXPECT_DOUBLE_EQ(v, 0.8);
  EXPECT_DOUBLE_EQ(cloud.spacing, std::sqrt(0.8));
}

TEST(CloudTable, NotesColumnsThatAreNotUsed) {
  auto const [cloud, problems] = read_text("id,x,y,volume,vx [km/s]\n1,0,0,1,a\n2,1,0,1,b\n3,0,1,1,c\n");
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.notes, Words{"cloud.csv: columns that are not used: \"id, vx\""});
}

struct BadTable {
  std::string text;
  test::KeyWords words;
  CloudOptions options = {};
};

TEST(CloudMessages, SayWhatIsWrongWithTheHeader) {
  for (BadTable const& bad : std::vector<BadTable>{
           {"", {"cloud.csv: ", "empty", "x [mm],y [mm],z [mm]", "another file"}},
           {"\n# only this\n", {"cloud.csv: ", "empty", "x [mm],y [mm],z [mm]", "another file"}},
           {"# x,y\n1,2\n", {"cloud.csv:2: ", "\"1\"", "header", "x [mm],y [mm],z [mm],volume [mm^3]", "without #"}},
           {"x y z\n1 2 3\n", {"cloud.csv:1: ", "no column \"x\"", "\"x y z\"", "in 2D without z", "name"}},
           {"x,z\n1,2\n", {"cloud.csv:1: ", "no column \"y\"", "\"x, z\"", "in 2D without z", "name"}},
           {"x,y,X\n", {"cloud.csv:1:5: ", "column \"X\"", "twice", "remove one"}},
           {"x [mm,y\n", {"cloud.csv:1:1: ", "unit", "\"x [mm\"", "such as \"x [mm]\"", "leave it out"}},
           {"x [kg],y [mm]\n", {"cloud.csv:1:1: ", "\"kg\"", "not a unit of \"x\"", "such as mm", "correct it"}},
           {"x [mm],y [mm], volume [mm^3]\n",
            {"cloud.csv:1:16: ", "\"mm^3\"", "not a unit of \"volume\"", "mm^2", "correct it"}},
           {"x [mm],y [mm],volume\n", {"cloud.csv:1: ", "\"volume\" has no unit", "a unit, or none"}},
           {"x [mm],y [mm]\n",
            {"cloud.csv:1: ", "units", "the case gives one", "leave out one"},
            {.length_unit = 1e-3}},
           {"x,\"y\n1,2\n", {"cloud.csv:1:3: ", "quotation mark", "not closed", "close it"}},
           {std::string("\xff\xfex\0,\0", 6), {"cloud.csv: ", "UTF-16", "expected UTF-8", "CSV UTF-8"}},
           {std::string("x,y\n\0", 5), {"cloud.csv: ", "no text", "NUL byte", ".hdf"}}})
    EXPECT_TRUE(mentions_each(read_text(bad.text, bad.options).problems, {bad.words})) << bad.text;
}

TEST(CloudMessages, NameLineAndColumnOfBadRows) {
  auto const problems = read_text("x,y,volume\n# good\n0,0,1\n\n1, abc,1\n1,2\n1,2,3,4\n1,1e999,1\n\"1,1,1\n").problems;
  EXPECT_TRUE(mentions_each(problems,
                            {{"cloud.csv:5:4: ", "\"abc\"", "not a number", "such as 0.0015", "correct or remove"},
                             {"cloud.csv:6: ", "2 fields", "expected 3", "\"x, y, volume\"", "missing"},
                             {"cloud.csv:7: ", "4 fields", "expected 3", "\"x, y, volume\"", "decimal point"},
                             {"cloud.csv:8:3: ", "\"1e999\"", "at most 1.8e308, at least 5e-324", "correct or remove"},
                             {"cloud.csv:9:1: ", "quotation mark", "not closed", "close it"}}));
  EXPECT_TRUE(mentions_each(read_text("x;y\n1,5;2\n").problems,
                            {{"cloud.csv:2:1:", "1,5", "not a number", "0.0015", "correct or remove"}}));
  EXPECT_TRUE(mentions_each(read_text("x;y\n1;5;2\n").problems,
                            {{"cloud.csv:2:", "3 fields", "expected 2", "x, y", "remove the rest"}}));
  for (char const* number : {"", "+-1", "1e", "0x10", "1 2"})
    EXPECT_EQ(read_text(fmt::format("x,y\n{},1\n", number)).problems.size(), 1U) << number;
}

TEST(CloudMessages, ListAFewAndCountTheRest) {
  std::string text = "x,y,volume\n";
  for (int i = 0; i < 2000; ++i) text += "1,what,1\n";
  auto const problems = read_text(text).problems;
  ASSERT_EQ(problems.size(), 6U);
  EXPECT_EQ(problems.back(), "cloud.csv: 1,995 more such problems");
}

TEST(CloudMessages, SayWhatIsWrongWithNumbers) {
  auto const problems = read_text("x,y,volume,kernel_volume\n0,nan,1,1\n1,0,0,1\n-inf,1,1,1\n3e9,0,1,-2\n").problems;
  EXPECT_TRUE(mentions_each(problems, {{"cloud.csv:2:", "y", "not a number", "finite", "correct the row"},
                                       {"cloud.csv:3:", "volume", "0 m^2", "positive", "correct or remove"},
                                       {"cloud.csv:4:", "x", "-inf m", "finite", "correct the row"},
                                       {"cloud.csv:5:", "x", "3e+09 m", "at most 1e+09 m", "unit"},
                                       {"cloud.csv:5:", "kernel volume", "-2 m^2", "positive", "correct or remove"}}));
}

TEST(CloudMessages, SayWhatIsWrongWithVolumesAndBodies) {
  std::string const points = "x,y\n0,0\n1,0\n0,1\n";
  EXPECT_TRUE(
      mentions_each(read_text(points).problems, {{"cloud.csv:", "no column \"volume\"", "add one", "total volume"}}));
  EXPECT_TRUE(mentions_each(read_text(points, {.total_volume = 0}).problems,
                            {{"cloud.csv:", "total volume", "0", "positive", "correct it"}}));
  EXPECT_TRUE(mentions_each(read_text("x,y,volume\n0,0,1\n1,0,1\n0,1,1\n", {.total_volume = 3}).problems,
                            {{"cloud.csv:", "volumes", "total volume", "leave out one"}}));
  EXPECT_TRUE(mentions_each(read_text(points, {.total_volume = 3, .body = "ball"}).problems,
                            {{"cloud.csv:", "no column \"body\"", "\"ball\"", "add one"}}));
  EXPECT_EQ(read_text("x,y,z\n0,0,0\n1,0,0\n", {.total_volume = 3}).problems,
            Words{"cloud.csv: holds 2 points (at least 4 in 3D) - give more"});
}

TEST(CloudMessages, SayWhichPointsAreTooClose) {
  std::string const square = "x,y\n" + square_rows(5);
  EXPECT_EQ(
      read_text(square + "1,1\n", {.total_volume = 25}).problems,
      Words{"cloud.csv: 1 point is where another one is, first line 8 and line 27 - remove the rows that are there "
            "twice"});
  EXPECT_TRUE(mentions_each(read_text(square + "1.2,1\n", {.total_volume = 25}).problems,
                            {{"cloud.csv:", "2 points", "0.3 of the median distance 1 m", "line 8 and line 27",
                              "200 mm", "spread or remove"}}));
  EXPECT_TRUE(mentions_each(read_text("x,y\n0,0\n1e-200,0\n0,1e-200\n", {.total_volume = 1}).problems,
                            {{"cloud.csv:", "median distance", "0 m", "at least 1e-12 m", "unit"}}));
}

TEST(CloudMessages, SayThatVolumesDoNotFitTheDistances) {
  EXPECT_TRUE(mentions_each(read_text("x,y\n" + square_rows(5), {.total_volume = 25e-6}).problems,
                            {{"cloud.csv:", "volumes", "2.5e-05 m^2 over 25 points", "1 mm", "median distance is 1 m",
                              "0.25 to 2.5 spacings", "units"}}));
}

TEST(CloudMessages, SayWhereNoGradientCanBeFormed) {
  std::string plane = "x,y,z\n";
  for (int i = 0; i < 36; ++i) plane += fmt::format("{},{},{}\n", i % 6, i / 6, i % 6 + 2 * (i / 6));
  EXPECT_EQ(
      read_text(plane, {.total_volume = 36}).problems,
      Words{"cloud.csv: no gradient can be formed at any of the 36 points: in every neighbourhood they lie on one "
            "plane or line - give several layers, or only the columns x and y for a case in 2D"});
  EXPECT_TRUE(mentions_each(read_text("x,y\n0,0\n1,0\n2,0\n3,0\n", {.total_volume = 4}).problems,
                            {{"cloud.csv:", "no gradient", "any of the 4 points", "one line", "spread"}}));
  std::string const stray = "x,y,z,volume\n" + lattice_rows(4) + "20,0,0,1\n";
  EXPECT_TRUE(
      mentions_each(read_text(stray).problems, {{"cloud.csv:", "no gradient", "1 point", "line 66", "eigenvalue",
                                                 "at least 0.02", "2.4 spacings of 1 m", "add points"}}));
}

TEST(CloudMessages, NoteWeakGradients) {
  std::string const text = "x,y\n" + square_rows(8) + "8.5,3\n";
  auto const [cloud, problems] = read_text(text, {.total_volume = 65});
  EXPECT_EQ(problems, Words{});
  EXPECT_TRUE(mentions_each(cloud.notes, {{"cloud.csv:", "gradient is weak", "line 66", "eigenvalue", "0.044"}}));
}

TEST(CloudMessages, NoteUnevenClouds) {
  std::mt19937 engine(3);
  std::string text = "x,y\n";
  auto const shift = [&] { return 0.6 * (static_cast<double>(engine()) / 4294967296.0 - 0.5); };
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i)
      text += fmt::format("{},{}\n", (i < 10 ? i : 10 + 0.8 * (i - 10)) + 0.1 * shift(), j + 0.1 * shift());
  auto const [cloud, problems] = read_text(text, {.total_volume = 400});
  EXPECT_EQ(problems, Words{});
  ASSERT_EQ(cloud.notes.size(), 1U);
  std::string const& note = cloud.notes[0];
  EXPECT_TRUE(note.starts_with("cloud.csv: at ")) << note;
  EXPECT_NE(note.find(" inside, the number density is more than 20 % off ("), std::string::npos) << note;
  EXPECT_TRUE(note.ends_with(" of the even one): a more even cloud is more accurate")) << note;
}

TEST(CloudMessages, NameTheFileThatCannotBeRead) {
  Words problems;
  TemporaryFolder const folder;
  read_cloud((folder / "none.csv").string(), {}, problems);
  read_cloud((folder / "cloud.VTU").string(), {}, problems);
  read_cloud((folder / "none.h5").string(), {}, problems);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_TRUE(mentions(problems[0], {(folder / "none.csv").string() + ": ", "exists", "may read"}));
  EXPECT_TRUE(
      mentions(problems[1], {(folder / "cloud.VTU").string() + ": ", "CSV, HDF5 or a frame", "convert it to CSV"}));
  EXPECT_EQ(problems[2], (folder / "none.h5").string() + ": cannot be read - it is missing, empty or not a file");
}

TEST(CloudChecks, FindTheSameNeighboursAsAComparisonOfAllPairs) {
  std::mt19937 engine(1);
  auto const fraction = [&] { return static_cast<double>(engine()) / 4294967296.0; };
  std::vector<std::array<double, 3>> X;
  for (int i = 0; i < 1500; ++i) {  // dense in one place, sparse in another, and one far away
    double const size = i % 3 == 0 ? 1 : 1e-4;
    X.push_back({size * fraction(), size * fraction(), size * fraction()});
  }
  X.push_back({1e6, 0, 0});
  auto const found = nearest_points(X);
  for (std::size_t i = 0; i < X.size(); ++i) {
    double least = 1e300;
    for (std::size_t j = 0; j < X.size(); ++j)
      if (j != i) least = std::min(least, std::hypot(X[i][0] - X[j][0], X[i][1] - X[j][1], X[i][2] - X[j][2]));
    EXPECT_NEAR(found[i].distance, least, 1e-12 * least) << i;
  }
}

TEST(CloudChecks, SeeAFullNeighbourhoodInsideALattice) {
  auto const [cloud, problems] = read_text("x,y,z,volume\n" + lattice_rows(7));
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.notes, Words{});
  auto const moments = cloud_moments(cloud);
  CloudMoment const middle = moments[3 * 49 + 3 * 7 + 3], corner = moments[0];
  EXPECT_TRUE(middle.inside);
  EXPECT_NEAR(middle.density, 1, 0.02);  // what quadrature on a lattice leaves
  EXPECT_NEAR(middle.least_eigenvalue, 1, 0.03);
  EXPECT_NEAR(middle.mean_eigenvalue, middle.least_eigenvalue, 1e-12);  // cubic symmetry
  EXPECT_FALSE(corner.inside);
  EXPECT_LT(corner.least_eigenvalue, 0.3);
  EXPECT_GT(corner.least_eigenvalue, 0.15);
  // Inside are all but the outer layer.
  EXPECT_EQ(std::count_if(moments.begin(), moments.end(), [](CloudMoment const& m) { return m.inside; }), 125);
}

/// A body of our own as the table that another program would write.
std::string table_of(ShapeSpec const& shape) {
  ParticleSet set;
  set.dimension = shape.dimension;
  fill(shape, "body", set);
  std::string text = shape.dimension == 3 ? "x,y,z,volume,kernel_volume\n" : "x,y,volume,kernel_volume\n";
  for (std::size_t i = 0; i < set.X.size(); ++i) {
    text += fmt::format("{},{},", set.X[i][0], set.X[i][1]);
    if (shape.dimension == 3) text += fmt::format("{},", set.X[i][2]);
    text += fmt::format("{},{}\n", set.volume[i], set.kernel_volume[i]);
  }
  return text;
}

TEST(CloudChecks, AcceptTheBodiesThatPiolaItselfMakes) {
  using Kind = ShapeSpec::Kind;
  using Placement = ShapeSpec::Placement;
  using Arrangement = ShapeSpec::Arrangement;
  std::vector<ShapeSpec> const shapes{
      {.max = {1, 1, 1}, .particles = {2, 2, 2}},
      {.max = {1, 1, 1}, .particles = {2, 2, 2}, .placement = Placement::cell_centred},
      {.max = {8, 2, 2}, .particles = {8, 2, 2}, .placement = Placement::cell_centred},
      {.max = {8, 8, 1}, .particles = {9, 9, 2}},
      {.max = {6, 6, 6}, .particles = {7, 7, 7}, .jitter = 0.2},
      {.max = {6, 6, 6}, .particles = {7, 7, 7}, .random = true},
      {.dimension = 2, .max = {6, 6, 0}, .particles = {9, 9, 1}, .random = true},
      {.kind = Kind::sphere, .radius = 5, .spacing = 1},
      {.kind = Kind::cylinder, .radius = 3, .inner_radius = 2, .length = 9, .spacing = 0.5},
      {.kind = Kind::sphere, .dimension = 2, .radius = 5, .arrangement = Arrangement::rings, .spacing = 0.5},
      {.kind = Kind::sphere, .dimension = 2, .radius = 5, .arrangement = Arrangement::lattice_with_rings, .spacing = 1},
      {.kind = Kind::sphere,
       .dimension = 2,
       .radius = 5,
       .inner_radius = 4,
       .arrangement = Arrangement::rings,
       .spacing = 0.5}};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    auto const [cloud, problems] = read_text(table_of(shapes[k]));
    EXPECT_EQ(problems, Words{}) << k;
    for (std::string const& note : cloud.notes) EXPECT_NE(note.find("the number density"), std::string::npos) << k;
  }
}

TEST(CloudFrame, IsReadBack) {
  TemporaryFolder const folder;
  ParticleSet const set = testing::make_plate(12);
  testing::Springs const springs(set);
  FrameWriter writer(folder.path(), {}, true);
  FieldCache cache(springs, set);
  writer.write(0, cache);
  std::string const path = (folder / "frames/000000.hdf").string();
  Words problems;
  PointCloud const cloud = read_cloud(path, {.body = "0"}, problems);
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.dimension, 2);
  ASSERT_EQ(cloud.X.size(), set.X.size());
  for (std::size_t i = 0; i < set.X.size(); ++i) EXPECT_EQ(cloud.X[i], set.X[i]);
  EXPECT_EQ(cloud.spacing, 1);
  read_cloud(path, {.length_unit = 0.5}, problems);
  read_cloud(path, {.body = "1"}, problems);
  EXPECT_TRUE(mentions_each(
      problems, {{path + ": ", "frame", "in m", "leave it out"}, {path + ": ", "no rows", "\"1\"", "\"0\""}}));
}

TEST(CloudTable, OfAHundredThousandRowsTakesWellUnderASecond) {
  std::string text = "x [mm],y [mm],z [mm],volume [mm^3]\n";
  for (int i = 0; i < 100'000; ++i) text += fmt::format("{}.5,{}.5,{}.5,1\n", i % 50, i / 50 % 50, i / 2500);
  auto const start = std::chrono::steady_clock::now();
  auto const [cloud, problems] = read_text(text);
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(problems, Words{});
  EXPECT_EQ(cloud.X.size(), 100'000U);
  RecordProperty("seconds", fmt::format("{:.2f}", seconds));
  EXPECT_LT(seconds, 10);  // a bound for busy machines and sanitizers; about 0.3 s
}

}  // namespace
}  // namespace piola
