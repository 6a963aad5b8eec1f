// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

/// Paths of this build. Only places.cpp contains them, so the compiler cache serves all other files in any folder.
namespace piola::testing {

std::string source_folder();  ///< the root of the repository
std::string program();        ///< path of the program; "" if it is not built

}  // namespace piola::testing
