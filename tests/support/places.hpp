// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

/// Where this build stands. In one file, so that the others are compiled alike wherever it does and the compiler cache
/// knows them.
namespace piola::testing {

std::string source_folder();  ///< the root of the repository
std::string program();        ///< path of the program; "" if it is not built

}  // namespace piola::testing
