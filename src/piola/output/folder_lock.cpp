// SPDX-License-Identifier: Apache-2.0
#include "piola/output/folder_lock.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include <array>
#include <cerrno>
#include <ctime>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace piola {
namespace {

/// Content of the lock file: "process 1234 on host 'node7' since 2026-01-31 12:00:00".
std::string holder_text() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host = {'?'};
  return fmt::format("process {} on host '{}' since {:%Y-%m-%d %H:%M:%S}", ::getpid(), host.data(),
                     fmt::localtime(std::time(nullptr)));
}

constexpr char const* no_holder = "another process";

std::string holder_of(int descriptor) {
  std::array<char, 400> text{};
  ::ssize_t const count = ::pread(descriptor, text.data(), text.size(), 0);
  std::string const holder(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  return holder.starts_with("process ") ? holder.substr(0, holder.find('\n')) : no_holder;
}

/// Whether the open file may be overwritten: a regular file with one name, empty or with the text of a lock.
bool is_lock_file(int descriptor) {
  struct stat found {};
  return ::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && found.st_nlink <= 1 &&
         (found.st_size == 0 || holder_of(descriptor) != no_holder);
}

}  // namespace

FolderLock::FolderLock(std::filesystem::path const& folder) : file_(folder / lock_name) {
  while (!take()) {
  }
  if (!held_) return;
  std::string const text = holder_text() + "\n";
  bool const written = ::ftruncate(descriptor_, 0) == 0 &&
                       ::pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<::ssize_t>(text.size());
  if (!written) {
    int const error = errno;
    ::close(descriptor_);
    throw FileError(write_error_text(file_, error));
  }
}

/// Returns false if the file was removed between opening and locking it.
bool FolderLock::take() {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw FileError(write_error_text(file_, errno));
  if (!is_lock_file(descriptor_)) {
    ::close(std::exchange(descriptor_, -1));
    throw InputError(
        fmt::format("{}: is not a lock of Piola (a results folder has no other file of this name) - "
                    "remove or rename it, or give another folder with --out",
                    file_.string()));
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
    held_ = still_there(descriptor_, file_);
    if (!held_) ::close(descriptor_);
    return held_;
  }
  bool const taken = errno == EWOULDBLOCK;
  std::string const holder = taken ? holder_of(descriptor_) : "";
  ::close(descriptor_);
  descriptor_ = -1;
  if (!taken) return true;
  throw InputError(
      fmt::format("{}: is in use by {} (allowed: one run at a time in a folder) - wait until it ends, stop it, or use "
                  "another folder",
                  file_.parent_path().string(), holder));
}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());  // while it is still locked, so that no other process holds it
  ::close(descriptor_);
}

}  // namespace piola
