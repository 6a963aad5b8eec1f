// SPDX-License-Identifier: Apache-2.0
#include "piola/output/atomic_file.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace piola {
namespace {

std::string advice(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT: return "free some space or give another folder with --out; what was written before is intact";
    case EFBIG: return "raise the limit of the file size (ulimit -f); what was written before is intact";
    case EACCES:
    case EPERM:
    case EROFS: return "give a folder that you may write to with --out";
    case ELOOP: return "a link stands there, and results are never written through links: remove it";
    case ENOTDIR: return "a file stands where a folder is needed; give another folder with --out";
    default: return "give another folder with --out; what was written before is intact";
  }
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// Makes the rename itself durable; a file system that cannot sync a folder is not an error.
void sync_folder(std::filesystem::path const& folder) {
  Descriptor const handle(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.get() >= 0) ::fsync(handle.get());
}

/// Nothing if there has been an error already.
void write_at(int fd, std::uint64_t at, std::span<std::byte const> bytes, int& error) {
  while (!bytes.empty() && error == 0) {
    ::ssize_t const written = ::pwrite(fd, bytes.data(), bytes.size(), static_cast<::off_t>(at));
    if (written < 0 && errno != EINTR) error = errno;
    if (written <= 0) continue;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
}

/// Returns what is left to read at the end of the file, or at an error.
std::span<std::byte> read_at(int fd, std::uint64_t at, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    ::ssize_t const had = ::pread(fd, bytes.data(), bytes.size(), static_cast<::off_t>(at));
    if (had < 0 && errno == EINTR) continue;
    if (had <= 0) break;
    bytes = bytes.subspan(static_cast<std::size_t>(had));
    at += static_cast<std::uint64_t>(had);
  }
  return bytes;
}

/// Whether it is a regular file without another name.
bool is_ours_alone(int fd) {
  struct stat found {};
  return ::fstat(fd, &found) == 0 && S_ISREG(found.st_mode) && found.st_nlink <= 1;
}

}  // namespace

std::string write_error_text(std::filesystem::path const& path, int error) {
  return fmt::format("{}: cannot be written, {} - {}", path.string(), std::generic_category().message(error),
                     advice(error));
}

namespace {

/// -1 and errno if it cannot be opened.
int try_to_open(std::filesystem::path const& path, Opening how) {
  int const flags = how == Opening::replace  ? O_RDWR | O_CREAT | O_EXCL
                    : how == Opening::append ? O_WRONLY | O_APPEND
                                             : O_RDWR;
  if (how == Opening::replace) ::unlink(path.c_str());
  return ::open(path.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
}

}  // namespace

std::string was_removed(std::filesystem::path const& path) {
  return fmt::format("{}: cannot be written, it was removed while the run went on - run the case again", path.string());
}

int open_result(std::filesystem::path const& path, Opening how) {
  PIOLA_EXPECTS(!path.empty());
  int fd = try_to_open(path, how);
  if (fd < 0 && errno == ENOENT && how != Opening::replace) throw FileError(was_removed(path));
  if (fd < 0) throw FileError(write_error_text(path, errno));
  if (how == Opening::replace || is_ours_alone(fd)) return fd;
  ::close(fd);
  write_whole_file(path, read_text_file(path));  // other names of the file keep what they have
  fd = try_to_open(path, how);
  if (fd < 0) throw FileError(write_error_text(path, errno));
  return fd;
}

ResultFile open_result_file(std::filesystem::path const& path, Opening how) {
  int const fd = open_result(path, how);
  return {::fdopen(fd, how == Opening::append ? "a" : "w"), &std::fclose};
}

bool still_there(int fd, std::filesystem::path const& path) {
  PIOLA_EXPECTS(fd >= 0);
  struct stat opened {};
  struct stat named {};
  return ::fstat(fd, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  fd_ = try_to_open(part_, Opening::replace);
  if (fd_ < 0) throw FileError(write_error_text(path_, errno));
}

AtomicFile::~AtomicFile() { remove(); }

void AtomicFile::remove() noexcept {
  if (fd_ < 0) return;
  ::close(std::exchange(fd_, -1));
  ::unlink(part_.c_str());
}

void AtomicFile::write(std::uint64_t at, std::span<std::byte const> bytes) noexcept {
  write_at(fd_, at, bytes, error_);
}

void AtomicFile::read(std::uint64_t at, std::span<std::byte> bytes) const noexcept {
  bytes = read_at(fd_, at, bytes);
  std::fill(bytes.begin(), bytes.end(), std::byte{0});
}

void AtomicFile::throw_if_failed() const {
  if (error_ != 0) throw FileError(write_error_text(path_, error_));
}

void AtomicFile::finish(std::uint64_t bytes, std::string_view end) {
  PIOLA_EXPECTS(fd_ >= 0);
  write(bytes, std::as_bytes(std::span(end.data(), end.size())));
  if (error_ == 0 && ::fsync(fd_) != 0) error_ = errno;
  throw_if_failed();
  // A network disk may report a full disk only here.
  if (::close(std::exchange(fd_, -1)) != 0 || ::rename(part_.c_str(), path_.c_str()) != 0) {
    error_ = errno;
    ::unlink(part_.c_str());
  }
  throw_if_failed();
  sync_folder(path_.parent_path());
}

std::uint64_t SharedFile::number(std::filesystem::path const& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 ? static_cast<std::uint64_t>(found.st_ino) : 0;
}

SharedFile::SharedFile(std::filesystem::path const& path, std::uint64_t number, To to)
    : fd_(::open(path.c_str(), (to == To::write ? O_WRONLY | O_NOFOLLOW : O_RDONLY) | O_CLOEXEC)), to_(to) {
  struct stat found {};
  if (fd_ < 0 || (::fstat(fd_, &found) == 0 && static_cast<std::uint64_t>(found.st_ino) == number)) return;
  ::close(std::exchange(fd_, -1));
}

void SharedFile::write(std::uint64_t at, std::span<std::byte const> bytes) noexcept {
  write_at(fd_, at, bytes, error_);
}

bool SharedFile::read(std::uint64_t at, std::span<std::byte> bytes) const noexcept {
  return read_at(fd_, at, bytes).empty();
}

int SharedFile::close() noexcept {
  if (fd_ < 0) return error_;
  if (to_ == To::write && error_ == 0 && ::fsync(fd_) != 0) error_ = errno;
  if (::close(std::exchange(fd_, -1)) != 0 && error_ == 0) error_ = errno;
  return error_;
}

void write_whole_file(std::filesystem::path const& path, std::span<std::byte const> content) {
  AtomicFile file(path);
  file.write(0, content);
  file.finish(content.size());
}

void write_whole_file(std::filesystem::path const& path, std::string_view content) {
  write_whole_file(path, std::as_bytes(std::span(content.data(), content.size())));
}

bool overwrite_end(std::filesystem::path const& path, std::uint64_t size, std::uint64_t old_end,
                   std::string_view text) {
  PIOLA_EXPECTS(old_end <= size);
  Descriptor file(::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat now {};
  if (file.get() < 0 || !is_ours_alone(file.get()) || ::fstat(file.get(), &now) != 0 ||
      static_cast<std::uint64_t>(now.st_size) != size)
    return false;
  auto const from = static_cast<::off_t>(size - old_end);
  std::string before(old_end, '\0');
  if (::pread(file.get(), before.data(), old_end, from) != static_cast<::ssize_t>(old_end)) return false;
  ::ssize_t const written = ::pwrite(file.get(), text.data(), text.size(), from);
  if (written == static_cast<::ssize_t>(text.size()) && ::fdatasync(file.get()) == 0) return true;
  int const error = written < 0 ? errno : written < static_cast<::ssize_t>(text.size()) ? ENOSPC : errno;
  // The bytes of before have their place on the disk.
  bool const restored = ::pwrite(file.get(), before.data(), old_end, from) == static_cast<::ssize_t>(old_end) &&
                        ::ftruncate(file.get(), static_cast<::off_t>(size)) == 0;
  throw FileError(write_error_text(path, error) + (restored ? "" : " (its end is torn)"));
}

void make_folder(std::filesystem::path const& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw FileError(write_error_text(path, error.value()));
}

}  // namespace piola
