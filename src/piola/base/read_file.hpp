// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace piola {

/// A regular file, opened to read. Folders, pipes, sockets and devices are refused when they are opened: reading them
/// may block or never end. Links are followed. Not thread-safe.
class FileToRead {
 public:
  explicit FileToRead(std::filesystem::path const& path);
  FileToRead(FileToRead const&) = delete;
  FileToRead& operator=(FileToRead const&) = delete;
  ~FileToRead();

  /// Why nothing (more) can be read, "is a pipe (a regular file is needed) - ..."; empty if all is well.
  std::string const& problem() const { return problem_; }
  std::uint64_t size() const { return size_; }  ///< bytes, when the file was opened; 0 with a problem
  /// Reads the next bytes and returns how many; fewer than asked for only at the end of the file or with a problem.
  std::size_t read(std::span<char> bytes);

 private:
  int fd_ = -1;
  std::uint64_t size_ = 0;
  std::string problem_;
};

inline constexpr std::uint64_t most_text_bytes = 4'000'000'000;  ///< of a text file

/// Returns the whole content of a text file. Throws FileError if it is no regular file, cannot be read or holds more
/// than `most` bytes; no more than that is read.
std::string read_text_file(std::filesystem::path const& path, std::uint64_t most = most_text_bytes);

/// read_text_file() of a file that the user names. Throws InputError.
std::string read_input_file(std::filesystem::path const& path, std::uint64_t most = most_text_bytes);

}  // namespace piola
