// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace piola {

/// Version of the library, "major.minor.patch"; the build system is its only source.
std::string_view version();

/// The build id (40 hexadecimal digits) that the linker gave the program, or the Python module, that this code is part
/// of: a digest of what was linked. Empty if there is none.
std::string build_id();

}  // namespace piola
