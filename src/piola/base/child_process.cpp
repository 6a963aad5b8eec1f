// SPDX-License-Identifier: Apache-2.0
#include "piola/base/child_process.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <poll.h>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PIOLA_CHILD_UNLIMITED  // sanitizers reserve terabytes
#endif
#endif

namespace piola {

namespace {

constexpr char good_end = '+';

/// Body of the child process: silent, with limited resources. One character at the end marks a complete answer.
[[noreturn]] void answer_and_end(std::function<std::string()> const& work, int pipe, std::size_t memory) {
  int const nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  for (int const signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTERM}) std::signal(signal, SIG_DFL);
  std::signal(SIGPIPE, SIG_IGN);
  rlimit const no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
#ifndef PIOLA_CHILD_UNLIMITED
  std::array<std::uint64_t, 6> pages{};  // the sixth: data and stack
  std::ifstream statm("/proc/self/statm");
  for (auto& count : pages) statm >> count;
  rlim_t const data = pages[5] * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + memory;
  rlimit const limit{data, data};
  ::setrlimit(RLIMIT_DATA, &limit);
#else
  static_cast<void>(memory);
#endif
  try {
    std::string answer = work();
    answer += good_end;
    std::string_view left = answer;
    while (!left.empty()) {
      auto const written = ::write(pipe, left.data(), left.size());
      if (written < 0 && errno != EINTR) break;
      if (written > 0) left.remove_prefix(static_cast<std::size_t>(written));
    }
  } catch (std::exception const&) {  // no memory, most likely: the answer stays without its end
  }
  ::_exit(0);
}

/// Appends what comes until the other side closes the pipe; false: too late.
bool collect(int pipe, double seconds, std::string& bytes) {
  using Clock = std::chrono::steady_clock;
  auto const end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  std::array<char, 65536> buffer{};
  for (;;) {
    auto const left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd wait{pipe, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(left)) <= 0) continue;  // interrupted or too late: decided by the clock
    auto const count = ::read(pipe, buffer.data(), buffer.size());
    if (count == 0) return true;
    if (count > 0) bytes.append(buffer.data(), static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) return true;
  }
}

}  // namespace

ChildAnswer run_in_child_process(std::function<std::string()> const& work, ChildLimits const& limits) {
  PIOLA_EXPECTS(work != nullptr);
  PIOLA_EXPECTS(limits.seconds > 0 && std::isfinite(limits.seconds));
  ChildAnswer answer;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return {{}, "could not be started: too many open files"};
  pid_t const child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    answer_and_end(work, ends[1], limits.memory);
  }
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return {{}, "could not be started: too many processes or too little memory"};
  }
  bool const in_time = collect(ends[0], limits.seconds, answer.bytes);
  if (!in_time) ::kill(child, SIGKILL);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  bool const whole = in_time && !answer.bytes.empty() && answer.bytes.back() == good_end;
  if (whole && WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    answer.bytes.pop_back();
    return answer;
  }
  if (!in_time) return {{}, fmt::format("took longer than {}", duration_text(limits.seconds))};
  return {{}, "crashed or needed too much memory"};
}

}  // namespace piola
