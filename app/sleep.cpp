// SPDX-License-Identifier: Apache-2.0
#include "sleep.hpp"
#include <array>
#include <climits>
#include <cstdlib>
#include <sys/auxv.h>
#include <unistd.h>

namespace piola::app {

void sleep_while_waiting(char** arguments) {
  for (char const* const variable : {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "KMP_BLOCKTIME"}) {
    if (std::getenv(variable) != nullptr) return;
  }
  // Without a base the loader was asked by name to start the program, so that /proc/self/exe is the loader.
  if (::getauxval(AT_BASE) == 0) return;
  std::array<char, PATH_MAX> program{};
  ::ssize_t const length = ::readlink("/proc/self/exe", program.data(), program.size() - 1);
  if (length <= 0) return;
  ::setenv("GOMP_SPINCOUNT", "1000", 1);  // turns of GCC's OpenMP
  ::setenv("KMP_BLOCKTIME", "0", 1);      // milliseconds of LLVM's
  ::execv(program.data(), arguments);
}

}  // namespace piola::app
