// SPDX-License-Identifier: Apache-2.0
#include "streams.hpp"
#include "piola/base/controls.hpp"
#include "commands.hpp"
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <system_error>
#include <unistd.h>

namespace piola::app {
namespace {

int out_error = 0;  // the first error of standard output
bool silent = false;

/// Writes the whole text; returns 0 or the errno of the failure. Waits for a non-blocking descriptor for at most
/// `timeout` [ms] (-1: no limit).
int write_all(int descriptor, std::string_view text, int timeout) {
  while (!text.empty()) {
    ::ssize_t const written = ::write(descriptor, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    int const error = errno;
    if (error == EINTR) continue;
    if (error != EAGAIN) return error;
    pollfd ready{.fd = descriptor, .events = POLLOUT, .revents = 0};
    if (::poll(&ready, 1, timeout) == 0) return error;
  }
  return 0;
}

}  // namespace

void secure_streams() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number is this one. The wrong direction makes every use of it an error, as on a closed one.
    int const opened = ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    if (opened > STDERR_FILENO) ::close(opened);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void set_quiet(bool quiet) { silent = quiet; }

void write_out(std::string_view text) {
  if (silent) return;
  int const error = write_all(STDOUT_FILENO, without_controls(text), -1);
  if (out_error == 0) out_error = error;
}

void clear_terminal() {
  if (!silent) write_all(STDOUT_FILENO, "\x1b[H\x1b[2J", -1);
}

void write_err(std::string_view text) {
  constexpr int timeout = 1000;
  if (silent) return;
  write_all(STDERR_FILENO, without_controls(text), timeout);
}

int with_output(int code) {
  if (out_error == 0) return code;
  if (out_error != EPIPE)
    print_message("piola: standard output: cannot be written, {} - give it a file or a terminal with room\n",
                  std::generic_category().message(out_error));
  return code == completed ? internal_error : code;
}

}  // namespace piola::app
