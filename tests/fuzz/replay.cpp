// SPDX-License-Identifier: Apache-2.0
// Feeds stored inputs to a fuzz target, so that the corpus is part of the ordinary tests and needs no clang.
// Usage: NAME_replay FOLDER...
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

int main(int count, char** words) {
  int inputs = 0;
  for (int w = 1; w < count; ++w) {
    for (auto const& entry : std::filesystem::recursive_directory_iterator(words[w])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      std::string const text{std::istreambuf_iterator<char>(file), {}};
      std::cout << entry.path().string() << std::endl;  // the last line names the culprit if the target aborts
      LLVMFuzzerTestOneInput(reinterpret_cast<std::uint8_t const*>(text.data()), text.size());
      ++inputs;
    }
  }
  std::cout << inputs << " inputs\n";
  return inputs > 0 ? 0 : 1;
}
