// SPDX-License-Identifier: Apache-2.0
#include "piola/output/hdf5.hpp"
#include "piola/base/problems.hpp"
#include "piola/output/deflate.hpp"
#include "piola/output/hdf5_driver.hpp"
#include "piola/output/hdf5_types.hpp"
#include "piola/output/seal.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace piola::hdf5 {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1}
                                    << 20;  // large enough to compress well, small enough to share among threads

void check(herr_t result, std::string_view what) {
  if (result < 0)
    throw FileError(fmt::format("HDF5 cannot make {} - this is a defect of the program, please report it", what));
}

/// Compresses all chunks in threads, then hands them to HDF5 in order.
void write_chunks(hid_t dataset, std::span<std::byte const> bytes, std::size_t row_bytes, std::size_t chunk_rows,
                  std::size_t width) {
  auto const chunks = deflate_chunks(bytes, row_bytes * chunk_rows, width);
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    std::array<hsize_t, 2> const offset{k * chunk_rows, 0};
    check(H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, offset.data(), chunks[k].size(), chunks[k].data()), "a chunk");
  }
}

}  // namespace

Handle::Handle(hid_t id, Close close, std::string_view what) : id_(id), close_(close) {
  if (id < 0)
    throw FileError(
        fmt::format("HDF5 cannot make or open {} - this is a defect of the program, please report it", what));
}

struct Writer::Parts {
  explicit Parts(std::filesystem::path path) : disk(std::move(path)), file(create_on(disk)) {}
  /// What all that comes is put into. Throws FileError if something before could not be written.
  hid_t id() const {
    disk.on_disk.demand_written();
    return file->id();
  }
  GrowingFile disk;
  std::optional<Handle> file;
};

Writer::Writer(std::filesystem::path path) : parts_(std::make_unique<Parts>(std::move(path))) {}

Writer::~Writer() = default;

void Writer::group(std::string const& path) {
  Handle const links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "a property list");
  check(H5Pset_create_intermediate_group(links.id(), 1), path);
  Handle const made(H5Gcreate2(parts_->id(), path.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
}

template <class T>
void Writer::dataset(std::string const& path, std::span<T const> values, int columns, Storage storage) {
  auto const width = static_cast<std::size_t>(columns);
  std::array<hsize_t, 2> const shape{values.size() / width, width};
  int const rank = columns > 1 ? 2 : 1;
  Handle const space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose, path);
  Handle const layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path);
  std::size_t const chunk_rows =
      std::clamp<std::size_t>(chunk_bytes / (sizeof(T) * width), 1, std::max<std::size_t>(shape[0], 1));
  check(H5Pset_obj_track_times(layout.id(), false), path);  // the same data give the same file
  bool const compress = storage == Storage::compressed && shape[0] > 1;
  if (compress) {
    std::array<hsize_t, 2> const chunk{chunk_rows, width};
    check(H5Pset_chunk(layout.id(), rank, chunk.data()), path);
    check(H5Pset_shuffle(layout.id()), path);
    check(H5Pset_deflate(layout.id(), 1), path);
    check(H5Pset_fill_time(layout.id(), H5D_FILL_TIME_NEVER), path);
  }
  hid_t const type = native_type<T>();
  Handle const set(H5Dcreate2(parts_->id(), path.c_str(), type, space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
                   H5Dclose, path);
  if (values.empty()) return;
  if (compress) {
    write_chunks(set.id(), std::as_bytes(values), sizeof(T) * width, chunk_rows, sizeof(T));
  } else {
    check(H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
  }
}
template void Writer::dataset(std::string const&, std::span<float const>, int, Storage);
template void Writer::dataset(std::string const&, std::span<double const>, int, Storage);
template void Writer::dataset(std::string const&, std::span<std::int64_t const>, int, Storage);
template void Writer::dataset(std::string const&, std::span<std::int32_t const>, int, Storage);
template void Writer::dataset(std::string const&, std::span<std::uint8_t const>, int, Storage);
template void Writer::dataset(std::string const&, std::span<char const>, int, Storage);

void Writer::attribute(std::string const& object, std::string const& name, std::string_view text) {
  // VTK wants a plain ASCII string of fixed length.
  Handle const type(H5Tcopy(H5T_C_S1), H5Tclose, name);
  check(H5Tset_size(type.id(), std::max<std::size_t>(text.size(), 1)), name);
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), name);
  Handle const space(H5Screate(H5S_SCALAR), H5Sclose, name);
  Handle const owner(H5Oopen(parts_->id(), object.c_str(), H5P_DEFAULT), H5Oclose, object);
  Handle const made(H5Acreate2(owner.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                    name);
  std::string const padded = text.empty() ? std::string(1, '\0') : std::string(text);
  check(H5Awrite(made.id(), type.id(), padded.data()), name);
}

void Writer::attribute(std::string const& object, std::string const& name, std::span<std::int64_t const> values) {
  hsize_t const count = values.size();
  Handle const space(H5Screate_simple(1, &count, nullptr), H5Sclose, name);
  Handle const owner(H5Oopen(parts_->id(), object.c_str(), H5P_DEFAULT), H5Oclose, object);
  Handle const made(H5Acreate2(owner.id(), name.c_str(), H5T_STD_I64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                    name);
  check(H5Awrite(made.id(), H5T_NATIVE_INT64, values.data()), name);
}

void Writer::attribute(std::string const& object, std::string const& name, double value) {
  Handle const space(H5Screate(H5S_SCALAR), H5Sclose, name);
  Handle const owner(H5Oopen(parts_->id(), object.c_str(), H5P_DEFAULT), H5Oclose, object);
  Handle const made(H5Acreate2(owner.id(), name.c_str(), H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose, name);
  check(H5Awrite(made.id(), H5T_NATIVE_DOUBLE, &value), name);
}

void Writer::finish() {
  check(H5Fflush(parts_->id(), H5F_SCOPE_GLOBAL), "the file");
  parts_->file.reset();
  GrowingFile& disk = parts_->disk;
  disk.on_disk.demand_written();
  CheckSum sum;
  std::vector<std::byte> some;
  for (std::uint64_t at = 0; at < disk.bytes; at += some.size()) {
    some.resize(static_cast<std::size_t>(std::min<std::uint64_t>(chunk_bytes, disk.bytes - at)));
    disk.on_disk.read(at, some);
    sum.add(some);
  }
  disk.on_disk.finish(disk.bytes, seal_of(sum, disk.bytes));
}

}  // namespace piola::hdf5
