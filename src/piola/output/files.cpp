// SPDX-License-Identifier: Apache-2.0
#include "piola/output/files.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/text.hpp"
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

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
  /// Closes now and says whether that went well (a network disk may report a full disk only here).
  bool close() {
    int const fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

/// Returns 0 or the errno of the first failure.
int write_and_sync(std::filesystem::path const& path, std::span<std::byte const> content, std::string_view end) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) return errno;
  for (auto part : {content, std::as_bytes(std::span(end.data(), end.size()))}) {
    while (!part.empty()) {
      ::ssize_t const written = ::write(file.get(), part.data(), part.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      part = part.subspan(static_cast<std::size_t>(written));
    }
  }
  if (::fsync(file.get()) != 0) return errno;
  return file.close() ? 0 : errno;
}

/// Makes the rename itself durable; a file system that cannot sync a folder is not an error.
void sync_folder(std::filesystem::path const& folder) {
  Descriptor const handle(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.get() >= 0) ::fsync(handle.get());
}

}  // namespace

std::string cannot_write(std::filesystem::path const& path, int error) {
  return fmt::format("{}: cannot be written, {} - {}", path.string(), std::generic_category().message(error),
                     advice(error));
}

void write_whole_file(std::filesystem::path const& path, std::span<std::byte const> content, std::string_view end) {
  std::filesystem::path part = path;
  part += ".part";
  int error = write_and_sync(part, content, end);
  if (error == 0 && ::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(part.c_str());
    throw FileError(cannot_write(path, error));
  }
  sync_folder(path.parent_path());
}

void write_whole_file(std::filesystem::path const& path, std::string_view content) {
  write_whole_file(path, std::as_bytes(std::span(content.data(), content.size())));
}

bool overwrite_end(std::filesystem::path const& path, std::uint64_t size, std::uint64_t old_end,
                   std::string_view text) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  struct stat now {};
  if (file.get() < 0 || ::fstat(file.get(), &now) != 0 || static_cast<std::uint64_t>(now.st_size) != size) return false;
  auto const from = static_cast<::off_t>(size - old_end);
  std::string before(old_end, '\0');
  if (::pread(file.get(), before.data(), old_end, from) != static_cast<::ssize_t>(old_end)) return false;
  ::ssize_t const written = ::pwrite(file.get(), text.data(), text.size(), from);
  if (written == static_cast<::ssize_t>(text.size()) && ::fdatasync(file.get()) == 0) return true;
  int const error = written < 0 ? errno : written < static_cast<::ssize_t>(text.size()) ? ENOSPC : errno;
  // The bytes of before have their place on the disk.
  bool const restored = ::pwrite(file.get(), before.data(), old_end, from) == static_cast<::ssize_t>(old_end) &&
                        ::ftruncate(file.get(), static_cast<::off_t>(size)) == 0;
  throw FileError(cannot_write(path, error) + (restored ? "" : " (its end is torn)"));
}

std::string read_text_file(std::filesystem::path const& path, std::uint64_t most) {
  constexpr std::size_t block = std::size_t{1} << 16;
  std::ifstream in(path, std::ios::binary);
  std::string text;
  while (in && text.size() <= most) {
    std::size_t const before = text.size();
    text.resize(before + block);
    in.read(text.data() + before, block);
    text.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (!in.is_open() || in.bad()) {
    throw FileError(
        fmt::format("{}: cannot be read - check that the file exists and that you may read it", path.string()));
  }
  if (text.size() > most) {
    throw FileError(fmt::format("{}: holds more than {} - is this the right file?", path.string(),
                                size_text(static_cast<double>(most))));
  }
  return text;
}

void make_folder(std::filesystem::path const& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw FileError(cannot_write(path, error.value()));
}

}  // namespace piola
