// SPDX-License-Identifier: Apache-2.0
#include "support/places.hpp"

namespace piola::testing {

std::string source_folder() { return PIOLA_SOURCE_DIR; }
std::string program() { return PIOLA_PROGRAM; }

}  // namespace piola::testing
