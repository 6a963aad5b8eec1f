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

/// Does work that may crash, hang or devour memory in a copy of this process, which ends after it, and waits for the
/// answer. The work must not use threads, nor anything that other threads of this process may hold.
ChildAnswer done_by_child(std::function<std::string()> const& work, ChildLimits const& limits);

}  // namespace piola
