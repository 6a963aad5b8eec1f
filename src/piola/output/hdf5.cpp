// SPDX-License-Identifier: Apache-2.0
#include "piola/output/hdf5.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/checksum_trailer.hpp"
#include "piola/output/hdf5_driver.hpp"
#include "piola/output/hdf5_types.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace piola::hdf5 {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1}
                                    << 20;  // large enough to compress well, small enough to share among threads

void check(herr_t result, std::string_view what) {
  if (result < 0)
    throw FileError(fmt::format("HDF5 cannot make {} - this is a defect of the program, please report it", what));
}

}  // namespace

Handle::Handle(hid_t id, Close close, std::string_view what) : id_(id), close_(close) {
  if (id < 0)
    throw FileError(
        fmt::format("HDF5 cannot make or open {} - this is a defect of the program, please report it", what));
}

struct Writer::Parts {
  explicit Parts(std::filesystem::path path) : disk(std::move(path)), file(create_on(disk)) {}
  /// Identifier of the open file. Throws FileError if an earlier write has failed.
  hid_t id() const {
    PIOLA_EXPECTS(file.has_value());
    disk.on_disk.throw_if_failed();
    return file->id();
  }
  /// Bytes of HDF5's own.
  void add_from_disk(CheckSum& sum, std::uint64_t from, std::uint64_t to) const {
    std::vector<std::byte> some;
    for (std::uint64_t at = from; at < to; at += some.size()) {
      some.resize(static_cast<std::size_t>(std::min<std::uint64_t>(chunk_bytes, to - at)));
      disk.on_disk.read(at, some);
      sum.add(some);
    }
  }
  AppendOnlyFile disk;
  std::optional<Handle> file;
  std::map<std::uint64_t, WrittenPart> written;  ///< of what was reserved
};

Writer::Writer(std::filesystem::path path) : parts_(std::make_unique<Parts>(std::move(path))) {}

Writer::~Writer() = default;

void Writer::group(std::string const& path) {
  PIOLA_EXPECTS(!path.empty());
  Handle const links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "a property list");
  check(H5Pset_create_intermediate_group(links.id(), 1), path);
  Handle const made(H5Gcreate2(parts_->id(), path.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
}

WrittenPart part_of(std::uint64_t at, std::span<std::byte const> bytes) {
  CheckSum sum;
  sum.add(bytes);
  return {at, bytes.size(), sum.value()};
}

std::uint64_t chunk_rows(std::uint64_t rows, int columns, std::size_t bytes) {
  PIOLA_EXPECTS(columns >= 1 && bytes > 0);
  std::uint64_t const row = bytes * static_cast<std::uint64_t>(columns);
  return std::clamp<std::uint64_t>(chunk_bytes / row, 1, std::max<std::uint64_t>(rows, 1));
}

/// An empty data set. `early`: its place in the file is known at once; `chunk`: rows that are compressed together, or
/// 0.
Handle Writer::make_dataset(std::string const& path, hid_t type, std::uint64_t rows, int columns, std::uint64_t chunk,
                            bool early) {
  std::array<hsize_t, 2> const shape{rows, static_cast<hsize_t>(columns)};
  int const dimensions = columns > 1 ? 2 : 1;
  Handle const space(H5Screate_simple(dimensions, shape.data(), nullptr), H5Sclose, path);
  Handle const layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path);
  check(H5Pset_obj_track_times(layout.id(), false), path);  // the same data give the same file
  if (chunk > 0) {
    std::array<hsize_t, 2> const extent{chunk, shape[1]};
    check(H5Pset_chunk(layout.id(), dimensions, extent.data()), path);
    check(H5Pset_shuffle(layout.id()), path);
    check(H5Pset_deflate(layout.id(), 1), path);
  }
  if (chunk > 0 || early) check(H5Pset_fill_time(layout.id(), H5D_FILL_TIME_NEVER), path);
  if (early) check(H5Pset_alloc_time(layout.id(), H5D_ALLOC_TIME_EARLY), path);
  return {H5Dcreate2(parts_->id(), path.c_str(), type, space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT), H5Dclose,
          path};
}

template <class T>
void Writer::dataset(std::string const& path, std::span<T const> values, int columns) {
  PIOLA_EXPECTS(columns >= 1 && values.size() % static_cast<std::size_t>(columns) == 0);
  hid_t const type = native_type<T>();
  Handle const set = make_dataset(path, type, values.size() / static_cast<std::size_t>(columns), columns, 0, false);
  if (!values.empty()) check(H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
}

template <class T>
std::uint64_t Writer::reserve(std::string const& path, std::uint64_t rows, int columns) {
  PIOLA_EXPECTS(columns >= 1);
  Handle const set = make_dataset(path, native_type<T>(), rows, columns, 0, true);
  return rows == 0 ? 0 : H5Dget_offset(set.id());
}

template <class T>
std::vector<std::uint64_t> Writer::reserve_chunks(std::string const& path, std::uint64_t rows, int columns,
                                                  std::span<std::uint64_t const> bytes) {
  PIOLA_EXPECTS(columns >= 1);
  std::uint64_t const chunk = chunk_rows(rows, columns, sizeof(T));
  Handle const set = make_dataset(path, native_type<T>(), rows, columns, chunk, false);
  // HDF5 allocates a chunk when it is written. In reserving mode the driver records the offset instead of writing.
  std::vector<std::byte> const nothing(bytes.empty() ? 0 : *std::max_element(bytes.begin(), bytes.end()));
  std::vector<std::uint64_t> places;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::array<hsize_t, 2> const offset{k * chunk, 0};
    parts_->disk.reserving = true;
    herr_t const made = H5Dwrite_chunk(set.id(), H5P_DEFAULT, 0, offset.data(), bytes[k], nothing.data());
    parts_->disk.reserving = false;
    check(made, "a chunk");
    places.push_back(parts_->disk.reserved);
  }
  return places;
}

void Writer::put_at(std::uint64_t at, std::span<std::byte const> bytes) {
  parts_->disk.on_disk.write(at, bytes);
  note(part_of(at, bytes));
}

void Writer::note(WrittenPart part) {
  if (part.bytes > 0) parts_->written.emplace(part.at, part);
}

std::filesystem::path const& Writer::part() const { return parts_->disk.on_disk.part(); }
std::filesystem::path const& Writer::path() const { return parts_->disk.on_disk.path(); }

template std::uint64_t Writer::reserve<float>(std::string const&, std::uint64_t, int);
template std::uint64_t Writer::reserve<double>(std::string const&, std::uint64_t, int);
template std::uint64_t Writer::reserve<std::int64_t>(std::string const&, std::uint64_t, int);
template std::uint64_t Writer::reserve<std::uint8_t>(std::string const&, std::uint64_t, int);
using Sizes = std::span<std::uint64_t const>;
using Places = std::vector<std::uint64_t>;
template Places Writer::reserve_chunks<float>(std::string const&, std::uint64_t, int, Sizes);
template Places Writer::reserve_chunks<double>(std::string const&, std::uint64_t, int, Sizes);
template Places Writer::reserve_chunks<std::int64_t>(std::string const&, std::uint64_t, int, Sizes);
template Places Writer::reserve_chunks<std::uint8_t>(std::string const&, std::uint64_t, int, Sizes);
template void Writer::dataset(std::string const&, std::span<float const>, int);
template void Writer::dataset(std::string const&, std::span<double const>, int);
template void Writer::dataset(std::string const&, std::span<std::int64_t const>, int);
template void Writer::dataset(std::string const&, std::span<std::int32_t const>, int);
template void Writer::dataset(std::string const&, std::span<std::uint8_t const>, int);
template void Writer::dataset(std::string const&, std::span<char const>, int);

void Writer::attribute(std::string const& object, std::string const& name, std::string_view text) {
  PIOLA_EXPECTS(!name.empty());
  // VTK requires a plain ASCII string of fixed length.
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
  PIOLA_EXPECTS(!name.empty());
  hsize_t const count = values.size();
  Handle const space(H5Screate_simple(1, &count, nullptr), H5Sclose, name);
  Handle const owner(H5Oopen(parts_->id(), object.c_str(), H5P_DEFAULT), H5Oclose, object);
  Handle const made(H5Acreate2(owner.id(), name.c_str(), H5T_STD_I64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                    name);
  check(H5Awrite(made.id(), H5T_NATIVE_INT64, values.data()), name);
}

void Writer::attribute(std::string const& object, std::string const& name, double value) {
  PIOLA_EXPECTS(!name.empty());
  Handle const space(H5Screate(H5S_SCALAR), H5Sclose, name);
  Handle const owner(H5Oopen(parts_->id(), object.c_str(), H5P_DEFAULT), H5Oclose, object);
  Handle const made(H5Acreate2(owner.id(), name.c_str(), H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose, name);
  check(H5Awrite(made.id(), H5T_NATIVE_DOUBLE, &value), name);
}

void Writer::finish() {
  PIOLA_EXPECTS(parts_->file.has_value());
  check(H5Fflush(parts_->id(), H5F_SCOPE_GLOBAL), "the file");
  parts_->file.reset();
  AppendOnlyFile& disk = parts_->disk;
  disk.on_disk.throw_if_failed();
  CheckSum sum;
  std::uint64_t at = 0;
  for (auto const& [start, part] : parts_->written) {
    parts_->add_from_disk(sum, at, start);
    sum.add(part.check_sum, part.bytes);
    at = start + part.bytes;
  }
  parts_->add_from_disk(sum, at, disk.bytes);
  disk.on_disk.finish(disk.bytes, checksum_trailer_of(sum, disk.bytes));
}

}  // namespace piola::hdf5
