// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/read_file.hpp"
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// How a file of a results folder is opened: `replace` creates a new file; `append` and `change` require an existing
/// one.
enum class Opening { replace, append, change };

/// Opens a file of a results folder for writing; all such files are opened here. A link at the end of the path is never
/// followed: `replace` removes it, `append` and `change` refuse it. A file with several names (hard links) is copied
/// before it is changed. Returns a descriptor that the caller closes. Throws FileError.
int open_result(std::filesystem::path const& path, Opening how);

/// A stream of open_result(). Null if there is no memory for one.
using ResultFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
ResultFile open_result_file(std::filesystem::path const& path, Opening how);

/// Whether the open file is still the one with that name.
bool still_there(int fd, std::filesystem::path const& path);

/// Replaces a file atomically: readers see the old content or all of the new one. The file is "PATH.part" until
/// finish(), and is removed if finish() fails or is never called.
class AtomicFile {
 public:
  /// Throws FileError with path, reason and advice if it cannot be made.
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(AtomicFile const&) = delete;
  AtomicFile& operator=(AtomicFile const&) = delete;
  ~AtomicFile();

  /// Never throws. The first failure is stored; later data are not written.
  void write(std::uint64_t at, std::span<std::byte const> bytes) noexcept;
  /// Reads bytes; zeros where nothing has been written.
  void read(std::uint64_t at, std::span<std::byte> bytes) const noexcept;
  /// Throws FileError if a write has failed.
  void throw_if_failed() const;
  /// Path of the file until finish().
  std::filesystem::path const& part() const { return part_; }
  std::filesystem::path const& path() const { return path_; }
  /// Truncates the file to `bytes`, appends `end`, syncs it to the disk and renames it to path(). Throws FileError with
  /// path, reason and advice.
  void finish(std::uint64_t bytes, std::string_view end = {});

 private:
  void remove() noexcept;
  std::filesystem::path path_, part_;
  int fd_ = -1;
  int error_ = 0;  ///< errno of the first failure
};

/// An AtomicFile that another process has created, for concurrent writing, or a file to read.
class SharedFile {
 public:
  /// `number`: identity of the file on the creating process, see number(). The file is not opened if the local one
  /// differs or is missing.
  enum class To { write, read };
  SharedFile(std::filesystem::path const& path, std::uint64_t number, To to = To::write);
  SharedFile(SharedFile const&) = delete;
  SharedFile& operator=(SharedFile const&) = delete;
  ~SharedFile() { close(); }
  /// Identity of a file, to distinguish it from files of the same name on other machines; 0 if there is no file.
  static std::uint64_t number(std::filesystem::path const& path);
  bool is_open() const { return fd_ >= 0; }
  /// Never throws. The first failure is stored; later data are not written.
  void write(std::uint64_t at, std::span<std::byte const> bytes) noexcept;
  /// Returns whether all bytes could be read.
  bool read(std::uint64_t at, std::span<std::byte> bytes) const noexcept;
  /// Syncs to the disk and closes. Returns the errno of the first failure, or 0.
  int close() noexcept;

 private:
  int fd_ = -1, error_ = 0;
  To to_;
};

/// Writes a file as a whole, as AtomicFile. Throws FileError with path, reason and advice.
void write_whole_file(std::filesystem::path const& path, std::span<std::byte const> content);
void write_whole_file(std::filesystem::path const& path, std::string_view content);

/// Replaces the last `old_end` bytes of a file of `size` bytes by a longer text, in one write, and waits until it is on
/// the disk. Returns false, with nothing changed, if there is no file of that size. Throws FileError if it cannot be
/// written; the file is then as before.
bool overwrite_end(std::filesystem::path const& path, std::uint64_t size, std::uint64_t old_end, std::string_view text);

/// Makes a folder with its parents. Throws FileError if that is impossible.
void make_folder(std::filesystem::path const& path);

/// The sentence for a file that is gone although this run wrote it.
std::string was_removed(std::filesystem::path const& path);

/// The sentence of every failed write: "PATH: cannot be written, REASON - what to do". `error` is an errno.
std::string write_error_text(std::filesystem::path const& path, int error);

}  // namespace piola
