// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/state_hash.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/math/hash.hpp"
#include <bit>
#include <fmt/format.h>

namespace piola {
namespace {

std::uint64_t seed_of(std::string_view name) {
  std::uint64_t seed = 0;
  for (char const letter : name) seed = hash_mix(seed + static_cast<unsigned char>(letter) + 1);
  return seed;
}

std::uint64_t hash_of(std::uint64_t seed, std::uint64_t place, double value) {
  return hash_mix(hash_mix(seed + place) + std::bit_cast<std::uint64_t>(value));
}

struct HashSum {
  std::uint64_t value = 0;
  void add(HashSum const& other) { value += other.value; }
};

}  // namespace

void StateHash::put(std::string_view name, std::span<double const> values) {
  if (comm::rank() != 0) return;
  std::uint64_t const seed = seed_of(name);
  for (std::size_t k = 0; k < values.size(); ++k) sum_ += hash_of(seed, k, values[k]);
}

void StateHash::put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values) {
  if (!rows.places) return put(name, values);
  auto const columns = static_cast<std::size_t>(rows.columns);
  PIOLA_EXPECTS(values.size() == rows.places->size() * columns);
  std::uint64_t const seed = seed_of(name);
  for (std::size_t k = 0; k < values.size(); ++k) {
    auto const row = static_cast<std::uint64_t>((*rows.places)[k / columns]);
    sum_ += hash_of(seed, row * columns + k % columns, values[k]);
  }
}

void StateHash::end_rows() {
  HashSum sum{sum_};
  comm::allreduce_sum(sum);
  sum_ = sum.value;
}

std::string StateHash::text() const { return fmt::format("{:016x}", sum_); }

}  // namespace piola
