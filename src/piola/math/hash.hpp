// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace piola {

/// Bijective mixing of 64 bits (the finaliser of SplitMix64: Steele, Lea, Flood, OOPSLA 2014).
constexpr std::uint64_t hash_mix(std::uint64_t number) {
  number = (number ^ (number >> 30)) * 0xBF58476D1CE4E5B9U;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EBU;
  return number ^ (number >> 31);
}

/// Pseudo-random number in (0, 1) for a seed and a number.
constexpr double uniform(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t const bits = hash_mix(hash_mix(seed + 0x9E3779B97F4A7C15U) + number * 0x9E3779B97F4A7C15U);
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

}  // namespace piola
