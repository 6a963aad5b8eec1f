// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace piola {

/// Everything that the results of a run depend on, as digests of 16 hexadecimal digits. Two runs with the same `run`
/// give the same results, bit for bit.
struct Identity {
  std::string run;  ///< digest of all below; empty: not known, equal to no other
  std::string
      case_text;  ///< of the case with its settings, without comments, layout and the keys that change no result
  std::vector<std::pair<std::string, std::string>> files;  ///< as the case names them, with the digest of the content
  std::string program;                                     ///< version and build
  std::string backend;                                     ///< instruction sets
};

}  // namespace piola
