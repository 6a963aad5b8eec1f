// SPDX-License-Identifier: Apache-2.0
#include "signals.hpp"
#include "piola/materials/block_law.hpp"
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <thread>
#include <unistd.h>

namespace piola::app {
namespace {

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

std::atomic<std::int64_t> first_signal{0};  ///< when it came [ms]; 0: not yet

std::int64_t milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1000} * now.tv_sec + now.tv_nsec / 1'000'000 + 1;
}

char const* name_of_crash(int signal) {
  switch (signal) {
    case SIGSEGV: return "SIGSEGV: access to memory that is not its own";
    case SIGBUS: return "SIGBUS: access to memory that does not exist";
    case SIGFPE: return "SIGFPE: division of integers by zero";
    case SIGILL: return "SIGILL: an instruction that this processor does not have";
    default: return "SIGABRT";
  }
}

extern "C" void on_stop_signal(int signal, siginfo_t* info, void*) {
  constexpr std::int64_t least_gap = 500;  // ms between two stop signals
  std::int64_t const now = milliseconds();
  std::int64_t before = 0;
  if (first_signal.compare_exchange_strong(before, now)) {
    stop_signal = signal;
    return;
  }
  bool const from_keyboard = info != nullptr && info->si_code == SI_KERNEL && signal == SIGINT;
  if (from_keyboard || now - before >= least_gap) ::_exit(128 + signal);
}

extern "C" void on_checkpoint_signal(int signal, siginfo_t*, void*) {
  int none = 0;
  if (signal == SIGUSR1)
    checkpoint_signal = signal;
  else
    stop_signal.compare_exchange_strong(none, signal);
}

constexpr std::array crash_signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
std::array<struct sigaction, crash_signals.size()> before_crash;  ///< what was done on them before, as by sanitizers

/// Says that code of a user's library crashed, if it did, then does what was done on the signal before.
extern "C" void on_crash(int signal, siginfo_t*, void*) {
  if (char const* const law = running_block_law()) {
    for (char const* text : {"piola: the law ", law, " crashed in its library (", name_of_crash(signal),
                             ") - try it with 'piola test-material', or build it with -g -fsanitize=address\n"})
      if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  }
  auto const place = std::find(crash_signals.begin(), crash_signals.end(), signal) - crash_signals.begin();
  sigaction(signal, &before_crash[static_cast<std::size_t>(place)], nullptr);
  ::raise(signal);
}

void on(int signal, void (*handler)(int, siginfo_t*, void*)) {
  struct sigaction action {};
  action.sa_sigaction = handler;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

std::atomic<int> stop_signal{0}, checkpoint_signal{0};

void catch_stop_signals() {
  on(SIGINT, on_stop_signal);
  on(SIGTERM, on_stop_signal);
  if (!is_ignored(SIGHUP)) on(SIGHUP, on_stop_signal);
}

void tell_crashes_of_laws() {
  for (std::size_t k = 0; k < crash_signals.size(); ++k) {
    sigaction(crash_signals[k], nullptr, &before_crash[k]);
    on(crash_signals[k], on_crash);
  }
}

void ignore_stop_signals() {
  for (int const signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
}

void catch_checkpoint_signals() {
  on(SIGUSR1, on_checkpoint_signal);
  on(SIGUSR2, on_checkpoint_signal);
}

bool wait_unless_stopped(double seconds) {
  auto const until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < until) {
    if (stop_signal != 0) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

}  // namespace piola::app
