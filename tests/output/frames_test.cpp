// SPDX-License-Identifier: Apache-2.0
#include "piola/output/frames.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/frame_reader.hpp"
#include "piola/output/hdf5.hpp"
#include "support/fake_formulation.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"
#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace piola {
namespace {

using testing::Springs;
using testing::TemporaryFolder;

void write_frames(FrameWriter& writer, ParticleSet const& set, std::vector<double> const& times) {
  Springs const springs(set);
  for (double time : times) {
    FieldCache cache(springs, set);
    writer.write(time, cache);
  }
}

class FramesAsStored : public ::testing::TestWithParam<bool> {};

TEST_P(FramesAsStored, AreReadByAnIndependentProgram) {
  TemporaryFolder const folder;
  ParticleSet const set = testing::make_plate(600);  // more than one chunk
  FrameWriter writer(folder.path(), {}, GetParam());
  write_frames(writer, set, {0.125});
  std::string const script = testing::source_folder() + "/tests/output/read_frame.py";
  int const status = std::system(
      fmt::format("/usr/bin/python3 '{}' '{}' 0.125 {}", script, (folder / "frames/000000.hdf").string(), set.size())
          .c_str());
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "python3-h5py is not installed";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}
INSTANTIATE_TEST_SUITE_P(Frames, FramesAsStored, ::testing::Bool(),
                         [](auto const& compress) { return compress.param ? "Compressed" : "Contiguous"; });

TEST(Frames, AreSmallerWhenCompressed) {
  TemporaryFolder const folder;
  ParticleSet const set = testing::make_plate(100);
  FrameWriter plain(folder / "plain", {}, false), packed(folder / "packed", {}, true);
  write_frames(plain, set, {0});
  write_frames(packed, set, {0});
  EXPECT_LT(2 * std::filesystem::file_size(folder / "packed/frames/000000.hdf"),
            std::filesystem::file_size(folder / "plain/frames/000000.hdf"));
}

TEST(Frames, AreListedInTheIndex) {
  TemporaryFolder const folder;
  FrameWriter writer(folder.path(), {}, true);
  write_frames(writer, testing::make_plate(3), {0, 0.5, 1});
  auto const series = nlohmann::json::parse(testing::text_of(folder / "frames.hdf.series"));
  ASSERT_EQ(series["files"].size(), 3U);
  EXPECT_EQ(series["files"][2]["name"], "frames/000002.hdf");
  EXPECT_EQ(series["files"][2]["time"], 1.0);
}

TEST(Frames, SayThatBodiesAreAxisymmetric) {
  TemporaryFolder const folder;
  ParticleSet set = testing::make_plate(3);
  FrameWriter plane(folder / "plane", {}, true), rings(folder / "rings", {}, true);
  write_frames(plane, set, {0});
  set.axisymmetric = true;
  write_frames(rings, set, {0});
  EXPECT_FALSE(FrameReader(folder / "plane/frames/000000.hdf").axisymmetric());
  EXPECT_TRUE(FrameReader(folder / "rings/frames/000000.hdf").axisymmetric());
}

TEST(Frames, HoldOnlyTheFieldsAskedFor) {
  TemporaryFolder const folder;
  FrameWriter writer(folder.path(), {"Velocity"}, true);
  write_frames(writer, testing::make_plate(3), {0});
  FrameReader const frame(folder / "frames/000000.hdf");
  EXPECT_EQ(frame.fields(), (std::vector<std::string>{"Body", "Id", "Velocity", "Volume"}));
  EXPECT_EQ(frame.info("Velocity").components, 3);
  EXPECT_EQ(frame.info("Velocity").unit, "m/s");
  EXPECT_EQ(frame.dimension(), 2);
  EXPECT_EQ(frame.bodies(), std::vector<int>(9, 0));
  EXPECT_EQ(frame.positions()[4], (std::array{1.0, 1.0, 0.0}));
  EXPECT_TRUE(frame.rigid_poses().empty());
  EXPECT_FLOAT_EQ(frame.values("Velocity")[3 * 3 * 1], 0.1F);  // v_x = 0.1 Y at particle (0, 1)
}

TEST(Frames, AreRemovedWhenTheyComeAfterTheCheckpoint) {
  TemporaryFolder const folder;
  FrameWriter writer(folder.path(), {}, true);
  write_frames(writer, testing::make_plate(3), {0, 0.5, 1});
  writer.continue_after({0, 0.5});
  EXPECT_FALSE(std::filesystem::exists(folder / "frames/000002.hdf"));
  write_frames(writer, testing::make_plate(3), {0.75});
  EXPECT_EQ(list_frames(folder.path()).at(2).first, 0.75);
}

TEST(Frames, NameTheFieldsThereAreWhenOneIsMissing) {
  TemporaryFolder const folder;
  FrameWriter writer(folder.path(), {}, true);
  write_frames(writer, testing::make_plate(3), {0});
  try {
    FrameReader(folder / "frames/000000.hdf").info("Presure");
    FAIL();
  } catch (InputError const& error) {
    EXPECT_NE(std::string(error.what()).find("has no field 'Presure' (it has Body, CauchyStress,"), std::string::npos)
        << error.what();
  }
}

TEST(Frames, GiveTheCompressivePressureOfThePressureTheyHold) {
  TemporaryFolder const folder;
  FrameWriter writer(folder.path(), {}, true);
  write_frames(writer, testing::make_plate(3), {0});
  FrameReader const frame(folder / "frames/000000.hdf");
  EXPECT_EQ(frame.info("CompressivePressure").name, "CompressivePressure");
  EXPECT_EQ(frame.info("CompressivePressure").unit, "Pa");
  auto const stored = frame.values("Pressure"), made = frame.values("CompressivePressure");
  ASSERT_EQ(made.size(), stored.size());
  for (std::size_t i = 0; i < made.size(); ++i) EXPECT_EQ(made[i], -stored[i]);
  hdf5::Reader const file(folder / "frames/000000.hdf");
  EXPECT_EQ(file.text("/VTKHDF/PointData/Pressure", "sign"), "tension positive");
  EXPECT_FALSE(file.has_attribute("/VTKHDF/PointData/VonMisesStress", "sign"));
}

/// Springs with a field that had another name in the previous release.
class OldSprings : public Springs {
 public:
  using Springs::Springs;
  std::vector<FieldInfo> fields() const override {
    auto all = Springs::fields();
    all.push_back({"LeastJacobian", "1", 1});
    return all;
  }
};

TEST(Frames, OfThePreviousReleaseHaveFieldsOfPresentNames) {
  TemporaryFolder const folder;
  FrameWriter writer(folder.path(), {}, true);
  ParticleSet const set = testing::make_plate(3);
  OldSprings const springs(set);
  FieldCache cache(springs, set);
  writer.write(0, cache);
  FrameReader const frame(folder / "frames/000000.hdf");
  EXPECT_TRUE(frame.knows("CellJacobianMin"));
  auto const fields = frame.fields();
  EXPECT_EQ(std::count(fields.begin(), fields.end(), "CellJacobianMin"), 1);
  EXPECT_EQ(std::count(fields.begin(), fields.end(), "LeastJacobian"), 0);
  EXPECT_EQ(frame.info("CellJacobianMin").name, "CellJacobianMin");
  EXPECT_EQ(frame.info("CellJacobianMin").components, 1);
  EXPECT_EQ(frame.values("CellJacobianMin").size(), 9U);
}

/// Springs beside a rigid shape that turns.
class SpringsWithStone : public Springs {
 public:
  using Springs::Springs;
  std::vector<RigidState> rigids() const override {
    return {{.name = "stone", .centre = {1, 2, 3}, .turn = {0, 0, 0.1}}};
  }
};

TEST(Frames, HoldThePosesOfShapesThatTurn) {
  TemporaryFolder const folder;
  FrameWriter writer(folder.path(), {}, true);
  ParticleSet const set = testing::make_plate(3);
  SpringsWithStone const springs(set);
  FieldCache cache(springs, set);
  writer.write(0, cache);
  EXPECT_EQ(FrameReader(folder / "frames/000000.hdf").rigid_poses(), (std::vector<double>{1, 2, 3, 0, 0, 0.1}));
}

/// In a child, because the limit cannot be lifted again. Exit status 0: as it should be.
int write_beyond_the_limit(std::filesystem::path const& folder) {
  std::signal(SIGXFSZ, SIG_IGN);
  ParticleSet const small = testing::make_plate(3), large = testing::make_plate(200);
  FrameWriter writer(folder, {}, false);
  write_frames(writer, small, {0});
  std::string const before = testing::text_of(folder / "frames/000000.hdf");
  rlimit const limit{100000, 100000};
  setrlimit(RLIMIT_FSIZE, &limit);
  try {
    write_frames(writer, large, {1});
    return 1;
  } catch (FileError const& error) {
    std::string const text = error.what();
    if (text.find("000001.hdf: cannot be written, File too large - ") == std::string::npos) return 2;
  }
  if (testing::text_of(folder / "frames/000000.hdf") != before) return 3;
  if (std::filesystem::exists(folder / "frames/000001.hdf") ||
      std::filesystem::exists(folder / "frames/000001.hdf.part"))
    return 4;
  return list_frames(folder).size() == 1 ? 0 : 5;
}

TEST(Frames, StayIntactWhenTheNextDoesNotFitOnTheDisk) {
  TemporaryFolder const folder;
  pid_t const child = fork();
  if (child == 0) ::_exit(write_beyond_the_limit(folder.path()));
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Files, SayWhyAFolderCannotBeWritten) {
  try {
    write_whole_file("/proc/piola/file", std::string_view("text"));
    FAIL();
  } catch (FileError const& error) {
    EXPECT_STREQ(error.what(),
                 "/proc/piola/file: cannot be written, No such file or directory - give another folder with --out; "
                 "what was written before is intact");
  }
  EXPECT_THROW(make_folder("/proc/piola"), FileError);
}

TEST(Files, AreNotReadBeyondWhatIsAllowed) {
  TemporaryFolder const folder;
  std::ofstream(folder / "a") << "12345";
  EXPECT_EQ(read_text_file(folder / "a", 5), "12345");
  EXPECT_THROW(read_text_file(folder / "a", 4), FileError);
  EXPECT_THROW(read_text_file("/dev/zero", 1'000'000), FileError);
}

TEST(Files, SayThatTheDiskIsFull) {
  std::string const text = write_error_text("results/frames/000003.hdf", ENOSPC);
  EXPECT_EQ(text,
            "results/frames/000003.hdf: cannot be written, No space left on device - free some space or give another "
            "folder with --out; what was written before is intact");
}

}  // namespace
}  // namespace piola
