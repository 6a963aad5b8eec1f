// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

namespace piola {

/// Version of the library, "major.minor.patch"; the build system is its only source.
std::string_view version();

}  // namespace piola
