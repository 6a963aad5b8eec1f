// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include <numbers>

namespace piola::inline PIOLA_BACKEND {

/// Circumference of the circle with this radius: the measure of a ring of an axisymmetric body [m].
template <class T>
PIOLA_FN T circle(T const& radius) {
  return (2 * std::numbers::pi) * radius;
}

}  // namespace piola::inline PIOLA_BACKEND
