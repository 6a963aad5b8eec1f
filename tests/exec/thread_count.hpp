// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/threads.hpp"

namespace piola::testing {

/// Sets the number of threads while it lives and puts it back.
class Threads {
 public:
  explicit Threads(int n) : before_(exec_host::threads()) { exec_host::set_threads(n); }
  Threads(Threads const&) = delete;
  Threads& operator=(Threads const&) = delete;
  ~Threads() { exec_host::set_threads(before_); }

 private:
  int before_;
};

}  // namespace piola::testing
