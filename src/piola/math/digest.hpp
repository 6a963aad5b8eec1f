// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/hash.hpp"
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

namespace piola {

/// Incremental 64-bit hash of bytes, to distinguish contents. Contents that differ by accident collide with probability
/// 2^-64. Not cryptographic.
class Digest {
 public:
  /// `bytes`: how many will come in all.
  explicit Digest(std::uint64_t bytes) : sum_(hash_mix(bytes)) {}
  /// All pieces but the last must hold a multiple of 8 bytes.
  void add(std::span<std::byte const> piece) {
    while (!piece.empty()) {
      std::uint64_t word = 0;
      std::size_t const some = std::min(piece.size(), sizeof(word));
      std::memcpy(&word, piece.data(), some);
      sum_ = hash_mix(sum_ ^ word) + 0x9E3779B97F4A7C15U;
      piece = piece.subspan(some);
    }
  }
  void add(std::string_view piece) { add(std::as_bytes(std::span(piece.data(), piece.size()))); }
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_;
};

}  // namespace piola
