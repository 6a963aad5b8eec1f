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

/// How a file of a results folder is opened: `replace` makes a new one in its place, `append` and
/// `change` need it to exist.
enum class Opening { replace, append, change };

/// Opens a file of a results folder to write: the only way to do so. A link at the end of the path is never followed:
/// `replace` removes it, the others refuse it. A file with several names (hard links) is copied before it is changed.
/// Returns a descriptor that the caller closes. Throws FileError.
int open_result(std::filesystem::path const& path, Opening how);

/// A stream of open_result(). Null if there is no memory for one.
using ResultFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
ResultFile open_result_file(std::filesystem::path const& path, Opening how);

/// Whether the open file is still the one with that name.
bool still_there(int fd, std::filesystem::path const& path);

/// A file of which a reader sees either the old content or all of the new one: it is "PATH.part" until finish(), and is
/// removed if that is never called or fails. Other files are untouched.
class NewFile {
 public:
  /// Throws FileError with path, reason and advice if it cannot be made.
  explicit NewFile(std::filesystem::path path);
  NewFile(NewFile const&) = delete;
  NewFile& operator=(NewFile const&) = delete;
  ~NewFile();

  /// Never throws: the first failure is kept, what comes after it is not written.
  void write(std::uint64_t at, std::span<std::byte const> bytes) noexcept;
  /// Zeros where nothing has been written.
  void read(std::uint64_t at, std::span<std::byte> bytes) const noexcept;
  /// Throws FileError if something could not be written so far.
  void demand_written() const;
  /// Where it stands until it has its name.
  std::filesystem::path const& part() const { return part_; }
  std::filesystem::path const& path() const { return path_; }
  /// Gives the file this end behind its `bytes` first ones, syncs it to the disk and gives it its name. Throws
  /// FileError with path, reason and advice.
  void finish(std::uint64_t bytes, std::string_view end = {});

 private:
  void remove() noexcept;
  std::filesystem::path path_, part_;
  int fd_ = -1;
  int error_ = 0;  ///< errno of the first failure
};

/// A NewFile of another process, to write to beside it, or a file to read.
class JoinedFile {
 public:
  /// `number` is that of the file there; see number(). Nothing can be written if it is another one, or none.
  enum class To { write, read };
  JoinedFile(std::filesystem::path const& path, std::uint64_t number, To to = To::write);
  JoinedFile(JoinedFile const&) = delete;
  JoinedFile& operator=(JoinedFile const&) = delete;
  ~JoinedFile() { close(); }
  /// What tells a file from others of its name on other machines; 0 if there is none.
  static std::uint64_t number(std::filesystem::path const& path);
  bool is_open() const { return fd_ >= 0; }
  /// Never throws: the first failure is kept, what comes after it is not written.
  void write(std::uint64_t at, std::span<std::byte const> bytes) noexcept;
  /// Returns whether all of them could be read.
  bool read(std::uint64_t at, std::span<std::byte> bytes) const noexcept;
  /// All is on the disk afterwards; the errno of the first failure, or 0.
  int close() noexcept;

 private:
  int fd_ = -1, error_ = 0;
  To to_;
};

/// Writes a file as a whole, as NewFile. Throws FileError with path, reason and advice. `end` follows the content.
void write_whole_file(std::filesystem::path const& path, std::span<std::byte const> content, std::string_view end = {});
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
std::string cannot_write(std::filesystem::path const& path, int error);

}  // namespace piola
