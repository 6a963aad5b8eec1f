// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include <cstdint>

namespace piola {

/// Reduction payload of failures: the failure at the lowest particle id wins.
struct FirstFailure {
  std::uint64_t id = ~std::uint64_t{0};  ///< the largest number where there is none
  Index index = FailureSlot::none;
  int code = 0;

  FirstFailure() = default;
  explicit FirstFailure(FailureSlot const& slot) : index(slot.index), code(slot.code) {
    if (index != FailureSlot::none) id = static_cast<std::uint64_t>(slot.id != nullptr ? slot.id[index] : index);
  }
  void add(FirstFailure const& other) {
    if (other.id < id) *this = other;
  }
  void put(FailureSlot& slot) const {
    slot.index = index;
    slot.code = code;
  }
};

}  // namespace piola
