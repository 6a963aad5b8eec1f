// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <string>

namespace piola {

/// Hash of the saved state of a formulation: the sum modulo 2^64 of a hash of each value with its place. Ranks add the
/// hashes of their own rows, so that no rank needs the rows of the other ones.
class StateHash final : public StateWriter {
 public:
  void put(std::string_view name, std::span<double const> values) override;
  void put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values) override;
  void end_rows() override;
  /// The hash in 16 hexadecimal digits, after end_rows().
  std::string text() const;

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace piola
