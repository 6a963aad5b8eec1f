// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cstddef>

namespace piola::adaptle {

/// A particle's place in arrays of all particles.
inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace piola::adaptle
