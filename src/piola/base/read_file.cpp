// SPDX-License-Identifier: Apache-2.0
#include "piola/base/read_file.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace piola {
namespace {

std::string kind_of(::mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder";
  if (S_ISFIFO(mode)) return "is a pipe";
  if (S_ISSOCK(mode)) return "is a socket";
  return "is a device";
}

constexpr char const* unreadable = "cannot be read - check that the file exists and that you may read it";

/// The content, or what is wrong.
std::string content_of_file(std::filesystem::path const& path, std::uint64_t most, std::string& problem) {
  constexpr std::size_t block = std::size_t{1} << 16;
  FileToRead file(path);
  std::string text;
  text.reserve(static_cast<std::size_t>(std::min(file.size(), most)) + block);
  for (std::size_t got = block; got == block && text.size() <= most;) {
    std::size_t const before = text.size();
    text.resize(before + block);
    got = file.read(std::span(text).subspan(before));
    text.resize(before + got);
  }
  problem = file.problem();
  if (problem.empty() && text.size() > most)
    problem = "holds more than " + size_text(static_cast<double>(most)) + " - is this the right file?";
  return text;
}

}  // namespace

FileToRead::FileToRead(std::filesystem::path const& path)
    // Without O_NONBLOCK, opening a pipe blocks until a process opens it to write.
    : fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  struct stat found {};
  if (fd_ < 0 || ::fstat(fd_, &found) != 0)
    problem_ = errno == ENXIO ? "is a socket (a regular file is needed) - name a file" : unreadable;
  else if (!S_ISREG(found.st_mode))
    problem_ = kind_of(found.st_mode) + " (a regular file is needed) - " +
               (S_ISDIR(found.st_mode) ? "name a file in it" : "write its content to a file and name that");
  else
    size_ = static_cast<std::uint64_t>(found.st_size);
}

FileToRead::~FileToRead() {
  if (fd_ >= 0) ::close(fd_);
}

std::size_t FileToRead::read(std::span<char> bytes) {
  PIOLA_EXPECTS(fd_ >= 0 || !problem_.empty());
  std::size_t done = 0;
  while (problem_.empty() && done < bytes.size()) {
    ::ssize_t const got = ::read(fd_, bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) problem_ = unreadable;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string read_text_file(std::filesystem::path const& path, std::uint64_t most) {
  std::string problem;
  std::string text = content_of_file(path, most, problem);
  if (!problem.empty()) throw FileError(path.string() + ": " + problem);
  return text;
}

std::string read_input_file(std::filesystem::path const& path, std::uint64_t most) {
  std::string problem;
  std::string text = content_of_file(path, most, problem);
  if (!problem.empty()) throw InputError(path.string() + ": " + problem);
  return text;
}

}  // namespace piola
