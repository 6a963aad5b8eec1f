// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/dataset_storage.hpp"
#include <cstdint>
#include <filesystem>
#include <hdf5.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A thin, owning layer over the C interface of HDF5. Included by output/*.cpp only.
namespace piola::hdf5 {

/// Owns one HDF5 identifier.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  /// Throws FileError that names `what` if the identifier is not valid.
  Handle(hid_t id, Close close, std::string_view what);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(Handle const&) = delete;
  Handle& operator=(Handle const&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

WrittenPart part_of(std::uint64_t at, std::span<std::byte const> bytes);

/// Rows per compressed chunk of a table with `rows` rows and `columns` columns of values of `bytes` bytes.
std::uint64_t chunk_rows(std::uint64_t rows, int columns, std::size_t bytes);

/// Writes a file, which gets its name in finish(). Write errors are not reported to HDF5 (hdf5_driver.hpp), so that a
/// full disk causes a FileError with a clear reason instead of an error inside the library. Data sets are not buffered
/// in memory.
class Writer {
 public:
  /// This and all other members except put_at() throw FileError if the file cannot be written.
  explicit Writer(std::filesystem::path path);
  Writer(Writer const&) = delete;
  Writer& operator=(Writer const&) = delete;
  ~Writer();
  /// Creates a group and its parents; "/" exists already.
  void group(std::string const& path);
  /// values[row * columns + c]; columns = 1 gives a one-dimensional data set.
  template <class T>
  void dataset(std::string const& path, std::span<T const> values, int columns = 1);
  void attribute(std::string const& object, std::string const& name, std::string_view text);
  void attribute(std::string const& object, std::string const& name, std::span<std::int64_t const> values);
  void attribute(std::string const& object, std::string const& name, double value);
  /// Creates a contiguous data set without writing its values. Returns the file offset of the first value.
  template <class T>
  std::uint64_t reserve(std::string const& path, std::uint64_t rows, int columns);
  /// Creates a data set in chunks of chunk_rows() rows without writing them. bytes: deflated size of each chunk.
  /// Returns the file offset of each chunk.
  template <class T>
  std::vector<std::uint64_t> reserve_chunks(std::string const& path, std::uint64_t rows, int columns,
                                            std::span<std::uint64_t const> bytes);
  /// Writes values at a reserved offset. Never throws; finish() throws if the write has failed.
  void put_at(std::uint64_t at, std::span<std::byte const> bytes);
  /// Adds the check sum of bytes that another process has written.
  void note(WrittenPart part);
  /// Path of the file until finish().
  std::filesystem::path const& part() const;
  std::filesystem::path const& path() const;
  /// Appends the checksum trailer and renames the file. Nothing can be written afterwards.
  void finish();

 private:
  Handle make_dataset(std::string const& path, hid_t type, std::uint64_t rows, int columns, std::uint64_t chunk,
                      bool early);
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Reads a file. The whole file is verified by its checksum trailer before HDF5 opens it. Kind, shape and size of an
/// object are checked before its values are read. A missing object, or one of another kind, throws FileError with path
/// and name.
class Reader {
 public:
  explicit Reader(std::filesystem::path const& path);
  /// Opens a file without a checksum trailer, for files of other programs, whose texts may have any length. HDF5 may
  /// crash or hang on a damaged file: call only in a child process.
  static Reader unsealed(std::filesystem::path const& path);
  bool has(std::string const& path) const;
  std::vector<std::string> names(std::string const& group) const;  ///< members, sorted
  /// Numbers per row of a data set: 1 if it has one dimension.
  std::uint64_t columns(std::string const& dataset) const;
  /// Rows, and columns if it has two dimensions, of a data set of numbers; empty for any other object.
  std::vector<std::uint64_t> shape_of_numbers(std::string const& path) const;
  bool has_attribute(std::string const& object, std::string const& name) const;
  /// All numbers of a data set with this many columns and any number of rows, row by row. Integers may be read as
  /// floating-point numbers, not the reverse.
  template <class T>
  std::vector<T> dataset(std::string const& path, std::uint64_t columns = 1) const;
  /// File offset of a list of doubles that is stored contiguously; nothing otherwise.
  std::optional<std::uint64_t> place_of_doubles(std::string const& path) const;
  std::string text(std::string const& object, std::string const& name) const;
  double number(std::string const& object, std::string const& name) const;
  std::int64_t integer(std::string const& object, std::string const& name) const;
  std::filesystem::path const& path() const { return path_; }

  /// Throws FileError: "PATH: 'what' why - the file is damaged or was written by another program".
  [[noreturn]] void fail(std::string_view what, std::string_view why) const;

 private:
  Reader(std::filesystem::path const& path, Handle file, bool sealed);
  Handle open_dataset(std::string const& path) const;
  Handle open_attribute(std::string const& object, std::string const& name) const;
  std::vector<std::uint64_t> shape(hid_t dataset, std::string const& path) const;
  std::string text_of_any_length(hid_t attribute, hid_t type, std::string const& object, std::string const& name) const;
  template <class T>
  T single(std::string const& object, std::string const& name) const;
  std::filesystem::path path_;
  std::uintmax_t bytes_ = 0;  ///< of the file
  bool sealed_ = true;        ///< written by us: texts have a fixed length
  Handle file_;
};

}  // namespace piola::hdf5
