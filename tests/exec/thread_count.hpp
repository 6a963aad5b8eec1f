// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/threads.hpp"
#include <array>

namespace piola::testing {

/// Numbers of threads that must give the same bits: one, the same partition twice, and odd ones that cut elsewhere.
inline constexpr std::array thread_counts{1, 2, 3, 7};

/// Sets the number of threads while it lives and puts it back. Loops are shared by all of them however few particles
/// there are.
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
