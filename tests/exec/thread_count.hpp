// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/threads.hpp"
#include <array>

namespace piola::testing {

/// Thread counts whose results must be equal bit for bit. Odd counts split loops at other places than 2 does.
inline constexpr std::array thread_counts{1, 2, 3, 7};

/// Sets the number of threads for its lifetime and restores it in its destructor. Sets the minimal grain size to 1, so
/// that even short loops use all threads.
class Threads {
 public:
  explicit Threads(int n) : before_(exec_host::threads()), share_(exec_host::set_min_grain_size(1)) {
    exec_host::set_threads(n);
  }
  Threads(Threads const&) = delete;
  Threads& operator=(Threads const&) = delete;
  ~Threads() {
    exec_host::set_threads(before_);
    exec_host::set_min_grain_size(share_);
  }

 private:
  int before_, share_;
};

}  // namespace piola::testing
