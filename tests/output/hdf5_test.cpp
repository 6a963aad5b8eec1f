// SPDX-License-Identifier: Apache-2.0
// Files that are sealed but hold something else than the reader asks for, as another program could write them.
#include "piola/output/hdf5.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/checksum_trailer.hpp"
#include "piola/output/collective_table_writer.hpp"
#include "piola/output/frame_reader.hpp"
#include "piola/output/frames.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace piola {
namespace {

using hdf5::Handle;

void seal_file(std::filesystem::path const& path) {
  std::string const text = testing::text_of(path);
  CheckSum sum;
  sum.add(text);
  std::ofstream(path, std::ios::binary | std::ios::app) << checksum_trailer_of(sum, text.size());
}

/// A file made with the library itself; `fill` writes what it likes.
void make_file(std::filesystem::path const& path, std::function<void(hid_t)> const& fill) {
  {
    Handle const file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "a file");
    fill(file.id());
  }
  seal_file(path);
}

void put_attribute(hid_t file, char const* name, hid_t type, std::vector<hsize_t> const& shape, void const* values) {
  Handle const space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, name);
  Handle const made(H5Acreate2(file, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  if (values != nullptr) H5Awrite(made.id(), type, values);
}

void put_dataset(hid_t file, char const* name, hid_t type, std::vector<hsize_t> const& shape, void const* values) {
  Handle const space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, name);
  Handle const made(H5Dcreate2(file, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, name);
  if (values != nullptr) H5Dwrite(made.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

/// The message of a FileError; "" if there is none.
std::string complaint_of(std::function<void()> const& action) {
  try {
    action();
  } catch (FileError const& error) {
    return error.what();
  }
  return "";
}

#define EXPECT_COMPLAINT(action, part)                                     \
  {                                                                        \
    std::string const said = complaint_of([&] { action; });                \
    EXPECT_NE(said.find(part), std::string::npos) << #action ": " << said; \
  }

/// In a child, because of the limit. Exit status 0: as it should be.
int write_under_every_limit(std::filesystem::path const& path) {
  std::signal(SIGXFSZ, SIG_IGN);
  std::vector<double> const values(5000, 1.5);
  auto const write = [&] {
    hdf5::Writer file(path);
    file.group("/state");
    for (char const* name : {"/state/a", "/state/b"}) file.dataset<double>(name, values);
    CollectiveTableWriter rows(&file);
    rows.put<double>("/state/c", {.count = 1000, .columns = 5}, values, hdf5::Storage::compressed);
    rows.put<double>("/state/d", {.count = 5000}, values, hdf5::Storage::sequence);
    rows.end();
    file.attribute("/state/a", "name", "a");
    file.finish();
  };
  write();
  std::string const before = testing::text_of(path);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  for (limit.rlim_cur = 0; limit.rlim_cur < before.size(); limit.rlim_cur += 1 + limit.rlim_cur / 3) {
    setrlimit(RLIMIT_FSIZE, &limit);
    std::string const said = complaint_of(write);
    if (said.find("cannot be written, File too large - raise the limit") == std::string::npos) return 1;
    if (std::filesystem::exists(path.string() + ".part") || testing::text_of(path) != before) return 2;
  }
  limit.rlim_cur = before.size();
  setrlimit(RLIMIT_FSIZE, &limit);
  write();
  return testing::text_of(path) == before ? 0 : 3;
}

TEST(Hdf5Writer, LeavesWhatWasThereWhereverTheDiskIsFull) {
  testing::TemporaryFolder const folder;
  pid_t const child = fork();
  if (child == 0) ::_exit(write_under_every_limit(folder / "file.h5"));
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(hdf5::Reader(folder / "file.h5").dataset<double>("/state/c", 5), std::vector<double>(5000, 1.5));
}

TEST(CheckSum, OfPartsIsThatOfTheWhole) {
  std::string text;
  for (int k = 0; k < 1000; ++k) text += static_cast<char>(k * k % 251);
  CheckSum whole;
  whole.add(text);
  for (std::size_t const cut : {0UL, 1UL, 7UL, 512UL, 999UL, 1000UL}) {
    CheckSum sum, second;
    sum.add(std::string_view(text).substr(0, cut));
    second.add(std::string_view(text).substr(cut));
    sum.add(second.value(), text.size() - cut);
    EXPECT_EQ(sum.value(), whole.value()) << cut;
  }
}

TEST(Hdf5Writer, LeavesNothingOfAFileThatIsNotFinished) {
  testing::TemporaryFolder const folder;
  hdf5::Writer(folder / "file.h5").group("/state");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Hdf5Reader, ReadsNoAttributeThatIsAnArrayOrOfAnotherKind) {
  testing::TemporaryFolder const folder;
  std::vector<double> const many(4000, 7);
  char const* const pointer = "text of variable length";
  double const real = 1.5;
  make_file(folder / "a.h5", [&](hid_t file) {
    put_attribute(file, "array", H5T_NATIVE_DOUBLE, {4000}, many.data());
    put_attribute(file, "nothing", H5T_NATIVE_DOUBLE, {0}, nullptr);
    put_attribute(file, "real", H5T_NATIVE_DOUBLE, {1}, &real);
    Handle const text(H5Tcopy(H5T_C_S1), H5Tclose, "a type");
    H5Tset_size(text.id(), H5T_VARIABLE);
    put_attribute(file, "pointer", text.id(), {1}, &pointer);
    hsize_t const width = 500;
    Handle const inner(H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &width), H5Tclose, "a type");
    put_attribute(file, "array type", inner.id(), {1}, many.data());
  });
  hdf5::Reader const reader(folder / "a.h5");
  EXPECT_EQ(reader.number("/", "real"), 1.5);
  EXPECT_COMPLAINT(reader.number("/", "array"), "'array' of / is not a single value");
  EXPECT_COMPLAINT(reader.number("/", "nothing"), "'nothing' of / is not a single value");
  EXPECT_COMPLAINT(reader.number("/", "array type"), "no number of the expected kind");
  EXPECT_COMPLAINT(reader.number("/", "pointer"), "no number of the expected kind");
  EXPECT_COMPLAINT(reader.number("/", "absent"), "'absent' of / is missing");
  EXPECT_COMPLAINT(reader.number("/absent", "real"), "is missing");
  EXPECT_COMPLAINT(reader.integer("/", "real"), "no number of the expected kind");
  EXPECT_COMPLAINT(reader.text("/", "pointer"), "no text of fixed length");
  EXPECT_COMPLAINT(reader.text("/", "real"), "no text of fixed length");
}

TEST(Hdf5Reader, ReadsNoDataSetOfAnotherShapeOrKind) {
  testing::TemporaryFolder const folder;
  std::vector<double> const values(12, 3);
  make_file(folder / "a.h5", [&](hid_t file) {
    put_dataset(file, "list", H5T_NATIVE_DOUBLE, {12}, values.data());
    put_dataset(file, "table", H5T_NATIVE_DOUBLE, {4, 3}, values.data());
    put_dataset(file, "block", H5T_NATIVE_DOUBLE, {2, 2, 3}, values.data());
    put_dataset(file, "empty rows", H5T_NATIVE_DOUBLE, {5, 0}, nullptr);
    put_dataset(file, "endless", H5T_NATIVE_DOUBLE, {std::uint64_t{1} << 40}, nullptr);
    put_dataset(file, "overflow", H5T_NATIVE_DOUBLE, {std::uint64_t{1} << 40, 3}, nullptr);
    put_dataset(file, "text", H5T_C_S1, {12}, "twelve bytes");
    Handle const group(H5Gcreate2(file, "group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "group");
  });
  hdf5::Reader const reader(folder / "a.h5");
  EXPECT_EQ(reader.dataset<double>("/list"), values);
  EXPECT_EQ(reader.dataset<float>("/table", 3).size(), 12U);
  EXPECT_EQ(reader.columns("/empty rows"), 0U);
  EXPECT_COMPLAINT(reader.dataset<double>("/table"), "'/table' has not 1 number per row");
  EXPECT_COMPLAINT(reader.dataset<double>("/list", 3), "has not 3 numbers per row");
  EXPECT_COMPLAINT(reader.dataset<double>("/block"), "neither a list nor a table");
  EXPECT_COMPLAINT(reader.dataset<double>("/endless"), "claims more numbers than the file can hold");
  EXPECT_COMPLAINT(reader.dataset<double>("/overflow", 3), "claims more numbers than the file can hold");
  EXPECT_COMPLAINT(reader.dataset<std::int64_t>("/list"), "does not hold numbers of the expected kind");
  EXPECT_COMPLAINT(reader.dataset<char>("/text"), "does not hold numbers of the expected kind");
  EXPECT_COMPLAINT(reader.dataset<double>("/group"), "is missing or no data set");
  EXPECT_COMPLAINT(reader.dataset<double>("/absent/deep"), "is missing or no data set");
  EXPECT_COMPLAINT(reader.names("/list"), "is missing or no group");
}

TEST(Hdf5Reader, OpensNothingThatIsNotSealed) {
  testing::TemporaryFolder const folder;
  make_file(folder / "a.h5", [](hid_t) {});
  EXPECT_EQ(complaint_of([&] { hdf5::Reader{folder / "a.h5"}; }), "");
  std::filesystem::resize_file(folder / "a.h5",
                               std::filesystem::file_size(folder / "a.h5") - checksum_trailer_of({}, 0).size());
  EXPECT_COMPLAINT(hdf5::Reader{folder / "a.h5"}, "does not end with its check sum");
  EXPECT_COMPLAINT(hdf5::Reader{folder / "absent.h5"}, "cannot be read");
  EXPECT_COMPLAINT(hdf5::Reader{folder.path()}, "cannot be read");
  std::ofstream(folder / "b.h5") << "text";
  seal_file(folder / "b.h5");
  EXPECT_COMPLAINT(hdf5::Reader{folder / "b.h5"}, "is no HDF5 file");
}

/// A good frame, then `change` makes it a strange one.
std::string complaint_of_frame(std::filesystem::path const& folder, std::function<void(hid_t)> const& change) {
  ParticleSet const set = testing::make_plate(3);
  testing::Springs const springs(set);
  FrameWriter writer(folder, {}, false);
  FieldCache cache(springs, set);
  writer.write(0, cache);
  auto const path = folder / "frames/000000.hdf";
  std::string const text = testing::text_of(path);
  std::ofstream(path, std::ios::binary) << text.substr(0, text.size() - checksum_trailer_of({}, 0).size());
  {
    Handle const file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "the frame");
    change(file.id());
  }
  seal_file(path);
  return complaint_of([&] {
    FrameReader const frame(path);
    frame.values("Pressure");
    frame.volumes();
  });
}

void replace_dataset(hid_t file, char const* name, hid_t type, std::vector<hsize_t> const& shape) {
  H5Ldelete(file, name, H5P_DEFAULT);
  put_dataset(file, name, type, shape, nullptr);
}

TEST(Frames, AreRefusedWhereTheirShapesDoNotFitTogether) {
  testing::TemporaryFolder const folder;
  auto const said = [&](std::function<void(hid_t)> const& change) { return complaint_of_frame(folder.path(), change); };
  EXPECT_EQ(said([](hid_t) {}), "");
  EXPECT_NE(said([](hid_t file) {
              H5Adelete(file, "dimension");
              std::int64_t const strange = 99;
              put_attribute(file, "dimension", H5T_NATIVE_INT64, {1}, &strange);
            }).find("'dimension' is 99 (1, 2 or 3 is known)"),
            std::string::npos);
  EXPECT_NE(said([](hid_t file) {
              replace_dataset(file, "/VTKHDF/PointData/Pressure", H5T_NATIVE_FLOAT, {9, 0});
            }).find("has 0 components"),
            std::string::npos);
  EXPECT_NE(said([](hid_t file) {
              replace_dataset(file, "/VTKHDF/Points", H5T_NATIVE_FLOAT, {9, 2});
            }).find("'/VTKHDF/Points' has not 3 numbers per row"),
            std::string::npos);
  EXPECT_NE(said([](hid_t file) {
              replace_dataset(file, "/VTKHDF/PointData/Volume", H5T_NATIVE_FLOAT, {8});
            }).find("'Volume' has not one value per point"),
            std::string::npos);
  EXPECT_NE(said([](hid_t file) {
              replace_dataset(file, "/VTKHDF/FieldData/TimeValue", H5T_NATIVE_DOUBLE, {0});
            }).find("is not a single time"),
            std::string::npos);
}

}  // namespace
}  // namespace piola
