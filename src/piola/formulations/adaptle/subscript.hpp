// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cstddef>

namespace piola::adaptle {

/// A particle's index in arrays of all particles.
template <class Number>
std::size_t at(Number i) {
  return static_cast<std::size_t>(i);
}

}  // namespace piola::adaptle
