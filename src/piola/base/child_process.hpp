// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace piola {

struct ChildLimits {
  double seconds;      ///< of wall clock
  std::size_t memory;  ///< on top of what this process holds [bytes]
};

struct ChildAnswer {
  std::string bytes;    ///< what the work returned
  std::string trouble;  ///< empty, or why there is no answer: "took longer than 5 s"
};

/// Runs work that may crash, hang or exhaust memory in a forked child process and waits for its result. The work must
/// not use threads, nor locks that other threads of this process may hold.
ChildAnswer run_in_child_process(std::function<std::string()> const& work, ChildLimits const& limits);

}  // namespace piola
