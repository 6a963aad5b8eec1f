// SPDX-License-Identifier: Apache-2.0
// Whatever bytes a case file holds, the reader returns a case or throws InputError, and nothing else happens.
#include "piola/model/read_case.hpp"
#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  // The first line may hold settings, so that they are exercised too: "#set a=b".
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  std::vector<std::string> overrides;
  if (text.starts_with("#set ")) overrides.emplace_back(text.substr(5, text.find('\n') - 5));
  try {
    piola::read_case_text(text, "fuzz.toml", overrides, {.particles = 5000, .memory = false});
  } catch (piola::InputError const&) {
  }
  return 0;
}
