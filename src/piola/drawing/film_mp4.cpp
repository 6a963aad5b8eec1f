// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/drawing/film_encoders.hpp"
#include "piola/output/atomic_file.hpp"
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace piola {
namespace {

/// Where the program is found; empty if it is not there.
std::filesystem::path program_ffmpeg() {
  char const* const folders = std::getenv("PATH");
  std::string list = folders ? folders : "";
  while (!list.empty()) {
    std::size_t const end = std::min(list.find(':'), list.size());
    std::filesystem::path const program = std::filesystem::path(list.substr(0, end)) / "ffmpeg";
    if (end > 0 && access(program.c_str(), X_OK) == 0) return program;
    list.erase(0, end + 1);
  }
  return {};
}

/// Runs the encoder as a child process, which reads pictures from a socket; a closed socket shows that it has ended.
/// Its output file is renamed at the end; its error messages go to a file next to it.
class Mp4Encoder : public Film::Encoder {
 public:
  Mp4Encoder(std::filesystem::path const& path, std::filesystem::path const& program, int width, int height,
             FilmPace const& pace)
      : path_(path),
        part_(path.parent_path() / (".part-" + path.filename().string())),
        error_log_(part_.string() + ".log"),
        pace_(pace) {
    std::vector<std::string> words{
        program.string(), "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
        fmt::format("{}x{}", width, height), "-r", fmt::format("{}", pace.pictures_per_second), "-i", "-", "-vf",
        // H.264 requires even sizes in this pixel format, the only one that all players support.
        "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18",
        "-movflags", "+faststart", "-bitexact", "-f", "mp4", part_.string()};
    start(words);
  }
  ~Mp4Encoder() override {
    if (socket_ >= 0) close(socket_);
    if (child_ > 0) wait_for_it();
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    std::filesystem::remove(error_log_, ignored);
  }
  Mp4Encoder(Mp4Encoder const&) = delete;
  Mp4Encoder& operator=(Mp4Encoder const&) = delete;

  void add(Image const& picture) override {
    last_ = picture;
    send_all(picture);
  }

  void finish() override {
    auto const more = std::lround(pace_.hold_end * pace_.pictures_per_second);
    for (long k = 0; k < more && !last_.rgb.empty(); ++k) send_all(last_);
    close(socket_);
    socket_ = -1;
    if (wait_for_it() != 0) fail();
    std::error_code error;
    std::filesystem::rename(part_, path_, error);
    if (error)
      throw FileError(fmt::format("{}: cannot be written ({}) - check the folder", path_.string(), error.message()));
  }

 private:
  void start(std::vector<std::string>& words) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail();
    socket_ = ends[0];
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    close(open_result(part_, Opening::replace));  // removes a link of that name instead of following it
    int const error_output = open_result(error_log_, Opening::replace);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, error_output, 2);
    int const error = posix_spawn(&child_, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    close(error_output);
    if (error != 0) child_ = -1;
    if (error != 0) fail();
  }

  void send_all(Image const& picture) {
    std::size_t sent = 0;
    while (sent < picture.rgb.size()) {
      auto const n = send(socket_, picture.rgb.data() + sent, picture.rgb.size() - sent, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail();
      sent += static_cast<std::size_t>(n);
    }
  }

  /// Its exit status; -1 if it was killed.
  int wait_for_it() {
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[noreturn]] void fail() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
    if (child_ > 0) wait_for_it();
    std::string said = std::filesystem::exists(error_log_) ? read_text_file(error_log_) : "";
    said.resize(std::min({said.find('\n'), said.size(), std::size_t{300}}));
    throw FileError(fmt::format("{}: ffmpeg did not make it ({}) - check the folder and the space, or make a .webp",
                                path_.string(), said.empty() ? "it says nothing" : said));
  }

  std::filesystem::path path_, part_, error_log_;
  FilmPace pace_;
  Image last_;
  pid_t child_ = -1;
  int socket_ = -1;
};

}  // namespace

std::unique_ptr<Film::Encoder> make_mp4(std::filesystem::path const& path, int width, int height,
                                        FilmPace const& pace) {
  auto const program = program_ffmpeg();
  if (program.empty())
    throw InputError(
        fmt::format("{}: films of this kind need the program ffmpeg, which is not there - install it "
                    "(Debian: apt-get install ffmpeg), or make a .webp",
                    path.string()));
  return std::make_unique<Mp4Encoder>(path, program, width, height, pace);
}

}  // namespace piola
