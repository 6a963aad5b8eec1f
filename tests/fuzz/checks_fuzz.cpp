// SPDX-License-Identifier: Apache-2.0
// Whatever bytes a checks.toml holds, the reader returns checks or throws InputError.
#include "piola/base/errors.hpp"
#include "piola/verification/verify.hpp"
#include "odd_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  static piola::fuzz::ScratchFile const scratch("checks.toml");
  scratch.write({reinterpret_cast<char const*>(data), size});
  try {
    piola::read_checks(scratch.path());
  } catch (piola::InputError const&) {
  }
  return 0;
}
