// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace piola {

/// A place [m] or a direction in space.
using Point3 = std::array<double, 3>;

}  // namespace piola
